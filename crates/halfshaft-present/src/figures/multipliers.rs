//! Floquet multipliers in the complex plane, against the unit circle.

use std::f64::consts::TAU;

use halfshaft_results::SpecialKind;

use crate::figure::{Axis, Colour, Curve, Figure, Line, Panel, Points, Size};
use crate::reading::Reading;

/// The id of the figure.
pub(super) const ID: &str = "multipliers";
/// Half of the width of the plane at most, in radii of the circle.
const WIDEST: f64 = 2.5;

/// The multipliers of all responses; `None` where none is known or none leaves the circle but in
/// folds, at 1, where there is nothing to see.
pub(super) fn figure(reading: &Reading<'_>) -> Option<Figure> {
    let branches = &reading.result.branches;
    let leaves = |kind: SpecialKind| {
        matches!(kind, SpecialKind::PeriodDoubling | SpecialKind::NeimarkSacker)
    };
    if !branches.iter().flat_map(|b| &b.special_points).any(|point| leaves(point.kind)) {
        return None;
    }
    let all = || branches.iter().flat_map(|branch| &branch.multipliers).flatten();
    let size = |multiplier: &[f64; 2]| multiplier[0].hypot(multiplier[1]);
    let most = all().map(size).filter(|size| size.is_finite()).reduce(f64::max)?;
    if most <= 1.0 {
        return None;
    }
    let reach = (1.1 * most).clamp(1.25, WIDEST);
    let axis = |label: &str| Axis::new(label, "").with_range(-reach, reach);
    let mut panel = Panel::new(axis("Real part"), axis("Imaginary part")).with(circle());
    for (label, outside, colour) in
        [("inside: stable", false, Colour::PRIMARY), ("outside: not stable", true, Colour::DANGER)]
    {
        let (x, y): (Vec<f64>, Vec<f64>) = all()
            .filter(|one| (size(one) > 1.0) == outside)
            // Of a pair only one may be listed.
            .flat_map(|one| [(one[0], one[1]), (one[0], -one[1])])
            .filter(apart(reach))
            .unzip();
        if !x.is_empty() {
            panel = panel.with(Points { size: 3.5, ..Points::new(label, x, y, colour) });
        }
    }
    let caption = "Floquet multipliers of all responses: the factors by which small disturbances \
                   change over one period. They leave the unit circle at 1 in a fold, at −1 in a \
                   period doubling, as a pair in a Neimark-Sacker point. Of multipliers that lie \
                   closer than a dot one is drawn.";
    Some(
        Figure::new(ID, "Floquet multipliers and the unit circle")
            .with_caption(caption)
            .with_size(Size::Square)
            .with(panel),
    )
}

/// Cells along half of the plane: one dot in each is enough, more would run into each other.
const CELLS: f64 = 45.0;

/// Whether a place lies in a cell of its own among those asked before.
fn apart(reach: f64) -> impl FnMut(&(f64, f64)) -> bool {
    let mut taken = std::collections::BTreeSet::new();
    let cell = move |value: f64| (value / reach * CELLS).round() as i64;
    move |(x, y)| x.is_finite() && y.is_finite() && taken.insert((cell(*x), cell(*y)))
}

fn circle() -> Curve {
    let turn = |step: u32| TAU * f64::from(step) / 180.0;
    let (y, x) = (0..=180).map(|step| turn(step).sin_cos()).unzip();
    Curve::new("unit circle", x, y, Colour::AUXILIARY).with_line(Line::Dashed).with_width(1.0)
}

#[cfg(test)]
mod tests {
    use super::{CELLS, apart};

    /// Oracle: by hand: places a hundredth of a cell apart are one, those two cells apart are two.
    #[test]
    fn dots_keep_apart() {
        let mut keeps = apart(1.0);
        assert!(keeps(&(0.0, 0.0)));
        assert!(!keeps(&(0.01 / CELLS, 0.0)));
        assert!(keeps(&(2.0 / CELLS, 0.0)));
        assert!(!keeps(&(f64::NAN, 0.0)));
    }
}
