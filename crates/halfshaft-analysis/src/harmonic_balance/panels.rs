//! Columns of the variational equation, panel by panel, by Taylor series.
//!
//! A panel has as many columns as fit the registers and keep the coefficients of all groups in the
//! cache; all panels take the same steps.

use halfshaft_dynamics::{Connection, EquationsOfMotion};
use halfshaft_numerics::dense::Matrix;

use super::series::{DEGREE, Series};

/// Tangent stiffness and damping of one connection over a step.
#[derive(Clone)]
pub(super) struct Tangent {
    pub(super) stiffness: Series,
    pub(super) stiffness_terms: usize,
    pub(super) damping: Series,
    pub(super) damping_terms: usize,
}

/// Size of the last terms of a step relative to the first.
const ROUNDING: f64 = 1e-12;
/// Coefficients of a row.
const TERMS: usize = DEGREE + 1;

/// Columns of the variational equation at one time.
pub(super) struct Panels<const W: usize> {
    /// Angles, then speeds, of each group, panel after panel.
    state: Vec<[f64; W]>,
    next: Vec<[f64; W]>,
    /// Coefficients of the panel at hand: power, group.
    angles: Vec<[f64; W]>,
    /// The same of twists: connection, power.
    twists: Vec<[f64; W]>,
    net: Vec<[f64; W]>,
    yielding: Vec<f64>,
    columns: usize,
    groups: usize,
    /// Rates are measured by it.
    speed: f64,
    damped: bool,
    /// Instructions of the processor at hand.
    arch: pulp::Arch,
}

/// One step of one panel, or only its coefficients where no step is given, as work that runs with the
/// widest instructions of the processor: a structure and no closure, because only that is sure to be
/// compiled with them.
struct PanelStep<'p, 'e, const W: usize> {
    panels: &'p mut Panels<W>,
    equations: &'e EquationsOfMotion,
    tangents: &'e [Tangent],
    panel: usize,
    step: Option<f64>,
}

impl<const W: usize> pulp::NullaryFnOnce for PanelStep<'_, '_, W> {
    /// The longest step that the terms of the panel allow.
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { panels, equations, tangents, panel, step } = self;
        panels.load(panel);
        panels.recur(equations, tangents);
        let reach = panels.reach();
        if let Some(step) = step {
            panels.advance(panel, step);
        }
        reach
    }
}

impl<const W: usize> Panels<W> {
    /// Panels of so many columns, all zero.
    pub(super) fn new(equations: &EquationsOfMotion, columns: usize, speed: f64) -> Self {
        let groups = equations.groups();
        let count = columns.div_ceil(W);
        Self {
            state: vec![[0.0; W]; count * 2 * groups],
            next: vec![[0.0; W]; count * 2 * groups],
            angles: vec![[0.0; W]; TERMS * groups],
            twists: vec![[0.0; W]; TERMS * equations.connections.len()],
            net: vec![[0.0; W]; groups],
            yielding: equations.inertia.iter().map(|m| 1.0 / m).collect(),
            damped: equations.ground_damping.iter().any(|d| *d != 0.0),
            arch: pulp::Arch::new(),
            columns,
            groups,
            speed,
        }
    }

    /// Unit twists, then unit rates (times the reference speed), as group angles and speeds; last the
    /// speed of the whole, where it counts.
    pub(super) fn start(&mut self, equations: &EquationsOfMotion, with_speed: bool) {
        let tree = equations.network.tree.len();
        let mut unit = vec![0.0; tree];
        let mut values = vec![0.0; self.groups];
        for column in 0..2 * tree {
            let (power, edge) = (column / tree, column % tree);
            unit.fill(0.0);
            unit[edge] = if power == 0 { 1.0 } else { self.speed };
            equations.group_angles(&unit, &mut values);
            if let Some(rigid) = &equations.rigid {
                let mean = rigid.mean(&values);
                values.iter_mut().zip(&rigid.speeds).for_each(|(q, r)| *q -= mean * r);
            }
            self.set(column, power, &values);
        }
        if let (true, Some(rigid)) = (with_speed, &equations.rigid) {
            let values: Vec<f64> = rigid.speeds.iter().map(|r| self.speed * r).collect();
            self.set(2 * tree, 1, &values);
        }
    }

    fn set(&mut self, column: usize, power: usize, values: &[f64]) {
        let (panel, lane) = (column / W, column % W);
        let from = (2 * panel + power) * self.groups;
        for (row, value) in self.state[from..from + self.groups].iter_mut().zip(values) {
            row[lane] = *value;
        }
    }

    /// The longest step that the terms of all panels allow.
    pub(super) fn longest_step(
        &mut self,
        equations: &EquationsOfMotion,
        tangents: &[Tangent],
    ) -> f64 {
        let arch = self.arch;
        let count = self.state.len() / (2 * self.groups);
        (0..count)
            .map(|panel| {
                arch.dispatch(PanelStep { panels: self, equations, tangents, panel, step: None })
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// Moves all panels on by `step`, which is made shorter where their terms do not allow it; gives
    /// the longest step that they would have allowed.
    pub(super) fn step(
        &mut self,
        equations: &EquationsOfMotion,
        tangents: &[Tangent],
        step: &mut f64,
    ) -> f64 {
        let arch = self.arch;
        let panels = self.state.len() / (2 * self.groups);
        loop {
            let mut longest = f64::INFINITY;
            for panel in 0..panels {
                let length = *step;
                let step = Some(length);
                let work = PanelStep { panels: self, equations, tangents, panel, step };
                let reach = arch.dispatch(work);
                longest = longest.min(reach);
                if longest < 0.8 * length {
                    break;
                }
            }
            if longest >= 0.8 * *step || longest.is_nan() {
                std::mem::swap(&mut self.state, &mut self.next);
                return longest;
            }
            *step = 0.95 * longest;
        }
    }

    #[inline(always)]
    fn load(&mut self, panel: usize) {
        let from = 2 * panel * self.groups;
        self.angles[..2 * self.groups].copy_from_slice(&self.state[from..from + 2 * self.groups]);
    }

    /// All coefficients of the panel at hand from those of powers 0 and 1.
    #[inline(always)]
    fn recur(&mut self, equations: &EquationsOfMotion, tangents: &[Tangent]) {
        let groups = self.groups;
        for (index, connection) in equations.connections.iter().enumerate() {
            self.twists[index * TERMS] = twist(connection, &self.angles[..groups]);
        }
        for power in 0..DEGREE - 1 {
            self.net.fill([0.0; W]);
            let (known, later) = self.angles.split_at_mut((power + 2) * groups);
            let rates = &known[(power + 1) * groups..];
            for ((connection, tangent), row) in
                equations.connections.iter().zip(tangents).zip(self.twists.chunks_exact_mut(TERMS))
            {
                row[power + 1] = twist(connection, rates);
                let mut torque = [0.0_f64; W];
                let terms = tangent.stiffness_terms.min(power + 1);
                for (k, x) in tangent.stiffness[..terms].iter().zip(row[..=power].iter().rev()) {
                    axpy(*k, x, &mut torque);
                }
                let terms = tangent.damping_terms.min(power + 1);
                for (j, c) in tangent.damping[..terms].iter().enumerate() {
                    if *c != 0.0 {
                        axpy(c * (power - j + 1) as f64, &row[power - j + 1], &mut torque);
                    }
                }
                if let Some((group, ratio)) = connection.from {
                    axpy(-ratio, &torque, &mut self.net[group]);
                }
                if let Some((group, ratio)) = connection.to {
                    axpy(ratio, &torque, &mut self.net[group]);
                }
            }
            let scale = 1.0 / ((power + 1) * (power + 2)) as f64;
            for group in 0..groups {
                let net = &mut self.net[group];
                let damping = equations.ground_damping[group];
                if self.damped && damping != 0.0 {
                    axpy(-damping * (power + 1) as f64, &rates[group], net);
                }
                let factor = scale * self.yielding[group];
                for (q, net) in later[group].iter_mut().zip(net.iter()) {
                    *q = factor * net;
                }
            }
        }
    }

    /// The step after which the last two terms are rounding beside the first.
    #[inline(always)]
    fn reach(&self) -> f64 {
        let size = |power: usize| {
            let rows = &self.angles[power * self.groups..(power + 1) * self.groups];
            let mut most = [0.0_f64; W];
            for row in rows {
                for (most, value) in most.iter_mut().zip(row) {
                    *most = most.max(value.abs());
                }
            }
            most.into_iter().fold(0.0, f64::max)
        };
        let scale = size(0).max(size(1) / self.speed);
        let reach = |power: usize| {
            let last = size(power);
            if last == 0.0 {
                return f64::INFINITY;
            }
            (ROUNDING * scale / last).powf(1.0 / power as f64)
        };
        reach(DEGREE).min(reach(DEGREE - 1))
    }

    /// Writes angles and speeds after `step` to the next state.
    #[inline(always)]
    fn advance(&mut self, panel: usize, step: f64) {
        let groups = self.groups;
        let from = 2 * panel * groups;
        for group in 0..groups {
            // q = q0 + q1 t + t² v(t): value and slope of v by Horner's rule.
            let (mut value, mut slope) = ([0.0_f64; W], [0.0_f64; W]);
            for power in (2..=DEGREE).rev() {
                let term = &self.angles[power * groups + group];
                for lane in 0..W {
                    slope[lane] = slope[lane] * step + value[lane];
                    value[lane] = value[lane] * step + term[lane];
                }
            }
            let (angle, rate) = (self.angles[group], self.angles[groups + group]);
            for lane in 0..W {
                let (v, s) = (value[lane], slope[lane]);
                self.next[from + group][lane] = angle[lane] + step * (rate[lane] + step * v);
                self.next[from + groups + group][lane] = rate[lane] + step * (2.0 * v + step * s);
            }
        }
    }

    /// Twists and rates of the columns as a square matrix.
    pub(super) fn finish(&self, equations: &EquationsOfMotion, with_speed: bool) -> Matrix {
        let (groups, n) = (self.groups, self.columns);
        let tree = equations.network.tree.len();
        let mut matrix = Matrix::zeros(n, n);
        let mut values = vec![0.0; groups];
        for column in 0..n {
            for power in 0..2 {
                let scale = if power == 0 { 1.0 } else { 1.0 / self.speed };
                let from = (2 * (column / W) + power) * groups;
                for (value, row) in values.iter_mut().zip(&self.state[from..from + groups]) {
                    *value = scale * row[column % W];
                }
                for (edge, shaft) in equations.network.tree.iter().enumerate() {
                    matrix[(power * tree + edge, column)] = equations.twist(shaft.shaft, &values);
                }
                if let (true, true, Some(rigid)) = (power == 1, with_speed, &equations.rigid) {
                    matrix[(2 * tree, column)] = rigid.mean(&values);
                }
            }
        }
        matrix
    }
}

/// Twist of a connection from the angles of the groups, all columns of a panel.
#[inline(always)]
fn twist<const W: usize>(connection: &Connection, angles: &[[f64; W]]) -> [f64; W] {
    let mut x = [0.0; W];
    if let Some((group, ratio)) = connection.from {
        axpy(ratio, &angles[group], &mut x);
    }
    if let Some((group, ratio)) = connection.to {
        axpy(-ratio, &angles[group], &mut x);
    }
    x
}

#[inline(always)]
fn axpy<const W: usize>(factor: f64, x: &[f64; W], y: &mut [f64; W]) {
    for lane in 0..W {
        y[lane] += factor * x[lane];
    }
}
