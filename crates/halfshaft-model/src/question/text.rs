//! The words of a question, and what can be wrong with them.

/// A question in words: the options as text, the same for flags and for study files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct QuestionText {
    /// `--duration`.
    pub duration: Option<String>,
    /// `--initial`, repeatable.
    pub initial: Vec<String>,
    /// `--start`.
    pub start: Option<String>,
    /// `--frequency`: one speed or a run from one to another for `simulate`, one for `basins` and beside
    /// a `--parameter` of `resonance` and `bifurcation`, a range for the others.
    pub frequency: Option<String>,
    /// `--step`.
    pub step: Option<String>,
    /// `--tolerance`.
    pub tolerance: Option<String>,
    /// `--record`.
    pub record: Option<String>,
    /// `--method`.
    pub method: Option<String>,
    /// `--order`.
    pub order: Option<String>,
    /// `--equation`.
    pub equation: Option<String>,
    /// `--printed-velocity`.
    pub printed_velocity: bool,
    /// `--compare`.
    pub compare: bool,
    /// `--mode`.
    pub mode: Option<String>,
    /// `--points`.
    pub points: Option<String>,
    /// `--verify`.
    pub verify: bool,
    /// `--parameter`.
    pub parameter: Option<String>,
    /// `--equilibrium`.
    pub equilibrium: Option<String>,
    /// `--harmonics`.
    pub harmonics: Option<String>,
    /// `--stability`.
    pub stability: Option<String>,
    /// `--backbone`.
    pub backbone: bool,
    /// `--grid`.
    pub grid: Option<String>,
    /// `--window`.
    pub window: Option<String>,
    /// `--shaft`.
    pub shaft: Option<String>,
    /// `--periods`.
    pub periods: Option<String>,
    /// `--shock`.
    pub shock: Option<String>,
    /// `--rate`.
    pub rate: Option<String>,
    /// `--integrator`.
    pub integrator: Option<String>,
    /// `--orders`: a channel for `simulate`, numbers for `campbell` and `forced`.
    pub orders: Option<String>,
    /// `--friction`.
    pub friction: Option<String>,
    /// `--steps`.
    pub steps: Option<String>,
    /// `--transient`.
    pub transient: Option<String>,
    /// `--direction`.
    pub direction: Option<String>,
    /// `--no-branches`.
    pub no_branches: bool,
    /// `--count`.
    pub count: Option<String>,
    /// `--operating`.
    pub operating: Option<String>,
    /// `--node`.
    pub node: Option<String>,
    /// `--this-gear`.
    pub this_gear: bool,
}

/// What is wrong with one option.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{option} \"{text}\": {message}")]
pub struct OptionError {
    /// Name of the option without dashes.
    pub option: &'static str,
    /// What was written.
    pub text: String,
    /// What is wrong.
    pub message: String,
    /// What to write instead; may be empty.
    pub hint: String,
}

impl OptionError {
    /// An error about the given option.
    pub fn new(
        option: &'static str,
        text: impl Into<String>,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Self {
        Self { option, text: text.into(), message: message.into(), hint: hint.into() }
    }
}
