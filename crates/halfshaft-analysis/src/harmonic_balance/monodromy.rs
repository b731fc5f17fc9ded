//! Floquet multipliers of a response: the variational equation over one period by Taylor series.
//!
//! Along the orbit the connections have the tangent stiffness `k(t)` and damping `c(t)`, whose Taylor
//! coefficients follow from the harmonics. With `q = Σ q_k τ^k` the equations of motion give
//!
//! ```text
//! (k+1)(k+2) M q_{k+2} = -Σ_e w_e [ Σ_j k_j x_{k-j} + Σ_j c_j (k-j+1) x_{k-j+1} ] - (k+1) D q_{k+1}
//! ```
//!
//! for all columns of the monodromy matrix at once, to degree 20, with the step that keeps the last
//! terms at rounding. Steps end where a twist passes from one piece of its law to another. The
//! rigid-body angle of a free line is left out (its multiplier is 1 whatever happens), and so is its
//! speed unless dampers to ground couple it. An orbit that mirrors itself after half a period needs
//! half the work: its monodromy matrix is a square.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::{Piece, Pieces};
use halfshaft_numerics::Complex;
use halfshaft_numerics::dense::{Matrix, eigenvalues};
use halfshaft_numerics::harmonics::HarmonicSet;

use super::series::{DEGREE, Series, expand, friction_slope, stiffness};
use super::switching::passages;

/// An orbit as the variational equation sees it.
pub(super) struct Orbit<'o> {
    pub(super) set: &'o HarmonicSet,
    /// Frequency of the fundamental, rad/s.
    pub(super) speed: f64,
    /// Coefficients of the twist of each nonlinear connection, with the index of the connection.
    pub(super) twists: &'o [(usize, Vec<f64>)],
}

/// The variational equation of a line, with its store.
#[derive(Clone, Debug)]
pub(super) struct Variational {
    /// Pieces of the law of each connection; `None` for linear ones.
    laws: Vec<Option<Pieces>>,
    /// Inverse inertias.
    yielding: Vec<f64>,
    damped: bool,
    /// Twists and rates, and the speed as a whole where it counts.
    with_speed: bool,
    columns: usize,
    /// `q_k`, row-major: power, group, column.
    angles: Vec<f64>,
    /// `x_k` of the connection at hand for all powers, connection by connection.
    twists: Vec<f64>,
    net: Vec<f64>,
    torque: Vec<f64>,
    slope: Vec<f64>,
    reference_speed: f64,
    /// Instructions of the processor at hand.
    arch: pulp::Arch,
}

/// Size of the last terms of a step relative to the first.
const ROUNDING: f64 = 1e-12;
/// Terms of a tangent stiffness that change a step by less than this part are left out.
const NEGLIGIBLE: f64 = 1e-17;
/// A step is at most so many times as long as the one before.
const LARGEST_GROWTH: f64 = 2.0;
/// Steps a period at most.
const MOST_STEPS: usize = 100_000;

/// Work that runs with the widest instructions of the processor.
struct Wide<F>(F);

impl<R, F: FnOnce() -> R> pulp::NullaryFnOnce for Wide<F> {
    type Output = R;

    #[inline(always)]
    fn call(self) -> R {
        (self.0)()
    }
}

/// Tangent stiffness and damping of one connection over a step.
#[derive(Clone)]
struct Tangent {
    stiffness: Series,
    stiffness_terms: usize,
    damping: Series,
    damping_terms: usize,
}

impl Variational {
    pub(super) fn new(equations: &EquationsOfMotion, nonlinear: &[usize]) -> Self {
        let groups = equations.groups();
        let mut laws = vec![None; equations.connections.len()];
        for index in nonlinear {
            laws[*index] = Some(equations.connections[*index].law.pieces());
        }
        let with_speed = equations.rigid.as_ref().is_some_and(|rigid| rigid.ground_damping > 0.0);
        let columns = 2 * equations.network.tree.len() + usize::from(with_speed);
        Self {
            yielding: equations.inertia.iter().map(|m| 1.0 / m).collect(),
            damped: equations.ground_damping.iter().any(|d| *d != 0.0),
            angles: vec![0.0; (DEGREE + 1) * groups * columns],
            twists: vec![0.0; laws.len() * (DEGREE + 1) * columns],
            net: vec![0.0; groups * columns],
            torque: vec![0.0; columns],
            slope: vec![0.0; groups * columns],
            reference_speed: 1.0,
            arch: pulp::Arch::new(),
            laws,
            with_speed,
            columns,
        }
    }

    /// The multipliers of an orbit, largest modulus first; of half a period for one that mirrors
    /// itself then, whose squares are those of the period.
    pub(super) fn multipliers(
        &mut self,
        equations: &EquationsOfMotion,
        orbit: &Orbit<'_>,
    ) -> Result<Vec<Complex>, halfshaft_numerics::Error> {
        let half = orbit.set.is_odd();
        let period = std::f64::consts::TAU / orbit.speed;
        let end = if half { 0.5 * period } else { period };
        let matrix = self.monodromy(equations, orbit, end)?;
        let mut values = spectrum(&matrix)?;
        values.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
        Ok(values)
    }

    /// The fundamental matrix in twists and their rates (over the reference speed) from 0 to `end`.
    pub(super) fn monodromy(
        &mut self,
        equations: &EquationsOfMotion,
        orbit: &Orbit<'_>,
        end: f64,
    ) -> Result<Matrix, halfshaft_numerics::Error> {
        self.reference_speed = orbit.speed;
        self.start(equations);
        let mut breaks = Vec::new();
        for (connection, twist) in orbit.twists {
            if let Some(pieces) = &self.laws[*connection] {
                breaks.extend(passages(pieces, orbit.set, twist, orbit.speed, end).times);
            }
        }
        breaks.push(end);
        breaks.sort_by(f64::total_cmp);
        let mut t = 0.0;
        let mut steps = 0;
        let mut longest = f64::INFINITY;
        for goal in breaks {
            if goal - t <= 1e-13 * end {
                continue;
            }
            let pieces = self.active(orbit, f64::midpoint(t, goal));
            while t < goal {
                let reach = longest.min(goal - t);
                let tangents = self.tangents(equations, orbit, &pieces, t, reach);
                self.recur(equations, &tangents);
                let free = self.step_length();
                longest = LARGEST_GROWTH * free;
                let step = free.min(reach);
                // A sliver left over would cost a step of its own.
                let step = if goal - t - step < 1e-3 * step { goal - t } else { step };
                self.advance(step);
                t = if step == goal - t { goal } else { t + step };
                steps += 1;
                if steps > MOST_STEPS || !step.is_finite() || step <= 0.0 {
                    return Err(halfshaft_numerics::ode::Stop::StepLimit {
                        time: t,
                        limit: MOST_STEPS,
                    }
                    .into());
                }
            }
        }
        Ok(self.finish(equations))
    }

    /// The piece of each nonlinear law that the twist is on at time `t`.
    fn active(&self, orbit: &Orbit<'_>, t: f64) -> Vec<Option<Piece>> {
        let mut active = vec![None; self.laws.len()];
        for (connection, twist) in orbit.twists {
            let x = orbit.set.evaluate(twist, orbit.speed * t).0;
            if let Some(pieces) = &self.laws[*connection] {
                let list = pieces.list();
                let at = list.partition_point(|piece| piece.to < x).min(list.len() - 1);
                active[*connection] = Some(list[at].clone());
            }
        }
        active
    }

    fn tangents(
        &self,
        equations: &EquationsOfMotion,
        orbit: &Orbit<'_>,
        pieces: &[Option<Piece>],
        t: f64,
        reach: f64,
    ) -> Vec<Tangent> {
        let zero = [0.0; DEGREE + 1];
        let mut tangents: Vec<Tangent> = (equations.connections.iter())
            .map(|connection| {
                let (mut stiffness, mut damping) = (zero, zero);
                stiffness[0] = connection.law.stiffness(0.0);
                damping[0] = connection.damping;
                Tangent { stiffness, stiffness_terms: 1, damping, damping_terms: 1 }
            })
            .collect();
        let mut x = zero;
        for (connection, twist) in orbit.twists {
            let Some(piece) = &pieces[*connection] else { continue };
            let tangent = &mut tangents[*connection];
            expand(orbit.set, twist, orbit.speed, t, &mut x);
            stiffness(piece, &x, &mut tangent.stiffness);
            tangent.stiffness_terms = terms(&tangent.stiffness, reach);
            if let Some(friction) = &equations.connections[*connection].friction {
                friction_slope(friction, &x, &mut tangent.damping);
                tangent.damping[0] += equations.connections[*connection].damping;
                tangent.damping_terms = terms(&tangent.damping, reach);
            }
        }
        tangents
    }

    /// Unit twists, then unit rates (times the reference speed), as group angles and speeds.
    fn start(&mut self, equations: &EquationsOfMotion) {
        let (groups, columns) = (equations.groups(), self.columns);
        let tree = equations.network.tree.len();
        self.angles.fill(0.0);
        let mut unit = vec![0.0; tree];
        let mut column_of = vec![0.0; groups];
        for column in 0..2 * tree {
            let (power, edge) = (column / tree, column % tree);
            unit.fill(0.0);
            unit[edge] = if power == 0 { 1.0 } else { self.reference_speed };
            equations.group_angles(&unit, &mut column_of);
            if let Some(rigid) = &equations.rigid {
                let mean = rigid.mean(&column_of);
                column_of.iter_mut().zip(&rigid.speeds).for_each(|(q, r)| *q -= mean * r);
            }
            for (group, value) in column_of.iter().enumerate() {
                self.angles[(power * groups + group) * columns + column] = *value;
            }
        }
        if let (true, Some(rigid)) = (self.with_speed, &equations.rigid) {
            for (group, r) in rigid.speeds.iter().enumerate() {
                self.angles[(groups + group) * columns + 2 * tree] = self.reference_speed * r;
            }
        }
    }

    /// All Taylor coefficients of the columns from those of powers 0 and 1.
    fn recur(&mut self, equations: &EquationsOfMotion, tangents: &[Tangent]) {
        let arch = self.arch;
        arch.dispatch(Wide(|| self.recur_wide(equations, tangents)));
    }

    #[inline(always)]
    fn recur_wide(&mut self, equations: &EquationsOfMotion, tangents: &[Tangent]) {
        let (groups, n) = (equations.groups(), self.columns);
        let plane = groups * n;
        for power in 0..DEGREE - 1 {
            self.net.fill(0.0);
            for (index, (connection, tangent)) in
                equations.connections.iter().zip(tangents).enumerate()
            {
                let store = index * (DEGREE + 1) * n;
                if power == 0 {
                    self.twist_row(connection, store, 0, plane);
                }
                self.twist_row(connection, store, power + 1, plane);
                self.torque.fill(0.0);
                for j in 0..tangent.stiffness_terms.min(power + 1) {
                    let from = store + (power - j) * n;
                    axpy(tangent.stiffness[j], &self.twists[from..from + n], &mut self.torque);
                }
                for j in 0..tangent.damping_terms.min(power + 1) {
                    let from = store + (power - j + 1) * n;
                    let factor = tangent.damping[j] * (power - j + 1) as f64;
                    if factor != 0.0 {
                        axpy(factor, &self.twists[from..from + n], &mut self.torque);
                    }
                }
                if let Some((group, ratio)) = connection.from {
                    axpy(-ratio, &self.torque, &mut self.net[group * n..(group + 1) * n]);
                }
                if let Some((group, ratio)) = connection.to {
                    axpy(ratio, &self.torque, &mut self.net[group * n..(group + 1) * n]);
                }
            }
            let (known, next) = self.angles.split_at_mut((power + 2) * plane);
            let rates = &known[(power + 1) * plane..];
            let scale = 1.0 / ((power + 1) * (power + 2)) as f64;
            for group in 0..groups {
                let rows = group * n..(group + 1) * n;
                let net = &mut self.net[rows.clone()];
                let damping = equations.ground_damping[group];
                if self.damped && damping != 0.0 {
                    axpy(-damping * (power + 1) as f64, &rates[rows.clone()], net);
                }
                let factor = scale * self.yielding[group];
                next[rows].iter_mut().zip(net).for_each(|(q, net)| *q = factor * *net);
            }
        }
    }

    /// Twist coefficients of one power of one connection, from the angles.
    #[inline(always)]
    fn twist_row(
        &mut self,
        connection: &halfshaft_dynamics::Connection,
        store: usize,
        power: usize,
        plane: usize,
    ) {
        let n = self.columns;
        let row = &mut self.twists[store + power * n..store + (power + 1) * n];
        let angle = |group: usize| {
            let from = power * plane + group * n;
            &self.angles[from..from + n]
        };
        match (connection.from, connection.to) {
            (Some((a, ra)), Some((b, rb))) => {
                for ((x, a), b) in row.iter_mut().zip(angle(a)).zip(angle(b)) {
                    *x = ra * a - rb * b;
                }
            }
            (Some((a, ra)), None) => row.iter_mut().zip(angle(a)).for_each(|(x, a)| *x = ra * a),
            (None, Some((b, rb))) => row.iter_mut().zip(angle(b)).for_each(|(x, b)| *x = -rb * b),
            (None, None) => row.fill(0.0),
        }
    }

    /// The step after which the last two terms are rounding beside the first.
    fn step_length(&self) -> f64 {
        self.arch.dispatch(Wide(|| self.step_length_wide()))
    }

    #[inline(always)]
    fn step_length_wide(&self) -> f64 {
        let plane = self.net.len();
        let size = |power: usize| {
            let terms = &self.angles[power * plane..(power + 1) * plane];
            terms.iter().fold(0.0_f64, |most, value| most.max(value.abs()))
        };
        let scale = size(0).max(size(1) / self.reference_speed);
        let reach = |power: usize| {
            let last = size(power);
            if last == 0.0 {
                return f64::INFINITY;
            }
            (ROUNDING * scale / last).powf(1.0 / power as f64)
        };
        reach(DEGREE).min(reach(DEGREE - 1))
    }

    /// Moves angles and speeds on by `step`.
    fn advance(&mut self, step: f64) {
        let arch = self.arch;
        arch.dispatch(Wide(|| self.advance_wide(step)));
    }

    #[inline(always)]
    fn advance_wide(&mut self, step: f64) {
        let plane = self.net.len();
        let (low, high) = self.angles.split_at_mut(2 * plane);
        let (angle, speed) = low.split_at_mut(plane);
        // Horner's rule on value and slope at once, from the highest power down.
        let term = |power: usize| &high[(power - 2) * plane..(power - 1) * plane];
        self.net.fill(0.0);
        let value = &mut self.net;
        self.slope.fill(0.0);
        let slope = &mut self.slope;
        for power in (2..=DEGREE).rev() {
            for ((value, slope), term) in value.iter_mut().zip(slope.iter_mut()).zip(term(power)) {
                *slope = *slope * step + *value;
                *value = *value * step + term;
            }
        }
        for (((angle, speed), value), slope) in
            angle.iter_mut().zip(speed.iter_mut()).zip(value.iter()).zip(slope.iter())
        {
            // q = q0 + q1 t + t² v(t), q' = q1 + 2 t v + t² v'.
            let rate = *speed;
            *angle += step * (rate + step * value);
            *speed = rate + step * (2.0 * value + step * slope);
        }
    }

    /// Twists and rates of the columns as a square matrix.
    fn finish(&self, equations: &EquationsOfMotion) -> Matrix {
        let (groups, n) = (equations.groups(), self.columns);
        let tree = equations.network.tree.len();
        let mut matrix = Matrix::zeros(n, n);
        let mut values = vec![0.0; groups];
        for column in 0..n {
            for power in 0..2 {
                let scale = if power == 0 { 1.0 } else { 1.0 / self.reference_speed };
                for (group, value) in values.iter_mut().enumerate() {
                    *value = scale * self.angles[(power * groups + group) * n + column];
                }
                for (edge, shaft) in equations.network.tree.iter().enumerate() {
                    matrix[(power * tree + edge, column)] = equations.twist(shaft.shaft, &values);
                }
                if let (true, true, Some(rigid)) = (power == 1, self.with_speed, &equations.rigid) {
                    matrix[(2 * tree, column)] = rigid.mean(&values);
                }
            }
        }
        matrix
    }
}

/// Terms of a series until the rest is rounding over a step of the given length.
fn terms(series: &Series, reach: f64) -> usize {
    let mut power = 1.0;
    let mut largest = 0.0_f64;
    let mut last = 0;
    for (index, value) in series.iter().enumerate() {
        let size = (value * power).abs();
        largest = largest.max(size);
        if size > NEGLIGIBLE * largest {
            last = index;
        }
        power *= reach;
    }
    last + 1
}

#[inline(always)]
fn axpy(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// Eigenvalues; two by two in closed form.
fn spectrum(matrix: &Matrix) -> Result<Vec<Complex>, halfshaft_numerics::Error> {
    if matrix.rows() != 2 {
        return eigenvalues(matrix);
    }
    let (a, b, c, d) = (matrix[(0, 0)], matrix[(0, 1)], matrix[(1, 0)], matrix[(1, 1)]);
    let (mean, half) = (0.5 * (a + d), 0.5 * (a - d));
    let discriminant = half * half + b * c;
    if discriminant < 0.0 {
        let imaginary = (-discriminant).sqrt();
        return Ok(vec![Complex::new(mean, imaginary), Complex::new(mean, -imaginary)]);
    }
    // The smaller root from the product, without cancellation.
    let far = mean + mean.signum() * discriminant.sqrt();
    let determinant = a * d - b * c;
    let near = if far == 0.0 { 0.0 } else { determinant / far };
    Ok(vec![Complex::from(far), Complex::from(near)])
}
