//! From the words of a question to the question.

use super::channel::{InitialValue, parse_initial};
use super::kinds::{
    FoldsQuestion, ModesQuestion, ParameterRange, Question, ResonanceMethod, ResonanceQuestion,
    ShockEquation, ShockMethod, ShockQuestion, SimulateQuestion, Start, Verb,
};
use crate::diagnostic::did_you_mean;
use crate::driveline::Driveline;
use crate::range::{parse_flag_quantity, parse_range};
use crate::units::{QuantityKind, Sign};

/// A question in words: the options as text, the same for flags and for study files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct QuestionText {
    /// `--duration`.
    pub duration: Option<String>,
    /// `--initial`, repeatable.
    pub initial: Vec<String>,
    /// `--start`.
    pub start: Option<String>,
    /// `--frequency`: one speed for `simulate`, a range for the others.
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

/// Reads a question about `line`.
///
/// # Errors
/// Every option that is wrong.
pub fn read(
    verb: Verb,
    text: &QuestionText,
    line: &Driveline,
) -> Result<Question, Vec<OptionError>> {
    let mut reader = Reader { text, line, errors: Vec::new() };
    let question = match verb {
        Verb::Check => Question::Check,
        Verb::Static => Question::Static,
        Verb::Modes => Question::Modes(ModesQuestion {
            equilibrium: reader.count("equilibrium", text.equilibrium.as_deref(), 1, 10_000),
        }),
        Verb::Simulate => Question::Simulate(reader.simulate()),
        Verb::Shock => Question::Shock(reader.shock()),
        Verb::Resonance => Question::Resonance(reader.resonance()),
        Verb::Folds => match reader.folds() {
            Some(folds) => Question::Folds(folds),
            None => return Err(reader.errors),
        },
    };
    if reader.errors.is_empty() { Ok(question) } else { Err(reader.errors) }
}

/// Most samples that one answer may hold: eight columns of them are a gigabyte.
const MOST_SAMPLES: f64 = 2e7;

struct Reader<'q> {
    text: &'q QuestionText,
    line: &'q Driveline,
    errors: Vec<OptionError>,
}

impl Reader<'_> {
    fn simulate(&mut self) -> SimulateQuestion {
        let default = SimulateQuestion::default();
        let text = self.text;
        let time = QuantityKind::Time;
        let duration = self
            .quantity("duration", text.duration.as_deref(), time, Sign::Positive)
            .unwrap_or(default.duration);
        let record = self.range("record", text.record.as_deref(), time);
        if let Some((from, to)) = record
            && (from < 0.0 || to > duration)
        {
            let message = "the recorded times lie outside the run";
            let hint = format!("the run lasts from 0 s to {duration} s");
            let written = text.record.clone().unwrap_or_default();
            self.errors.push(OptionError::new("record", written, message, hint));
        }
        let (from, to) = record.unwrap_or((0.0, duration));
        SimulateQuestion {
            duration,
            start: self.start(),
            initial: self.initial(),
            frequency: self.quantity(
                "frequency",
                text.frequency.as_deref(),
                QuantityKind::Speed,
                Sign::Positive,
            ),
            step: self.step(to - from),
            tolerance: self.tolerance(default.tolerance),
            record,
        }
    }

    fn shock(&mut self) -> ShockQuestion {
        let default = ShockQuestion::default();
        let text = self.text;
        let duration = self
            .quantity("duration", text.duration.as_deref(), QuantityKind::Time, Sign::Positive)
            .unwrap_or(default.duration);
        let methods = [
            ("full", ShockMethod::Full),
            ("clamped", ShockMethod::Clamped),
            ("published", ShockMethod::Published),
            ("multiple-scales", ShockMethod::MultipleScales),
        ];
        let equations = [
            ("published", ShockEquation::Published),
            ("clamped", ShockEquation::Clamped),
            ("twist", ShockEquation::Twist),
        ];
        let order = self.count("order", text.order.as_deref(), 1, 2);
        if text.printed_velocity && order != Some(1) {
            let message = "the paper prints a velocity without slow terms at first order only";
            let hint = "add --order 1";
            self.errors.push(OptionError::new("printed-velocity", "", message, hint));
        }
        ShockQuestion {
            method: self.choice("method", text.method.as_deref(), &methods).unwrap_or_default(),
            order: if order == Some(1) { 1 } else { default.order },
            equation: self
                .choice("equation", text.equation.as_deref(), &equations)
                .unwrap_or_default(),
            printed_velocity: text.printed_velocity,
            initial: self.initial(),
            duration,
            step: self.step(duration),
            tolerance: self.tolerance(default.tolerance),
            compare: text.compare,
        }
    }

    fn resonance(&mut self) -> ResonanceQuestion {
        let default = ResonanceQuestion::default();
        let text = self.text;
        ResonanceQuestion {
            frequency: self.speeds(),
            method: self.resonance_method(),
            mode: self.count("mode", text.mode.as_deref(), 1, 10_000).unwrap_or(default.mode),
            order: self.excitation_order(),
            points: self
                .count("points", text.points.as_deref(), 2, 1_000_000)
                .unwrap_or(default.points),
            verify: text.verify,
        }
    }

    fn folds(&mut self) -> Option<FoldsQuestion> {
        let text = self.text;
        let frequency = self.speeds();
        let method = self.resonance_method();
        let mode = self.count("mode", text.mode.as_deref(), 1, 10_000).unwrap_or(1);
        let order = self.excitation_order();
        let points = self.count("points", text.points.as_deref(), 8, 1_000_000).unwrap_or(200);
        let parameter = self.parameter()?;
        Some(FoldsQuestion { frequency, parameter, method, mode, order, points })
    }

    /// The parameter axis; errors are noted and give `None`.
    fn parameter(&mut self) -> Option<ParameterRange> {
        let example = "e.g. --parameter \"half-shaft.cubic=-700..0\"";
        let Some(text) = self.text.parameter.as_deref() else {
            let message = "which parameter, and from where to where?";
            self.errors.push(OptionError::new("parameter", "", message, example));
            return None;
        };
        let Some((address, range)) = text.split_once('=') else {
            let message = "a parameter range is ADDRESS=A..B";
            self.errors.push(OptionError::new("parameter", text, message, example));
            return None;
        };
        let address = address.trim();
        let kind = match mode_coefficient(address) {
            Some(kind) => kind,
            None => match self.line.parameter(address) {
                Ok(parameter) => parameter.kind,
                Err(error) => {
                    let names = self.line.element_names();
                    let hint = did_you_mean(address, names).unwrap_or_else(|| {
                        "addresses are <element name>.<key>, or mode.alpha, mode.beta, mode.f, \
                         mode.omega_1"
                            .to_owned()
                    });
                    self.errors.push(OptionError::new("parameter", text, error.to_string(), hint));
                    return None;
                }
            },
        };
        match parse_range(range, kind) {
            Ok((from, to)) => Some(ParameterRange { address: address.to_owned(), from, to }),
            Err(error) => {
                let hint = error.hint().unwrap_or_default();
                self.errors.push(OptionError::new("parameter", text, error.to_string(), hint));
                None
            }
        }
    }

    fn speeds(&mut self) -> Option<(f64, f64)> {
        let range = self.range("frequency", self.text.frequency.as_deref(), QuantityKind::Speed);
        if let Some((from, _)) = range
            && from < 0.0
        {
            let written = self.text.frequency.clone().unwrap_or_default();
            let message = "excitation speeds begin at zero";
            self.errors.push(OptionError::new("frequency", written, message, ""));
        }
        range
    }

    fn resonance_method(&mut self) -> ResonanceMethod {
        let text = self.text.method.as_deref();
        if let Some(planned @ ("harmonic-balance" | "first-harmonic")) = text {
            let message = format!("{planned} is not available in this version");
            let hint = "this version answers in closed form: --method averaged";
            self.errors.push(OptionError::new("method", planned, message, hint));
            return ResonanceMethod::Averaged;
        }
        let methods = [("averaged", ResonanceMethod::Averaged)];
        self.choice("method", text, &methods).unwrap_or_default()
    }

    fn excitation_order(&mut self) -> Option<f64> {
        let text = self.text.order.as_deref();
        self.quantity("order", text, QuantityKind::Number, Sign::Positive)
    }

    fn start(&mut self) -> Start {
        let starts = [("rest", Start::Rest), ("equilibrium", Start::Equilibrium)];
        self.choice("start", self.text.start.as_deref(), &starts).unwrap_or_default()
    }

    fn initial(&mut self) -> Vec<InitialValue> {
        let mut values: Vec<InitialValue> = Vec::new();
        for text in &self.text.initial {
            match parse_initial(text, self.line) {
                Ok(value) if values.iter().any(|other| other.channel == value.channel) => {
                    let message = format!("{} is given twice", value.channel.name());
                    self.errors.push(OptionError::new("initial", text, message, ""));
                }
                Ok(value) => values.push(value),
                Err(error) => self.errors.push(error),
            }
        }
        values
    }

    fn step(&mut self, recorded: f64) -> Option<f64> {
        let text = self.text.step.as_deref();
        let step = self.quantity("step", text, QuantityKind::Time, Sign::Positive)?;
        if recorded / step > MOST_SAMPLES {
            let message = format!("{recorded} s in steps of {step} s are too many samples");
            let hint = format!("at most {MOST_SAMPLES:.0} samples; take a larger step or --record");
            self.errors.push(OptionError::new("step", text.unwrap_or(""), message, hint));
        }
        Some(step)
    }

    fn tolerance(&mut self, default: f64) -> f64 {
        let text = self.text.tolerance.as_deref();
        let tolerance = self.quantity("tolerance", text, QuantityKind::Number, Sign::Positive);
        match tolerance {
            Some(tolerance) if !(1e-14..=1e-1).contains(&tolerance) => {
                let hint = "from 1e-14 to 0.1; the default is 1e-10";
                let message = "a tolerance outside what the integrator can hold";
                self.errors.push(OptionError::new("tolerance", text.unwrap_or(""), message, hint));
                default
            }
            Some(tolerance) => tolerance,
            None => default,
        }
    }

    fn quantity(
        &mut self,
        option: &'static str,
        text: Option<&str>,
        kind: QuantityKind,
        sign: Sign,
    ) -> Option<f64> {
        let text = text?;
        let problem = match parse_flag_quantity(text, kind) {
            Ok(value) if sign.allows(value) => return Some(value),
            Ok(_) => OptionError::new(option, text, format!("it must {}", sign.rule()), ""),
            Err(error) => {
                let hint = error.hint().unwrap_or_default();
                OptionError::new(option, text, error.to_string(), hint)
            }
        };
        self.errors.push(problem);
        None
    }

    fn range(
        &mut self,
        option: &'static str,
        text: Option<&str>,
        kind: QuantityKind,
    ) -> Option<(f64, f64)> {
        let text = text?;
        match parse_range(text, kind) {
            Ok(range) => Some(range),
            Err(error) => {
                let hint = error.hint().unwrap_or_default();
                self.errors.push(OptionError::new(option, text, error.to_string(), hint));
                None
            }
        }
    }

    fn count(
        &mut self,
        option: &'static str,
        text: Option<&str>,
        least: usize,
        most: usize,
    ) -> Option<usize> {
        let text = text?;
        match text.trim().parse::<usize>() {
            Ok(number) if (least..=most).contains(&number) => Some(number),
            _ => {
                let message = format!("a whole number from {least} to {most} is wanted");
                self.errors.push(OptionError::new(option, text, message, ""));
                None
            }
        }
    }

    fn choice<T: Copy>(
        &mut self,
        option: &'static str,
        text: Option<&str>,
        choices: &[(&str, T)],
    ) -> Option<T> {
        let text = text?;
        if let Some((_, choice)) = choices.iter().find(|(word, _)| *word == text) {
            return Some(*choice);
        }
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        let hint = did_you_mean(text, words.iter().copied())
            .unwrap_or_else(|| format!("choose from {}", words.join(", ")));
        self.errors.push(OptionError::new(option, text, format!("no such {option}"), hint));
        None
    }
}

/// What a coefficient of the mode means, by its address.
fn mode_coefficient(address: &str) -> Option<QuantityKind> {
    // Their units mix time and angle in ways that no flag needs, so they are bare numbers.
    matches!(address, "mode.alpha" | "mode.beta" | "mode.f" | "mode.omega_1")
        .then_some(QuantityKind::Number)
}
