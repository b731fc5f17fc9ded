//! A law with a kink in harmonic balance: the one-sided contact of the reference cases, whose special
//! points come from an exact piecewise-linear solution.

mod common;

use common::{line_of, of_kind, resonance, some};
use halfshaft_model::question::QuestionText;
use halfshaft_results::{SpecialKind, SpecialPoint};

/// `M = I`, `K = [[1, -1], [-1, 2]]`, `D = 0.03 K`, a stop at 1 rad with stiffness 100 on the first.
const ONE_SIDED: &str = r#"
format = 1
name = "One-sided contact"
[[inertia]]
name = "n1"
inertia = 1
[[inertia]]
name = "n2"
inertia = 1
[[shaft]]
name = "coupling"
from = "n1"
to = "n2"
stiffness = 1
damping = 0.03
[[shaft]]
name = "mount"
from = "n2"
to = "ground"
stiffness = 1
damping = 0.03
[[shaft]]
name = "stop"
from = "n1"
to = "ground"
contact = "1 rad"
stiffness = 100
[[torque]]
name = "drive"
on = "n2"
amplitude = 0.1
"#;

/// Special points over a range, by as many harmonics as a rough tolerance needs: shooting relocates
/// them exactly whatever that is.
fn specials(frequency: &str) -> Vec<SpecialPoint> {
    let question = QuestionText {
        method: some("harmonic-balance"),
        frequency: some(frequency),
        tolerance: some("1e-4"),
        ..QuestionText::default()
    };
    let result = resonance(&line_of(ONE_SIDED, &[]), &question);
    result.branches.into_iter().flat_map(|branch| branch.special_points).collect()
}

#[track_caller]
fn has(points: &[SpecialPoint], kind: SpecialKind, frequency: f64) -> SpecialPoint {
    let near = |point: &&&SpecialPoint| {
        point.value("frequency").is_some_and(|f| (f - frequency).abs() < 1.1e-10)
    };
    let found = of_kind(points, kind);
    let places: Vec<Option<f64>> = found.iter().map(|point| point.value("frequency")).collect();
    match found.iter().find(near) {
        Some(point) => (*point).clone(),
        None => panic!("no {kind:?} at {frequency}: {places:?}"),
    }
}

// Source: periodic-cases, "One-sided contact": exact piecewise-linear solution, all digits given.
#[test]
fn the_neimark_sacker_point_and_grazing_are_those_of_the_exact_solution() {
    let points = specials("0.6..0.63");
    let torus = has(&points, SpecialKind::NeimarkSacker, 0.618_606_874_3);
    let angle = torus.value("multiplier_angle").expect("it is told");
    assert!((angle.cos() + 0.069_761).abs() < 1e-5, "{angle}");
    let points = specials("0.57..0.59");
    has(&points, SpecialKind::GrazingContact, 0.581_899_639_0);
}
