//! The parameter axis of `folds`: an address with a range of values that can have an effect.

use super::kinds::ParameterRange;
use super::text::OptionError;
use super::values::Reader;
use crate::driveline::Driveline;
use crate::elements::Harmonic;
use crate::parameter::{AddressError, Parameter};
use crate::range::parse_range;
use crate::units::{QuantityKind, Sign};

impl Reader<'_> {
    /// The parameter axis of the fold curves of an order; errors are noted and give `None`.
    pub(super) fn parameter(&mut self, order: Option<f64>) -> Option<ParameterRange> {
        let example = "e.g. --parameter \"half-shaft.cubic=-700..0\"";
        let Some(text) = self.text.parameter.as_deref() else {
            let message = "which parameter, and from where to where?";
            self.errors.push(OptionError::new("parameter", "", message, example));
            return None;
        };
        // Names may hold "=", values never do.
        let Some((address, range)) = text.rsplit_once('=') else {
            let message = "a parameter range is ADDRESS=A..B";
            self.errors.push(OptionError::new("parameter", text, message, example));
            return None;
        };
        match self.parameter_range(address.trim(), range, order) {
            Ok(range) => Some(range),
            Err((message, hint)) => {
                self.errors.push(OptionError::new("parameter", text, message, hint));
                None
            }
        }
    }

    /// A range of legal values of an address, or what is wrong and a hint.
    fn parameter_range(
        &self,
        address: &str,
        range: &str,
        order: Option<f64>,
    ) -> Result<ParameterRange, (String, String)> {
        let plain = |message: String| (message, String::new());
        let coefficient = mode_coefficient(address, self.line)?;
        let parameter = match coefficient {
            Some(_) => None,
            None => Some(self.line.parameter(address).map_err(|error| {
                let hint = format!("{}, or {COEFFICIENTS}", error.hint(self.line));
                let elsewhere = matches!(error, AddressError::NoElement { .. });
                let hint = if elsewhere { hint } else { error.hint(self.line) };
                (error.to_string(), hint)
            })?),
        };
        if let Some(useless) = parameter.as_ref().and_then(|p| no_effect(p, self.line, order)) {
            return Err(useless);
        }
        let kind = parameter.as_ref().map_or(QuantityKind::Number, |parameter| parameter.kind);
        let (from, to) = parse_range(range, kind)
            .map_err(|error| (error.to_string(), error.hint().unwrap_or_default()))?;
        let sign = coefficient.or(parameter.as_ref().map(|p| p.sign)).unwrap_or(Sign::Any);
        if !sign.allows_range(from, to) {
            return Err(plain(format!("\"{address}\" must {}", sign.rule())));
        }
        for end in [from, to] {
            if let Some(Err(error)) = parameter.as_ref().map(|p| self.line.with(p, end)) {
                return Err(plain(error.to_string()));
            }
        }
        Ok(ParameterRange { address: address.to_owned(), from, to })
    }
}

/// The addresses of the mode's coefficients, for messages.
const COEFFICIENTS: &str =
    "one of the mode's coefficients mode.alpha, mode.beta, mode.f, mode.omega_1";

/// The signs that a coefficient of the mode may have, by its address; `None` where the address is
/// none of a mode. Their units mix time and angle in ways that no flag needs, so their values are
/// bare numbers.
fn mode_coefficient(address: &str, line: &Driveline) -> Result<Option<Sign>, (String, String)> {
    let Some(name) = address.strip_prefix("mode.") else { return Ok(None) };
    let sign = match name {
        "alpha" => Sign::Any,
        "beta" | "f" => Sign::NonNegative,
        "omega_1" => Sign::Positive,
        // An element may have that name as well.
        _ if line.element_names().any(|element| element == "mode") => return Ok(None),
        _ => {
            let message = format!("the mode has no coefficient \"{name}\"");
            return Err((message, format!("give {COEFFICIENTS}")));
        }
    };
    Ok(Some(sign))
}

/// Why a number of the line has no effect on the fold curves of an order (`None` for the
/// strongest), with a hint: whoever asks for its curves would take "no fold" for an answer.
fn no_effect(
    parameter: &Parameter,
    line: &Driveline,
    order: Option<f64>,
) -> Option<(String, String)> {
    let useless = |why: String, hint: String| {
        Some((format!("\"{}\" has no effect on fold curves: {why}", parameter.address), hint))
    };
    let key = parameter.key();
    if parameter.is_listed_ratio() {
        let why = "a list of ratios only says for which of them static and report answer";
        let ratio = parameter.address.strip_suffix(key).map(|element| format!("{element}ratio"));
        return useless(why.to_owned(), format!("take \"{}\"", ratio.unwrap_or_default()));
    }
    let torque = parameter.torque(line)?;
    if key.starts_with("pulse.") {
        let why = "a pulse acts once, and the curves are of lasting responses";
        return useless(why.to_owned(), "`halfshaft shock` answers for pulses".to_owned());
    }
    if key == "frequency" {
        let why = "a torque with a speed of its own does not follow the excitation speed";
        let hint = "the excitation speed is the other axis already; --frequency is its range";
        return useless(why.to_owned(), hint.to_owned());
    }
    let (harmonic, key) = parameter.harmonic(line)?;
    if key == "order" {
        let why = "they are those of one order, which stays".to_owned();
        return useless(why, "choose the order by --order".to_owned());
    }
    if torque.frequency_rad_s.is_some() {
        let why = "this torque has a speed of its own and does not follow the excitation speed";
        return useless(why.to_owned(), format!("leave frequency out of \"{}\"", torque.name));
    }
    if let Some(order) = order.filter(|order| *order != harmonic.order) {
        let why = format!("it belongs to order {}, the curves to order {order}", harmonic.order);
        return useless(why, format!("add --order {}", harmonic.order));
    }
    if key == "phase" && stands_alone(harmonic, line) {
        let why = format!("no other torque of order {} is there to add to", harmonic.order);
        return useless(why, "a phase alone only shifts the time".to_owned());
    }
    None
}

/// Whether no harmonic but this one drives the line at its order.
fn stands_alone(harmonic: &Harmonic, line: &Driveline) -> bool {
    let following = line.torques().iter().filter(|torque| torque.frequency_rad_s.is_none());
    let mut all = following.flat_map(|torque| &torque.harmonics);
    !all.any(|other| {
        !std::ptr::eq(other, harmonic) && other.order == harmonic.order && other.amplitude_nm != 0.0
    })
}
