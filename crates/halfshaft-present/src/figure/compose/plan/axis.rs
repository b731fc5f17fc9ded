//! What stands along one axis.

use crate::figure::axis::{Axis, Scale, Secondary};
use crate::figure::compose::style;
use crate::figure::compose::wrap::wrapped;
use crate::figure::font::{CAP_HEIGHT, Weight};
use crate::figure::ticks::{self, Room, Ticks};
use crate::figure::typeset::Rich;
use crate::figure::view::View;

/// One axis with its marks and text.
pub(in crate::figure::compose) struct AxisPlan {
    pub view: View,
    pub ticks: Ticks,
    pub text: Vec<Rich>,
    /// Room that the numbers need across the axis.
    pub label_width: f64,
    pub secondary: Option<SecondPlan>,
}

/// The second reading of an axis.
pub(in crate::figure::compose) struct SecondPlan {
    pub reading: Secondary,
    pub ticks: Ticks,
    pub text: Vec<Rich>,
    pub label_width: f64,
}

impl AxisPlan {
    pub(super) fn new(axis: &Axis, view: View, length: f64, along: bool) -> Self {
        let room = Room { length, along, size: style::TICK_SIZE };
        let ticks = if axis.names.is_empty() {
            ticks::choose(&view, room)
        } else {
            ticks::named(&axis.names, &view, room)
        };
        let text = axis_lines(&axis.label, &axis.unit, &ticks, length);
        let label_width = label_width(&ticks, along);
        let secondary = axis.usable_secondary().map(|second| SecondPlan::new(second, &view, room));
        Self { view, ticks, text, label_width, secondary }
    }

    /// Where the major and minor marks lie along the axis, 0 to 1.
    pub(in crate::figure::compose) fn shares(&self, ticks: &Ticks) -> (Vec<f64>, Vec<f64>) {
        let majors = ticks.majors.iter().map(|tick| self.view.share(tick.value));
        let minors = ticks.minors.iter().map(|value| self.view.share(*value));
        (majors.collect(), minors.collect())
    }

    /// The same for the second reading.
    pub(in crate::figure::compose) fn secondary_shares(
        &self,
        second: &SecondPlan,
    ) -> (Vec<f64>, Vec<f64>) {
        let share = |value: f64| self.view.share(second.reading.primary(value));
        let majors = second.ticks.majors.iter().map(|tick| share(tick.value));
        (majors.collect(), second.ticks.minors.iter().map(|value| share(*value)).collect())
    }
}

impl SecondPlan {
    fn new(reading: &Secondary, view: &View, room: Room) -> Self {
        let ends = (reading.value(view.low), reading.value(view.high));
        let (low, high) = (ends.0.min(ends.1), ends.0.max(ends.1));
        let own = match view.scale {
            Scale::Linear => View::linear(low, high),
            Scale::Log => View::log(low, high),
        };
        let mut ticks = ticks::choose(&own, room);
        // An offset that dwarfs the interval leaves marks that have no place on the axis.
        ticks.majors.retain(|tick| view.shows(reading.primary(tick.value)));
        ticks.minors.retain(|value| view.shows(reading.primary(*value)));
        let text = axis_lines(&reading.label, &reading.unit, &ticks, room.length);
        let label_width = label_width(&ticks, room.along);
        Self { reading: reading.clone(), ticks, text, label_width }
    }
}

/// The text of an axis in lines no longer than the axis and a little more.
fn axis_lines(label: &str, unit: &str, ticks: &Ticks, length: f64) -> Vec<Rich> {
    let text = ticks::axis_text(label, unit, &ticks.reading);
    let room = (1.1 * length / style::SLACK).max(30.0);
    wrapped(&text, style::LABEL_SIZE, Weight::Regular, room, 3)
}

/// Room that the numbers need across the axis.
fn label_width(ticks: &Ticks, along: bool) -> f64 {
    let size = style::TICK_SIZE;
    if along {
        return size * (CAP_HEIGHT + 0.05);
    }
    let widths = ticks.majors.iter().map(|tick| tick.label.width(size, Weight::Regular));
    style::SLACK * widths.fold(0.0, f64::max)
}
