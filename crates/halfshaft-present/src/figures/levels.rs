//! Closed form, first harmonic, harmonic balance and integration in one figure.

use halfshaft_results::{ReportResult, ResonanceResult};

use super::{axes, periodic, resonance};
use crate::account::levels;
use crate::figure::{Axis, Colour, Curve, Figure, LegendPlace, Line, Marker, Panel, Points, Scale};
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
        (&report.closed_form, Method::Averaged, Colour::Orange, 4.5),
        (&report.first_harmonic, Method::FirstHarmonic, Colour::Green, 2.6),
        (&report.resonance, Method::HarmonicBalance, Colour::PRIMARY, 1.0),
    ];
    let lower = differences(report, &reading);
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
                   methods agree to the width of the line. Below: how far each is from integration, \
                   in percent of it; the table has all differences.";
    let figure = Figure::new(ID, "The methods side by side").with_caption(caption).with(panel);
    Some(match lower {
        Some(lower) => figure.with(lower),
        None => figure,
    })
}

/// Differences from integration, in percent, on a logarithmic axis.
fn differences(report: &ReportResult, reading: &Reading<'_>) -> Option<Panel> {
    let mut x = periodic::axis(&reading.x);
    x.range = reading.range();
    let y = Axis { scale: Scale::Log, ..Axis::new("Off from integration", "%") };
    let mut panel = Panel::new(x, y).with_legend(LegendPlace::Hidden);
    panel.height_share = 0.6;
    let looks = [
        (Method::Averaged, Colour::Orange, Marker::Square),
        (Method::FirstHarmonic, Colour::Green, Marker::Triangle),
        (Method::HarmonicBalance, Colour::PRIMARY, Marker::Circle),
    ];
    for (method, colour, marker) in looks {
        let (x, y): (Vec<f64>, Vec<f64>) = levels::from_integration(&report.levels, method)
            .into_iter()
            .map(|(speed, part)| (speed, 100.0 * part.max(f64::EPSILON)))
            .unzip();
        if !x.is_empty() {
            panel = panel.with(Points::new(method.words(), x, y, colour).with_marker(marker));
        }
    }
    (!panel.items.is_empty()).then_some(panel)
}
