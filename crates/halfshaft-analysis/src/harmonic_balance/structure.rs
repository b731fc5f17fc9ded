//! What the variational equation is written in: the angles of all groups, or a few modes.

use halfshaft_dynamics::{Connection, EquationsOfMotion};

use super::panels::{TERMS, Tangent};

/// Coordinates of the variational equation, and its recurrence in them.
pub(super) trait Structure {
    /// Number of coordinates.
    fn coordinates(&self) -> usize;

    /// Order of the monodromy matrix.
    fn columns(&self) -> usize;

    /// Indices of the connections whose tangents the recurrence takes, in its order.
    fn connections(&self) -> &[usize];

    /// Tells `set` each column of the start, as column, power of time and coordinates: unit changes,
    /// rates measured by `speed`.
    fn start(&self, speed: f64, set: &mut dyn FnMut(usize, usize, &[f64]));

    /// All coefficients (power, coordinate) to power `degree` from those of powers 0 and 1. `twists`
    /// (connection, power) and `net` are stores. `FUSED` where the processor multiplies and adds in one.
    fn recur<const W: usize, const FUSED: bool>(
        &self,
        tangents: &[Tangent],
        degree: usize,
        coordinates: &mut [[f64; W]],
        twists: &mut [[f64; W]],
        net: &mut [[f64; W]],
    );

    /// Tells `set` the rows of the monodromy matrix of coordinates (power 0) or of their rates (1).
    fn finish(&self, power: usize, values: &[f64], set: &mut dyn FnMut(usize, f64));
}

/// The whole line: the columns are changes of the twists of its tree and of their rates.
#[derive(Debug)]
pub(super) struct WholeLine<'e> {
    equations: &'e EquationsOfMotion,
    connections: Vec<usize>,
    with_speed: bool,
    yielding: Vec<f64>,
    damped: bool,
}

impl<'e> WholeLine<'e> {
    pub(super) fn new(equations: &'e EquationsOfMotion) -> Self {
        Self {
            connections: (0..equations.connections.len()).collect(),
            with_speed: with_speed(equations),
            yielding: equations.inertia.iter().map(|m| 1.0 / m).collect(),
            damped: equations.ground_damping.iter().any(|d| *d != 0.0),
            equations,
        }
    }
}

/// Whether the speed of a free line as a whole is part of its response.
pub(super) fn with_speed(equations: &EquationsOfMotion) -> bool {
    equations.rigid.as_ref().is_some_and(|rigid| rigid.ground_damping > 0.0)
}

impl Structure for WholeLine<'_> {
    fn coordinates(&self) -> usize {
        self.equations.groups()
    }

    fn columns(&self) -> usize {
        2 * self.equations.network.tree.len() + usize::from(self.with_speed)
    }

    fn connections(&self) -> &[usize] {
        &self.connections
    }

    fn start(&self, speed: f64, set: &mut dyn FnMut(usize, usize, &[f64])) {
        let equations = self.equations;
        let tree = equations.network.tree.len();
        let mut unit = vec![0.0; tree];
        let mut values = vec![0.0; equations.groups()];
        for column in 0..2 * tree {
            let (power, edge) = (column / tree, column % tree);
            unit.fill(0.0);
            unit[edge] = if power == 0 { 1.0 } else { speed };
            equations.group_angles(&unit, &mut values);
            if let Some(rigid) = &equations.rigid {
                let mean = rigid.mean(&values);
                values.iter_mut().zip(&rigid.speeds).for_each(|(q, r)| *q -= mean * r);
            }
            set(column, power, &values);
        }
        if let (true, Some(rigid)) = (self.with_speed, &equations.rigid) {
            let values: Vec<f64> = rigid.speeds.iter().map(|r| speed * r).collect();
            set(2 * tree, 1, &values);
        }
    }

    #[inline(always)]
    fn recur<const W: usize, const FUSED: bool>(
        &self,
        tangents: &[Tangent],
        degree: usize,
        angles: &mut [[f64; W]],
        twists: &mut [[f64; W]],
        net: &mut [[f64; W]],
    ) {
        let groups = self.equations.groups();
        let connections = &self.equations.connections;
        for (index, connection) in connections.iter().enumerate() {
            twists[index * TERMS] = twist::<W, FUSED>(connection, &angles[..groups]);
        }
        for power in 0..degree - 1 {
            net.fill([0.0; W]);
            let (known, later) = angles.split_at_mut((power + 2) * groups);
            let rates = &known[(power + 1) * groups..];
            for ((connection, tangent), row) in
                connections.iter().zip(tangents).zip(twists.chunks_exact_mut(TERMS))
            {
                row[power + 1] = twist::<W, FUSED>(connection, rates);
                let torque = torque::<W, FUSED>(tangent, row, power);
                if let Some((group, ratio)) = connection.from {
                    axpy::<W, FUSED>(-ratio, &torque, &mut net[group]);
                }
                if let Some((group, ratio)) = connection.to {
                    axpy::<W, FUSED>(ratio, &torque, &mut net[group]);
                }
            }
            let scale = 1.0 / ((power + 1) * (power + 2)) as f64;
            for group in 0..groups {
                let mut net = net[group];
                let damping = self.equations.ground_damping[group];
                if self.damped && damping != 0.0 {
                    axpy::<W, FUSED>(-damping * (power + 1) as f64, &rates[group], &mut net);
                }
                let factor = scale * self.yielding[group];
                later[group] = net.map(|net| factor * net);
            }
        }
    }

    fn finish(&self, power: usize, values: &[f64], set: &mut dyn FnMut(usize, f64)) {
        let tree = &self.equations.network.tree;
        for (edge, shaft) in tree.iter().enumerate() {
            set(power * tree.len() + edge, self.equations.twist(shaft.shaft, values));
        }
        if let (true, true, Some(rigid)) = (power == 1, self.with_speed, &self.equations.rigid) {
            set(2 * tree.len(), rigid.mean(values));
        }
    }
}

/// Coefficient of the torque of a connection at a power of time, from those of its twist.
#[inline(always)]
pub(super) fn torque<const W: usize, const FUSED: bool>(
    tangent: &Tangent,
    twist: &[[f64; W]],
    power: usize,
) -> [f64; W] {
    let mut torque = [0.0_f64; W];
    let terms = tangent.stiffness_terms.min(power + 1);
    for (k, x) in tangent.stiffness[..terms].iter().zip(twist[..=power].iter().rev()) {
        axpy::<W, FUSED>(*k, x, &mut torque);
    }
    let terms = tangent.damping_terms.min(power + 1);
    for (j, c) in tangent.damping[..terms].iter().enumerate() {
        if *c != 0.0 {
            axpy::<W, FUSED>(c * (power - j + 1) as f64, &twist[power - j + 1], &mut torque);
        }
    }
    torque
}

/// Twist of a connection from the angles of the groups, all columns of a panel.
#[inline(always)]
fn twist<const W: usize, const FUSED: bool>(
    connection: &Connection,
    angles: &[[f64; W]],
) -> [f64; W] {
    let mut x = [0.0; W];
    if let Some((group, ratio)) = connection.from {
        axpy::<W, FUSED>(ratio, &angles[group], &mut x);
    }
    if let Some((group, ratio)) = connection.to {
        axpy::<W, FUSED>(-ratio, &angles[group], &mut x);
    }
    x
}

/// `y += factor x` in all lanes.
#[inline(always)]
pub(super) fn axpy<const W: usize, const FUSED: bool>(factor: f64, x: &[f64; W], y: &mut [f64; W]) {
    for lane in 0..W {
        y[lane] = sum::<FUSED>(factor, x[lane], y[lane]);
    }
}

/// `a b + c`.
#[inline(always)]
pub(super) fn sum<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    // Without the instruction `mul_add` is a slow call.
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}
