//! Periodic orbits by Newton's method on the stroboscopic map, alone or along a branch.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_numerics::dense::{Lu, Matrix, eigenvalues};

use super::flow::{Flow, Lost, Step};

/// A periodic orbit.
#[derive(Clone, Debug)]
pub(crate) struct Orbit {
    /// State at time 0.
    pub(crate) state: Vec<f64>,
    /// Excitation speed, rad/s; the drive where that runs in its place.
    pub(crate) frequency: f64,
    /// Derivative of the state after the period (or half of it) by that before.
    pub(crate) matrix: Matrix,
    /// Derivative of the same by the excitation speed relative to its reference.
    pub(crate) by_frequency: Vec<f64>,
    /// Distance by which the orbit failed to close when last tried.
    pub(crate) residual: f64,
}

impl Orbit {
    /// The multipliers of the matrix, largest modulus first.
    pub(crate) fn multipliers(&self) -> Result<Vec<Complex>, Lost> {
        let mut values = eigenvalues(&self.matrix).map_err(|_| Lost::RanAway)?;
        values.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
        Ok(values)
    }
}

/// A linear condition `row · state + corner · (frequency / reference) = target` on an orbit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane<'p> {
    pub(crate) row: &'p [f64],
    pub(crate) corner: f64,
    pub(crate) target: f64,
}

/// Finds orbits of one line.
#[derive(Clone, Debug)]
pub(crate) struct Shooter<'e> {
    flow: Flow<'e>,
    /// Order of the fundamental of the orbits.
    base: f64,
    /// Whether orbits mirror themselves after half a period: only that half is followed.
    mirrored: bool,
    /// Excitation speed by which speeds are measured, rad/s; 1 where the drive runs.
    frequency: f64,
    /// The excitation speed where the drive runs in its place, rad/s.
    held: Option<f64>,
    /// A correction below this, relative, is the last: the state has converged to its square then, the
    /// derivatives to itself.
    enough: f64,
}

/// Iterations at most.
const MOST_ITERATIONS: usize = 12;
/// A correction below this cannot be improved on.
const FINAL: f64 = 1e-13;
/// A correction below this that does not shrink any more is rounding.
const ROUNDING: f64 = 1e-9;

impl<'e> Shooter<'e> {
    /// Orbits whose period is that of order `base` at excitation speeds near `frequency`.
    pub(crate) fn new(
        equations: &'e EquationsOfMotion,
        base: f64,
        frequency: f64,
        mirrored: bool,
    ) -> Self {
        let flow = Flow::new(equations, base * frequency);
        Self { flow, base, mirrored, frequency, held: None, enough: 0.0 }
    }

    /// Orbits at one excitation speed over the drive, the factor on all harmonic torques.
    pub(crate) fn over_drive(
        equations: &'e EquationsOfMotion,
        base: f64,
        frequency: f64,
        mirrored: bool,
    ) -> Self {
        let mut flow = Flow::new(equations, base * frequency);
        flow.vary_drive();
        Self { flow, base, mirrored, frequency: 1.0, held: Some(frequency), enough: 0.0 }
    }

    /// The same for orbits of another period or symmetry, in the same coordinates.
    pub(crate) fn of_kind(&self, base: f64, mirrored: bool) -> Self {
        Self { base, mirrored, ..self.clone() }
    }

    /// Sets the relative correction that is the last one; 0 for going on to rounding.
    pub(crate) fn set_enough(&mut self, enough: f64) {
        self.enough = enough;
    }

    /// Sets the drive where that runs; gives the excitation speed.
    fn place(&mut self, parameter: f64) -> f64 {
        let Some(frequency) = self.held else { return parameter };
        self.flow.set_drive(parameter);
        frequency
    }

    pub(crate) fn equations(&self) -> &'e EquationsOfMotion {
        self.flow.equations()
    }

    pub(crate) fn coordinates(&self) -> super::Coordinates {
        self.flow.coordinates
    }

    /// Excitation speed by which speeds are measured, rad/s.
    pub(crate) fn reference(&self) -> f64 {
        self.frequency
    }

    /// Period at an excitation speed, s.
    pub(crate) fn period(&self, frequency: f64) -> f64 {
        std::f64::consts::TAU / (self.base * self.held.unwrap_or(frequency))
    }

    /// -1 where orbits mirror themselves after half a period, else 1.
    pub(crate) fn sign(&self) -> f64 {
        if self.mirrored { -1.0 } else { 1.0 }
    }

    /// The state after the period or half of it, and how it depends on state and speed.
    fn pass(
        &mut self,
        state: &[f64],
        frequency: f64,
    ) -> Result<(Vec<f64>, Matrix, Vec<f64>), Lost> {
        let end = self.period(frequency) * if self.mirrored { 0.5 } else { 1.0 };
        let speed = self.place(frequency);
        let arrived = self.flow.run(state, speed, end, true, |_| {})?;
        let Some((matrix, mut by_frequency)) = arrived.variation else {
            return Err(Lost::NotConverged);
        };
        // A higher speed ends the period earlier.
        let turn = match self.held {
            Some(_) => 0.0,
            None => self.flow.coordinates.reference * end / frequency,
        };
        for (slope, rate) in by_frequency.iter_mut().zip(&arrived.rate) {
            *slope = (*slope - turn * rate) * self.frequency;
        }
        Ok((arrived.state, matrix, by_frequency))
    }

    /// The orbit nearest to a guess that meets a condition.
    pub(crate) fn correct(
        &mut self,
        guess: &[f64],
        frequency: f64,
        plane: &Plane<'_>,
    ) -> Result<Orbit, Lost> {
        let n = guess.len();
        let sign = self.sign();
        let mut state = guess.to_vec();
        let mut frequency = frequency;
        let mut before = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let (after, matrix, by_frequency) = self.pass(&state, frequency)?;
            let mut step: Vec<f64> = state.iter().zip(&after).map(|(x, y)| sign * x - y).collect();
            let residual = length(&step);
            let held: f64 = plane.row.iter().zip(&state).map(|(r, x)| r * x).sum();
            step.push(plane.target - held - plane.corner * frequency / self.frequency);
            let bordered = self.bordered(&matrix, &by_frequency, plane.row, plane.corner);
            let lu = Lu::new(&bordered).map_err(|_| Lost::Singular)?;
            lu.solve_in_place(&mut step).map_err(|_| Lost::Singular)?;
            let size = length(&state).max(f64::MIN_POSITIVE.sqrt());
            let correction = (length(&step[..n]) / size).hypot(step[n]);
            let stalled = correction > 0.3 * before && before < ROUNDING;
            if !correction.is_finite() || (correction > 10.0 && before < 1.0) {
                return Err(Lost::NotConverged);
            }
            if correction <= FINAL || stalled {
                return Ok(Orbit { state, frequency, matrix, by_frequency, residual });
            }
            // Newton's method must not throw the speed to nothing.
            let shrink = (0.2 / step[n].abs()).min(1.0);
            state.iter_mut().zip(&step).for_each(|(x, s)| *x += shrink * s);
            frequency += shrink * step[n] * self.frequency;
            if correction <= self.enough {
                return Ok(Orbit { state, frequency, matrix, by_frequency, residual });
            }
            before = correction;
        }
        Err(Lost::NotConverged)
    }

    /// The orbit at one excitation speed.
    pub(crate) fn at(&mut self, guess: &[f64], frequency: f64) -> Result<Orbit, Lost> {
        let row = vec![0.0; guess.len()];
        let target = frequency / self.frequency;
        self.correct(guess, frequency, &Plane { row: &row, corner: 1.0, target })
    }

    /// `[M - s I, φ_Ω; row, corner]`.
    pub(crate) fn bordered(
        &self,
        matrix: &Matrix,
        by_frequency: &[f64],
        row: &[f64],
        corner: f64,
    ) -> Matrix {
        let n = row.len();
        let sign = self.sign();
        Matrix::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (true, true) => matrix[(i, j)] - if i == j { sign } else { 0.0 },
            (true, false) => by_frequency[i],
            (false, true) => row[j],
            (false, false) => corner,
        })
    }

    /// Direction of the branch at an orbit, of unit length, with a positive share of `(row, corner)`.
    pub(crate) fn tangent(
        &self,
        orbit: &Orbit,
        row: &[f64],
        corner: f64,
    ) -> Result<(Vec<f64>, f64), Lost> {
        let n = row.len();
        let mut along = (row.to_vec(), corner);
        // Bordered by its own direction the matrix is as regular as it can be.
        for _ in 0..2 {
            let matrix = self.bordered(&orbit.matrix, &orbit.by_frequency, &along.0, along.1);
            let lu = Lu::new(&matrix).map_err(|_| Lost::Singular)?;
            let mut direction = vec![0.0; n + 1];
            direction[n] = 1.0;
            lu.solve_in_place(&mut direction).map_err(|_| Lost::Singular)?;
            let size = length(&direction);
            if !size.is_finite() || size == 0.0 {
                return Err(Lost::Singular);
            }
            let share = direction[n] / size;
            direction.truncate(n);
            direction.iter_mut().for_each(|x| *x /= size);
            along = (direction, share);
        }
        Ok(along)
    }

    /// Follows an orbit through its whole period.
    pub(crate) fn watch(&mut self, orbit: &Orbit, see: impl FnMut(&Step<'_>)) -> Result<(), Lost> {
        let end = self.period(orbit.frequency);
        let speed = self.place(orbit.frequency);
        self.flow.run(&orbit.state, speed, end, false, see)?;
        Ok(())
    }

    /// The state after a part of the period.
    pub(crate) fn after(
        &mut self,
        state: &[f64],
        frequency: f64,
        part: f64,
        see: impl FnMut(&Step<'_>),
    ) -> Result<Vec<f64>, Lost> {
        let end = part * self.period(frequency);
        let speed = self.place(frequency);
        Ok(self.flow.run(state, speed, end, false, see)?.state)
    }
}

/// Euclidean length.
pub(crate) fn length(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}
