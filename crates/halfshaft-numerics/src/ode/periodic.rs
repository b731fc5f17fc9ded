//! Periodic orbits of periodic systems by shooting, with their Floquet multipliers.
//!
//! For a system with `f(t + T, y) = f(t, y)` let `P(y0)` be the state at `t0 + T` of the solution
//! that starts at `y0` at time `t0` (the stroboscopic map). A periodic orbit solves `P(y0) = y0`;
//! Newton's method needs `∂P/∂y0`, the monodromy matrix, from the variational equation. Its
//! eigenvalues at the orbit are the Floquet multipliers: all of modulus below one, and the orbit is
//! asymptotically stable. A subharmonic of order `m` is an orbit of period `m T`.

use std::cell::RefCell;

use super::dop853::Dop853;
use super::{Linearised, Settings, Statistics, Step, System, Variational};
use crate::complex::Complex;
use crate::dense::{Matrix, eigenvalues};
use crate::error::{Error, all_finite, has_length};
use crate::newton;

/// The numbers of the search.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicSettings {
    /// Integration over a period. Default: tolerances 1e-11, so that its error stays well below the
    /// tolerance of Newton's method.
    pub integration: Settings,
    /// Newton's method on the initial state. Default: its own defaults.
    pub newton: newton::Settings,
}

impl Default for PeriodicSettings {
    fn default() -> Self {
        Self { integration: Settings::with_tolerance(1e-11), newton: newton::Settings::default() }
    }
}

/// A periodic orbit, or the best approximation that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicOrbit {
    /// The time at which the state is taken.
    pub start_time: f64,
    /// The period.
    pub period: f64,
    /// The state of the orbit at the start time.
    pub state: Vec<f64>,
    /// The derivative of the state after one period with respect to the state.
    pub monodromy: Matrix,
    /// Its eigenvalues, largest modulus first.
    pub multipliers: Vec<Complex>,
    /// Largest difference between the state after one period and the state.
    pub residual: f64,
    /// How Newton's method fared; ask its `converged` before trusting the rest.
    pub report: newton::Report,
    /// The integrations' work, all together.
    pub statistics: Statistics,
}

/// Finds a periodic orbit near a guess of its state at `start_time`.
///
/// Failing to converge is not an error: the report says why the iteration ended, and the orbit is
/// the best point so far.
///
/// # Errors
///
/// [`Error::Length`], [`Error::NonFinite`] or [`Error::Setting`] for arguments that do not fit,
/// [`Error::Stopped`] if the solution from the guess does not live for one period,
/// [`Error::EigenvaluesNotConverged`].
pub fn find_orbit<S: Linearised>(
    system: &mut S,
    start_time: f64,
    period: f64,
    guess: &[f64],
    settings: &PeriodicSettings,
) -> Result<PeriodicOrbit, Error> {
    let dimension = system.dimension();
    has_length("guess of the orbit", dimension, guess.len())?;
    all_finite("period", &[period])?;
    let integration = Variational::<S>::settings(&settings.integration, dimension);
    integration.validate(dimension + dimension * dimension)?;
    let map = RefCell::new(Map::new(system, start_time, period, integration));
    map.borrow_mut().shoot(guess)?;

    let solution = newton::solve(
        |state, residual| {
            let mut map = map.borrow_mut();
            match map.shoot(state) {
                Ok(()) => map.write_residual(residual),
                // A trial step to where the solution does not live is one that was too long.
                Err(_) => residual.fill(f64::NAN),
            }
        },
        // Newton's method asks for a Jacobian only where it has just taken a residual.
        |_, jacobian| map.borrow().write_jacobian(jacobian),
        guess,
        &settings.newton,
    )?;
    map.borrow_mut().shoot(&solution.unknowns)?;
    map.into_inner().orbit(solution)
}

impl PeriodicOrbit {
    /// The orbit at `count` uniformly spaced times from `start_time` on, the end of the period left
    /// out: component `i` in row `i` of the matrix, ready for [`crate::fourier`].
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if the system is not of the orbit's dimension, [`Error::Setting`] or
    /// [`Error::Stopped`] from the integration.
    pub fn sample<S: System>(
        &self,
        system: &mut S,
        count: usize,
        settings: &Settings,
    ) -> Result<Matrix, Error> {
        let mut samples = Matrix::zeros(self.state.len(), count);
        let mut state = self.state.clone();
        let time = |k: usize| self.start_time + self.period * k as f64 / count as f64;
        let mut integrator = Dop853::new(system, self.start_time, &state, settings.clone())?;
        let direction = self.period.signum();
        for k in 0..count {
            while direction * integrator.time() < direction * time(k) {
                integrator.step(self.start_time + self.period)?;
            }
            integrator.dense().evaluate(time(k), &mut state);
            for (component, value) in state.iter().enumerate() {
                samples[(component, k)] = *value;
            }
        }
        Ok(samples)
    }
}

/// The stroboscopic map, which remembers its last image.
struct Map<'a, S> {
    system: &'a mut S,
    start_time: f64,
    period: f64,
    settings: Settings,
    statistics: Statistics,
    /// The state that was mapped last, and what came out: image and monodromy matrix.
    argument: Vec<f64>,
    image: Vec<f64>,
}

impl<'a, S: Linearised> Map<'a, S> {
    fn new(system: &'a mut S, start_time: f64, period: f64, settings: Settings) -> Self {
        Self {
            system,
            start_time,
            period,
            settings,
            statistics: Statistics::default(),
            argument: Vec::new(),
            image: Vec::new(),
        }
    }

    /// Integrates the variational equation over one period, unless that was just done.
    fn shoot(&mut self, state: &[f64]) -> Result<(), Error> {
        if self.argument == state {
            return Ok(());
        }
        let initial = Variational::<S>::initial_state(state);
        let equation = Variational::new(&mut *self.system);
        let mut integrator =
            Dop853::new(equation, self.start_time, &initial, self.settings.clone())?;
        let outcome = loop {
            match integrator.step(self.start_time + self.period) {
                Ok(Step::Advanced) => {}
                Ok(Step::Reached) => break Ok(()),
                Err(stop) => break Err(stop),
            }
        };
        let work = integrator.statistics();
        self.statistics.evaluations += work.evaluations;
        self.statistics.accepted += work.accepted;
        self.statistics.rejected += work.rejected;
        outcome?;
        self.image = integrator.state().to_vec();
        self.argument = state.to_vec();
        Ok(())
    }

    fn write_residual(&self, residual: &mut [f64]) {
        for ((residual, image), argument) in
            residual.iter_mut().zip(&self.image).zip(&self.argument)
        {
            *residual = image - argument;
        }
    }

    fn monodromy(&self) -> Matrix {
        Variational::<S>::matrix(&self.image, self.argument.len())
    }

    fn write_jacobian(&self, jacobian: &mut Matrix) {
        *jacobian = self.monodromy();
        (0..jacobian.rows()).for_each(|k| jacobian[(k, k)] -= 1.0);
    }

    fn orbit(self, solution: newton::Solution) -> Result<PeriodicOrbit, Error> {
        let monodromy = self.monodromy();
        let differences = self.image.iter().zip(&self.argument).map(|(a, b)| (a - b).abs());
        Ok(PeriodicOrbit {
            start_time: self.start_time,
            period: self.period,
            residual: differences.fold(0.0, f64::max),
            multipliers: eigenvalues(&monodromy)?,
            monodromy,
            state: solution.unknowns,
            report: solution.report,
            statistics: self.statistics,
        })
    }
}
