//! The numbers of an ensemble.

use super::{Instructions, LARGEST_DEGREE};
use crate::error::{Error, setting};
use crate::ode::{Tolerance, check_tolerances};

/// Least degree of the Taylor series.
const LEAST_DEGREE: usize = 4;

/// The numbers of an ensemble.
///
/// None but the tolerances, the degree, the lengths and limits of steps has an effect on the results:
/// threads, lanes and instructions decide how long they take.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Error per step that is tolerated as a share of the component's size. Default 1e-10.
    pub relative_tolerance: f64,
    /// Error per step that is tolerated in any case, in the component's unit. Default 1e-10.
    pub absolute_tolerance: Tolerance,
    /// No step is longer than this. Default infinite.
    pub largest_step: f64,
    /// All steps have this length (the last before a goal may be shorter), with no control of the
    /// error: for measuring the order of convergence.
    pub fixed_step: Option<f64>,
    /// Most steps of a trajectory, those tried in vain included. Default ten million.
    pub step_limit: usize,
    /// Degree of the Taylor series. Default 20: near the best from tolerances of 1e-8 to rounding.
    pub degree: usize,
    /// Threads; 0, the default, for as many as the machine has.
    pub threads: usize,
    /// Lanes at least, up to what the instructions are made for ([`Instructions::widths`]); `None`, the
    /// default, for as many as there are trajectories.
    pub lanes: Option<usize>,
    /// Instructions; `None`, the default, for the widest that the processor has.
    pub instructions: Option<Instructions>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            relative_tolerance: 1e-10,
            absolute_tolerance: Tolerance::Uniform(1e-10),
            largest_step: f64::INFINITY,
            fixed_step: None,
            step_limit: 10_000_000,
            degree: 20,
            threads: 0,
            lanes: None,
            instructions: None,
        }
    }
}

impl Settings {
    /// The default settings with both tolerances equal to `tolerance`.
    pub fn with_tolerance(tolerance: f64) -> Self {
        Self {
            relative_tolerance: tolerance,
            absolute_tolerance: Tolerance::Uniform(tolerance),
            ..Self::default()
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] with the field that is out of range, [`Error::Length`] if there are not as
    /// many absolute tolerances as components.
    pub fn validate(&self, dimension: usize) -> Result<(), Error> {
        check_tolerances(self.relative_tolerance, &self.absolute_tolerance, dimension)?;
        let fixed = self.fixed_step.unwrap_or(1.0);
        for (name, length) in [("largest_step", self.largest_step), ("fixed_step", fixed)] {
            setting(name, length, length > 0.0, "must be positive")?;
        }
        let sensible = (LEAST_DEGREE..=LARGEST_DEGREE).contains(&self.degree);
        setting("degree", self.degree as f64, sensible, "must lie from 4 to 30")
    }
}
