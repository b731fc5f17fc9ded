//! Whether the shafts take the shock.

use halfshaft_results::{ReportResult, ShaftMetrics, StaticResult};

use super::{Finding, Standing, limit_twist};
use crate::account::head;
use crate::words::{percent, plain, quantity, times};

/// The shaft that comes nearest to its limit in the shock, or else the one with the largest torque.
pub(super) fn shock(report: &ReportResult) -> Option<Finding> {
    let result = report.shock.as_ref()?;
    if let Some(end) = head::early_end(&result.header.termination) {
        return Some(Finding::new(Standing::Unsafe, "Shock", crate::words::capital(&end) + "."));
    }
    let statics = report.statics.as_ref();
    let strain = |shaft: &String| {
        let twist = result.metrics.channels.get(&format!("{shaft}.twist"))?;
        let reach =
            |limit: Option<f64>, twist: f64| limit.map(|limit| (twist.abs() / limit, limit));
        let forward = reach(limit_twist(statics?, shaft, 1.0), twist.maximum.max(0.0));
        let back = reach(limit_twist(statics?, shaft, -1.0), twist.minimum.min(0.0));
        forward.into_iter().chain(back).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let shafts = result.metrics.shafts.iter();
    let strained = shafts.clone().filter_map(|(name, metrics)| {
        let (share, limit) = strain(name)?;
        Some((name, metrics, share, limit))
    });
    if let Some((name, metrics, share, limit)) = strained.max_by(|a, b| a.2.total_cmp(&b.2)) {
        let standing = Standing::of_margin(1.0 / share);
        let text = limited(statics, name, metrics, (share, limit));
        return Some(Finding::new(standing, "Shock", text));
    }
    let (name, metrics) =
        shafts.max_by(|a, b| a.1.peak_torque.abs().total_cmp(&b.1.peak_torque.abs()))?;
    let text = format!("{}; no law has a limit to hold that against.", rise(name, metrics));
    Some(Finding::new(Standing::Note, "Shock", text))
}

/// How far the torque of a shaft rises.
fn rise(name: &str, metrics: &ShaftMetrics) -> String {
    let over = metrics.dynamic_factor.map_or_else(String::new, |factor| {
        let way = if factor < 0.0 { " the other way round" } else { "" };
        format!(", {} the torque before{way}", times(factor.abs()))
    });
    let peak = quantity(metrics.peak_torque, 4, "N·m");
    format!("The torque of the {} reaches {peak}{over}", plain(name))
}

fn limited(
    statics: Option<&StaticResult>,
    name: &str,
    metrics: &ShaftMetrics,
    (share, limit): (f64, f64),
) -> String {
    let capacity = statics
        .and_then(|statics| statics.capacity.get(name))
        .and_then(|c| if metrics.peak_torque < 0.0 { c.negative } else { c.positive });
    let of_capacity = capacity.map_or_else(String::new, |capacity| {
        let share = (metrics.peak_torque / capacity.torque).abs();
        let carries = quantity(capacity.torque.abs(), 4, "N·m");
        format!(", {} of the {carries} that it can carry", percent(share, 3))
    });
    let twist = quantity(share * limit, 4, "rad");
    let limit = quantity(limit, 4, "rad");
    let passes = if share >= 1.0 { "passes" } else { "stays below" };
    format!(
        "{}{of_capacity}; its twist of {twist} {passes} the {limit} at which the law gives way.",
        rise(name, metrics)
    )
}
