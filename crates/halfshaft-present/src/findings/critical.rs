//! Critical speeds and the operating range.

use halfshaft_results::{CriticalSpeed, ReportResult};

use super::{Finding, Standing};
use crate::words::{RPM, counted, number, percent, plain, quantity};

/// Distance from the operating range below which a critical speed is told.
const NEAR: f64 = 0.2;

/// Which excited critical speeds lie in the operating range or near it; nothing without a range.
pub(super) fn critical(report: &ReportResult) -> Option<Finding> {
    let campbell = report.campbell.as_ref()?;
    let (from, to) = campbell.operating?;
    let excited = campbell.gears.iter().flat_map(|gear| &gear.critical);
    let mut excited: Vec<&CriticalSpeed> = excited.filter(|speed| speed.shaft.is_some()).collect();
    excited.sort_by(|a, b| b.torque.unwrap_or(0.0).total_cmp(&a.torque.unwrap_or(0.0)));
    let range = format!("{} to {} rpm", number(from * RPM, 4), number(to * RPM, 4));
    let within = |most: f64| excited.iter().filter(move |s| s.margin.is_some_and(|m| m <= most));
    if let Some(worst) = within(0.0).next() {
        let count = counted(within(0.0).count(), "critical speed", "critical speeds");
        let text =
            format!("{count} in the operating range of {range}; the strongest is {}.", told(worst));
        return Some(Finding::new(Standing::Watch, "Critical speeds", text));
    }
    let nearest =
        within(NEAR).min_by(|a, b| a.margin.unwrap_or(NEAR).total_cmp(&b.margin.unwrap_or(NEAR)));
    if let Some(nearest) = nearest {
        let margin = percent(nearest.margin.unwrap_or(0.0), 2);
        let text = format!(
            "None in the operating range of {range}; {margin} off it lies {}.",
            told(nearest)
        );
        return Some(Finding::new(Standing::Watch, "Critical speeds", text));
    }
    let text =
        format!("None in the operating range of {range} or within {} of it.", percent(NEAR, 2));
    Some(Finding::new(Standing::Safe, "Critical speeds", text))
}

fn told(speed: &CriticalSpeed) -> String {
    let torque = match (&speed.shaft, speed.torque) {
        (Some(shaft), Some(torque)) => {
            format!(", which alone loads the {} with ±{}", plain(shaft), quantity(torque, 4, "N·m"))
        }
        _ => String::new(),
    };
    format!(
        "order {} on mode {} at {} rpm{torque}",
        number(speed.order, 4),
        speed.mode,
        number(speed.speed * RPM, 4)
    )
}
