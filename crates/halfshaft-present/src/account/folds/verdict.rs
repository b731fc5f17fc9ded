//! Whether the response folds at the model's own value of the parameter, and how far that is from
//! where folds begin.
//!
//! The fold curves themselves decide, whatever number of cusps they have: the response folds at a
//! value where a curve passes it.

use halfshaft_results::{FoldsResult, SpecialKind, SpecialPoint};

use crate::reading::bounds;
use crate::words::{RPM, counted, list, number, plain, quantity, times};

/// The speeds at which curves pass a value of the parameter, ascending, rad/s.
fn folds_at(result: &FoldsResult, value: f64) -> Vec<f64> {
    let mut speeds = Vec::new();
    for curve in &result.curves {
        let (x, y) = (curve.values("frequency"), curve.values(&result.parameter));
        for (x, y) in x.windows(2).zip(y.windows(2)) {
            let (a, b) = (y[0] - value, y[1] - value);
            // A value that is a sample itself belongs to one of its two stretches.
            if (a <= 0.0) != (b <= 0.0) {
                speeds.push(x[0] + (x[1] - x[0]) * a / (a - b));
            }
        }
    }
    speeds.sort_by(f64::total_cmp);
    speeds
}

/// The ranges of the parameter over which curves run, those that touch as one, ascending.
fn ranges(result: &FoldsResult) -> Vec<(f64, f64)> {
    let of =
        |curve: &halfshaft_results::Table| bounds(curve.values(&result.parameter).iter().copied());
    let mut all: Vec<(f64, f64)> = result.curves.iter().filter_map(of).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut merged: Vec<(f64, f64)> = Vec::new();
    for (low, high) in all {
        match merged.last_mut() {
            Some(last) if low <= last.1 => last.1 = last.1.max(high),
            _ => merged.push((low, high)),
        }
    }
    merged
}

/// The values of the parameter that were looked at.
fn asked(result: &FoldsResult) -> Option<(f64, f64)> {
    let end = |name: &str| {
        let settings = &result.header.settings;
        settings.pointer(&format!("/parameter/{name}")).and_then(serde_json::Value::as_f64)
    };
    let (from, to) = (end("from")?, end("to")?);
    Some((from.min(to), from.max(to)))
}

/// Where folds begin or end: an end of a range that is not one of what was looked at, at the special
/// point that lies there.
fn begin(result: &FoldsResult, end: f64) -> Option<(f64, Option<SpecialKind>)> {
    let (low, high) = asked(result).or_else(|| {
        let values = result.curves.iter().flat_map(|curve| curve.values(&result.parameter));
        bounds(values.copied())
    })?;
    let near = 0.01 * (high - low);
    let apart = |point: &SpecialPoint| point.value(&result.parameter).map(|v| (v - end).abs());
    let kinds = [SpecialKind::Cusp, SpecialKind::IsolaBirth, SpecialKind::IsolaMerger];
    let points = result.special_points.iter().filter(|point| kinds.contains(&point.kind));
    let close = points.filter_map(|point| Some((apart(point)?, point)));
    let close = close.filter(|(apart, _)| *apart <= near).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((_, point)) = close {
        return Some((point.value(&result.parameter)?, Some(point.kind)));
    }
    let edge = (end - low).abs().min((end - high).abs()) <= 1e-3 * (high - low);
    (!edge).then_some((end, None))
}

/// Whether a detached response is all that the folds at the model's own value belong to: it is born
/// at `from`, and nothing joins it and no cusp lies between.
fn only_detached(result: &FoldsResult, from: (f64, Option<SpecialKind>), own: f64) -> bool {
    let between = |point: &SpecialPoint| {
        let value = point.value(&result.parameter);
        point.kind != SpecialKind::IsolaBirth
            && value.is_some_and(|value| (value - from.0) * (value - own) < 0.0)
    };
    from.1 == Some(SpecialKind::IsolaBirth) && !result.special_points.iter().any(between)
}

/// The model's own value against a threshold, where both have the same sign.
fn ratio(own: f64, threshold: f64) -> Option<String> {
    let factor = own / threshold;
    if !(factor.is_finite() && factor > 0.0) {
        return None;
    }
    Some(if factor >= 1.0 {
        format!("{} the threshold", times(factor))
    } else {
        format!("{} % of the threshold", number(100.0 * factor, 3))
    })
}

fn distance(own: f64, threshold: f64) -> f64 {
    let ratio = (threshold / own).ln().abs();
    if ratio.is_finite() { ratio } else { f64::INFINITY }
}

/// The verdict as sentences.
pub(super) fn told(result: &FoldsResult) -> Vec<String> {
    let Some(own) = result.parameter_value else { return Vec::new() };
    if asked(result).is_some_and(|(low, high)| own < low || own > high) {
        return vec![
            "The model's own value lies outside of the range shown, which decides nothing for it."
                .to_owned(),
        ];
    }
    let ranges = ranges(result);
    let speeds = folds_at(result, own);
    let around = ranges.iter().find(|(low, high)| (*low..=*high).contains(&own));
    let ends: Vec<f64> = match around {
        Some((low, high)) => vec![*low, *high],
        None => ranges.iter().flat_map(|(low, high)| [*low, *high]).collect(),
    };
    let nearest = ends
        .into_iter()
        .filter_map(|end| begin(result, end))
        .min_by(|a, b| distance(own, a.0).total_cmp(&distance(own, b.0)));
    let at = nearest.and_then(|(threshold, _)| ratio(own, threshold));
    if speeds.is_empty() {
        let tail = at.map_or_else(String::new, |at| format!("; its value is {at}"));
        return vec![format!("So the model does not jump{tail}.")];
    }
    let tail = at.map_or_else(String::new, |at| format!(", at {at}"));
    let detached = nearest.is_some_and(|nearest| only_detached(result, nearest, own));
    let verdict = if detached {
        format!("So the model has a detached response{tail}; slow sweeps do not jump to it.")
    } else {
        format!("So the model lies in the jumping range{tail}.")
    };
    vec![verdict, folds(result, own, &speeds)]
}

/// Where the response folds at the model's own value.
fn folds(result: &FoldsResult, own: f64, speeds: &[f64]) -> String {
    let places: Vec<String> = speeds.iter().map(|speed| number(speed * RPM, 5)).collect();
    format!(
        "At {} it has {}, at {}\u{a0}rpm.",
        quantity(own, 5, &plain(&result.parameter_unit)),
        counted(speeds.len(), "fold", "folds"),
        list(&places)
    )
}

#[cfg(test)]
mod tests {
    use halfshaft_results::{Named, SpecialKind, SpecialPoint, Status};

    use super::told;
    use crate::made::plane;

    fn cusp(kind: SpecialKind, speed: f64, value: f64) -> SpecialPoint {
        let mut values = Named::default();
        values.insert("frequency".to_owned(), speed);
        values.insert("drive.amplitude".to_owned(), value);
        SpecialPoint::new(kind, Status::Located, values)
    }

    /// Two wedges, one from 60 N·m at 40 rad/s, one from 180 N·m at 30 rad/s, whose cusp is the
    /// nearer one to 110 N·m by its ratio.
    fn wedges(own: f64) -> Vec<String> {
        let first = [(42.0, 200.0), (40.0, 60.0), (54.0, 200.0)];
        let second = [(29.0, 200.0), (30.0, 180.0), (31.0, 200.0)];
        let points =
            vec![cusp(SpecialKind::Cusp, 40.0, 60.0), cusp(SpecialKind::Cusp, 30.0, 180.0)];
        told(&plane(&[&first, &second], points, own))
    }

    /// Oracle: by hand: 130 N·m lie half way up the first wedge, between its folds at 41 and 47 rad/s
    /// (391.52 and 448.82 rpm), at 130/60 of its threshold; 190 N·m cut both wedges.
    #[test]
    fn the_curves_at_the_own_value_decide_among_several_cusps() {
        let text = wedges(130.0).join(" ");
        assert!(
            text.contains("lies in the jumping range, at 2.17\u{a0}times the threshold"),
            "{text}"
        );
        assert!(text.contains("two folds, at 391.52 and 448.82\u{a0}rpm"), "{text}");
        let text = wedges(190.0).join(" ");
        assert!(text.contains("four folds, at"), "{text}");
        let text = wedges(45.0).join(" ");
        assert_eq!(text, "So the model does not jump; its value is 75 % of the threshold.");
    }

    /// Oracle: by hand: the curve of a detached response, born at 90 N·m.
    #[test]
    fn a_detached_response_is_no_jump() {
        let curve = [(35.0, 200.0), (40.0, 90.0), (45.0, 200.0)];
        let birth = |more: Vec<SpecialPoint>| {
            let points = [vec![cusp(SpecialKind::IsolaBirth, 40.0, 90.0)], more].concat();
            told(&plane(&[&curve], points, 135.0)).join(" ")
        };
        let text = birth(Vec::new());
        assert!(
            text.contains("has a detached response, at 1.5\u{a0}times the threshold"),
            "{text}"
        );
        let text = birth(vec![cusp(SpecialKind::IsolaMerger, 36.0, 120.0)]);
        assert!(text.contains("lies in the jumping range"), "{text}");
    }

    #[test]
    fn a_value_outside_of_the_range_is_not_judged() {
        assert!(wedges(250.0)[0].contains("outside of the range"));
    }
}
