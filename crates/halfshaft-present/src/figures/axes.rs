//! Axes for the columns of results.

use crate::figure::{Axis, Colour, Curve, Reference, escape};
use crate::words::{RPM, capital, column_label, short, unit};

/// Longest name of a user in a figure, in characters.
const NAME: usize = 36;

/// A name of a user in a figure.
pub(super) fn name(text: &str) -> String {
    escape(&short(text, NAME))
}

/// The axis of a column: words and unit; speeds of the excitation also in rpm.
pub(super) fn column_axis(column: &str, symbol: &str) -> Axis {
    let label = capital(&column_label(column));
    let axis = Axis::new(escape(&short(&label, 80)), escape(unit(symbol)));
    if column == "frequency" { with_rpm(axis) } else { axis }
}

/// The axis of the excitation speed.
pub(super) fn speed_axis() -> Axis {
    with_rpm(Axis::new("Excitation speed Ω", "rad/s"))
}

fn with_rpm(axis: Axis) -> Axis {
    axis.with_secondary("Excitation speed", "rpm", RPM)
}

/// An axis for times.
pub(super) fn time_axis() -> Axis {
    Axis::new("Time", "s")
}

/// A curve through two columns; a value of one without the other is left out by the figure.
pub(super) fn curve(label: String, x: &[f64], y: &[f64], colour: Colour) -> Curve {
    Curve::new(label, x.to_vec(), y.to_vec(), colour)
}

/// A thin level line for reading.
pub(super) fn level(value: f64, label: &str) -> Reference {
    let line = crate::figure::Line::Dotted;
    Reference { line, ..Reference::horizontal(value, label, Colour::AUXILIARY) }
}
