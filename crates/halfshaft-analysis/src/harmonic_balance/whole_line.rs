//! The variational equation in the angles of all groups.

use halfshaft_dynamics::{Connection, EquationsOfMotion};

use super::panels::{TERMS, Tangent};
use super::structure::{Structure, dampers, springs, sums, with_speed};

/// The whole line: the columns are changes of the twists of its tree and of their rates.
#[derive(Debug)]
pub(super) struct WholeLine<'e> {
    equations: &'e EquationsOfMotion,
    connections: Vec<usize>,
    joints: Vec<[Joint; 2]>,
    bodies: Vec<Body>,
    with_speed: bool,
}

/// Where a connection meets a group.
#[derive(Clone, Copy, Debug)]
struct Joint {
    group: usize,
    /// What an angle of the group adds to the twist; nothing at ground.
    ratio: f64,
    /// Whether the connection is the first or the last of the group in their order.
    first: bool,
    last: bool,
}

/// What a group needs to answer to torques.
#[derive(Debug)]
struct Body {
    yielding: f64,
    damping: f64,
}

impl<'e> WholeLine<'e> {
    pub(super) fn new(equations: &'e EquationsOfMotion) -> Self {
        let ground = equations.inertia.iter().zip(&equations.ground_damping);
        Self {
            connections: (0..equations.connections.len()).collect(),
            joints: joints(equations),
            bodies: ground.map(|(m, d)| Body { yielding: 1.0 / m, damping: *d }).collect(),
            with_speed: with_speed(equations),
            equations,
        }
    }

    /// The equations that it is made of.
    pub(super) fn equations(&self) -> &'e EquationsOfMotion {
        self.equations
    }

    /// The coefficients of the angles two powers of time above `power`. What springs do at a power and
    /// at the next is one pass over the same twists, so that of two passes the second has it: only its
    /// dampers wait for the rates.
    #[inline(always)]
    fn pass<const W: usize, const FUSED: bool, const SECOND: bool>(
        &self,
        power: usize,
        tangents: &[Tangent],
        angles: &mut [[f64; W]],
        twists: &mut [[f64; W]],
        (net, kept): (&mut [[f64; W]], &mut [[f64; W]]),
    ) {
        let groups = self.bodies.len();
        let (known, later) = angles.split_at_mut((power + 2) * groups);
        let rates = &known[(power + 1) * groups..];
        let rows = twists.chunks_exact_mut(TERMS).zip(kept);
        for ((joints, tangent), (row, kept)) in self.joints.iter().zip(tangents).zip(rows) {
            row[power + 1] = twist::<W, FUSED>(joints, rates);
            let mut torque = *kept;
            if !SECOND {
                (torque, *kept) = springs::<W, FUSED>(tangent, row, power);
            }
            dampers::<W, FUSED>(tangent, row, power, &mut torque);
            for joint in joints {
                let at = joint.group;
                let sum = if joint.first {
                    torque.map(|torque| -joint.ratio * torque)
                } else {
                    sums::<W, FUSED>(-joint.ratio, &torque, &net[at])
                };
                if joint.last {
                    later[at] = self.bodies[at].answer::<W, FUSED>(power, &sum, &rates[at]);
                } else {
                    net[at] = sum;
                }
            }
        }
    }
}

impl Body {
    /// Coefficient of the angle two powers of time above that of a torque.
    #[inline(always)]
    fn answer<const W: usize, const FUSED: bool>(
        &self,
        power: usize,
        net: &[f64; W],
        rate: &[f64; W],
    ) -> [f64; W] {
        let next = (power + 1) as f64;
        let factor = self.yielding / (next * (next + 1.0));
        sums::<W, FUSED>(-self.damping * next, rate, net).map(|net| factor * net)
    }
}

/// Both ends of all connections. An end at ground stands at the group of the other, where it does
/// nothing.
fn joints(equations: &EquationsOfMotion) -> Vec<[Joint; 2]> {
    let ends = |connection: &Connection| {
        let other = connection.from.or(connection.to).map_or(0, |(group, _)| group);
        let joint = |end: Option<(usize, f64)>, sign: f64| {
            let (group, ratio) = end.unwrap_or((other, 0.0));
            Joint { group, ratio: sign * ratio, first: false, last: false }
        };
        [joint(connection.from, 1.0), joint(connection.to, -1.0)]
    };
    let mut joints: Vec<[Joint; 2]> = equations.connections.iter().map(ends).collect();
    let mut seen = vec![false; equations.groups()];
    for joint in joints.iter_mut().flatten() {
        joint.first = !std::mem::replace(&mut seen[joint.group], true);
    }
    seen.fill(false);
    for joint in joints.iter_mut().flatten().rev() {
        joint.last = !std::mem::replace(&mut seen[joint.group], true);
    }
    joints
}

/// Twist of a connection from the angles of the groups, all columns of a panel.
#[inline(always)]
fn twist<const W: usize, const FUSED: bool>(
    [from, to]: &[Joint; 2],
    angles: &[[f64; W]],
) -> [f64; W] {
    let part = angles[from.group].map(|angle| from.ratio * angle);
    sums::<W, FUSED>(to.ratio, &angles[to.group], &part)
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
        for (joints, row) in self.joints.iter().zip(twists.chunks_exact_mut(TERMS)) {
            row[0] = twist::<W, FUSED>(joints, &angles[..self.bodies.len()]);
        }
        let (net, kept) = net.split_at_mut(self.bodies.len());
        for power in (0..degree - 1).step_by(2) {
            self.pass::<W, FUSED, false>(power, tangents, angles, twists, (net, kept));
            if power + 1 < degree - 1 {
                self.pass::<W, FUSED, true>(power + 1, tangents, angles, twists, (net, kept));
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
