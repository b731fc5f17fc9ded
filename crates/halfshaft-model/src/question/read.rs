//! From the words of a question to the question.

use super::channel::parse_channel;
use super::kinds::{ModesQuestion, Question, ShockEquation, ShockMethod, ShockQuestion, Verb};
use super::simulate::{DryFriction, IntegratorChoice, SimulateQuestion};
use super::text::{OptionError, QuestionText};
use super::values::Reader;
use crate::driveline::Driveline;
use crate::range::{RangeError, parse_range};
use crate::units::{QuantityKind, Sign};

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
            count: reader.count("count", text.count.as_deref(), 1, 10_000),
        }),
        Verb::Campbell => Question::Campbell(reader.campbell()),
        Verb::Forced => Question::Forced(reader.forced()),
        Verb::Simulate => Question::Simulate(reader.simulate()),
        Verb::Shock => Question::Shock(reader.shock()),
        Verb::Resonance => Question::Resonance(reader.resonance()),
        Verb::Folds => match reader.folds() {
            Some(folds) => Question::Folds(folds),
            None => return Err(reader.errors),
        },
        Verb::Basins => Question::Basins(reader.basins()),
        Verb::Bifurcation => Question::Bifurcation(reader.bifurcation()),
    };
    if reader.errors.is_empty() { Ok(question) } else { Err(reader.errors) }
}

/// Excitation speeds at the start and at the end, rad/s, with the duration where a rate gives it.
#[derive(Clone, Copy)]
struct Run {
    from: f64,
    to: f64,
    duration: Option<f64>,
}

impl Reader<'_> {
    fn simulate(&mut self) -> SimulateQuestion {
        let default = SimulateQuestion::default();
        let text = self.text;
        let run = self.run_of_speeds();
        let duration = match run {
            Some(Run { duration: Some(duration), .. }) => Some(duration),
            _ => self.duration(default.duration),
        };
        let record = self.record(duration);
        let recorded = record.map(|(from, to)| to - from).or(duration);
        SimulateQuestion {
            duration: duration.unwrap_or(default.duration),
            start: self.start(),
            initial: self.initial(),
            frequency: run.map(|run| run.from),
            acceleration: match (run, duration) {
                (Some(run), Some(duration)) => (run.to - run.from) / duration,
                _ => 0.0,
            },
            orders: self.order_channel(),
            integrator: self
                .choice("integrator", text.integrator.as_deref(), &IntegratorChoice::ALL)
                .unwrap_or_default(),
            friction: self
                .choice("friction", text.friction.as_deref(), &DryFriction::ALL)
                .unwrap_or_default(),
            step: self.step(recorded),
            tolerance: self.tolerance(default.tolerance),
            record,
        }
    }

    /// The channel whose orders are told.
    fn order_channel(&mut self) -> Option<String> {
        let written = self.text.orders.as_deref()?;
        if self.text.frequency.is_none() {
            let hint = "add --frequency, one speed or a run-up A..B";
            self.refuse("orders", Some(written), "orders need an excitation speed", hint);
        }
        match parse_channel(written, self.line) {
            Ok(channel) => Some(channel.name()),
            Err((message, hint)) => {
                self.errors.push(OptionError::new("orders", written, message, hint));
                None
            }
        }
    }

    /// `--frequency` of `simulate`, one speed or two, with `--rate`.
    fn run_of_speeds(&mut self) -> Option<Run> {
        let rate = self.quantity(
            "rate",
            self.text.rate.as_deref(),
            QuantityKind::Acceleration,
            Sign::Positive,
        );
        let text = self.text.frequency.as_deref();
        let Some(written) = text.filter(|written| written.contains("..")) else {
            let hint = "write --frequency A..B, or leave the rate out";
            self.refuse("rate", self.text.rate.as_deref(), "only a run of speeds has a rate", hint);
            let speed = self.quantity("frequency", text, QuantityKind::Speed, Sign::Positive)?;
            return Some(Run { from: speed, to: speed, duration: None });
        };
        let (from, to) = match parse_range(written, QuantityKind::Speed) {
            // A run-down.
            Err(RangeError::Reversed { meant, .. }) => {
                self.range("frequency", Some(&meant), QuantityKind::Speed).map(|(a, b)| (b, a))?
            }
            _ => self.range("frequency", text, QuantityKind::Speed)?,
        };
        if from.min(to) < 0.0 {
            let message = "excitation speeds begin at zero";
            self.errors.push(OptionError::new("frequency", written, message, ""));
        }
        if rate.is_some() {
            let hint = "leave one of them out: a run of speeds takes as long as its rate says";
            let message = "a run with a rate has its duration";
            self.refuse("duration", self.text.duration.as_deref(), message, hint);
        }
        let duration = rate.map(|rate| (to - from).abs() / rate);
        Some(Run { from, to, duration })
    }

    fn shock(&mut self) -> ShockQuestion {
        let default = ShockQuestion::default();
        let text = self.text;
        let duration = self.duration(default.duration);
        let errors = self.errors.len();
        let method = self.choice("method", text.method.as_deref(), &ShockMethod::ALL);
        if self.errors.len() == errors {
            self.unused_by(method.unwrap_or_default());
        }
        let order = self.count("order", text.order.as_deref(), 1, 2);
        if text.printed_velocity && order != Some(1) {
            let message = "the paper prints a velocity without slow terms at first order only";
            let hint = "add --order 1";
            self.errors.push(OptionError::new("printed-velocity", "", message, hint));
        }
        ShockQuestion {
            method: method.unwrap_or_default(),
            order: if order == Some(1) { 1 } else { default.order },
            equation: self
                .choice("equation", text.equation.as_deref(), &ShockEquation::ALL)
                .unwrap_or_default(),
            printed_velocity: text.printed_velocity,
            initial: self.initial(),
            duration: duration.unwrap_or(default.duration),
            step: self.step(duration),
            tolerance: self.tolerance(default.tolerance),
            compare: text.compare,
        }
    }

    /// Options that say nothing to a method of `shock` are mistakes: whoever wrote one expects an
    /// effect. A tolerance is none of them: it bounds an error that a closed form does not make.
    fn unused_by(&mut self, method: ShockMethod) {
        let text = self.text;
        if method == ShockMethod::MultipleScales {
            return;
        }
        let message = "only the method multiple-scales uses it";
        let hint = "add --method multiple-scales, or leave it out";
        self.refuse("order", text.order.as_deref(), message, hint);
        self.refuse("equation", text.equation.as_deref(), message, hint);
        self.refuse("printed-velocity", text.printed_velocity.then_some(""), message, hint);
    }
}
