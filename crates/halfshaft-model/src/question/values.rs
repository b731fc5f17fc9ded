//! One option of a question at a time: its value, or what is wrong with it.

use super::channel::{InitialValue, parse_initial};
use super::kinds::Start;
use super::text::{OptionError, QuestionText};
use crate::diagnostic::did_you_mean;
use crate::driveline::{Driveline, Topology};
use crate::range::{parse_flag_quantity, parse_range};
use crate::units::{QuantityKind, Sign};

/// Most numbers that one time history may hold: they are more than a gigabyte.
const MOST_VALUES: f64 = 2e8;

/// Samples of a time history for which nobody gives a step.
const DEFAULT_SAMPLES: f64 = 2000.0;

/// Reads options about a line and collects what is wrong with them.
pub(super) struct Reader<'q> {
    pub(super) text: &'q QuestionText,
    pub(super) line: &'q Driveline,
    pub(super) errors: Vec<OptionError>,
}

impl Reader<'_> {
    /// The duration, s; `None` where it is written but wrong.
    pub(super) fn duration(&mut self, default: f64) -> Option<f64> {
        let text = self.text.duration.as_deref();
        let read = self.quantity("duration", text, QuantityKind::Time, Sign::Positive);
        if text.is_none() { Some(default) } else { read }
    }

    /// The times to keep, which must lie within the run.
    pub(super) fn record(&mut self, duration: Option<f64>) -> Option<(f64, f64)> {
        let text = self.text.record.as_deref();
        let (from, to) = self.range("record", text, QuantityKind::Time)?;
        if let Some(duration) = duration.filter(|duration| from < 0.0 || to > *duration) {
            let message = "the recorded times lie outside the run";
            let hint = format!("the run lasts from 0 s to {duration} s");
            self.errors.push(OptionError::new("record", text.unwrap_or(""), message, hint));
        }
        Some((from, to))
    }

    pub(super) fn speeds(&mut self) -> Option<(f64, f64)> {
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

    pub(super) fn excitation_order(&mut self) -> Option<f64> {
        let text = self.text.order.as_deref();
        self.quantity("order", text, QuantityKind::Number, Sign::Positive)
    }

    pub(super) fn start(&mut self) -> Start {
        self.choice("start", self.text.start.as_deref(), &Start::ALL).unwrap_or_default()
    }

    pub(super) fn initial(&mut self) -> Vec<InitialValue> {
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

    /// The output step; `recorded` is `None` where how long it is cannot be told.
    pub(super) fn step(&mut self, recorded: Option<f64>) -> Option<f64> {
        let text = self.text.step.as_deref();
        let step = self.quantity("step", text, QuantityKind::Time, Sign::Positive);
        if let Some(recorded) = recorded.filter(|_| step.is_some() || text.is_none()) {
            self.check_step(recorded, step);
        }
        step
    }

    /// Whether the samples are as many as can be held, and more than none.
    fn check_step(&mut self, recorded: f64, step: Option<f64>) {
        let mut wrong = |message: String, hint: String| {
            let text = self.text.step.as_deref().unwrap_or("");
            self.errors.push(OptionError::new("step", text, message, hint));
        };
        let columns = columns_of(self.line);
        if step.map_or(DEFAULT_SAMPLES, |step| recorded / step) * columns > MOST_VALUES {
            let steps = step.map_or_else(
                || format!("{DEFAULT_SAMPLES} samples, which are kept where no step is given,"),
                |step| format!("{recorded} s in steps of {step} s"),
            );
            let least = recorded * columns / MOST_VALUES;
            let hint = format!(
                "a history of this line has {columns} columns, so at most {:.0} samples: take a \
                 step from {least:.1e} s on, or record less",
                (MOST_VALUES / columns).floor()
            );
            wrong(format!("{steps} are too many samples"), hint);
        }
        if step.is_some_and(|step| step > recorded) {
            let message = format!("the step is longer than the {recorded} s that are recorded");
            wrong(message, "take a smaller step or a longer --duration".to_owned());
        }
    }

    /// Notes that an option, where it is written, says nothing to what was chosen: whoever wrote it
    /// expects an effect.
    pub(super) fn refuse(
        &mut self,
        option: &'static str,
        written: Option<&str>,
        message: &str,
        hint: &str,
    ) {
        if let Some(written) = written {
            self.errors.push(OptionError::new(option, written, message, hint));
        }
    }

    pub(super) fn tolerance(&mut self, default: f64) -> f64 {
        let text = self.text.tolerance.as_deref();
        let tolerance = self.quantity("tolerance", text, QuantityKind::Number, Sign::Positive);
        match tolerance {
            Some(tolerance) if !(1e-14..=1e-1).contains(&tolerance) => {
                let hint = format!("from 1e-14 to 0.1; the default is {default:e}");
                let message = "a tolerance outside what can be held";
                self.errors.push(OptionError::new("tolerance", text.unwrap_or(""), message, hint));
                default
            }
            Some(tolerance) => tolerance,
            None => default,
        }
    }

    pub(super) fn quantity(
        &mut self,
        option: &'static str,
        text: Option<&str>,
        kind: QuantityKind,
        sign: Sign,
    ) -> Option<f64> {
        let text = text?;
        let problem = match parse_flag_quantity(text, kind) {
            Ok(value) if sign.allows(value) => return Some(value),
            Ok(value) => {
                let hint = sign.advice(value).unwrap_or_default();
                OptionError::new(option, text, format!("it must {}", sign.rule()), hint)
            }
            Err(error) => {
                let hint = error.hint().unwrap_or_default();
                OptionError::new(option, text, error.to_string(), hint)
            }
        };
        self.errors.push(problem);
        None
    }

    pub(super) fn range(
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

    pub(super) fn count(
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

    pub(super) fn choice<T: Copy>(
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

/// Columns of a time history of a line: the time, three channels a shaft and two a node.
#[expect(clippy::cast_precision_loss, reason = "files are too small for so many elements")]
fn columns_of(line: &Driveline) -> f64 {
    let line = line.expanded();
    let (topology, _) = Topology::with_contradictions(&line);
    (1 + 3 * line.connection_names().count() + 2 * topology.nodes.len()) as f64
}
