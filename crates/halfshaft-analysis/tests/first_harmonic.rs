//! `--method first-harmonic`: all responses of a line with one nonlinear shaft.

mod common;

use common::{assert_close, driveline, line_of, of_kind, oscillator, some, try_ask};
use halfshaft_analysis::AnalysisError;
use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_numerics::Complex;
use halfshaft_numerics::dense::{Matrix, solve};
use halfshaft_results::{Answer, Branch, ResonanceResult, SpecialKind, Status};

fn text(frequency: &str, points: &str) -> QuestionText {
    let (frequency, points) = (some(frequency), some(points));
    QuestionText { frequency, points, method: some("first-harmonic"), ..QuestionText::default() }
}

fn respond(line: &Driveline, text: &QuestionText) -> ResonanceResult {
    match try_ask(line, Verb::Resonance, text) {
        Ok(Answer::Resonance(result)) => result,
        other => panic!("{other:?}"),
    }
}

/// `x'' + c x' + k x + g x³ = P cos(W t)`.
fn duffing(c: f64, k: f64, g: f64, p: f64) -> Driveline {
    line_of(
        &format!(
            "format = 1\nname = \"Duffing\"\n\
             [[inertia]]\nname = \"mass\"\ninertia = 1.0\n\
             [[shaft]]\nname = \"spring\"\nfrom = \"mass\"\nto = \"ground\"\n\
             stiffness = {k:?}\ndamping = {c:?}\ncubic = {g:?}\n\
             [[torque]]\nname = \"drive\"\non = \"mass\"\namplitude = {p:?}\n"
        ),
        &[],
    )
}

/// Frequency and amplitude of the twist of a shaft at all folds, by ascending frequency.
fn folds(result: &ResonanceResult, shaft: &str) -> Vec<(f64, f64)> {
    let all = result.branches.iter().flat_map(|b| of_kind(&b.special_points, SpecialKind::Fold));
    let mut folds: Vec<(f64, f64)> = all
        .map(|point| {
            assert_eq!(point.status, Status::Located);
            let amplitude = point.value(&format!("{shaft}.twist.harmonic1"));
            (point.value("frequency").expect("frequency"), amplitude.expect("amplitude"))
        })
        .collect();
    folds.sort_by(|a, b| a.0.total_cmp(&b.0));
    folds
}

/// All amplitudes of a shaft's twist that the branches hold at exactly one frequency.
fn amplitudes_at(result: &ResonanceResult, shaft: &str, frequency: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for branch in &result.branches {
        let rows = branch.values("frequency").iter().enumerate();
        let amplitude = branch.values(&format!("{shaft}.twist.harmonic1"));
        let there = rows.filter(|(_, f)| (*f - frequency).abs() <= 1e-14 * frequency);
        found.extend(there.map(|(row, _)| amplitude[row]));
    }
    found.sort_by(f64::total_cmp);
    found.dedup_by(|b, a| (*b - *a).abs() < 1e-12 * *a);
    found
}

// Source: reference table of periodic cases, forced Duffing with one harmonic (D1 both folds, D2 the
// upper one).
#[test]
fn folds_of_the_forced_duffing_oscillator_are_those_of_the_reference() {
    let d1 = respond(&duffing(0.05, 1.0, 0.1, 0.18), &text("0.7..1.6", "300"));
    let found = folds(&d1, "spring");
    assert_eq!(found.len(), 2);
    assert_close(found[0].0, 1.115_585_927_2, 1e-10);
    assert_close(found[1].0, 1.267_536_959_5, 1e-10);
    let d2 = respond(&duffing(0.04, 1.0, 1.0, 0.015), &text("0.9..1.2", "300"));
    let found = folds(&d2, "spring");
    assert_eq!(found.len(), 2);
    assert_close(found[1].0, 1.049_131_685_9, 1e-10);
}

// Source: the amplitude equation itself, `a² [(k - W² + 3/4 g a²)² + c² W²] = P²`, scanned over a
// million amplitudes.
#[test]
fn all_responses_are_those_of_a_fine_scan() {
    let (c, k, g, p) = (0.05, 1.0, 0.1, 0.18);
    let result = respond(&duffing(c, k, g, p), &text("1.0..1.4", "41"));
    for step in 0..=40 {
        let w = 1.0 + 0.4 * (f64::from(step) / 40.0);
        let left = |a: f64| {
            let stiffness = k - w * w + 0.75 * g * a * a;
            a * a * (stiffness * stiffness + c * c * w * w) - p * p
        };
        let count = 1_000_000;
        let at = |i: i32| 5.0 * f64::from(i) / f64::from(count);
        let scanned: Vec<f64> = (0..count)
            .filter(|i| (left(at(*i)) < 0.0) != (left(at(*i + 1)) < 0.0))
            .map(at)
            .collect();
        let found = amplitudes_at(&result, "spring", w);
        assert_eq!(found.len(), scanned.len(), "W = {w}");
        for (found, scanned) in found.iter().zip(&scanned) {
            assert!((found - scanned).abs() < 1e-5, "W = {w}: {found} {scanned}");
            assert!(left(*found).abs() < 1e-11, "W = {w}");
        }
    }
}

// Source: the fold condition: between the folds the middle response alone is unstable, and the
// dimension changes by one at each.
#[test]
fn the_middle_response_is_unstable() {
    let result = respond(&duffing(0.05, 1.0, 0.1, 0.18), &text("0.7..1.6", "200"));
    assert_eq!(result.branches.len(), 1);
    let branch = &result.branches[0];
    let folds = of_kind(&branch.special_points, SpecialKind::Fold);
    let changes: Vec<Option<i32>> = folds.iter().map(|f| f.unstable_dimension_change).collect();
    assert_eq!(changes, [Some(1), Some(-1)]);
    let (first, second) = (folds[0].value("frequency"), folds[1].value("frequency"));
    assert!(first > second);
    let jumps: Vec<&str> = result.jumps.iter().map(|jump| jump.sweep.as_str()).collect();
    assert_eq!(jumps, ["up", "down"]);
    let (up, down) = (&result.jumps[0], &result.jumps[1]);
    assert!(up.after.expect("lands") < up.before && down.after.expect("lands") > down.before);
}

/// Mean, in-phase and out-of-phase first harmonic of the torque of connection `index` over
/// `x = mean + a cos φ`, by the midpoint rule, damper and friction included.
fn galerkin(line: &EquationsOfMotion, index: usize, mean: f64, a: f64, nu: f64) -> [f64; 3] {
    let connection = &line.connections[index];
    let count = 40_000;
    let mut sums = [0.0; 3];
    for k in 0..count {
        let phi = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(count);
        let (x, v) = (mean + a * phi.cos(), -a * nu * phi.sin());
        let torque = connection.law.torque(x) + connection.resistance(x, v);
        sums[0] += torque / f64::from(count);
        sums[1] += 2.0 * torque * phi.cos() / f64::from(count);
        sums[2] -= 2.0 * torque * phi.sin() / f64::from(count);
    }
    sums
}

/// Complex twists of all connections of the whole line, the nonlinear one with the complex stiffness
/// that its harmonic makes, by one dense elimination.
fn dense_twists(
    line: &EquationsOfMotion,
    shaft: usize,
    stiffness: Complex,
    nu: f64,
    order: f64,
) -> Vec<f64> {
    let n = line.groups();
    let mut matrix = Matrix::zeros(2 * n, 2 * n);
    let mut add = |row: usize, column: usize, z: Complex| {
        matrix[(row, column)] += z.re;
        matrix[(n + row, n + column)] += z.re;
        matrix[(row, n + column)] -= z.im;
        matrix[(n + row, column)] += z.im;
    };
    for group in 0..n {
        let inertia = -nu * nu * line.inertia[group];
        add(group, group, Complex::new(inertia, nu * line.ground_damping[group]));
    }
    for (index, connection) in line.connections.iter().enumerate() {
        let own = if index == shaft {
            stiffness
        } else {
            Complex::new(connection.law.stiffness(0.0), nu * connection.damping)
        };
        let mut direction = vec![0.0; n];
        line.add_direction(index, 1.0, &mut direction);
        for (row, a) in direction.iter().enumerate() {
            for (column, b) in direction.iter().enumerate() {
                if a * b != 0.0 {
                    add(row, column, own.scaled(a * b));
                }
            }
        }
    }
    let torques = line.excitation.harmonic(n, order, nu / order);
    let right: Vec<f64> = torques.iter().map(|t| t.0).chain(torques.iter().map(|t| t.1)).collect();
    let angles = solve(&matrix, &right).expect("damped");
    (0..line.connections.len())
        .map(|index| line.twist(index, &angles[..n]).hypot(line.twist(index, &angles[n..])))
        .collect()
}

/// Every sample of every branch satisfies the one-harmonic equations of the whole line, by numerical
/// integrals of the law and a dense solution. `asked` is the mean torque of the shaft where statics
/// decide it.
fn check_samples(
    line: &Driveline,
    result: &ResonanceResult,
    shaft: &str,
    order: f64,
    tolerance: f64,
) {
    let equations = EquationsOfMotion::new(line).expect("a sound line");
    let index = equations.connection(shaft).expect("a shaft of the line");
    let mut checked = 0;
    for branch in &result.branches {
        let of = |name: &str, word: &str| branch.values(&format!("{name}.{word}")).to_vec();
        let amplitudes = of(shaft, "twist.harmonic1");
        let means = of(shaft, "twist.mean");
        let torques = of(shaft, "torque.mean");
        let harmonics: Vec<Vec<f64>> = equations
            .connections
            .iter()
            .map(|connection| of(&connection.name, "twist.harmonic1"))
            .collect();
        let step = (amplitudes.len() / 60).max(1);
        for row in (0..amplitudes.len()).step_by(step) {
            let nu = order * branch.values("frequency")[row];
            let (a, mean) = (amplitudes[row], means[row]);
            let [constant, cosine, sine] = galerkin(&equations, index, mean, a, nu);
            let size = equations.connections[index].law.stiffness(mean).abs() * a;
            assert!(
                (constant - torques[row]).abs() <= tolerance * (constant.abs() + size + 1e-12),
                "mean torque {constant} {} at {nu}",
                torques[row]
            );
            let stiffness = Complex::new(cosine / a, sine / a);
            let twists = dense_twists(&equations, index, stiffness, nu, order);
            for (found, harmonic) in twists.iter().zip(&harmonics) {
                let miss = (found - harmonic[row]).abs();
                assert!(
                    miss <= tolerance * found.abs().max(1e-3 * twists[index]),
                    "{found} {} at {nu}, a = {a}, mean = {mean}",
                    harmonic[row]
                );
            }
            checked += 1;
        }
    }
    assert!(checked > 20, "{checked} samples");
}

const GEARED: &str = r#"
format = 1
name = "Geared line"
[[inertia]]
name = "engine"
inertia = 0.3
damping = 0.01
[[gear]]
name = "gearbox"
input = "engine"
output = "flange"
ratio = -3.1
[[inertia]]
name = "wheel"
inertia = 1.2
[[inertia]]
name = "vehicle"
inertia = 40.0
[[shaft]]
name = "half-shaft"
from = "flange"
to = "wheel"
stiffness = 6000.0
cubic = 90000.0
damping = 12.0
[[shaft]]
name = "tyre"
from = "wheel"
to = "vehicle"
stiffness = 20000.0
damping = 60.0
[[torque]]
name = "engine torque"
on = "engine"
amplitude = 60.0
order = 2
phase = 0.4
[[torque]]
name = "road"
on = "vehicle"
amplitude = 20.0
order = 2
"#;

// Source: numerical integrals and dense elimination.
#[test]
fn samples_of_a_geared_free_line_satisfy_the_equations() {
    let line = line_of(GEARED, &[]);
    let result = respond(&line, &QuestionText { frequency: None, ..text("", "200") });
    assert!(result.branches[0].values("frequency").len() > 200);
    check_samples(&line, &result, "half-shaft", 2.0, 1e-8);
}

// Source: the same; with a mean torque that the shaft carries and a law that is not odd.
#[test]
fn samples_with_a_mean_torque_satisfy_the_equations() {
    let settings = ["engine torque.mean=150", "road.mean=balance", "half-shaft.quadratic=20000"];
    let line = line_of(GEARED, &settings);
    let result = respond(&line, &QuestionText { frequency: None, ..text("", "200") });
    check_samples(&line, &result, "half-shaft", 2.0, 1e-8);
    let mean = result.branches[0].values("half-shaft.torque.mean");
    let carried: f64 = -3.1 * 150.0;
    assert!(mean.iter().all(|torque| torque.abs() > 0.9 * carried.abs()), "{:?}", mean[0]);
    let spread = mean.iter().fold(0.0_f64, |most, torque| most.max((torque - mean[0]).abs()));
    assert!(spread < 1e-9 * mean[0].abs(), "statics decide the mean torque: {spread}");
}

const BACKLASH: &str = r#"
format = 1
name = "Backlash"
[[inertia]]
name = "pinion"
inertia = 0.01
[[inertia]]
name = "wheel"
inertia = 0.05
[[shaft]]
name = "mesh"
from = "pinion"
to = "wheel"
stiffness = 2000.0
clearance = 0.01
damping = 0.4
[[shaft]]
name = "output"
from = "wheel"
to = "ground"
stiffness = 300.0
damping = 0.5
[[torque]]
name = "motor"
on = "pinion"
mean = 6.0
amplitude = 9.0
"#;

// Source: numerical integrals and dense elimination; the branch leaves the flank, crosses the gap and
// bends: with a mean torque, so that the mean moves.
#[test]
fn samples_of_backlash_under_load_satisfy_the_equations() {
    let line = line_of(BACKLASH, &[]);
    let result = respond(&line, &text("50..800", "300"));
    check_samples(&line, &result, "mesh", 1.0, 1e-6);
    let means = result.branches[0].values("mesh.twist.mean");
    let (least, most) = means.iter().fold((f64::MAX, f64::MIN), |(a, b), m| (a.min(*m), b.max(*m)));
    assert!(most - least > 1e-3, "the mean moves: {least} {most}");
    assert!(result.header.warnings.is_empty(), "{:?}", result.header.warnings);
}
