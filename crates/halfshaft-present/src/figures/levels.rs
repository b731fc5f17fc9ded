//! Closed form, first harmonic, harmonic balance and integration in one figure.

use halfshaft_results::{ReportResult, ResonanceResult};

use super::{axes, periodic, resonance};
use crate::figure::{Colour, Curve, Figure, Line, Panel};
use crate::reading::{Method, Reading};

/// The id of the figure.
pub(crate) const ID: &str = "levels";

/// The figure; `None` where fewer than two methods answered.
pub(super) fn figure(report: &ReportResult) -> Option<Figure> {
    let best = report.best_resonance()?;
    let reading = Reading::of(best);
    let column = format!("{}.harmonic1", reading.channel.as_ref()?);
    // The roughest lies at the bottom and is drawn widest, so that all show where they agree.
    let methods = [
        (&report.closed_form, Method::Averaged, Colour::Orange, 3.0),
        (&report.first_harmonic, Method::FirstHarmonic, Colour::Green, 2.0),
        (&report.resonance, Method::HarmonicBalance, Colour::PRIMARY, 1.0),
    ];
    let known = methods.into_iter().filter_map(|(result, method, colour, width)| {
        Some((result.as_ref()?, method.words(), colour, width))
    });
    let known: Vec<(&ResonanceResult, &str, Colour, f64)> = known.collect();
    if known.len() < 2 {
        return None;
    }
    let mut x = periodic::axis(&reading.x);
    x.range = reading.range();
    let mut panel = Panel::new(x, axes::column_axis(&column, "rad"));
    for (result, label, colour, width) in known {
        for branch in &result.branches {
            let curves = resonance::branch_curves(branch, "frequency", &column, label, colour);
            panel = panel.with_all(curves.into_iter().map(|curve| {
                // Wide dashes would close their gaps.
                let width = if curve.line == Line::Solid { width } else { width.min(1.6) };
                Curve { width, ..curve }
            }));
        }
    }
    panel = panel.with_all(resonance::verified(best, None, "frequency"));
    let caption = "The same response by every method: the closed form of one mode, one harmonic of \
                   the whole line, harmonic balance, and periodic motions of the full equations by \
                   integration. Solid is stable, dashed is not. Where only one colour shows, the \
                   methods agree to the width of the line; the table has the differences.";
    Some(Figure::new(ID, "The methods side by side").with_caption(caption).with(panel))
}
