//! From the words of a question to the question.

use super::kinds::{
    ModesQuestion, Question, ShockEquation, ShockMethod, ShockQuestion, SimulateQuestion, Verb,
};
use super::text::{OptionError, QuestionText};
use super::values::Reader;
use crate::driveline::Driveline;
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
        }),
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

impl Reader<'_> {
    fn simulate(&mut self) -> SimulateQuestion {
        let default = SimulateQuestion::default();
        let text = self.text;
        let duration = self.duration(default.duration);
        let record = self.record(duration);
        let recorded = record.map(|(from, to)| to - from).or(duration);
        SimulateQuestion {
            duration: duration.unwrap_or(default.duration),
            start: self.start(),
            initial: self.initial(),
            frequency: self.quantity(
                "frequency",
                text.frequency.as_deref(),
                QuantityKind::Speed,
                Sign::Positive,
            ),
            step: self.step(recorded),
            tolerance: self.tolerance(default.tolerance),
            record,
        }
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
