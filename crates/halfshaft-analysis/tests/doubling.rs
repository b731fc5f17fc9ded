//! Period doublings of smooth lines and the branches of twice the period.

mod common;

use common::{line_of, of_kind, resonance, some};
use halfshaft_model::question::QuestionText;
use halfshaft_results::{Branch, ResonanceResult, SpecialKind, Status};

/// `x'' + c x' + k x + q x² + g x³ = P cos W t`.
const OSCILLATOR: &str = r#"
format = 1
name = "Oscillator"
[[inertia]]
name = "mass"
inertia = 1
[[shaft]]
name = "spring"
from = "mass"
to = "ground"
stiffness = 1
damping = 0.1
quadratic = 0.0
cubic = 0.0
[[torque]]
name = "drive"
on = "mass"
amplitude = 1
"#;

fn asked(settings: &[&str], frequency: &str) -> ResonanceResult {
    let question = QuestionText {
        method: some("harmonic-balance"),
        frequency: some(frequency),
        verify: true,
        ..QuestionText::default()
    };
    resonance(&line_of(OSCILLATOR, settings), &question)
}

fn doublings(branch: &Branch) -> Vec<f64> {
    let points = of_kind(&branch.special_points, SpecialKind::PeriodDoubling);
    points
        .iter()
        .map(|point| {
            assert_eq!(point.status, Status::Located);
            point.value("frequency").expect("has one")
        })
        .collect()
}

fn show(result: &ResonanceResult) {
    println!("{:?}", result.header.warnings);
    for branch in &result.branches {
        let f = branch.values("frequency");
        println!("BRANCH periods {} {} closed {} ends {} from {}: {} .. {}", branch.periods, f.len(), branch.closed, branch.ends, branch.origin, f[0], f[f.len() - 1]);
        for p in &branch.special_points {
            println!("  {:?} {:?} {:.12} amp {:?} {:?} {:?}", p.kind, p.status, p.value("frequency").unwrap_or(f64::NAN), p.value("spring.twist.amplitude"), p.value("precision"), p.unstable_dimension_change);
        }
    }
    for v in &result.verification {
        println!("V {:.8} pred {:.9} int {:.9} rel {:.1e} stable {} {} mult {:?} {} res {:.1e}", v.frequency, v.predicted, v.integrated, v.relative_difference, v.predicted_stable, v.integrated_stable, v.predicted_multiplier, v.largest_multiplier, v.orbit_residual);
    }
}

#[test]
fn quadratic() {
    let result = asked(&["spring.quadratic=0.3", "spring.cubic=0.05", "drive.amplitude=2"], "1.5..3");
    show(&result);
}

#[test]
fn ueda() {
    let result = asked(&["spring.stiffness=0.001", "spring.cubic=1", "drive.amplitude=4"], "0.7..1.6");
    show(&result);
}
