//! Texts and numbers as plotly reads them.

use crate::figure::axis::Axis;
use crate::figure::scene::Ink;
use crate::figure::typeset::{Level, Rich, xml_escape};

/// A text with its levels in plotly's small subset of HTML.
pub(super) fn html(rich: &Rich) -> String {
    rich.runs
        .iter()
        .map(|run| match run.level {
            Level::Base => protected(&run.text),
            Level::Sub => format!("<sub>{}</sub>", protected(&run.text)),
            Level::Super => format!("<sup>{}</sup>", protected(&run.text)),
        })
        .collect()
}

/// A text of a user as HTML.
pub(super) fn typeset(text: &str) -> String {
    html(&Rich::parse(text))
}

/// Besides the signs of HTML, plotly acts on `%{...}` (templates) and `$...$` (formulas).
fn protected(text: &str) -> String {
    xml_escape(text).replace('%', "&#37;").replace('$', "&#36;")
}

/// One line of a hover text: the quantity and its value to six digits with its unit.
pub(super) fn hover_line(axis: &Axis, letter: &str) -> String {
    if !axis.names.is_empty() {
        return format!("%{{{letter}}}");
    }
    let label = typeset(&axis.label);
    let label = if label.is_empty() { letter } else { &label };
    let unit = typeset(&axis.unit);
    let unit = if unit.is_empty() { unit } else { format!(" {unit}") };
    format!("{label}: %{{{letter}:.6~g}}{unit}")
}

/// A colour as `#rrggbb`.
pub(super) fn hex((red, green, blue): Ink) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Digits of a number in the data: more than a screen or the hover text shows.
pub(super) const DIGITS: usize = 8;

/// A value to eight digits.
pub(super) fn rounded(value: f64) -> Option<f64> {
    rounded_to(value, DIGITS)
}

/// A value to this many digits; none if it is infinite or not a number.
pub(super) fn rounded_to(value: f64, digits: usize) -> Option<f64> {
    // Writing and reading decimal digits rounds correctly at every size of number.
    let shown: f64 = format!("{value:.*e}", digits.clamp(1, 17) - 1).parse().ok()?;
    shown.is_finite().then_some(shown)
}
