//! Answers made by hand, with everything that harmonic balance can find: folds, period doublings,
//! Neimark-Sacker points, a detached response, one of twice the period, births and mergers.
//!
//! The main response is the exact one-harmonic curve of x'' + c x' + x + g x³ = P cos W t; what else
//! happens on it is put there for the sake of showing it.

use halfshaft::Answer;
use halfshaft::results::{
    Branch, Column, Effort, FoldsResult, Header, JumpSpeeds, LevelRow, ModelIdentity, Named,
    ReportResult, ResonanceResult, ResponseCount, SpecialKind, SpecialPoint, Status, Table,
    Termination, VerifiedPoint,
};
use serde_json::{Value, json};

const C: f64 = 0.04;
const G: f64 = 1.0;
const P: f64 = 0.015;
/// Harmonics that the made-up answer kept.
pub const HARMONICS: f64 = 7.0;
/// What it left out at most.
pub const TRUNCATION: f64 = 3e-7;

pub fn header(analysis: &str, settings: Value) -> Header {
    Header {
        analysis: analysis.to_owned(),
        model: ModelIdentity { name: "Made up".to_owned(), digest: "0123456789abcdef".to_owned() },
        settings,
        termination: Termination::completed(),
        version: "0.0.0".to_owned(),
        warnings: Vec::new(),
        assumptions: Vec::new(),
    }
}

/// A sample of a branch: speed or parameter, amplitude, stable, largest multiplier.
#[derive(Clone, Copy)]
struct Row {
    x: f64,
    a: f64,
    stable: bool,
    multiplier: f64,
}

fn row(x: f64, a: f64, stable: bool) -> Row {
    Row { x, a, stable, multiplier: if stable { 0.88 } else { 1.2 } }
}

/// Speed of the one-harmonic response of amplitude `a`; the lower or the upper of the two.
pub fn speed(a: f64, upper: bool) -> Option<f64> {
    let stiffness = 1.0 + 0.75 * G * a * a;
    let (half, product) = (stiffness - 0.5 * C * C, stiffness * stiffness - (P / a).powi(2));
    let root = (half * half - product).max(0.0).sqrt();
    let square = if upper { half + root } else { half - root };
    (half * half >= product && square > 0.0).then(|| square.sqrt())
}

/// The amplitude at which the speed has an extreme between two others, by thirds.
fn extreme(mut low: f64, mut high: f64, largest: bool) -> (f64, f64) {
    let of = |a: f64| speed(a, true).map_or(f64::NAN, |w| if largest { w } else { -w });
    for _ in 0..200 {
        let (first, second) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if of(first) < of(second) { low = first } else { high = second }
    }
    let a = f64::midpoint(low, high);
    (speed(a, true).unwrap(), a)
}

/// The folds: (speed, amplitude), the one that a sweep upwards meets first.
pub fn folds() -> [(f64, f64); 2] {
    [extreme(0.30, 0.357, true), extreme(0.12, 0.3, false)]
}

/// The peak of the one-harmonic response: where both speeds of an amplitude meet.
pub fn peak() -> (f64, f64) {
    let (mut low, mut high) = (0.3, 0.4);
    for _ in 0..100 {
        let middle = f64::midpoint(low, high);
        if speed(middle, true).is_some() { low = middle } else { high = middle }
    }
    (speed(low, true).unwrap(), low)
}

fn main_branch() -> Vec<Row> {
    let top = peak().1;
    let [(_, upper), (_, lower)] = folds();
    let grow = |k: u32| 0.0402 + (top - 0.0402) * (f64::from(k) / 200.0);
    let up = (0..=200).filter_map(|k| Some(row(speed(grow(k), false)?, grow(k), true)));
    let down = (0..=200).rev().filter_map(|k| {
        let a = grow(k);
        Some(row(speed(a, true)?, a, !(lower..=upper).contains(&a)))
    });
    let mut rows: Vec<Row> = up.chain(down).collect();
    // Between two speeds the response beats.
    for one in rows.iter_mut().filter(|row| row.x > 1.0 && row.x < 1.02 && row.stable) {
        *one = Row { stable: false, multiplier: 1.05, ..*one };
    }
    rows
}

/// A detached response: an ellipse, its upper half stable.
fn detached() -> Vec<Row> {
    let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / 90.0;
    (0..90)
        .map(|k| {
            let (sine, cosine) = turn(k).sin_cos();
            row(1.06 + 0.02 * cosine, 0.5 + 0.05 * sine, sine > 0.0)
        })
        .collect()
}

/// A response of twice the period between two period doublings.
fn doubled() -> Vec<Row> {
    (0..=40)
        .map(|k| {
            let share = f64::from(k) / 40.0;
            row(0.96 + 0.02 * share, 0.22 + 0.03 * (std::f64::consts::PI * share).sin(), true)
        })
        .collect()
}

fn branch(rows: &[Row], x: (&str, &str), points: Vec<SpecialPoint>) -> Branch {
    let column = |name: &str, unit: &str, of: &dyn Fn(&Row) -> f64| {
        Column::new(name, unit, rows.iter().map(of).collect())
    };
    let truth = |stable: bool| f64::from(u8::from(stable));
    let columns = vec![
        column(x.0, x.1, &|row| row.x),
        column("spring.twist.harmonic1", "rad", &|row| row.a),
        column("spring.twist.amplitude", "rad", &|row| 1.01 * row.a),
        column("spring.twist.mean", "rad", &|_| 0.0),
        column("spring.torque.harmonic1", "N·m", &|row| 100.0 * row.a),
        column("spring.torque.amplitude", "N·m", &|row| 103.0 * row.a),
        column("stable", "1", &|row| truth(row.stable)),
        column("unstable_dimension", "1", &|row| truth(!row.stable)),
        column("largest_multiplier", "1", &|row| row.multiplier),
        column("harmonics", "1", &|_| HARMONICS),
        column("truncation", "1", &|_| TRUNCATION),
    ];
    let multipliers = rows
        .iter()
        .map(|row| {
            let angle = 12.0 * row.x;
            let (sine, cosine) = angle.sin_cos();
            vec![[row.multiplier * cosine, row.multiplier * sine]]
        })
        .collect();
    Branch { multipliers, ..Branch::plain(columns, points) }
}

fn point(kind: SpecialKind, x: (&str, f64), a: f64) -> SpecialPoint {
    let mut values = Named::default();
    values.insert(x.0.to_owned(), x.1);
    values.insert("spring.twist.harmonic1".to_owned(), a);
    values.insert("spring.twist.amplitude".to_owned(), 1.01 * a);
    let mut point = SpecialPoint::new(kind, Status::Located, values);
    point.unstable_dimension_change = match kind {
        SpecialKind::Fold | SpecialKind::PeriodDoubling => Some(1),
        SpecialKind::NeimarkSacker => Some(2),
        _ => None,
    };
    if kind == SpecialKind::NeimarkSacker {
        point.values.insert("multiplier_angle".to_owned(), 0.560218);
    }
    point
}

/// A resonance with all that can happen on it.
pub fn resonance() -> ResonanceResult {
    let [upper, lower] = folds();
    let at = |kind, (x, a): (f64, f64)| point(kind, ("frequency", x), a);
    let a_of = |x: f64| {
        let rows = main_branch();
        rows.into_iter().min_by(|p, q| (p.x - x).abs().total_cmp(&(q.x - x).abs())).unwrap().a
    };
    let (first, second) = (a_of(1.0), a_of(1.02));
    let mut main = branch(
        &main_branch(),
        ("frequency", "rad/s"),
        vec![
            at(SpecialKind::End, (0.8, 0.0402)),
            at(SpecialKind::PeriodDoubling, (0.96, a_of(0.96))),
            at(SpecialKind::PeriodDoubling, (0.98, a_of(0.98))),
            at(SpecialKind::NeimarkSacker, (1.0, first)),
            at(SpecialKind::NeimarkSacker, (1.02, second)),
            at(SpecialKind::Fold, upper),
            at(SpecialKind::Fold, lower),
        ],
    );
    main.origin = "low end of the range".to_owned();
    main.ends = "the range ends".to_owned();
    let mut apart = branch(
        &detached(),
        ("frequency", "rad/s"),
        vec![at(SpecialKind::Fold, (1.08, 0.5)), at(SpecialKind::Fold, (1.04, 0.5))],
    );
    apart.closed = true;
    apart.origin = "first harmonic at 1.06 rad/s".to_owned();
    let mut twice = branch(&doubled(), ("frequency", "rad/s"), Vec::new());
    twice.periods = 2;
    twice.origin = "period doubling at 0.96 rad/s".to_owned();
    twice.ends = "it meets the response of one period again".to_owned();
    let backbone: Vec<f64> = (0..=60).map(|k| 0.4 * f64::from(k) / 60.0).collect();
    let of = |a: &f64| (1.0 + 0.75 * G * a * a).sqrt();
    ResonanceResult {
        header: header("resonance", json!({ "method": "harmonic-balance", "tolerance": 1e-6 })),
        branches: vec![main, apart, twice],
        scaling: Vec::new(),
        peaks: Vec::new(),
        backbones: vec![Table::new(vec![
            Column::new("frequency", "rad/s", backbone.iter().map(of).collect()),
            Column::new("spring.twist.harmonic1", "rad", backbone),
        ])],
        jumps: vec![jump("up", upper, Some(0.14)), jump("down", lower, None)],
        verification: vec![
            checked(0.95, a_of(0.95), true),
            checked(upper.0 - 0.002, 0.34, true),
            checked(1.045, 0.27, false),
        ],
        effort: Some(Effort { samples: 532, steps: 560, iterations: 1702, seeds: 24 }),
    }
}

fn jump(sweep: &str, (frequency, before): (f64, f64), after: Option<f64>) -> JumpSpeeds {
    JumpSpeeds {
        sweep: sweep.to_owned(),
        frequency,
        rpm: frequency * 30.0 / std::f64::consts::PI,
        channel: "spring.twist".to_owned(),
        before,
        after,
    }
}

fn checked(frequency: f64, predicted: f64, stable: bool) -> VerifiedPoint {
    VerifiedPoint {
        frequency,
        channel: "spring.twist".to_owned(),
        predicted,
        integrated: predicted * (1.0 - 2e-9),
        integrated_amplitude: 1.01 * predicted,
        relative_difference: 2e-9,
        predicted_stable: stable,
        integrated_stable: stable,
        largest_multiplier: if stable { 0.88 } else { 1.2 },
        predicted_multiplier: Some(if stable { 0.88 } else { 1.2 } + 3e-8),
        orbit_residual: 1e-13,
    }
}

/// Responses over a parameter at one speed: an S with two folds.
pub fn over_a_parameter() -> ResonanceResult {
    let address = "excitation.amplitude";
    let amplitude = |a: f64| {
        let (w, stiffness) = (1.06, 1.0 + 0.75 * G * a * a);
        a * ((stiffness - w * w).powi(2) + (C * w).powi(2)).sqrt()
    };
    let grow = |k: u32| 0.5 * f64::from(k) / 150.0;
    let rising = |a: f64| amplitude(a + 1e-6) > amplitude(a - 1e-6);
    let rows: Vec<Row> =
        (1..=150).map(|k| row(amplitude(grow(k)), grow(k), rising(grow(k)))).collect();
    let mut folds = Vec::new();
    for pair in rows.windows(2).filter(|pair| pair[0].stable != pair[1].stable) {
        folds.push(point(SpecialKind::Fold, (address, pair[0].x), pair[0].a));
        let last = folds.last_mut().unwrap();
        last.values.insert("frequency".to_owned(), 1.06);
    }
    let mut whole = branch(&rows, (address, "N·m"), folds);
    whole.columns.push(Column::new("frequency", "rad/s", vec![1.06; rows.len()]));
    let parameter = json!({ "address": address, "from": 0.0, "to": 0.05 });
    let settings = json!({ "method": "harmonic-balance", "frequency": [1.06, 1.06],
        "parameter": parameter });
    ResonanceResult {
        header: header("resonance", settings),
        branches: vec![whole],
        backbones: Vec::new(),
        jumps: Vec::new(),
        verification: Vec::new(),
        effort: None,
        ..resonance()
    }
}

/// Half of the width of the wedge between two folds above its cusp.
fn wedge(p: f64) -> Option<(f64, f64)> {
    let above = p - 0.01;
    let low = 1.02 + 4.0 * above;
    (above >= 0.0).then(|| (low, low + 200.0 * above.powf(1.5)))
}

/// Whether a point of the plane lies within the fold curve of the detached response.
fn within_lens(w: f64, p: f64) -> bool {
    ((w - 1.12) / 0.02).powi(2) + ((p - 0.022) / 0.004).powi(2) < 1.0
}

/// Number of responses in the plane.
pub fn count(w: f64, p: f64) -> u32 {
    let three = wedge(p).is_some_and(|(low, high)| low < w && w < high);
    1 + 2 * u32::from(three) + 2 * u32::from(within_lens(w, p))
}

/// A fold plane with a cusp, the birth and the merger of a detached response, and a count of
/// responses.
pub fn folds_plane() -> FoldsResult {
    let address = "excitation.amplitude";
    let steps = |k: i32| 0.01 + 0.02 * (f64::from(k) / 60.0).powi(2);
    let both: Vec<(f64, f64)> = (-60..=60)
        .map(|k| {
            let p = steps(k);
            let (low, high) = wedge(p).unwrap();
            (if k < 0 { low } else { high }, p)
        })
        .collect();
    let lens: Vec<(f64, f64)> = (0..=90)
        .map(|k| {
            let (sine, cosine) = (std::f64::consts::TAU * f64::from(k) / 90.0).sin_cos();
            (1.12 + 0.02 * cosine, 0.022 + 0.004 * sine)
        })
        .collect();
    let curve = |points: &[(f64, f64)]| {
        let (x, y): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        let swing = y.iter().map(|p| 10.0 * p).collect();
        Table::new(vec![
            Column::new("frequency", "rad/s", x),
            Column::new(address, "N·m", y),
            Column::new("spring.twist.harmonic1", "rad", swing),
        ])
    };
    let special = |kind, (x, y): (f64, f64)| {
        let mut point = point(kind, ("frequency", x), 10.0 * y);
        point.values.insert(address.to_owned(), y);
        point
    };
    let frequency: Vec<f64> = (0..=120).map(|k| 1.0 + 0.2 * f64::from(k) / 120.0).collect();
    let parameter: Vec<f64> = (0..=90).map(|k| 0.005 + 0.025 * f64::from(k) / 90.0).collect();
    let counts =
        parameter.iter().map(|p| frequency.iter().map(|w| count(*w, *p)).collect()).collect();
    let settings = json!({
        "method": "harmonic-balance",
        "frequency": [1.0, 1.2],
        "parameter": { "address": address, "from": 0.005, "to": 0.03 },
    });
    FoldsResult {
        header: header("folds", settings),
        curves: vec![curve(&both), curve(&lens)],
        special_points: vec![
            special(SpecialKind::Cusp, (1.02, 0.01)),
            special(SpecialKind::IsolaBirth, (1.12, 0.018)),
            special(SpecialKind::IsolaMerger, (1.12, 0.026)),
        ],
        parameter: address.to_owned(),
        parameter_unit: "N·m".to_owned(),
        parameter_value: Some(0.015),
        scaling: None,
        responses: Some(ResponseCount { frequency, parameter, count: counts }),
    }
}

/// All of them.
pub fn all() -> Vec<(&'static str, Answer)> {
    vec![
        ("resonance", Answer::Resonance(resonance())),
        ("parameter", Answer::Resonance(over_a_parameter())),
        ("folds", Answer::Folds(folds_plane())),
    ]
}

/// The same resonance by another method: speeds and swings a little off, without the scaling that
/// only the closed form has.
pub fn another_method(closed: &ResonanceResult, method: &str, off: f64) -> ResonanceResult {
    let mut other = closed.clone();
    other.header.settings = json!({ "method": method });
    other.scaling.clear();
    for branch in &mut other.branches {
        for column in &mut branch.columns {
            shift(&column.name, off, column.values.iter_mut());
        }
        branch.columns.retain(|column| !matches!(column.name.as_str(), "sigma" | "rho"));
        for point in &mut branch.special_points {
            for (name, value) in &mut point.values {
                shift(name, off, std::iter::once(value));
            }
        }
    }
    for peak in &mut other.peaks {
        for (name, value) in peak.iter_mut() {
            shift(name, off, std::iter::once(value));
        }
    }
    for point in &mut other.verification {
        point.predicted = point.integrated * (1.0 + 1e-9);
        point.relative_difference = 1e-9;
    }
    for jump in &mut other.jumps {
        jump.frequency *= 1.0 + off;
        jump.rpm *= 1.0 + off;
    }
    other
}

fn shift<'v>(name: &str, off: f64, values: impl Iterator<Item = &'v mut f64>) {
    let part = match name {
        "frequency" => 1.0 + off,
        name if name.contains(".harmonic1") || name.contains(".amplitude") => 1.0 - 3.0 * off,
        _ => return,
    };
    values.for_each(|value| *value *= part);
}

/// Fold curves by harmonic balance beside those of the closed form.
fn another_plane(closed: &FoldsResult, off: f64) -> FoldsResult {
    let mut other = closed.clone();
    other.scaling = None;
    other.header.settings["method"] = json!("harmonic-balance");
    for table in &mut other.curves {
        for column in table.columns.iter_mut().filter(|column| column.name == closed.parameter) {
            column.values.iter_mut().for_each(|value| *value *= 1.0 - off);
        }
    }
    for point in &mut other.special_points {
        if let Some(value) = point.values.get_mut(&closed.parameter) {
            *value *= 1.0 - off;
        }
    }
    other
}

/// A report in which every method has an answer, from one in which the closed form has.
pub fn with_every_method(report: &ReportResult) -> ReportResult {
    let closed = report.closed_form.as_ref().unwrap();
    let balance = another_method(closed, "harmonic-balance", 2e-4);
    let first = another_method(closed, "first-harmonic", 1e-4);
    let level = |what: &str, unit: &str, own: f64| LevelRow {
        what: what.to_owned(),
        unit: unit.to_owned(),
        closed_form: Some(own),
        first_harmonic: Some(own * (1.0 + 1e-4)),
        harmonic_balance: Some(own * (1.0 + 2e-4)),
        ..LevelRow::default()
    };
    let peak = &closed.peaks[0];
    let mut levels = vec![
        level("peak: speed", "rad/s", peak["frequency"]),
        level("peak: twist", "rad", peak["rho"]),
    ];
    for (index, fold) in closed.branches.iter().flat_map(|b| &b.special_points).enumerate() {
        if fold.kind == SpecialKind::Fold {
            let speed = fold.value("frequency").unwrap();
            levels.push(level(&format!("fold {index}: speed"), "rad/s", speed));
        }
    }
    levels.extend(closed.verification.iter().map(|point| LevelRow {
        at: Some(point.frequency),
        integration: Some(point.integrated),
        closed_form: Some(point.predicted),
        harmonic_balance: Some(point.integrated * (1.0 + 1e-9)),
        ..level("twist", "rad", point.predicted)
    }));
    ReportResult {
        resonance: Some(balance),
        first_harmonic: Some(first),
        levels,
        folds: report.closed_folds.iter().map(|plane| another_plane(plane, 5e-3)).collect(),
        ..report.clone()
    }
}
