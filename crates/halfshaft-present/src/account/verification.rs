//! What is told of responses held against integration of the full equations.

use halfshaft_results::{ResonanceResult, VerifiedPoint};

use super::{Account, Grid, Tone};
use crate::reading::{Method, Reading};
use crate::words::{capital, column_label, counted, number, percent, quantity};

/// The verdict, the table and how to read it; nothing where nothing was checked.
pub(crate) fn account(result: &ResonanceResult) -> Account {
    let mut account = Account::default();
    account.text([verdict(result)]);
    account.grid(grid(result));
    if !result.verification.is_empty() {
        account.note(
            "Integrated means a periodic motion of the full equations, found from the prediction. \
             Its largest Floquet multiplier is the factor by which a small disturbance changes over \
             one period: below 1 it dies out.",
        );
    }
    account
}

/// The check of the largest predicted response, and the check with the largest difference.
pub(crate) fn best_and_worst(points: &[VerifiedPoint]) -> Option<(&VerifiedPoint, &VerifiedPoint)> {
    let finite = || points.iter().filter(|point| point.relative_difference.is_finite());
    let top = finite().max_by(|a, b| a.predicted.total_cmp(&b.predicted))?;
    let worst = finite()
        .max_by(|a, b| a.relative_difference.abs().total_cmp(&b.relative_difference.abs()))?;
    Some((top, worst))
}

/// Largest difference of the predicted multipliers from those of the orbits, where there are any.
pub(crate) fn multiplier_difference(points: &[VerifiedPoint]) -> Option<f64> {
    let differences = points.iter().filter_map(|point| {
        let difference = (point.predicted_multiplier? - point.largest_multiplier).abs();
        difference.is_finite().then_some(difference)
    });
    differences.reduce(f64::max)
}

/// How well the prediction agrees with integration.
pub(crate) fn verdict(result: &ResonanceResult) -> String {
    let points = &result.verification;
    let Some((top, worst)) = best_and_worst(points) else { return String::new() };
    let disagree = points.iter().filter(|p| p.predicted_stable != p.integrated_stable).count();
    let stability = if disagree == 0 {
        "stability agrees at all of them".to_owned()
    } else {
        format!("stability disagrees at {}", counted(disagree, "point", "points"))
    };
    let multipliers = multiplier_difference(points).map_or_else(String::new, |difference| {
        format!(", the largest multipliers to {}", number(difference, 2))
    });
    let method = Reading::of(result).method.with_article();
    let place = place(result);
    format!(
        "Held against integration of the full equations at {}: at the largest of them ({}) {method} \
         differs by {}; the largest difference is {} at {}; {stability}{multipliers}.",
        counted(points.len(), "response", "responses"),
        place(top),
        percent(top.relative_difference.abs(), 2),
        percent(worst.relative_difference.abs(), 2),
        place(worst),
    )
}

/// Where a checked response lies, in words.
fn place(result: &ResonanceResult) -> impl Fn(&VerifiedPoint) -> String {
    // Where a parameter was gone through, all lie at one speed, and the swing tells them apart.
    let speeds = Reading::of(result).x.is_speed();
    move |point| {
        if speeds {
            quantity(point.frequency, 5, "rad/s")
        } else {
            format!("±{}", quantity(point.predicted, 4, "rad"))
        }
    }
}

fn grid(result: &ResonanceResult) -> Grid {
    let rows = &result.verification;
    let values = |of: fn(&VerifiedPoint) -> f64| rows.iter().map(move |point| Some(of(point)));
    let word = |stable: bool| if stable { "stable" } else { "unstable" };
    let method = Reading::of(result).method;
    let title = format!(
        "{} held against integration: first harmonic of the twist",
        capital(method.words())
    );
    let rpm = |point: &VerifiedPoint| Some(point.frequency * 30.0 / std::f64::consts::PI);
    let mut grid = Grid::new(title)
        .numbers("excitation speed", "rad/s", 6, values(|p| p.frequency))
        .numbers("excitation speed", "rpm", 5, rows.iter().map(rpm));
    let first = rows.first().map(|point| &point.channel);
    if rows.iter().any(|point| Some(&point.channel) != first) {
        grid = grid.words("of", rows.iter().map(|point| column_label(&point.channel)));
    }
    let digits = if method == Method::HarmonicBalance { 9 } else { 6 };
    grid = grid
        .numbers(method.words(), "rad", digits, values(|p| p.predicted))
        .numbers("integrated", "rad", digits, values(|p| p.integrated))
        .numbers("difference", "%", 3, values(|p| 100.0 * p.relative_difference))
        .words(
            "stability (both)",
            rows.iter().map(|point| {
                if point.predicted_stable == point.integrated_stable {
                    word(point.predicted_stable).to_owned()
                } else {
                    let (one, other) = (point.predicted_stable, point.integrated_stable);
                    format!("{} / {}", word(one), word(other))
                }
            }),
        )
        .numbers("largest multiplier", "", 4, values(|p| p.largest_multiplier));
    if rows.iter().any(|point| point.predicted_multiplier.is_some()) {
        let difference =
            |p: &VerifiedPoint| p.predicted_multiplier.map(|own| own - p.largest_multiplier);
        grid = grid.numbers("its difference", "", 2, rows.iter().map(difference));
    }
    grid.with_tones(rows.iter().map(|point| {
        if point.predicted_stable == point.integrated_stable { Tone::Usual } else { Tone::Bad }
    }))
}
