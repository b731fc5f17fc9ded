//! Floquet multipliers by Hill's method and by monodromy: each against the other and against what is
//! known in closed form.

mod common;

use common::{chain, line_of, resonance, some};
use halfshaft_model::question::QuestionText;
use halfshaft_results::{Branch, ResonanceResult};

const DUFFING: &str = r#"
format = 1
name = "Duffing"
[[inertia]]
name = "mass"
inertia = 1
[[shaft]]
name = "spring"
from = "mass"
to = "ground"
stiffness = 1
damping = 0.05
cubic = 0.1
[[torque]]
name = "drive"
on = "mass"
amplitude = 0.18
"#;

const ABSORBER: &str = r#"
format = 1
name = "Absorber"
[[inertia]]
name = "main"
inertia = 1
[[inertia]]
name = "small"
inertia = 0.05
[[shaft]]
name = "mount"
from = "main"
to = "ground"
stiffness = 1
damping = 0.002
cubic = 1
[[shaft]]
name = "coupling"
from = "main"
to = "small"
stiffness = 0.0453
damping = 0.013
quadratic = 0.0042
[[torque]]
name = "drive"
on = "main"
amplitude = 0.11
"#;

fn by(text: &str, settings: &[&str], question: &QuestionText, method: &str) -> ResonanceResult {
    let question = QuestionText {
        method: some("harmonic-balance"),
        stability: some(method),
        ..question.clone()
    };
    resonance(&line_of(text, settings), &question)
}

/// Largest distance of a multiplier of one list from the nearest of the other.
fn apart(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let from = |m: &[f64; 2]| {
        b.iter().map(|n| (m[0] - n[0]).hypot(m[1] - n[1])).fold(f64::INFINITY, f64::min)
    };
    a.iter().map(from).fold(0.0, f64::max)
}

fn compare(branches: (&[Branch], &[Branch]), tolerance: f64, least: usize) {
    assert_eq!(branches.0.len(), branches.1.len());
    let mut count = 0;
    for (a, b) in branches.0.iter().zip(branches.1) {
        assert_eq!(a.values("frequency"), b.values("frequency"));
        assert_eq!(a.values("unstable_dimension"), b.values("unstable_dimension"));
        for (at, (x, y)) in a.multipliers.iter().zip(&b.multipliers).enumerate() {
            let off = apart(x, y).max(apart(y, x));
            assert!(off < tolerance, "at {}: {off:e}\n{x:?}\n{y:?}", a.values("frequency")[at]);
            count += 1;
        }
    }
    assert!(count >= least, "{count} samples only");
}

// Source: two methods that share nothing but the response.
#[test]
fn hill_agrees_with_monodromy_on_a_duffing_oscillator() {
    let question = QuestionText { frequency: some("0.6..1.8"), ..QuestionText::default() };
    let [a, b] = ["monodromy", "hill"].map(|method| by(DUFFING, &[], &question, method));
    compare((&a.branches, &b.branches), 1e-8, 30);
}

// Source: as above; every order takes part, and pairs leave the unit circle.
#[test]
fn hill_agrees_with_monodromy_on_an_absorber() {
    let question = QuestionText {
        frequency: some("1.1..1.13"),
        harmonics: some("7"),
        ..QuestionText::default()
    };
    let [a, b] = ["monodromy", "hill"].map(|method| by(ABSORBER, &[], &question, method));
    compare((&a.branches, &b.branches), 1e-7, 5);
}

// Source: as above, with ten inertias and a cubic law in every shaft.
#[test]
fn hill_agrees_with_monodromy_on_a_chain_of_ten() {
    let text = chain(&[1.0; 10], &[1000.0; 9], Some(1000.0), 0.5)
        + "[[torque]]\nname = \"drive\"\non = \"n9\"\namplitude = 5\n";
    let cubic: Vec<String> = (0..9).map(|k| format!("s{k}.cubic=-500")).collect();
    let cubic: Vec<&str> = cubic.iter().map(String::as_str).collect();
    let question = QuestionText {
        frequency: some("4.660..4.662"),
        harmonics: some("5"),
        ..QuestionText::default()
    };
    let [a, b] = ["monodromy", "hill"].map(|method| by(&text, &cubic, &question, method));
    compare((&a.branches, &b.branches), 1e-7, 2);
}

// Source: a free line with a cubic shaft and a damper to ground: its angle as a whole is no part of
// the response, its speed is.
#[test]
fn hill_agrees_with_monodromy_on_free_lines() {
    let text = chain(&[1.0, 2.0, 0.5], &[3.0, 5.0], None, 0.1)
        + "[[torque]]\nname = \"drive\"\non = \"n0\"\namplitude = 0.5\n";
    let question = QuestionText {
        frequency: some("1.6..2.4"),
        harmonics: some("7"),
        ..QuestionText::default()
    };
    for settings in [&["s0.cubic=1"][..], &["s0.cubic=1", "n1.damping=0.2"]] {
        let [a, b] = ["monodromy", "hill"].map(|method| by(&text, settings, &question, method));
        compare((&a.branches, &b.branches), 1e-7, 5);
    }
}

// Source: without a cubic term the multipliers are exp(λ T) with λ² + 0.05 λ + 1 = 0.
#[test]
fn both_are_exact_on_a_linear_line() {
    let question = QuestionText { frequency: some("0.6..1.8"), ..QuestionText::default() };
    for method in ["monodromy", "hill"] {
        let result = by(DUFFING, &["spring.cubic=0"], &question, method);
        let branch = &result.branches[0];
        for (frequency, multipliers) in branch.values("frequency").iter().zip(&branch.multipliers) {
            let period = std::f64::consts::TAU / frequency;
            let (decay, turn) = (-0.025 * period, (1.0_f64 - 0.025 * 0.025).sqrt() * period);
            let exact = [turn, -turn].map(|t| [decay.exp() * t.cos(), decay.exp() * t.sin()]);
            assert!(apart(multipliers, &exact).max(apart(&exact, multipliers)) < 1e-11, "{method}");
        }
    }
}
