//! Floquet multipliers of a response: the variational equation over one period by Taylor series.
//!
//! Along the orbit the connections have the tangent stiffness `k(t)` and damping `c(t)`, whose Taylor
//! coefficients follow from the harmonics. With `q = Σ q_k τ^k` the equations of motion give
//!
//! ```text
//! (k+1)(k+2) M q_{k+2} = -Σ_e w_e [ Σ_j k_j x_{k-j} + Σ_j c_j (k-j+1) x_{k-j+1} ] - (k+1) D q_{k+1}
//! ```
//!
//! for panels of columns of the monodromy matrix, to degree 20 or 40, with the step that keeps the last terms
//! at rounding in all of them. Steps end where a twist passes from one piece of its law to another. The
//! rigid-body angle of a free line is left out (its multiplier is 1 whatever happens), and so is its
//! speed unless dampers to ground couple it. An orbit that mirrors itself after half a period needs
//! half the work: its monodromy matrix is a square.

use std::cell::Cell;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::{Piece, Pieces};
use halfshaft_numerics::Complex;
use halfshaft_numerics::dense::{Matrix, eigenvalues};
use halfshaft_numerics::harmonics::HarmonicSet;

use super::panels::Panels;
use super::reduction::Reduction;
use super::series::{Truncation, Waves};
use super::side_by_side::{ORBITS, SideBySide};
use super::structure::Structure;
use super::switching::passages;
use super::tangents::{Degree, Place, linear_tangents};
use super::whole_line::WholeLine;

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
    /// Phase of the first step that the last orbit allowed: the next orbit's is much the same.
    first: Cell<f64>,
    /// A few modes that a long line with few nonlinear connections is as good as.
    reduction: Reduction,
    /// A small smooth line, several of whose orbits are taken at once.
    side_by_side: Option<SideBySide>,
}

/// Steps a period at most.
const MOST_STEPS: usize = 100_000;
/// Columns from which on series are longer.
const MANY: usize = 12;
/// Part of the longest step that the last step's terms allowed.
const CAUTION: f64 = 0.92;

impl Variational {
    pub(super) fn new(equations: &EquationsOfMotion, nonlinear: &[usize]) -> Self {
        let mut laws = vec![None; equations.connections.len()];
        for index in nonlinear {
            laws[*index] = Some(equations.connections[*index].law.pieces());
        }
        Self {
            side_by_side: SideBySide::new(equations, &laws),
            laws,
            first: Cell::new(0.0),
            reduction: Reduction::new(nonlinear),
        }
    }

    /// The same without modes, for holding them against it.
    #[cfg(test)]
    pub(super) fn of_whole_lines(mut self) -> Self {
        self.reduction = Reduction::new(&[]);
        self
    }

    /// The multipliers of an orbit, largest modulus first; of half a period for one that mirrors
    /// itself then, whose squares are those of the period.
    pub(super) fn multipliers(
        &mut self,
        equations: &EquationsOfMotion,
        orbit: &Orbit<'_>,
    ) -> Result<Vec<Complex>, halfshaft_numerics::Error> {
        let period = std::f64::consts::TAU / orbit.speed;
        let end = if orbit.set.is_odd() { 0.5 * period } else { period };
        sorted_spectrum(&self.monodromy(equations, orbit, end)?)
    }

    /// The same of many orbits, all over the same harmonics, `None` for those to be taken one by one;
    /// `None` for a line of which that is all.
    pub(super) fn multipliers_of_all(
        &self,
        equations: &EquationsOfMotion,
        orbits: &[Orbit<'_>],
    ) -> Option<Vec<Option<Vec<Complex>>>> {
        let side_by_side = self.side_by_side.as_ref()?;
        let turn = std::f64::consts::TAU;
        let mut all = Vec::with_capacity(orbits.len());
        for few in orbits.chunks(ORBITS) {
            let end = if few[0].set.is_odd() { 0.5 * turn } else { turn };
            // One alone is faster by itself.
            let several = (few.len() > 1).then_some(few);
            match several.and_then(|few| side_by_side.monodromy(equations, few, end)) {
                Some(list) => all.extend(list.iter().map(|matrix| sorted_spectrum(matrix).ok())),
                None => all.extend(few.iter().map(|_| None)),
            }
        }
        Some(all)
    }

    /// The fundamental matrix from 0 to `end`, in twists and their rates (over the fundamental
    /// frequency), or in modes where a few are as good as the line.
    pub(super) fn monodromy(
        &mut self,
        equations: &EquationsOfMotion,
        orbit: &Orbit<'_>,
        end: f64,
    ) -> Result<Matrix, halfshaft_numerics::Error> {
        self.reduction.prepare(equations, orbit.speed * orbit.set.highest() as f64);
        match self.reduction.modes() {
            Some(modes) => self.in_panels(modes, equations, orbit, end),
            None => self.in_panels(&WholeLine::new(equations), equations, orbit, end),
        }
    }

    /// Panels as wide as the matrix where it is small, else as wide as keeps the work in the
    /// cache.
    fn in_panels(
        &self,
        structure: &impl Structure,
        equations: &EquationsOfMotion,
        orbit: &Orbit<'_>,
        end: f64,
    ) -> Result<Matrix, halfshaft_numerics::Error> {
        match structure.columns() {
            0..=2 => self.run::<2>(structure, equations, orbit, end),
            3..=4 => self.run::<4>(structure, equations, orbit, end),
            5..=8 => self.run::<8>(structure, equations, orbit, end),
            _ => self.run::<16>(structure, equations, orbit, end),
        }
    }

    fn run<const W: usize>(
        &self,
        structure: &impl Structure,
        equations: &EquationsOfMotion,
        orbit: &Orbit<'_>,
        end: f64,
    ) -> Result<Matrix, halfshaft_numerics::Error> {
        let truncation =
            if structure.columns() > MANY { Truncation::LONG } else { Truncation::SHORT };
        let mut panels = Panels::<W>::new(structure, orbit.speed, truncation);
        let mut tangents = linear_tangents(equations, structure.connections());
        let mut degree = Degree::new(truncation.degree);
        let mut waves = Waves::new(orbit.set);
        let mut next = self.first.get() / orbit.speed;
        let (mut t, mut steps) = (0.0, 0);
        for goal in self.stops(orbit, end) {
            if goal - t <= 1e-13 * end {
                continue;
            }
            let pieces = self.active(orbit, f64::midpoint(t, goal));
            let mut place = Place { equations, orbit, pieces: &pieces, t, reach: goal - t };
            while t < goal {
                place.t = t;
                if next == 0.0 {
                    place.reach = goal - t;
                    place.expand(structure.connections(), &mut waves, &mut degree, &mut tangents);
                    next = panels.longest_step(structure, &tangents);
                }
                let left = goal - t;
                // A sliver left over would cost a step of its own.
                let mut step = if next > 0.8 * left { left.min(1.2 * next) } else { next };
                place.reach = step;
                place.expand(structure.connections(), &mut waves, &mut degree, &mut tangents);
                let reach = panels.step(structure, &tangents, &mut step);
                t = if step == left { goal } else { t + step };
                next = CAUTION * reach;
                if steps == 0 {
                    self.first.set(next * orbit.speed);
                }
                steps += 1;
                if steps > MOST_STEPS || !step.is_finite() || step <= 0.0 {
                    self.first.set(0.0);
                    let stop =
                        halfshaft_numerics::ode::Stop::StepLimit { time: t, limit: MOST_STEPS };
                    return Err(stop.into());
                }
            }
        }
        Ok(panels.finish(structure))
    }

    /// Times at which a twist passes a break of its law, and the end.
    fn stops(&self, orbit: &Orbit<'_>, end: f64) -> Vec<f64> {
        let mut stops = Vec::new();
        for (connection, twist) in orbit.twists {
            if let Some(pieces) = &self.laws[*connection] {
                stops.extend(passages(pieces, orbit.set, twist, orbit.speed, end).times);
            }
        }
        stops.push(end);
        stops.sort_by(f64::total_cmp);
        stops
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
}

/// Eigenvalues, largest modulus first.
///
/// # Errors
/// Where the matrix is not finite: changes grew beyond all numbers.
fn sorted_spectrum(matrix: &Matrix) -> Result<Vec<Complex>, halfshaft_numerics::Error> {
    if matrix.as_slice().iter().any(|entry| !entry.is_finite()) {
        return Err(halfshaft_numerics::Error::EigenvaluesNotConverged {
            dimension: matrix.rows(),
        });
    }
    let mut values = spectrum(matrix)?;
    values.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
    Ok(values)
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
