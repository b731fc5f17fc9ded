//! Fold planes: the shaded wedge is where three responses exist.

use halfshaft::model::embedded;
use halfshaft::model::question::read;
use halfshaft::present::figure::{Direction, Figure, Item, Region};
use halfshaft::{Answer, QuestionText, Silent, Verb, ask};

use super::common::{by_hand, line};
use super::figures::{figure, points};

const OMEGA: f64 = 26.06;
const ALPHA: f64 = -0.679;
const BETA: f64 = 0.0951;

/// The plane of excitation speed and amplitude of the scaled oscillator.
fn plane() -> Figure {
    let line = line(embedded::scaled(), &[]);
    let (parameter, method) = (Some("mode.f=1..20".to_owned()), Some("averaged".to_owned()));
    let text = QuestionText { parameter, method, ..QuestionText::default() };
    let question = read(Verb::Folds, &text, &line).unwrap();
    let answer: Answer = ask(&line, &question, &Silent).unwrap();
    figure(&answer, "folds-mode.f")
}

/// Responses at a speed and an amplitude: changes of sign of the averaged equation over ρ², on a
/// grid fine enough for roots this far apart.
fn responses(speed: f64, f: f64) -> usize {
    let (kappa, sigma) = (3.0 * ALPHA / (8.0 * OMEGA), speed - OMEGA);
    let most = 1.01 * (f / (BETA * OMEGA)).powi(2);
    let value = |step: u32| {
        let square = most * f64::from(step) / 20_000.0;
        let bent = sigma - kappa * square;
        square * (BETA * BETA / 4.0 + bent * bent) - (f / (2.0 * OMEGA)).powi(2)
    };
    (0..20_000).filter(|step| (value(*step) < 0.0) != (value(step + 1) < 0.0)).count()
}

/// Whether a point lies within a closed line, by the number of crossings to its right.
fn holds(region: &Region, x: f64, y: f64) -> bool {
    let corners: Vec<(f64, f64)> = region.x.iter().copied().zip(region.y.iter().copied()).collect();
    let mut inside = false;
    for (index, (x1, y1)) in corners.iter().enumerate() {
        let (x2, y2) = corners[(index + 1) % corners.len()];
        if (*y1 > y) != (y2 > y) && x < x1 + (x2 - x1) * (y - y1) / (y2 - y1) {
            inside = !inside;
        }
    }
    inside
}

// Source: theory 5 by hand: the number of responses by counting the roots of the averaged equation.
#[test]
fn the_shaded_wedge_holds_three_responses() {
    let drawing = plane();
    let regions: Vec<&Region> = drawing.panels[0]
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Region(region) => Some(region),
            _ => None,
        })
        .collect();
    assert_eq!((regions.len(), regions[0].name.as_str()), (1, "three responses"));
    let mut seen = [0, 0];
    for across in 0..24 {
        for up in 0..24 {
            let speed = 25.3 + 0.9 * (f64::from(across) + 0.37) / 24.0;
            let f = 2.0 + 16.0 * (f64::from(up) + 0.41) / 24.0;
            let three = responses(speed, f) == 3;
            seen[usize::from(three)] += 1;
            assert_eq!(holds(regions[0], speed, f), three, "at {speed} rad/s, f = {f}");
        }
    }
    assert!(seen.iter().all(|count| *count > 30), "both kinds of places were looked at: {seen:?}");
}

// Source: theory 5 by hand: the threshold of folding; the model's own f is 10.
#[test]
fn the_cusp_lies_at_the_threshold() {
    let drawing = plane();
    let cusps = points(&drawing, "cusp").expect("a cusp");
    let threshold = by_hand::fold_threshold(OMEGA, ALPHA, BETA);
    assert_eq!(cusps.y.len(), 1);
    assert!((cusps.y[0] / threshold - 1.0).abs() < 1e-6, "{} {threshold}", cusps.y[0]);
    let own = drawing.panels[0].items.iter().find_map(|item| match item {
        Item::Reference(line) if line.axis == Direction::Horizontal => Some(line.value),
        _ => None,
    });
    assert_eq!(own, Some(10.0));
}
