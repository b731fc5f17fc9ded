//! The table of special points.

use halfshaft_results::{SpecialKind, SpecialPoint, Status};

use super::super::{Grid, check::minus};
use crate::reading::{Method, Reading};
use crate::words::{plain, special_explanation, special_words};

/// Points of a branch that are told: all but its ends.
fn points<'r>(reading: &Reading<'r>) -> Vec<(usize, &'r SpecialPoint)> {
    let branches = reading.result.branches.iter().enumerate();
    let all = branches
        .flat_map(|(index, branch)| branch.special_points.iter().map(move |point| (index, point)));
    all.filter(|(_, point)| point.kind != SpecialKind::End).collect()
}

/// Every special point with its place, its swing and what it does to stability.
pub(super) fn grid(reading: &Reading<'_>) -> Grid {
    let points = points(reading);
    let several = reading.result.branches.len() > 1;
    let of = |name: String| points.iter().map(move |(_, point)| point.value(&name));
    let rpm = |value: Option<f64>| value.map(|value| value * 30.0 / std::f64::consts::PI);
    let mut grid = Grid::new("Special points")
        .words("kind", points.iter().map(|(_, p)| special_words(p.kind)));
    if several {
        let branch = points.iter().map(|(index, _)| (index + 1).to_string());
        grid = grid.words("response", branch);
    }
    if !reading.x.is_speed() {
        let (name, unit) = (reading.x.name(), reading.x.unit.clone());
        grid = grid.numbers(&name, &unit, 8, of(reading.x.column.clone()));
    }
    let swing = reading.swing_column();
    let harmonic = reading.column();
    grid = grid.numbers("excitation speed", "rad/s", 9, of("frequency".to_owned())).numbers(
        "excitation speed",
        "rpm",
        6,
        of("frequency".to_owned()).map(rpm),
    );
    if swing != harmonic && reading.method != Method::FirstHarmonic {
        grid = grid.numbers("twist, half of peak to peak", "rad", 6, of(swing));
    }
    let multiplier = |point: &SpecialPoint| point.value("multiplier_angle").map(f64::to_degrees);
    grid = grid
        .numbers("twist, first harmonic", "rad", 7, of(harmonic))
        .words("unstable directions", points.iter().map(|(_, point)| change(point)))
        .numbers("angle of the multiplier", "°", 5, points.iter().map(|(_, p)| multiplier(p)));
    // That a point is located is what is to be expected.
    if points.iter().any(|(_, point)| point.status == Status::Bracketed) {
        grid = grid.words("", points.iter().map(|(_, point)| status(point)));
    }
    grid.without_empty_columns()
}

fn change(point: &SpecialPoint) -> String {
    point.unstable_dimension_change.map_or_else(String::new, |change| minus(&format!("{change:+}")))
}

fn status(point: &SpecialPoint) -> &'static str {
    match point.status {
        Status::Located => "located",
        Status::Bracketed => "between two samples",
    }
}

/// What happens at the kinds of points that there are.
pub(super) fn explanations(reading: &Reading<'_>) -> String {
    let mut told: Vec<&str> = Vec::new();
    for (_, point) in points(reading) {
        let text = special_explanation(point.kind);
        if !told.contains(&text) {
            told.push(text);
        }
    }
    told.join(" ")
}

/// What the analysis has to say of single points.
pub(super) fn remarks(reading: &Reading<'_>) -> Vec<String> {
    let told = |(_, point): (usize, &SpecialPoint)| {
        let note = plain(point.note.as_deref()?);
        let place = point.value(&reading.x.column).map(|value| reading.x.told(value));
        let place = place.map_or_else(String::new, |place| format!(" at {place}"));
        Some(format!("{}{place}: {note}", crate::words::capital(special_words(point.kind))))
    };
    points(reading).into_iter().filter_map(told).collect()
}
