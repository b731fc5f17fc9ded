//! What stands above and below every account.

use halfshaft_results::{Answer, Header, Reason, Termination};
use serde_json::Value;

use crate::words::{number, plain, quantity};

/// What an analysis is called, for headings.
pub(crate) fn title(analysis: &str) -> String {
    let words = match analysis {
        "check" => "The line",
        "static" => "Static wind-up and torque capacity",
        "modes" => "Modes of vibration",
        "campbell" => "Critical speeds",
        "forced" => "Forced linear vibration",
        "simulate" => "Simulation",
        "shock" => "Shock",
        "resonance" => "Resonance",
        "first-harmonic" => "Resonance by the first harmonic",
        "closed-form" => "Resonance in closed form",
        "levels" => "The methods side by side",
        "folds" => "Fold curves",
        "basins" => "Which start leads to which response",
        "run" => "Study",
        "report" => "Report",
        other => return plain(other),
    };
    words.to_owned()
}

/// Why an analysis ended before it had answered everything; `None` where it has.
pub(crate) fn early_end(termination: &Termination) -> Option<String> {
    let why = match termination.reason {
        Reason::Completed => return None,
        Reason::Cancelled => "it was stopped by the user",
        Reason::StepLimit => "the integrator used up its steps",
        Reason::StepTooSmall => "the steps of the integrator became too small to go on",
        Reason::NonFinite => "a value left the numbers: the motion runs away",
        Reason::Unanswered => "some questions have no full answer",
        Reason::Chattering => "a connection chatters",
        Reason::RunsAway => "a shaft gave way",
    };
    let detail = termination.detail.as_deref().map(plain).unwrap_or_default();
    let more = if detail.is_empty() { String::new() } else { format!("; {detail}") };
    Some(format!("this answer ends early: {why}{more}. What was reached is shown"))
}

/// The early ends of an answer and of the answers in it.
pub(crate) fn early_ends(answer: &Answer) -> Vec<String> {
    let own = answer.header();
    let of = |header: &Header| {
        let end = early_end(&header.termination)?;
        let part = if header.analysis == own.analysis {
            String::new()
        } else {
            format!("{}: ", plain(&header.analysis))
        };
        Some(format!("{part}{end}"))
    };
    super::headers(answer).into_iter().filter_map(of).collect()
}

/// Which program and which model made the answer.
pub(crate) fn provenance(header: &Header) -> String {
    let digest: String = plain(&header.model.digest).chars().take(12).collect();
    let version = plain(&header.version);
    format!("halfshaft {version}, model \"{}\" ({digest})", plain(&header.model.name))
}

/// The settings in the form "name = value", those that were given or have a value.
pub(crate) fn settings(header: &Header) -> Vec<String> {
    let Some(settings) = header.settings.as_object() else { return Vec::new() };
    let told = |(name, value): (&String, &Value)| {
        let value = setting(name, value)?;
        Some(format!("{} = {}", plain(&name.replace('_', " ")), plain(&value)))
    };
    settings.iter().filter_map(told).collect()
}

/// One setting as the command line would take it; `None` where it has no value.
fn setting(name: &str, value: &Value) -> Option<String> {
    let unit = match name {
        "duration" | "step" | "record" => "s",
        "frequency" => "rad/s",
        _ => "1",
    };
    Some(match value {
        Value::Null | Value::Bool(false) => return None,
        Value::Array(list) if list.is_empty() => return None,
        Value::String(text) => text.clone(),
        Value::Number(number) => quantity(number.as_f64()?, 6, unit),
        Value::Array(list) => match list.as_slice() {
            [Value::Number(from), Value::Number(to)] => {
                format!("{}..{}", number(from.as_f64()?, 6), quantity(to.as_f64()?, 6, unit))
            }
            _ => list.iter().filter_map(|one| setting(name, one)).collect::<Vec<_>>().join(", "),
        },
        Value::Object(parts) => parts
            .iter()
            .filter_map(|(part, value)| Some((part, setting(part, value)?)))
            .map(|(part, value)| match part.as_str() {
                "address" | "channel" | "owner" | "quantity" | "value" => value,
                other => format!("{other} {value}"),
            })
            .collect::<Vec<_>>()
            .join(" "),
        Value::Bool(true) => "yes".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::early_end;
    use halfshaft_results::{Reason, Termination};

    /// Oracle: the contract: what was reached and why it ended.
    #[test]
    fn an_early_end_is_told_with_its_detail() {
        assert_eq!(early_end(&Termination::completed()), None);
        let told = early_end(&Termination::early(Reason::StepLimit, "at 1.2 s of 5 s"));
        assert!(told.is_some_and(|text| text.contains("used up") && text.contains("at 1.2 s")));
    }
}
