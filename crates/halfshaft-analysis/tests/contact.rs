//! Laws with kinks in harmonic balance: the one-sided contact of the reference cases, and how honest
//! the truncation estimate is there.

mod common;

use common::{line_of, of_kind, resonance, some};
use halfshaft_model::question::QuestionText;
use halfshaft_results::{ResonanceResult, SpecialKind, SpecialPoint};

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

fn asked(text: &str, frequency: &str, verify: bool) -> ResonanceResult {
    let question = QuestionText {
        method: some("harmonic-balance"),
        frequency: some(frequency),
        verify,
        ..QuestionText::default()
    };
    resonance(&line_of(text, &[]), &question)
}

#[test]
fn look() {
    let start = std::time::Instant::now();
    let result = asked(ONE_SIDED, "0.55..0.8", true);
    println!("{:?}", start.elapsed());
    println!("{:?}", result.header.warnings);
    for branch in &result.branches {
        let f = branch.values("frequency");
        println!("BRANCH periods {} {} closed {} ends {} from {}", branch.periods, f.len(), branch.closed, branch.ends, branch.origin);
        let (h, t, a, s, l) = (branch.values("harmonics"), branch.values("truncation"), branch.values("stop.twist.amplitude"), branch.values("unstable_dimension"), branch.values("largest_multiplier"));
        for k in 0..f.len() {
            if k % 1 == 0 { println!("{:.10} {:.6} H {} trunc {:.1e} u {} {:.5}", f[k], a[k], h[k], t[k], s[k], l[k]); }
        }
        for p in &branch.special_points {
            println!("  {:?} {:?} {:.12} amp {:?} {:?} {:?} {:?}", p.kind, p.status, p.value("frequency").unwrap_or(f64::NAN), p.value("stop.twist.amplitude"), p.value("precision"), p.unstable_dimension_change, p.note);
        }
    }
    for v in &result.verification {
        println!("V {:.8} pred {:.9} int {:.9} rel {:.1e} stable {} {} mult {:?} {} res {:.1e}", v.frequency, v.predicted, v.integrated, v.relative_difference, v.predicted_stable, v.integrated_stable, v.predicted_multiplier, v.largest_multiplier, v.orbit_residual);
    }
}
