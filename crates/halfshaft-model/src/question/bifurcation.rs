//! The settings of `bifurcation` and its options.

use serde::Serialize;

use super::kinds::ParameterRange;
use super::text::OptionError;
use super::values::Reader;
use crate::format::words;

/// Most values of the swept number.
const MOST_STEPS: usize = 1_000_000;
/// Most periods at one value.
const MOST_PERIODS: usize = 10_000_000;
/// Most points of a diagram: they are more than a gigabyte.
const MOST_POINTS: usize = 100_000_000;

/// Which way a sweep goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SweepDirection {
    /// From the low end to the high end.
    Up,
    /// From the high end to the low end.
    Down,
    /// Up, and from where that ends down again.
    #[default]
    Both,
}

impl SweepDirection {
    /// All directions with their names.
    pub const ALL: [(&'static str, Self); 3] =
        [("up", Self::Up), ("down", Self::Down), ("both", Self::Both)];
    /// The names alone.
    pub const WORDS: [&'static str; Self::ALL.len()] = words(&Self::ALL);
}

/// Settings of `bifurcation`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BifurcationQuestion {
    /// Range of the excitation speed Ω, rad/s; `None` for one about the resonance.
    pub frequency: Option<(f64, f64)>,
    /// A number of the line to go through in place of the excitation speed, which then stays at the
    /// lower end of `frequency`.
    pub parameter: Option<ParameterRange>,
    /// Number of values, both ends included.
    pub steps: usize,
    /// Periods of the excitation that a motion has for settling at each value; `None` for as many as the
    /// damping of the line takes to leave a millionth.
    pub transient: Option<usize>,
    /// Periods that are recorded of a motion that does not come to repeat.
    pub points: usize,
    /// The shaft whose twist and rate of twist are recorded; `None` for the first nonlinear one.
    pub shaft: Option<String>,
    /// Error of one step of the integration that is tolerated, relative to the motion.
    pub tolerance: f64,
    /// Which way.
    pub direction: SweepDirection,
    /// Whether the branches of `resonance` over the same range are wanted beside it.
    pub branches: bool,
}

impl Default for BifurcationQuestion {
    fn default() -> Self {
        Self {
            frequency: None,
            parameter: None,
            steps: 200,
            transient: None,
            points: 64,
            shaft: None,
            tolerance: 1e-9,
            direction: SweepDirection::default(),
            branches: true,
        }
    }
}

impl Reader<'_> {
    pub(super) fn bifurcation(&mut self) -> BifurcationQuestion {
        let default = BifurcationQuestion::default();
        let text = self.text;
        let (parameter, frequency) = if text.parameter.is_some() {
            (self.swept("lasting motion"), self.one_speed())
        } else {
            (None, self.moving_speeds())
        };
        let mut count = |option, written: &Option<String>, least, most, default| {
            self.count(option, written.as_deref(), least, most).unwrap_or(default)
        };
        let steps = count("steps", &text.steps, 2, MOST_STEPS, default.steps);
        let points = count("points", &text.points, 1, MOST_PERIODS, default.points);
        let transient = self.count("transient", text.transient.as_deref(), 0, MOST_PERIODS);
        if steps.saturating_mul(points) > MOST_POINTS {
            let message = format!("{steps} values of {points} points each are too many");
            let hint = format!("at most {MOST_POINTS} together: take fewer --steps or --points");
            let written = text.points.clone().unwrap_or_default();
            self.errors.push(OptionError::new("points", written, message, hint));
        }
        BifurcationQuestion {
            frequency,
            parameter,
            steps,
            transient,
            points,
            shaft: self.shaft(),
            tolerance: self.tolerance(default.tolerance),
            direction: self
                .choice("direction", text.direction.as_deref(), &SweepDirection::ALL)
                .unwrap_or_default(),
            branches: !text.no_branches,
        }
    }

    /// A range of speeds that have a period.
    fn moving_speeds(&mut self) -> Option<(f64, f64)> {
        let range = self.range_of_speeds(true)?;
        if range.0 == 0.0 {
            let written = self.text.frequency.clone().unwrap_or_default();
            let message = "a standing excitation has no period to look at the motion by";
            let hint = "begin above zero, e.g. --frequency 0.1Hz..5Hz";
            self.errors.push(OptionError::new("frequency", written, message, hint));
        }
        Some(range)
    }
}
