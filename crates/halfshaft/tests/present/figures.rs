//! Figures of answers: what is drawn is what was answered.

use halfshaft::Answer;
use halfshaft::model::embedded;
use halfshaft::present::figure::{Axis, Curve, Direction, Figure, Item, Line, Points};
use halfshaft::present::figures;
use halfshaft::results::{Branch, ResonanceResult, SpecialKind, Table};

use super::common::by_hand::{self, DEMAND};
use super::common::{EMBEDDED, HARDENING, OVERLOADED, SCALED, answers, line, the_report};

pub fn figure(answer: &Answer, id: &str) -> Figure {
    let found = figures::of(answer).into_iter().find(|figure| figure.id == id);
    found.unwrap_or_else(|| panic!("no figure {id}"))
}

fn curves<'f>(figure: &'f Figure, panel: usize, name: &str) -> Vec<&'f Curve> {
    let of = |item: &'f Item| match item {
        Item::Curve(curve) if curve.name == name => Some(curve),
        _ => None,
    };
    figure.panels[panel].items.iter().filter_map(of).collect()
}

pub fn points<'f>(figure: &'f Figure, name: &str) -> Option<&'f Points> {
    figure.panels.iter().flat_map(|panel| &panel.items).find_map(|item| match item {
        Item::Points(points) if points.name == name => Some(points),
        _ => None,
    })
}

fn resonance(answer: &Answer) -> &ResonanceResult {
    the_report(answer).best_resonance().expect("a resonance")
}

/// Rows of a branch as (speed, swing, stable).
fn rows(branch: &Branch, column: &str) -> Vec<(f64, f64, bool)> {
    let (x, y) = (branch.values("frequency"), branch.values(column));
    let stable = branch.values("stable");
    assert!(!x.is_empty() && x.len() == y.len() && x.len() == stable.len());
    x.iter().zip(y).zip(stable).map(|((x, y), stable)| (*x, *y, *stable == 1.0)).collect()
}

// Source: the answer's own column of stability: between two neighbours the line is solid where both
// are stable and dashed elsewhere; every sample is drawn, in its order, and nothing else.
#[test]
fn the_response_is_solid_where_it_is_stable_and_dashed_elsewhere() {
    let cases =
        [(&*EMBEDDED, "half-shaft", 0), (&*HARDENING, "half-shaft", 0), (&*SCALED, "spring", 1)];
    for (answer, shaft, unstable) in cases {
        let drawing = figure(answer, "response");
        let drawn = curves(&drawing, 0, "response");
        let column = format!("{shaft}.twist.harmonic1");
        let mut pieces = drawn.iter().flat_map(|curve| {
            let places = curve.x.iter().zip(&curve.y);
            let next = places.clone().skip(1);
            places.zip(next).map(|(from, to)| (from, to, curve.line))
        });
        for branch in &resonance(answer).branches {
            for pair in rows(branch, &column).windows(2) {
                let (from, to, line) = pieces.next().expect("every piece is drawn");
                assert_eq!(
                    (*from.0, *from.1, *to.0, *to.1),
                    (pair[0].0, pair[0].1, pair[1].0, pair[1].1)
                );
                let wanted = if pair[0].2 && pair[1].2 { Line::Solid } else { Line::Dashed };
                assert_eq!(line, wanted, "at {} rad/s", from.0);
            }
        }
        assert!(pieces.next().is_none());
        assert_eq!(drawn.iter().filter(|curve| curve.line == Line::Dashed).count(), unstable);
    }
}

// Source: theory 5 by hand for x'' + 26.06² x − 0.679 x³ + 0.0951 x' = 10 cos Ωt: at a fold
// (β/2)² + (σ − κρ²)(σ − 3κρ²) = 0 and ρ²((β/2)² + (σ − κρ²)²) = (f/(2ω))², κ = 3α/(8ω); where
// the first is negative, and only there, the response is not stable.
#[test]
fn fold_markers_lie_at_the_folds() {
    let (omega, alpha, beta, f) = (26.06, -0.679, 0.0951, 10.0);
    let kappa = 3.0 * alpha / (8.0 * omega);
    let drawing = figure(&SCALED, "response");
    let folds = points(&drawing, "fold").expect("two folds");
    assert_eq!(folds.x.len(), 2);
    for (speed, rho) in folds.x.iter().zip(&folds.y) {
        let sigma = speed - omega;
        let bent = sigma - kappa * rho * rho;
        let response = rho * rho * (beta * beta / 4.0 + bent * bent);
        assert!((response / (f / (2.0 * omega)).powi(2) - 1.0).abs() < 1e-6, "{speed} {rho}");
        let slope = beta * beta / 4.0 + bent * (bent - 2.0 * kappa * rho * rho);
        assert!(slope.abs() < 1e-8, "{speed} {rho}: {slope}");
    }
    let special = resonance(&SCALED).branches.iter().flat_map(|branch| &branch.special_points);
    let of_answer = special.filter(|point| point.kind == SpecialKind::Fold);
    let speeds: Vec<f64> = of_answer.filter_map(|point| point.value("frequency")).collect();
    assert_eq!(folds.x, speeds);
    // Each label tells its speed.
    for (label, speed) in folds.labels.iter().zip(&folds.x) {
        super::common::assert_shows(super::common::number_after(label, "fold"), *speed, 6);
    }

    for curve in curves(&drawing, 0, "response") {
        // The ends of a dashed line are its stable neighbours.
        let inner = 1..curve.x.len() - 1;
        for (speed, rho) in curve.x[inner.clone()].iter().zip(&curve.y[inner]) {
            let bent = speed - omega - kappa * rho * rho;
            let slope = beta * beta / 4.0 + bent * (bent - 2.0 * kappa * rho * rho);
            // The folds themselves stand among the samples.
            let agrees = if curve.line == Line::Dashed { slope < 1e-8 } else { slope > -1e-8 };
            assert!(agrees, "{:?} at {speed} {rho}: {slope}", curve.line);
        }
    }
    // Where nothing folds there is no such marker.
    assert!(points(&figure(&EMBEDDED, "response"), "fold").is_none());
}

// Source: the law by hand: it gives way beyond the twist √(k1/(3|k3|)); a gear asks 850·5.71 times
// its ratio.
#[test]
fn the_law_is_dashed_where_it_gives_way_and_gears_are_marked() {
    let drawing = figure(&EMBEDDED, "torque-half-shaft");
    let limit = by_hand::limit_twist();
    for curve in curves(&drawing, 0, "law, stable part") {
        assert_eq!(curve.line, Line::Solid);
        assert!(curve.x.iter().all(|x| x.abs() <= limit * (1.0 + 1e-12)));
    }
    let falls = curves(&drawing, 0, "law, gives way");
    assert!(falls.iter().all(|curve| curve.line == Line::Dashed));
    for curve in &falls {
        let inner = &curve.x[1..curve.x.len() - 1];
        assert!(inner.iter().all(|x| x.abs() >= limit * (1.0 - 1e-12)), "{inner:?}");
    }
    assert_eq!(falls.len(), 2, "at both sides");
    for curve in curves(&drawing, 0, "law, stable part").into_iter().chain(falls) {
        for (x, y) in curve.x.iter().zip(&curve.y) {
            let torque = by_hand::K1 * x + by_hand::K3 * x.powi(3);
            assert!((y - torque).abs() < 1e-9 * by_hand::capacity(), "{x} {y} {torque}");
        }
    }
    let mut asked: Vec<f64> = drawing.panels[0]
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Reference(line) if line.axis == Direction::Horizontal => Some(line.value),
            _ => None,
        })
        .collect();
    let mut wanted: Vec<f64> = [5.82, 3.23, 1.79, 1.0, 0.64].map(|ratio| ratio * DEMAND).into();
    wanted.push(by_hand::capacity());
    asked.sort_by(f64::total_cmp);
    wanted.sort_by(f64::total_cmp);
    assert_eq!(asked.len(), wanted.len());
    for (asked, wanted) in asked.iter().zip(&wanted) {
        assert!((asked / wanted - 1.0).abs() < 1e-9, "{asked} {wanted}");
    }
    let rest = points(&drawing, "stable state").expect("a stable state");
    assert!((rest.x[0] - by_hand::twist(DEMAND)).abs() < 1e-9 && rest.x.len() == 1);
}

// Source: the columns of the answer.
#[test]
fn histories_show_the_columns_of_the_answer() {
    let shock = the_report(&EMBEDDED).shock.as_ref().expect("a shock");
    let drawing = figure(&EMBEDDED, "history");
    assert_eq!(drawing.panels.len(), 3);
    for (panel, quantity) in ["twist", "twist_rate", "torque"].into_iter().enumerate() {
        let drawn = curves(&drawing, panel, "half-shaft");
        assert_eq!(drawn.len(), 1);
        assert_eq!(drawn[0].x, shock.values("time"));
        assert_eq!(drawn[0].y, shock.values(&format!("half-shaft.{quantity}")));
    }
    let compared: &Table = shock.shock.as_ref().unwrap().comparison_history.as_ref().unwrap();
    let methods = figure(&EMBEDDED, "methods");
    let full = curves(&methods, 0, "full");
    assert_eq!((full.len(), full[0].y.as_slice()), (1, compared.values("full")));
}

/// Axes of all panels, with what stands on them.
fn axes(figure: &Figure) -> Vec<&Axis> {
    figure.panels.iter().flat_map(|panel| [&panel.x, &panel.y]).collect()
}

// Source: the rule that a number without a unit is none, save for shares and names; units by
// definition: 30/π rpm are 1 rad/s, 180/π degrees are 1 rad.
#[test]
fn axes_carry_their_units() {
    let mut all = answers(&line(embedded::example(), &[]));
    all.extend([EMBEDDED.clone(), HARDENING.clone(), OVERLOADED.clone(), SCALED.clone()]);
    let figures: Vec<Figure> = all.iter().flat_map(figures::of).collect();
    assert!(figures.len() > 15);
    for figure in &figures {
        for axis in axes(figure) {
            let pure = !axis.names.is_empty() || axis.label == "Motion over the largest";
            assert!(!axis.unit.is_empty() || pure, "{}: {axis:?}", figure.id);
            assert!(!axis.label.is_empty() || !axis.names.is_empty(), "{}: {axis:?}", figure.id);
            assert!(axis.unit != "1", "{}: {axis:?}", figure.id);
            let Some(second) = &axis.secondary else { continue };
            let factor = match (axis.unit.as_str(), second.unit.as_str()) {
                ("rad/s", "rpm") => 30.0 / std::f64::consts::PI,
                ("rad", "°") => 180.0 / std::f64::consts::PI,
                other => panic!("{other:?}"),
            };
            assert!((second.factor / factor - 1.0).abs() < 1e-15 && second.offset == 0.0);
        }
        assert!(!figure.title.is_empty() && !figure.caption.is_empty(), "{}", figure.id);
    }
}
