//! Variations of a motion: how its state at a later time depends on that at the start and on the
//! excitation speed, by Taylor series along with the motion itself.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::dense::Matrix;

use super::coordinates::Coordinates;
use super::motion::{Motion, reach};
use super::series::{DEGREE, Series, ZERO};

/// One column for each coordinate of the state and one for the excitation speed (or the drive).
#[derive(Clone, Debug)]
pub(super) struct Columns {
    count: usize,
    groups: usize,
    /// Coefficients by power, group, column.
    angles: Vec<f64>,
    /// The same of the twists: connection, power, column.
    twists: Vec<f64>,
    net: Vec<f64>,
    torque: Vec<f64>,
    loads: Vec<Series>,
    /// Whether the last column is that of the drive in place of the excitation speed.
    pub(super) by_drive: bool,
}

impl Columns {
    pub(super) fn new(equations: &EquationsOfMotion, coordinates: &Coordinates) -> Self {
        let (count, groups) = (coordinates.dimension() + 1, equations.groups());
        Self {
            angles: vec![0.0; (DEGREE + 1) * groups * count],
            twists: vec![0.0; equations.connections.len() * (DEGREE + 1) * count],
            net: vec![0.0; groups * count],
            torque: vec![0.0; count],
            loads: vec![ZERO; groups],
            by_drive: false,
            count,
            groups,
        }
    }

    /// Unit changes of each coordinate of the state; none of the excitation speed yet.
    pub(super) fn start(&mut self, equations: &EquationsOfMotion, coordinates: &Coordinates) {
        let n = coordinates.dimension();
        self.angles.fill(0.0);
        let mut unit = vec![0.0; n];
        let (mut angles, mut speeds) = (vec![0.0; self.groups], vec![0.0; self.groups]);
        for column in 0..n {
            unit.fill(0.0);
            unit[column] = 1.0;
            coordinates.spread(equations, &unit, &mut angles, &mut speeds);
            for group in 0..self.groups {
                self.angles[group * self.count + column] = angles[group];
                self.angles[(self.groups + group) * self.count + column] = speeds[group];
            }
        }
    }

    /// All powers from the first two along a motion that is expanded.
    pub(super) fn expand(&mut self, motion: &Motion<'_>, t: f64, frequency: f64) {
        let n = self.count;
        if self.by_drive {
            motion.loads_by_drive(t, frequency, &mut self.loads);
        } else {
            motion.loads_by_frequency(t, frequency, &mut self.loads);
        }
        let tangents: Vec<[(Series, usize); 2]> = (motion.equations.connections.iter())
            .zip(motion.acting.iter().zip(&motion.twists))
            .map(|(connection, (acting, twist))| {
                let (stiffness, damping) = acting.tangents(connection, twist);
                [(stiffness, terms(&stiffness)), (damping, terms(&damping))]
            })
            .collect();
        for power in 0..DEGREE - 1 {
            self.net.fill(0.0);
            for (group, load) in self.loads.iter().enumerate() {
                self.net[(group + 1) * n - 1] = load[power];
            }
            for (index, tangents) in tangents.iter().enumerate() {
                self.add_connection(motion.equations, index, tangents, power);
            }
            self.next(motion.equations, power);
        }
    }

    /// Torque of one power of one connection.
    fn add_connection(
        &mut self,
        equations: &EquationsOfMotion,
        index: usize,
        [(stiffness, stiff), (damping, damped)]: &[(Series, usize); 2],
        power: usize,
    ) {
        let n = self.count;
        if power == 0 {
            self.twist(equations, index, 0);
        }
        self.twist(equations, index, power + 1);
        self.torque.fill(0.0);
        let row = |k: usize| {
            let from = (index * (DEGREE + 1) + k) * n;
            from..from + n
        };
        for (j, k) in stiffness.iter().enumerate().take((*stiff).min(power + 1)) {
            axpy(*k, &self.twists[row(power - j)], &mut self.torque);
        }
        for (j, c) in damping.iter().enumerate().take((*damped).min(power + 1)) {
            let factor = c * (power - j + 1) as f64;
            axpy(factor, &self.twists[row(power - j + 1)], &mut self.torque);
        }
        let connection = &equations.connections[index];
        for (end, sign) in [(connection.from, -1.0), (connection.to, 1.0)] {
            if let Some((group, ratio)) = end {
                axpy(sign * ratio, &self.torque, &mut self.net[group * n..(group + 1) * n]);
            }
        }
    }

    /// Twist of one connection from the angles.
    fn twist(&mut self, equations: &EquationsOfMotion, index: usize, power: usize) {
        let n = self.count;
        let from = (index * (DEGREE + 1) + power) * n;
        let out = &mut self.twists[from..from + n];
        let connection = &equations.connections[index];
        let mut fresh = true;
        for (end, sign) in [(connection.from, 1.0), (connection.to, -1.0)] {
            let Some((group, ratio)) = end else { continue };
            let at = (power * self.groups + group) * n;
            let (factor, angles) = (sign * ratio, &self.angles[at..at + n]);
            if fresh {
                out.iter_mut().zip(angles).for_each(|(y, x)| *y = factor * x);
            } else {
                axpy(factor, angles, out);
            }
            fresh = false;
        }
        if fresh {
            out.fill(0.0);
        }
    }

    /// The angles two powers on from the net torques.
    fn next(&mut self, equations: &EquationsOfMotion, power: usize) {
        let n = self.count;
        let factor = (power + 1) as f64;
        let (known, next) = self.angles.split_at_mut((power + 2) * self.groups * n);
        let rates = &known[(power + 1) * self.groups * n..];
        for group in 0..self.groups {
            let row = group * n..(group + 1) * n;
            let drag = equations.ground_damping[group] * factor;
            let inverse = 1.0 / (equations.inertia[group] * factor * (factor + 1.0));
            let sources = self.net[row.clone()].iter().zip(&rates[row.clone()]);
            for (q, (net, rate)) in next[row].iter_mut().zip(sources) {
                *q = inverse * (net - drag * rate);
            }
        }
    }

    /// The step after which the last terms are rounding.
    pub(super) fn reach(&self, speed: f64, rounding: f64) -> f64 {
        let plane = self.groups * self.count;
        // The column of the excitation speed begins with nothing and does not set the pace.
        let size = |power: usize| {
            let rows = self.angles[power * plane..(power + 1) * plane].chunks_exact(self.count);
            rows.flat_map(|row| &row[..self.count - 1]).fold(0.0_f64, |most, q| most.max(q.abs()))
        };
        reach(size(0).max(size(1) / speed), [size(DEGREE - 1), size(DEGREE)], rounding)
    }

    /// Moves all columns on by `step`.
    pub(super) fn advance(&mut self, step: f64) {
        let plane = self.groups * self.count;
        for at in 0..plane {
            let (mut value, mut slope) = (0.0, 0.0);
            for power in (0..=DEGREE).rev() {
                slope = slope * step + value;
                value = value * step + self.angles[power * plane + at];
            }
            self.angles[at] = value;
            self.angles[plane + at] = slope;
        }
    }

    /// Damping of a connection jumps by `change` where its twist passes from one piece to another:
    /// motions that pass earlier or later meet it so much longer. Source: M. di Bernardo et al.,
    /// *Piecewise-smooth Dynamical Systems* (2008), section 2.5.
    pub(super) fn jump(&mut self, equations: &EquationsOfMotion, index: usize, change: f64) {
        let n = self.count;
        self.twist(equations, index, 0);
        let at = index * (DEGREE + 1) * n;
        let twist = self.twists[at..at + n].to_vec();
        let connection = &equations.connections[index];
        for (end, sign) in [(connection.from, -1.0), (connection.to, 1.0)] {
            if let Some((group, ratio)) = end {
                // Acceleration changes by -w c v / M, passing times by -δx / v.
                let factor = sign * ratio * change / equations.inertia[group];
                let from = (self.groups + group) * n;
                axpy(factor, &twist, &mut self.angles[from..from + n]);
            }
        }
    }

    /// The columns in the coordinates of the state: those of the state, and that of the speed.
    pub(super) fn finish(
        &self,
        equations: &EquationsOfMotion,
        coordinates: &Coordinates,
    ) -> (Matrix, Vec<f64>) {
        let n = coordinates.dimension();
        let mut matrix = Matrix::zeros(n, n);
        let mut by_frequency = vec![0.0; n];
        let mut out = vec![0.0; n];
        for column in 0..=n {
            let of = |power: usize| -> Vec<f64> {
                let at = |group: usize| (power * self.groups + group) * self.count + column;
                (0..self.groups).map(|group| self.angles[at(group)]).collect()
            };
            coordinates.gather(equations, &of(0), &of(1), &mut out);
            if column == n {
                by_frequency.copy_from_slice(&out);
            } else {
                out.iter().enumerate().for_each(|(row, value)| matrix[(row, column)] = *value);
            }
        }
        (matrix, by_frequency)
    }
}

/// Terms of a series that are not zero.
fn terms(series: &Series) -> usize {
    1 + series.iter().rposition(|value| *value != 0.0).unwrap_or(0)
}

#[inline]
fn axpy(factor: f64, x: &[f64], y: &mut [f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}
