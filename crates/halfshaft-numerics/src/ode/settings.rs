//! The numbers of the time integration.

use crate::error::{Error, has_length, setting};

/// A tolerance, the same for every component of the state or one for each.
#[derive(Debug, Clone, PartialEq)]
pub enum Tolerance {
    /// The same for all components.
    Uniform(f64),
    /// One for each component, in the order of the state.
    PerComponent(Vec<f64>),
}

impl Tolerance {
    /// The tolerance of one component; of the last one listed if there are too few.
    pub fn of(&self, component: usize) -> f64 {
        match self {
            Self::Uniform(value) => *value,
            Self::PerComponent(values) => {
                values.get(component).or(values.last()).copied().unwrap_or(0.0)
            }
        }
    }
}

impl From<f64> for Tolerance {
    fn from(value: f64) -> Self {
        Self::Uniform(value)
    }
}

impl From<Vec<f64>> for Tolerance {
    fn from(values: Vec<f64>) -> Self {
        Self::PerComponent(values)
    }
}

/// Checks both tolerances of an integration of so many components.
pub(crate) fn check_tolerances(
    relative: f64,
    absolute: &Tolerance,
    dimension: usize,
) -> Result<(), Error> {
    let sensible = (0.0..1.0).contains(&relative);
    setting("relative_tolerance", relative, sensible, "must lie in [0, 1)")?;
    if let Tolerance::PerComponent(values) = absolute {
        has_length("absolute tolerances", dimension, values.len())?;
    }
    for component in 0..dimension {
        let value = absolute.of(component);
        let sensible = value > 0.0 && value.is_finite();
        setting("absolute_tolerance", value, sensible, "must be positive and finite")?;
    }
    Ok(())
}

/// The numbers of the time integration.
///
/// A step is accepted if the root mean square over the components of
/// `error / (absolute + relative max(|y before|, |y after|))` is at most one.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Error per step that is tolerated as a share of the component's size. Default 1e-9.
    pub relative_tolerance: f64,
    /// Error per step that is tolerated in any case, in the component's unit. Positive, because a
    /// component may pass through zero. Default 1e-9.
    pub absolute_tolerance: Tolerance,
    /// No step is longer than this. Default infinite. A system at rest that is shaken only later
    /// needs a bound here, or a break time where the shaking begins.
    pub largest_step: f64,
    /// Length of the first step, instead of an estimate from the first two derivatives.
    pub first_step: Option<f64>,
    /// All steps have this length, with no control of the error (the last one may be shorter or up
    /// to 1 % longer): for measuring the order of convergence.
    pub fixed_step: Option<f64>,
    /// Most steps to try, rejected ones included, in the life of an integrator. Default 10 million.
    pub step_limit: usize,
    /// Share of the step length at which the error would just pass that is really used. Default
    /// 0.9, as in the published program: a safe distance costs little, a rejected step a whole one.
    pub safety: f64,
    /// A step is at least this share of the one before it. Default 1/3.
    pub smallest_factor: f64,
    /// A step is at most this multiple of the one before it. Default 6.
    pub largest_factor: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            relative_tolerance: 1e-9,
            absolute_tolerance: Tolerance::Uniform(1e-9),
            largest_step: f64::INFINITY,
            first_step: None,
            fixed_step: None,
            step_limit: 10_000_000,
            safety: 0.9,
            smallest_factor: 1.0 / 3.0,
            largest_factor: 6.0,
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
    /// [`Error::Setting`] with the field that is out of range, [`Error::Length`] if there are not
    /// as many absolute tolerances as components.
    pub fn validate(&self, dimension: usize) -> Result<(), Error> {
        check_tolerances(self.relative_tolerance, &self.absolute_tolerance, dimension)?;
        let lengths = [
            ("largest_step", self.largest_step),
            ("first_step", self.first_step.unwrap_or(1.0)),
            ("fixed_step", self.fixed_step.unwrap_or(1.0)),
        ];
        for (name, length) in lengths {
            setting(name, length, length > 0.0, "must be positive")?;
        }
        let inside = |value: f64| value > 0.0 && value < 1.0;
        let factor = self.smallest_factor;
        setting("safety", self.safety, inside(self.safety), "must lie between 0 and 1")?;
        setting("smallest_factor", factor, inside(factor), "must lie between 0 and 1")?;
        let largest = self.largest_factor;
        setting("largest_factor", largest, largest > 1.0, "must be above 1")
    }
}
