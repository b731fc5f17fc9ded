//! The options of `resonance` and `folds`: which of them the chosen method takes, and their values.

use super::kinds::{
    FoldsQuestion, ParameterRange, ResonanceMethod, ResonanceQuestion, StabilityMethod,
};
use super::parameter_axis::{Orders, Sweep};
use super::text::OptionError;
use super::values::Reader;
use crate::units::{QuantityKind, Sign};

/// Most harmonics that may be asked for: with them a waveform of any use is met to rounding.
const MOST_HARMONICS: usize = 1000;

impl Reader<'_> {
    pub(super) fn resonance(&mut self) -> ResonanceQuestion {
        let default = ResonanceQuestion::default();
        let text = self.text;
        let method = self.method();
        let balanced = method.is_none_or(|method| method == ResonanceMethod::HarmonicBalance);
        if !balanced {
            let hint = "leave --method out, or sweep the excitation speed by --frequency A..B";
            let message = "only the method harmonic-balance goes through a parameter";
            self.refuse("parameter", text.parameter.as_deref(), message, hint);
        }
        let swept = text.parameter.is_some();
        if swept {
            let message = "responses are held against integration over the excitation speed only";
            let hint = "leave it out, or leave --parameter out";
            self.refuse("verify", text.verify.then_some(""), message, hint);
        }
        let parameter = if swept && balanced { self.swept("periodic responses") } else { None };
        let frequency = match (swept, balanced) {
            (false, _) => self.range_of_speeds(balanced),
            (true, true) => self.one_speed(),
            // Whether a range or one speed is wanted is not known.
            (true, false) => None,
        };
        ResonanceQuestion {
            frequency,
            method: method.unwrap_or_default(),
            mode: self.count("mode", text.mode.as_deref(), 1, 10_000).unwrap_or(default.mode),
            order: self.excitation_order(),
            points: self.count("points", text.points.as_deref(), 2, 1_000_000),
            verify: text.verify,
            harmonics: self.harmonics(),
            tolerance: self.tolerance(default.tolerance),
            stability: self
                .choice("stability", text.stability.as_deref(), &StabilityMethod::ALL)
                .unwrap_or_default(),
            backbone: text.backbone,
            parameter,
        }
    }

    /// The plane of fold curves; `None` where its parameter is missing or wrong, which is noted.
    pub(super) fn folds(&mut self) -> Option<FoldsQuestion> {
        let text = self.text;
        let method = self.method();
        let frequency = self.speeds();
        let mode = self.count("mode", text.mode.as_deref(), 1, 10_000).unwrap_or(1);
        let order = self.excitation_order();
        let points = self.count("points", text.points.as_deref(), 8, 1_000_000).unwrap_or(200);
        let harmonics = self.harmonics();
        let tolerance = self.tolerance(ResonanceQuestion::default().tolerance);
        let coefficients = method.is_none_or(|method| method == ResonanceMethod::Averaged);
        let method = method.unwrap_or_default();
        let sweep = Sweep {
            what: "fold curves",
            coefficients,
            orders: match method {
                ResonanceMethod::HarmonicBalance => Orders::All,
                ResonanceMethod::FirstHarmonic | ResonanceMethod::Averaged => Orders::One(order),
            },
        };
        let parameter = self.parameter(&sweep)?;
        Some(FoldsQuestion {
            frequency,
            parameter,
            method,
            mode,
            order,
            points,
            harmonics,
            tolerance,
        })
    }

    /// The method; `None` where it is none of them, which is noted. Options that say nothing to it
    /// are noted too. A tolerance is none of these: it bounds an error that a closed form does not
    /// make.
    fn method(&mut self) -> Option<ResonanceMethod> {
        let errors = self.errors.len();
        let text = self.text;
        let method = self.choice("method", text.method.as_deref(), &ResonanceMethod::ALL);
        if self.errors.len() > errors {
            return None;
        }
        let method = method.unwrap_or_default();
        match method {
            ResonanceMethod::HarmonicBalance => {
                let message = "harmonic balance takes all orders of the torques together";
                let hint = "leave it out; --method averaged answers for one order alone";
                self.refuse("order", text.order.as_deref(), message, hint);
            }
            ResonanceMethod::FirstHarmonic | ResonanceMethod::Averaged => {
                let message = "only the method harmonic-balance uses it";
                let hint = "leave it out, or ask --method harmonic-balance";
                self.refuse("harmonics", text.harmonics.as_deref(), message, hint);
                self.refuse("stability", text.stability.as_deref(), message, hint);
            }
        }
        if method == ResonanceMethod::FirstHarmonic {
            let message = "one harmonic is not held against integration";
            let hint = "ask --method harmonic-balance --verify, which is; `halfshaft report` sets both \
                        side by side";
            self.refuse("verify", text.verify.then_some(""), message, hint);
        }
        if method == ResonanceMethod::HarmonicBalance && text.frequency.is_some() {
            let message = "the speeds are given, and harmonic balance takes all modes together";
            let hint = "leave it out; without --frequency it chooses the range of speeds";
            self.refuse("mode", text.mode.as_deref(), message, hint);
        }
        Some(method)
    }

    fn harmonics(&mut self) -> Option<usize> {
        self.count("harmonics", self.text.harmonics.as_deref(), 1, MOST_HARMONICS)
    }

    /// The parameter that responses are followed in at one speed; `what` they are, in words.
    pub(super) fn swept(&mut self, what: &'static str) -> Option<ParameterRange> {
        self.parameter(&Sweep { what, coefficients: false, orders: Orders::All })
    }

    /// A range of speeds; where one speed stands there, what it would be good for is told.
    pub(super) fn range_of_speeds(&mut self, balanced: bool) -> Option<(f64, f64)> {
        let errors = self.errors.len();
        let range = self.speeds();
        let single = self.text.frequency.as_deref().is_some_and(|text| !text.contains(".."));
        if balanced
            && single
            && let [error] = &mut self.errors[errors..]
        {
            error.hint += ", or add --parameter \"ADDRESS=A..B\" to stay at one speed";
        }
        range
    }

    /// The speed at which a parameter is gone through.
    pub(super) fn one_speed(&mut self) -> Option<(f64, f64)> {
        let Some(text) = self.text.frequency.as_deref() else {
            let message = "at which excitation speed does the parameter run?";
            let hint = "add one, e.g. --frequency 4Hz, or leave --parameter out to sweep the speed";
            self.errors.push(OptionError::new("frequency", "", message, hint));
            return None;
        };
        if text.contains("..") {
            let message = "with --parameter the excitation speed stays";
            let hint = "give one speed, e.g. --frequency 4Hz; `halfshaft folds` answers for both at \
                        once";
            self.errors.push(OptionError::new("frequency", text, message, hint));
            return None;
        }
        let speed = self.quantity("frequency", Some(text), QuantityKind::Speed, Sign::Positive)?;
        Some((speed, speed))
    }
}
