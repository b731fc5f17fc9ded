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
    // Exact for polynomials of degree seven; kinks and steep friction take more.
    let smooth = connection.law.polynomial().is_some() && connection.friction.is_none();
    let jumps = !connection.damps_in_gap;
    let count = if smooth {
        32
    } else if jumps {
        200_000
    } else {
        20_000
    };
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
            let size = cosine.hypot(sine);
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
                    "{}: {found} {} at {nu}, a = {a}, mean = {mean}",
                    line.name(),
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

/// A line of two inertias under a mean torque with one shaft of the given law, the load held by a soft
/// linear shaft.
fn loaded(name: &str, law: &str, mean: f64, amplitude: f64) -> Driveline {
    line_of(
        &format!(
            "format = 1\nname = \"{name}\"\n\
             [[inertia]]\nname = \"motor\"\ninertia = 0.02\n\
             [[inertia]]\nname = \"load\"\ninertia = 0.3\ndamping = 0.02\n\
             [[shaft]]\nname = \"coupling\"\nfrom = \"motor\"\nto = \"load\"\n{law}\n\
             [[shaft]]\nname = \"support\"\nfrom = \"load\"\nto = \"ground\"\n\
             stiffness = 150.0\ndamping = 0.4\n\
             [[torque]]\nname = \"drive\"\non = \"motor\"\nmean = {mean:?}\namplitude = {amplitude:?}\n"
        ),
        &[],
    )
}

/// Laws of every kind for that line.
const LAWS: [(&str, &str, f64, f64); 8] = [
    (
        "polynomial",
        "stiffness = 900.0\nquadratic = 1500.0\ncubic = -4000.0\ndamping = 0.25",
        20.0,
        6.0,
    ),
    ("softening", "stiffness = 900.0\ncubic = -6000.0\nquintic = 9000.0\ndamping = 0.2", 25.0, 8.0),
    ("backlash", "stiffness = 900.0\nclearance = 0.02\ndamping = 0.2", 3.0, 6.0),
    ("unloaded backlash", "stiffness = 900.0\nclearance = 0.02\ndamping = 0.2", 0.0, 4.0),
    (
        "stages",
        "stages = [ { until = 0.01, stiffness = 200.0 }, { until = 0.04, stiffness = 900.0 }, \
         { stiffness = 4000.0 } ]\ndamping = 0.25",
        4.0,
        9.0,
    ),
    ("friction", "stiffness = 900.0\nfriction = 2.0\ndamping = 0.1", 5.0, 12.0),
    (
        "table",
        "table = { twist = [-0.1, -0.03, 0.0, 0.02, 0.08], torque = [-90.0, -20.0, 0.0, 8.0, 80.0] }\n\
         damping = 0.25",
        10.0,
        7.0,
    ),
    (
        "damped contact",
        "stiffness = 900.0\nclearance = 0.02\ndamping = 0.25\ndamping_acts = \"in contact\"",
        3.0,
        6.0,
    ),
];

// Source: numerical integrals of each law and dense elimination of the line, and statics: the mean
// torque of the shaft is the mean torque of the drive.
#[test]
fn samples_under_every_law_satisfy_the_equations() {
    for (name, law, mean, amplitude) in LAWS {
        let line = loaded(name, law, mean, amplitude);
        let result = respond(&line, &text("60..420", "150"));
        // Midpoint sums over kinks and steep friction are good for six digits, over jumps for five.
        let tolerance = if name == "damped contact" { 3e-5 } else { 2e-6 };
        check_samples(&line, &result, "coupling", 1.0, tolerance);
        for branch in &result.branches {
            let carried = branch.values("coupling.torque.mean");
            assert!(carried.iter().all(|t| (t - mean).abs() < 1e-9 * (1.0 + mean)), "{name}");
        }
    }
}

/// Amplitudes at which the equation `|D a + F + i S| = |P|` changes sign along the means in balance
/// that are held, on a fine scan; `D`, `P` of the line `loaded`, in closed form.
fn scanned(line: &Driveline, mean_torque: f64, drive: f64, w: f64, highest: f64) -> Vec<f64> {
    let equations = EquationsOfMotion::new(line).expect("a sound line");
    let connection = &equations.connections[equations.connection("coupling").expect("there")];
    let motor = Complex::from(-w * w * 0.02);
    let load = Complex::new(150.0 - w * w * 0.3, w * (0.02 + 0.4));
    let d = motor * load / (motor + load);
    let p = Complex::from(drive) * load / (motor + load);
    let damping = if connection.damps_in_gap { connection.damping } else { 0.0 };
    let excess = |a: f64, mean: f64| {
        let force = connection.law.describing_function(mean, a).gain * a;
        let rubbing = connection
            .friction
            .map_or(0.0, |friction| friction.describing_function(w * a).damping * w * a);
        (d.scaled(a) + Complex::new(force, w * damping * a + rubbing)).modulus() - p.modulus()
    };
    // Held means by scan and bisection.
    let imbalance = |a: f64, mean: f64| {
        let of = connection.law.describing_function(mean, a);
        (of.mean_torque - mean_torque, of.mean_by_mean)
    };
    let held = |a: f64| -> Vec<f64> {
        let count = 120;
        let at = |k: i32| 0.9 * f64::from(k) / f64::from(count);
        let mut means = Vec::new();
        for k in -count..count {
            let (mut low, mut high) = (at(k), at(k + 1));
            if imbalance(a, low).0 < 0.0 && imbalance(a, high).0 >= 0.0 {
                for _ in 0..60 {
                    let middle = f64::midpoint(low, high);
                    if imbalance(a, middle).0 < 0.0 { low = middle } else { high = middle }
                }
                means.push(low);
            }
        }
        means
    };
    let count = 500;
    let mut found = Vec::new();
    let mut last: Vec<(f64, f64)> = Vec::new();
    for k in 1..=count {
        let a = highest * f64::from(k) / f64::from(count);
        let now: Vec<(f64, f64)> = held(a).into_iter().map(|m| (m, excess(a, m))).collect();
        if now.len() == last.len() {
            for (before, after) in last.iter().zip(&now) {
                if (before.1 < 0.0) != (after.1 < 0.0) {
                    found.push(a);
                }
            }
        }
        last = now;
    }
    found
}

/// The found amplitudes that no scanned one lies just above, each of which is used once.
fn unmatched(found: &[f64], scanned: &[f64], step: f64) -> Vec<f64> {
    let mut rest: Vec<f64> = scanned.to_vec();
    let mut unseen = Vec::new();
    for a in found {
        match rest.iter().position(|b| *b >= *a - 1e-12 && b - a <= 1.001 * step) {
            Some(index) => {
                rest.remove(index);
            }
            None => unseen.push(*a),
        }
    }
    unseen
}

// Source: the scan above, for laws whose mean moves.
#[test]
fn all_responses_under_every_law_are_those_of_a_scan() {
    let mut several = 0;
    for (name, law, mean, amplitude) in LAWS {
        // Inside the gap, without load, nothing decides the mean; and the scan has no damper in contact.
        if name == "unloaded backlash" || name == "damped contact" {
            continue;
        }
        let line = loaded(name, law, mean, amplitude);
        let result = respond(&line, &text("60..420", "7"));
        for step in 0..7 {
            let w = 60.0 + 360.0 * (f64::from(step) / 6.0);
            let found = amplitudes_at(&result, "coupling", w);
            let largest = found.iter().fold(0.01_f64, |most, a| most.max(*a));
            let scanned = scanned(&line, mean, amplitude, w, 1.5 * largest);
            let step = 1.5 * largest / 500.0;
            let unseen = unmatched(&found, &scanned, step);
            let seen = found.len() - unseen.len();
            assert_eq!(seen, scanned.len(), "{name} at {w}: {found:?} {scanned:?}");
            // Two responses between neighbours of the scan cannot be seen by it.
            assert!(unseen.len().is_multiple_of(2), "{name} at {w}: {found:?} {scanned:?}");
            for pair in unseen.chunks(2) {
                assert!(pair[1] - pair[0] < step, "{name} at {w}: {found:?} {scanned:?}");
            }
            several += usize::from(found.len() > 1);
        }
    }
    assert!(several > 2, "{several} speeds with several responses");
}

// Source: the reduced oscillator of the free two-mass line: inertia `J1 J2/(J1 + J2)`, excitation
// `T1 J2/(J1 + J2)`, with the gear's ratio squared into the inertia.
#[test]
fn a_free_geared_line_is_the_oscillator_of_its_twist() {
    let (ratio, j1, j2) = (5.71, 0.328, 81.6);
    let text_of = |cubic: f64| {
        format!(
            "format = 1\nname = \"two masses\"\n\
             [[inertia]]\nname = \"engine\"\ninertia = {j1:?}\n\
             [[gear]]\nname = \"gear\"\ninput = \"engine\"\noutput = \"flange\"\nratio = {ratio:?}\n\
             [[inertia]]\nname = \"vehicle\"\ninertia = {j2:?}\n\
             [[shaft]]\nname = \"half-shaft\"\nfrom = \"flange\"\nto = \"vehicle\"\n\
             stiffness = 6420.0\ncubic = {cubic:?}\ndamping = 3.0\n\
             [[torque]]\nname = \"drive\"\non = \"engine\"\namplitude = 30.0\norder = 2\n"
        )
    };
    let free = line_of(&text_of(9000.0), &[]);
    let up = j1 * ratio * ratio;
    let inertia = up * j2 / (up + j2);
    let oscillator = line_of(
        &format!(
            "format = 1\nname = \"oscillator\"\n\
             [[inertia]]\nname = \"mass\"\ninertia = {inertia:?}\n\
             [[shaft]]\nname = \"half-shaft\"\nfrom = \"mass\"\nto = \"ground\"\n\
             stiffness = 6420.0\ncubic = 9000.0\ndamping = 3.0\n\
             [[torque]]\nname = \"drive\"\non = \"mass\"\namplitude = {:?}\norder = 2\n",
            30.0 * ratio * j2 / (up + j2)
        ),
        &[],
    );
    let asked = text("10..25", "50");
    let (a, b) = (
        folds(&respond(&free, &asked), "half-shaft"),
        folds(&respond(&oscillator, &asked), "half-shaft"),
    );
    assert_eq!((a.len(), b.len()), (2, 2));
    for (one, other) in a.iter().zip(&b) {
        assert_close(one.0, other.0, 1e-12);
        assert_close(one.1, other.1, 1e-9);
    }
}

const MESHED: &str = r#"
format = 1
name = "Torque split"
[[inertia]]
name = "a"
inertia = 0.1
[[inertia]]
name = "b"
inertia = 0.2
[[inertia]]
name = "c"
inertia = 0.15
[[inertia]]
name = "d"
inertia = 0.4
[[shaft]]
name = "ab"
from = "a"
to = "b"
stiffness = 500.0
damping = 0.1
[[shaft]]
name = "bc"
from = "b"
to = "c"
stiffness = 700.0
damping = 0.1
[[shaft]]
name = "ca"
from = "c"
to = "a"
stiffness = 300.0
cubic = 60000.0
quadratic = 2000.0
damping = 0.1
[[shaft]]
name = "cd"
from = "c"
to = "d"
stiffness = 400.0
damping = 0.1
[[torque]]
name = "drive"
on = "a"
mean = 10.0
amplitude = 12.0
[[torque]]
name = "load"
on = "d"
mean = "balance"
"#;

// Source: numerical integrals and dense elimination, and the statics of the loop: the mean torques of
// the two ways share the load, and their mean twists agree.
#[test]
fn samples_of_a_line_with_a_loop_satisfy_the_equations() {
    let line = line_of(MESHED, &[]);
    let result = respond(&line, &text("30..160", "200"));
    check_samples(&line, &result, "ca", 1.0, 1e-7);
    let branch = &result.branches[0];
    let mean = |name: &str| branch.values(name);
    for row in 0..mean("frequency").len() {
        let (ab, ca) = (mean("ab.torque.mean")[row], mean("ca.torque.mean")[row]);
        assert!((ab - ca - 10.0).abs() < 1e-8, "{ab} {ca}");
        let around: f64 =
            ["ab", "bc", "ca"].iter().map(|s| mean(&format!("{s}.twist.mean"))[row]).sum();
        assert!(around.abs() < 1e-9, "{around}");
    }
}

// Source: dense elimination of the whole chain of 60.
#[test]
fn a_long_chain_condensed_equals_the_whole() {
    let mut model = common::chain(&[1.0; 60], &[1000.0; 59], Some(1000.0), 0.4);
    model = model.replace(
        "name = \"s30\"\nfrom = \"n30\"\nto = \"n31\"\n",
        "name = \"s30\"\nfrom = \"n30\"\nto = \"n31\"\ncubic = 200000.0\n",
    );
    model += "[[torque]]\nname = \"drive\"\non = \"n59\"\namplitude = 20.0\n";
    let line = line_of(&model, &[]);
    // Not so low that the dense elimination itself loses the digits.
    let result = respond(&line, &text("20..60", "200"));
    check_samples(&line, &result, "s30", 1.0, 1e-10);
    assert!(result.header.warnings.is_empty(), "{:?}", result.header.warnings);
}

// Source: numerical integrals and dense elimination, with the torque at each speed.
#[test]
fn torques_that_grow_with_speed_satisfy_the_equations() {
    let model = GEARED.replace(
        "amplitude = 60.0\n",
        "amplitude = 60.0\nspeed_power = 2\nreference_speed = 30.0\n",
    );
    let line = line_of(&model, &[]);
    let result = respond(&line, &text("20..60", "150"));
    check_samples(&line, &result, "half-shaft", 2.0, 1e-8);
}

// Source: one harmonic of the free Duffing oscillator, `W = sqrt(1 + 3 s/4)` with `s = g A²`; and the
// peak of the response, which lies on it but for damping: with `c² W²` the amplitude is greatest where
// `k - W² + 3/4 g a² = c²/2`.
#[test]
fn backbone_and_peak_of_the_duffing_oscillator() {
    let (c, g) = (0.05, 0.1);
    let result = respond(&duffing(c, 1.0, g, 0.18), &text("0.7..1.6", "100"));
    let backbone = &result.backbones[0];
    assert!(backbone.rows() > 50);
    let rows = backbone.values("frequency").iter().zip(backbone.values("spring.twist.harmonic1"));
    for (w, a) in rows {
        assert_close(*w, (1.0 + 0.75 * g * a * a).sqrt(), 1e-12);
    }
    let peak = &result.peaks[0];
    let (w, a) = (peak["frequency"], peak["spring.twist.harmonic1"]);
    assert_close(1.0 - w * w + 0.75 * g * a * a, c * c / 2.0, 1e-9);
    let all = result.branches[0].values("spring.twist.harmonic1");
    assert!(all.iter().all(|other| *other <= a));
}

// Source: the exact response of a linear line, by dense elimination; a law without curvature has one
// response.
#[test]
fn a_linear_line_has_its_linear_response() {
    let line = line_of(GEARED, &["half-shaft.cubic=0"]);
    let result = respond(&line, &text("10..60", "100"));
    assert_eq!(result.branches.len(), 1);
    check_samples(&line, &result, "half-shaft", 2.0, 1e-9);
    assert!(folds(&result, "half-shaft").is_empty());
}

// Source: the two branches of the undamped Duffing oscillator, `(k - W² + 3/4 g a²) a = ± P`.
#[test]
fn without_damping_both_branches_are_followed() {
    let (g, p) = (0.1, 0.18);
    let result = respond(&duffing(0.0, 1.0, g, p), &text("0.5..1.5", "100"));
    let mut phases = [0, 0];
    for branch in &result.branches {
        let rows = branch.values("frequency").iter().zip(branch.values("spring.twist.harmonic1"));
        for (w, a) in rows {
            let left = (1.0 - w * w + 0.75 * g * a * a) * a / p;
            assert!((left.abs() - 1.0).abs() < 1e-9, "{w} {a}");
            phases[usize::from(left < 0.0)] += 1;
        }
        assert!(branch.values("stable").iter().all(|stable| *stable == 0.0));
    }
    assert!(phases[0] > 100 && phases[1] > 50, "{phases:?}");
    assert!(result.header.warnings.iter().any(|w| w.contains("damping")));
}

// Source: the contract of errors: refused by name, with what is wrong.
#[test]
fn lines_that_do_not_fit_are_refused_by_name() {
    let two = line_of(GEARED, &["tyre.cubic=1000"]);
    let asked = QuestionText { frequency: None, ..text("", "100") };
    match try_ask(&two, Verb::Resonance, &asked) {
        Err(AnalysisError::MethodDoesNotFit { method, reason }) => {
            assert_eq!(method, "first-harmonic");
            assert!(reason.contains("half-shaft") && reason.contains("tyre"), "{reason}");
        }
        other => panic!("{other:?}"),
    }
    let silent = line_of(GEARED, &["engine torque.amplitude=0", "road.amplitude=0"]);
    assert!(matches!(
        try_ask(&silent, Verb::Resonance, &asked),
        Err(AnalysisError::NoExcitation { .. })
    ));
    let other = QuestionText { order: some("3"), ..asked };
    let line = line_of(GEARED, &[]);
    assert!(matches!(
        try_ask(&line, Verb::Resonance, &other),
        Err(AnalysisError::NoExcitation { .. })
    ));
}

// Source: the same responses from other numbers of listed speeds: branches do not depend on them.
#[test]
fn the_embedded_models_are_answered_without_any_option() {
    for line in [driveline(&[]), oscillator(&["excitation.amplitude=15"])] {
        let asked = |points: &str| QuestionText { frequency: None, ..text("", points) };
        let (few, many) = (respond(&line, &asked("50")), respond(&line, &asked("1000")));
        assert_eq!(few.branches.len(), many.branches.len());
        let shaft = if line.name().contains("oscillator") { "spring" } else { "half-shaft" };
        let (a, b) = (folds(&few, shaft), folds(&many, shaft));
        assert_eq!(a.len(), b.len());
        for (one, other) in a.iter().zip(&b) {
            assert_close(one.0, other.0, 1e-12);
        }
        assert!(few.branches.iter().all(|branch: &Branch| branch.values("frequency").len() >= 50));
    }
}
