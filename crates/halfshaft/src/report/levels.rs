//! The values that matter by every method side by side: the largest response, the folds, the
//! responses that were integrated, the cusps.

use halfshaft_analysis::ask;
use halfshaft_model::Driveline;
use halfshaft_model::question::{Question, ResonanceMethod, ResonanceQuestion};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Answer, Branch, FoldsResult, LevelRow, ReportResult, ResonanceResult, SpecialKind,
    VerifiedPoint,
};

/// Speeds of folds by two methods further apart than this, as a part, are of different folds.
const SAME_FOLD: f64 = 0.05;

/// A response: speed in rad/s, first harmonic of the twist in rad, whether it is stable.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    speed: f64,
    swing: f64,
    stable: bool,
}

/// All rows; none where fewer than two methods answered.
pub(super) fn levels(
    line: &Driveline,
    report: &ReportResult,
    observer: &dyn Observer,
) -> Vec<LevelRow> {
    let methods = [&report.closed_form, &report.first_harmonic, &report.resonance];
    let Some(best) = report.best_resonance() else { return Vec::new() };
    let channel = best.leading_channel();
    let Some(channel) = channel.filter(|_| methods.iter().filter(|m| m.is_some()).count() > 1)
    else {
        return Vec::new();
    };
    let column = format!("{channel}.harmonic1");
    let mut rows = Vec::new();
    let peaks = methods.map(|result| result.as_ref().and_then(|result| peak(result, &column)));
    rows.extend(pair("peak", peaks));
    rows.extend(folds(methods, &column));
    let checks = best.verification.iter().filter(|point| point.channel == channel);
    rows.extend(checks.map(|point| checked(line, report, point, &column, observer)));
    rows.extend(report.folds.iter().flat_map(|plane| cusps(plane, &report.closed_folds)));
    rows
}

/// Speed and swing of a point by closed form, first harmonic and harmonic balance.
fn pair(what: &str, [closed, first, balance]: [Option<Point>; 3]) -> Vec<LevelRow> {
    let row = |quantity: &str, unit: &str, of: fn(Point) -> f64| LevelRow {
        what: format!("{what}: {quantity}"),
        unit: unit.to_owned(),
        closed_form: closed.map(of),
        first_harmonic: first.map(of),
        harmonic_balance: balance.map(of),
        ..LevelRow::default()
    };
    vec![row("speed", "rad/s", |point| point.speed), row("twist", "rad", |point| point.swing)]
}

/// Branches that a slow sweep shows.
fn swept(result: &ResonanceResult) -> impl Iterator<Item = &Branch> {
    result.branches.iter().filter(|branch| !branch.is_detached() && branch.periods <= 1)
}

/// The largest response: as the analysis located it or between the samples, whichever is larger.
fn peak(result: &ResonanceResult, column: &str) -> Option<Point> {
    let located = result.peaks.iter().filter_map(|peak| {
        let (speed, swing) = (*peak.get("frequency")?, *peak.get(column)?);
        Some(Point { speed, swing, stable: true })
    });
    let sampled = swept(result).filter_map(|branch| between_samples(branch, column));
    located.chain(sampled).max_by(|a, b| a.swing.total_cmp(&b.swing))
}

/// The top of a branch by the parabola through its largest sample and the neighbours, over the
/// length along the curve.
fn between_samples(branch: &Branch, column: &str) -> Option<Point> {
    let (x, y) = (branch.values("frequency"), branch.values(column));
    let top = (0..x.len().min(y.len())).max_by(|a, b| y[*a].total_cmp(&y[*b]))?;
    let itself = Point { speed: x[top], swing: y[top], stable: true };
    if top == 0 || top + 1 >= x.len().min(y.len()) {
        return Some(itself);
    }
    let part =
        |from: usize, to: usize| ((x[to] - x[from]) / x[top]).hypot((y[to] - y[from]) / y[top]);
    let (before, after) = (-part(top - 1, top), part(top, top + 1));
    // Newton's form through (before, 0, after).
    let newton = |values: &[f64]| {
        let (low, middle, high) = (values[top - 1], values[top], values[top + 1]);
        let (first, second) = ((low - middle) / before, (high - middle) / after);
        let bend = (second - first) / (after - before);
        (middle, first - bend * before, bend)
    };
    let ((x0, x1, x2), (y0, y1, y2)) = (newton(x), newton(y));
    let place = -y1 / (2.0 * y2);
    if !(before..=after).contains(&place) {
        return Some(itself);
    }
    let at = |(value, slope, bend): (f64, f64, f64)| value + place * (slope + place * bend);
    Some(Point { speed: at((x0, x1, x2)), swing: at((y0, y1, y2)), stable: true })
}

/// Folds by every method, matched by their speeds.
fn folds(methods: [&Option<ResonanceResult>; 3], column: &str) -> Vec<LevelRow> {
    let found = methods.map(|result| result.as_ref().map(|result| fold_points(result, column)));
    // The best method that has an answer says which folds there are.
    let Some(leading) = found.iter().rev().flatten().next() else { return Vec::new() };
    let mut rows = Vec::new();
    for (index, fold) in leading.iter().enumerate() {
        let own = found.each_ref().map(|all| nearest(all.as_deref()?, fold, leading, index));
        rows.extend(pair(&format!("fold {}", index + 1), own));
    }
    rows
}

/// The folds that a slow sweep meets, by ascending speed.
fn fold_points(result: &ResonanceResult, column: &str) -> Vec<Point> {
    let points = swept(result).flat_map(|branch| &branch.special_points);
    let folds = points.filter(|point| point.kind == SpecialKind::Fold);
    let place = folds.filter_map(|point| {
        let (speed, swing) = (point.value("frequency")?, point.value(column)?);
        Some(Point { speed, swing, stable: false })
    });
    let mut folds: Vec<Point> = place.collect();
    folds.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    folds
}

/// The fold of a method that is the same as one of the leading method: by number where both have as
/// many, else by speed.
fn nearest(all: &[Point], fold: &Point, leading: &[Point], index: usize) -> Option<Point> {
    if all.len() == leading.len() {
        return all.get(index).copied();
    }
    let apart = |point: &Point| (point.speed / fold.speed - 1.0).abs();
    let close = all.iter().filter(|point| apart(point) < SAME_FOLD);
    close.min_by(|a, b| apart(a).total_cmp(&apart(b))).copied()
}

/// A response that was integrated, by every method at its speed.
fn checked(
    line: &Driveline,
    report: &ReportResult,
    point: &VerifiedPoint,
    column: &str,
    observer: &dyn Observer,
) -> LevelRow {
    let at = |known: bool, method: ResonanceMethod| {
        known.then(|| response_at(line, method, point, column, observer)).flatten()
    };
    let balanced = report.resonance.is_some();
    LevelRow {
        what: if point.predicted_stable { "twist" } else { "unstable twist" }.to_owned(),
        at: Some(point.frequency),
        unit: "rad".to_owned(),
        closed_form: match balanced {
            // Then it is the closed form that was integrated.
            false if report.closed_form.is_some() => Some(point.predicted),
            _ => at(report.closed_form.is_some(), ResonanceMethod::Averaged),
        },
        first_harmonic: at(report.first_harmonic.is_some(), ResonanceMethod::FirstHarmonic),
        harmonic_balance: balanced.then_some(point.predicted),
        integration: Some(point.integrated),
    }
}

/// The response of a method at a speed that is nearest to one that was integrated, among those of
/// the same stability if there are any.
fn response_at(
    line: &Driveline,
    method: ResonanceMethod,
    point: &VerifiedPoint,
    column: &str,
    observer: &dyn Observer,
) -> Option<f64> {
    let speed = point.frequency;
    let question = ResonanceQuestion {
        frequency: Some((speed, speed * (1.0 + 1e-7))),
        method,
        points: Some(2),
        ..ResonanceQuestion::default()
    };
    let Ok(Answer::Resonance(result)) = ask(line, &Question::Resonance(question), observer) else {
        return None;
    };
    let there = result.branches.iter().flat_map(|branch| {
        let rows = branch.values("frequency").iter().zip(branch.values(column)).enumerate();
        let near = rows.filter(move |(_, (x, _))| (**x / speed - 1.0).abs() < 1e-9);
        near.map(|(row, (_, swing))| {
            let stable = branch.values("stable").get(row).is_none_or(|value| *value != 0.0);
            Point { speed, swing: *swing, stable }
        })
    });
    let there: Vec<Point> = there.collect();
    let same = there.iter().any(|response| response.stable == point.predicted_stable);
    let wanted = there.iter().filter(|one| !same || one.stable == point.predicted_stable);
    let apart = |one: &Point| (one.swing - point.integrated).abs();
    wanted.min_by(|a, b| apart(a).total_cmp(&apart(b))).map(|one| one.swing)
}

/// The cusps of a plane beside those of the closed form over the same parameter.
fn cusps(plane: &FoldsResult, closed: &[FoldsResult]) -> Vec<LevelRow> {
    let values = |plane: &FoldsResult| -> Vec<(f64, f64)> {
        let cusps = plane.special_points.iter().filter(|point| point.kind == SpecialKind::Cusp);
        cusps
            .filter_map(|point| Some((point.value(&plane.parameter)?, point.value("frequency")?)))
            .collect()
    };
    let twin = closed.iter().find(|other| other.parameter == plane.parameter);
    let others = twin.map(values).unwrap_or_default();
    let nearest = |own: f64| {
        let apart = |other: &&(f64, f64)| (other.0 - own).abs();
        others.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).copied()
    };
    let name = plane.parameter.replace('.', " ");
    let rows = |(value, speed): (f64, f64)| {
        let other = nearest(value);
        let row = |what: String, unit: &str, own: f64, other: Option<f64>| LevelRow {
            what,
            unit: unit.to_owned(),
            closed_form: other,
            harmonic_balance: Some(own),
            ..LevelRow::default()
        };
        let unit = plane.parameter_unit.as_str();
        [
            row(format!("cusp: {name}"), unit, value, other.map(|other| other.0)),
            row(format!("cusp of {name}: speed"), "rad/s", speed, other.map(|other| other.1)),
        ]
    };
    values(plane).into_iter().flat_map(rows).collect()
}
