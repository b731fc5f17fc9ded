//! What is told of a shock.

use halfshaft_results::{HistoryResult, ShaftMetrics, ShockDetails};

use super::{Account, Grid, history, methods};
use crate::words::{frequency_words, percent, plain, quantity, times};

/// The whole account.
pub(crate) fn account(result: &HistoryResult) -> Account {
    let mut account = Account::default();
    let Some(shock) = &result.shock else { return history::account(result) };
    if let Some((name, metrics)) = main_shaft(result, shock) {
        account.text(first_peak(name, metrics));
        account.text([torque(name, metrics), settling(metrics)]);
    }
    account.text(super::events::sentences(result));
    history::figures(result, &mut account);
    account.append(history::more(result));
    account.note(format!(
        "Method {}: {}.{}",
        plain(&shock.method),
        plain(&shock.variable),
        coefficients(shock)
    ));
    account.grid(table(result));
    account.append(methods::account(shock));
    account.grid(history::extremes(result));
    account.text(history::trust(result));
    account
}

/// The shaft that the answer is about, with its metrics.
pub(crate) fn main_shaft<'r>(
    result: &'r HistoryResult,
    shock: &ShockDetails,
) -> Option<(&'r String, &'r ShaftMetrics)> {
    let shafts = &result.metrics.shafts;
    shafts.get_key_value(&shock.shaft).or_else(|| shafts.first())
}

fn first_peak(name: &str, metrics: &ShaftMetrics) -> Vec<String> {
    let shaft = plain(name);
    let (Some(peak), Some(time)) = (metrics.first_peak, metrics.first_peak_time) else {
        return vec![format!(
            "The twist of the {shaft} has no turning point in the time computed."
        )];
    };
    let mut sentences = vec![format!(
        "The twist of the {shaft} first turns round {} after the start, {} beyond where it comes \
         to rest.",
        quantity(time, 4, "s"),
        crate::words::angle(peak)
    )];
    if let (Some(peak), Some(time)) = (metrics.first_rate_peak, metrics.first_rate_peak_time) {
        sentences.push(format!(
            "Its rate peaks first at {}, after {}.",
            quantity(peak, 5, "rad/s"),
            quantity(time, 4, "s")
        ));
    }
    sentences
}

/// The largest torque and what it is of the torque before.
pub(crate) fn torque(name: &str, metrics: &ShaftMetrics) -> String {
    let before = quantity(metrics.static_torque, 6, "N·m");
    let over = metrics.dynamic_factor.map_or_else(
        || format!("; the shaft carried {before} before"),
        |factor| {
            let way = if factor < 0.0 { ", the other way round" } else { "" };
            format!(": {} the {before} before the shock{way}", times(factor.abs()))
        },
    );
    format!(
        "The torque of the {} peaks at {} after {}{over}.",
        plain(name),
        quantity(metrics.peak_torque, 6, "N·m"),
        quantity(metrics.peak_torque_time, 4, "s")
    )
}

/// How it rings and when it is over.
pub(crate) fn settling(metrics: &ShaftMetrics) -> String {
    let rings =
        match (metrics.oscillation_frequency, metrics.decay_rate.filter(|decay| *decay > 0.0)) {
            (Some(frequency), Some(decay)) => {
                let damping = metrics.damping_ratio.map_or_else(String::new, |ratio| {
                    format!(" ({} of critical damping)", percent(ratio, 3))
                });
                format!(
                    "It rings at {} and decays at {}{damping}",
                    frequency_words(frequency),
                    quantity(decay, 4, "1/s")
                )
            }
            (Some(frequency), None) => {
                format!("It rings at {} and does not decay", frequency_words(frequency))
            }
            _ => "It turns round too rarely to tell a frequency".to_owned(),
        };
    let settled = metrics.settling_time.map_or_else(
        || "it has not settled within 5 % of its largest peak in the time computed".to_owned(),
        |time| {
            format!("it stays within 5 % of its largest peak from {} on", quantity(time, 4, "s"))
        },
    );
    format!("{rings}; {settled}.")
}

/// The metrics of every shaft, one row each.
pub(super) fn table(result: &HistoryResult) -> Grid {
    let rows = || result.metrics.shafts.values();
    let values = |of: fn(&ShaftMetrics) -> f64| rows().map(move |m| Some(of(m)));
    let maybe = |of: fn(&ShaftMetrics) -> Option<f64>| rows().map(of);
    Grid::new("Each shaft")
        .words("shaft", result.metrics.shafts.keys())
        .numbers("first peak", "rad", 5, maybe(|m| m.first_peak))
        .numbers("at", "s", 4, maybe(|m| m.first_peak_time))
        .numbers("peak torque", "N·m", 6, values(|m| m.peak_torque))
        .numbers("at", "s", 4, values(|m| m.peak_torque_time))
        .numbers("before", "N·m", 6, values(|m| m.static_torque))
        .numbers("peak over before", "", 4, maybe(|m| m.dynamic_factor))
        .numbers("in the end", "N·m", 6, maybe(|m| m.final_torque))
        .numbers("overshoot", "", 4, maybe(|m| m.overshoot))
        .numbers("settled after", "s", 4, maybe(|m| m.settling_time))
        .numbers("frequency", "rad/s", 5, maybe(|m| m.oscillation_frequency))
        .numbers("decay", "1/s", 4, maybe(|m| m.decay_rate))
        .without_empty_columns()
}

/// The coefficients of a single equation, where one is solved.
fn coefficients(shock: &ShockDetails) -> String {
    let symbol = |name: &str| match name {
        "omega_0" => "ω₀".to_owned(),
        "alpha_0" => "α₀".to_owned(),
        "gamma" => "γ".to_owned(),
        "mu" => "μ".to_owned(),
        other => plain(other),
    };
    let unit = |name: &str| match name {
        "omega_0" => "rad/s",
        "alpha_0" => "1/s",
        "gamma" => "1/(rad² s²)",
        "mu" => "1/(rad s²)",
        _ => "",
    };
    let parts: Vec<String> = shock
        .coefficients
        .iter()
        .map(|(name, value)| format!("{} = {}", symbol(name), quantity(*value, 6, unit(name))))
        .collect();
    if parts.is_empty() {
        String::new()
    } else {
        format!(" Its coefficients: {}.", parts.join(", "))
    }
}
