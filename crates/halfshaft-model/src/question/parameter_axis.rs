//! The parameter that `folds`, `resonance` and `bifurcation` go through: an address with a range of values that can
//! have an effect.

use super::kinds::ParameterRange;
use super::text::OptionError;
use super::values::Reader;
use crate::driveline::Driveline;
use crate::elements::Harmonic;
use crate::parameter::{AddressError, Parameter};
use crate::range::parse_range;
use crate::units::{QuantityKind, Sign};

/// Which orders of the torques act together.
#[derive(Clone, Copy, Debug)]
pub(super) enum Orders {
    /// One alone; `None` for the strongest.
    One(Option<f64>),
    /// All of them.
    All,
}

/// What a parameter is gone through for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep {
    /// What it must have an effect on, in words.
    pub(super) what: &'static str,
    /// Whether the coefficients of the mode are there to be changed.
    pub(super) coefficients: bool,
    /// Which orders act.
    pub(super) orders: Orders,
}

impl Reader<'_> {
    /// The parameter axis; errors are noted and give `None`.
    pub(super) fn parameter(&mut self, sweep: &Sweep) -> Option<ParameterRange> {
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
        match self.parameter_range(address.trim(), range, sweep) {
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
        sweep: &Sweep,
    ) -> Result<ParameterRange, (String, String)> {
        let plain = |message: String| (message, String::new());
        let coefficient = mode_coefficient(address, self.line, sweep)?;
        let parameter = match coefficient {
            Some(_) => None,
            None => Some(self.line.parameter(address).map_err(|error| {
                let hint = error.hint(self.line);
                let elsewhere = matches!(error, AddressError::NoElement { .. });
                let more = elsewhere && sweep.coefficients;
                let hint = if more { format!("{hint}, or {COEFFICIENTS}") } else { hint };
                (error.to_string(), hint)
            })?),
        };
        if let Some(useless) = parameter.as_ref().and_then(|p| no_effect(p, self.line, sweep)) {
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
fn mode_coefficient(
    address: &str,
    line: &Driveline,
    sweep: &Sweep,
) -> Result<Option<Sign>, (String, String)> {
    let Some(name) = address.strip_prefix("mode.") else { return Ok(None) };
    let own = line.element_names().any(|element| element == "mode");
    if !sweep.coefficients && !own {
        let message = "only the closed form of one mode has such coefficients".to_owned();
        let hint = "take a number of the line, such as the damping of a shaft; `halfshaft folds \
                    --method averaged` has fold curves over coefficients of the mode";
        return Err((message, hint.to_owned()));
    }
    let sign = match name {
        _ if !sweep.coefficients => return Ok(None),
        "alpha" => Sign::Any,
        "beta" | "f" => Sign::NonNegative,
        "omega_1" => Sign::Positive,
        // An element may have that name as well.
        _ if own => return Ok(None),
        _ => {
            let message = format!("the mode has no coefficient \"{name}\"");
            return Err((message, format!("give {COEFFICIENTS}")));
        }
    };
    Ok(Some(sign))
}

/// Why a number of the line has no effect on what is asked for, with a hint: whoever asks for its
/// fold curves would take "no fold" for an answer.
fn no_effect(parameter: &Parameter, line: &Driveline, sweep: &Sweep) -> Option<(String, String)> {
    let useless = |why: String, hint: String| {
        let Parameter { address, .. } = parameter;
        Some((format!("\"{address}\" has no effect on {}: {why}", sweep.what), hint))
    };
    let key = parameter.key();
    if parameter.is_listed_ratio() {
        let why = "a list of ratios only says for which of them static and report answer";
        let ratio = parameter.address.strip_suffix(key).map(|element| format!("{element}ratio"));
        return useless(why.to_owned(), format!("take \"{}\"", ratio.unwrap_or_default()));
    }
    let torque = parameter.torque(line)?;
    if key.starts_with("pulse.") {
        let why = "a pulse acts once, and they are of lasting motion";
        return useless(why.to_owned(), "`halfshaft shock` answers for pulses".to_owned());
    }
    if key == "frequency" {
        let why = "a torque with a speed of its own does not follow the excitation speed";
        let hint = "the excitation speed is the other axis already; --frequency is its range";
        return useless(why.to_owned(), hint.to_owned());
    }
    let (harmonic, key) = parameter.harmonic(line)?;
    if key == "order" {
        let (why, hint) = match sweep.orders {
            Orders::One(_) => ("they are those of one order, which stays", "choose it by --order"),
            Orders::All => (
                "orders between two others have no common period with them",
                "change it by --set and ask again",
            ),
        };
        return useless(why.to_owned(), hint.to_owned());
    }
    if torque.frequency_rad_s.is_some() {
        let why = "this torque has a speed of its own and does not follow the excitation speed";
        return useless(why.to_owned(), format!("leave frequency out of \"{}\"", torque.name));
    }
    if let Orders::One(Some(order)) = sweep.orders
        && order != harmonic.order
    {
        let why = format!("it belongs to order {}, the curves to order {order}", harmonic.order);
        return useless(why, format!("add --order {}", harmonic.order));
    }
    if key == "phase" && stands_alone(harmonic, line, sweep.orders) {
        let why = match sweep.orders {
            Orders::One(_) => {
                format!("no other torque of order {} is there to add to", harmonic.order)
            }
            Orders::All => "no other oscillating torque is there to add to".to_owned(),
        };
        return useless(why, "a phase alone only shifts the time".to_owned());
    }
    None
}

/// Whether no harmonic but this one drives the line together with it.
fn stands_alone(harmonic: &Harmonic, line: &Driveline, orders: Orders) -> bool {
    let together = |other: &Harmonic| match orders {
        Orders::One(_) => other.order == harmonic.order,
        Orders::All => true,
    };
    let following = line.torques().iter().filter(|torque| torque.frequency_rad_s.is_none());
    let mut all = following.flat_map(|torque| &torque.harmonics);
    !all.any(|other| !std::ptr::eq(other, harmonic) && together(other) && other.amplitude_nm != 0.0)
}
