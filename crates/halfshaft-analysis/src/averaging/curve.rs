//! From responses at single frequencies to connected branches.
//!
//! The response is one curve: up one side of the backbone to the peak, down the other. Every
//! response knows its place on it by its side and its amplitude, so sorting joins what
//! belongs together. Within a window of frequencies the curve falls into pieces, which begin
//! and end exactly on the window's borders.

use super::responses::{Response, SlowFlow};

/// A point of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CurvePoint {
    pub(crate) response: Response,
    pub(crate) kind: PointKind,
}

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PointKind {
    /// On the list of frequencies, or between for a smooth picture.
    Regular,
    /// Exactly on a fold.
    Fold,
    /// Exactly on the peak.
    Peak,
    /// Exactly on the window's border.
    End,
}

/// Connected pieces of the response curve inside a window.
pub(crate) struct ResponseCurve {
    pub(crate) pieces: Vec<Vec<CurvePoint>>,
}

/// A point may lie this part of the picture's width and height from the next.
const FINENESS: f64 = 1.0 / 150.0;
/// Points added for smoothness are at most this many times those asked for.
const MOST_ADDED: usize = 4000;

impl ResponseCurve {
    /// The curve between detunings `from` and `to`, with all responses at `count` evenly spaced
    /// detunings, all folds and the peak on it.
    pub(crate) fn new(flow: &SlowFlow, (from, to): (f64, f64), count: usize) -> Self {
        let mut points = listed(flow, from, to, count.max(2));
        let inside = |response: &Response| response.sigma > from && response.sigma < to;
        let special = |response: Response, kind| CurvePoint { response, kind };
        let folds = flow.folds().into_iter().filter(inside);
        points.extend(folds.map(|response| special(response, PointKind::Fold)));
        let peak = flow.peak().filter(|peak| inside(peak) && peak.z > 0.0);
        points.extend(peak.map(|response| special(response, PointKind::Peak)));
        points.sort_by(|a, b| place(a).total_cmp(&place(b)));
        points.dedup_by(same);
        let mut pieces = split(flow, &points, (from, to));
        refine(flow, &mut pieces, to - from);
        Self { pieces }
    }
}

/// Place of a point along the curve: rising amplitude before the backbone, falling beyond it.
fn place(point: &CurvePoint) -> f64 {
    let Response { z, beyond, .. } = point.response;
    // A reciprocal keeps order for all amplitudes: -1/z rises with z, 1/z falls.
    match (point.kind, beyond > 0.0) {
        (PointKind::Peak, _) => 0.0,
        (_, true) => 1.0 / z,
        (_, false) => -1.0 / z,
    }
}

/// Whether two neighbours are one point met twice; the special one is kept.
fn same(later: &mut CurvePoint, earlier: &mut CurvePoint) -> bool {
    let (a, b) = (later.response, earlier.response);
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-13 * a.abs().max(b.abs());
    let one = close(a.z, b.z)
        && (a.sigma - b.sigma).abs() <= 1e-13 * a.beyond.abs().max(b.beyond.abs())
        && (a.beyond > 0.0) == (b.beyond > 0.0);
    if one && earlier.kind == PointKind::Regular {
        *earlier = *later;
    }
    one
}

/// All responses at evenly spaced detunings; those on the borders are ends.
fn listed(flow: &SlowFlow, from: f64, to: f64, count: usize) -> Vec<CurvePoint> {
    let mut points = Vec::with_capacity(count + 16);
    #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
    for index in 0..count {
        let share = index as f64 / (count - 1) as f64;
        let border = index == 0 || index == count - 1;
        let sigma = if index == count - 1 { to } else { from + (to - from) * share };
        let kind = if border { PointKind::End } else { PointKind::Regular };
        points.extend(
            flow.responses(sigma).into_iter().map(|response| CurvePoint { response, kind }),
        );
    }
    points
}

/// Cuts the sorted points where the curve leaves the window between two of them.
fn split(flow: &SlowFlow, points: &[CurvePoint], window: (f64, f64)) -> Vec<Vec<CurvePoint>> {
    let mut pieces: Vec<Vec<CurvePoint>> = Vec::new();
    let mut piece: Vec<CurvePoint> = Vec::new();
    for point in points {
        let leaves = piece.last().is_some_and(|last| leaves(flow, last, point, window));
        if leaves {
            pieces.push(std::mem::take(&mut piece));
        }
        piece.push(*point);
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

/// Whether the curve leaves the window between two neighbours: it can only do so across a
/// border, where both are ends.
fn leaves(flow: &SlowFlow, a: &CurvePoint, b: &CurvePoint, (from, to): (f64, f64)) -> bool {
    if a.kind != PointKind::End || b.kind != PointKind::End {
        return false;
    }
    let middle = middle(flow, a, b);
    middle.is_none_or(|response| response.sigma < from || response.sigma > to)
}

/// A point of the curve between two neighbours; over the peak where they are on two sides.
fn middle(flow: &SlowFlow, a: &CurvePoint, b: &CurvePoint) -> Option<Response> {
    let (before, after) = (a.response.beyond <= 0.0, b.response.beyond > 0.0);
    if before && after && a.kind != PointKind::Peak {
        return flow.peak();
    }
    let z = (a.response.z * b.response.z).sqrt();
    flow.at(z, after)
}

/// Adds points where neighbours are too far apart for a smooth picture.
fn refine(flow: &SlowFlow, pieces: &mut [Vec<CurvePoint>], width: f64) {
    let rho = |point: &CurvePoint| point.response.rho();
    let height = pieces.iter().flatten().map(rho).fold(0.0, f64::max);
    let far = |a: &CurvePoint, b: &CurvePoint| {
        let across = (a.response.sigma - b.response.sigma).abs() / width;
        let up = (rho(a) - rho(b)).abs() / height;
        across.max(up) > FINENESS
    };
    for piece in pieces {
        let mut fine: Vec<CurvePoint> = Vec::with_capacity(piece.len());
        let mut waiting: Vec<CurvePoint> = piece.iter().rev().copied().collect();
        let most = piece.len() + MOST_ADDED;
        while let Some(next) = waiting.pop() {
            let between = fine
                .last()
                .filter(|last| far(last, &next) && fine.len() + waiting.len() < most)
                .and_then(|last| midpoint(flow, last, &next));
            match between {
                Some(middle) => waiting.extend([next, middle]),
                None => fine.push(next),
            }
        }
        *piece = fine;
    }
}

/// A new regular point between two neighbours on one side of the backbone.
fn midpoint(flow: &SlowFlow, a: &CurvePoint, b: &CurvePoint) -> Option<CurvePoint> {
    let after = if a.kind == PointKind::Peak { b } else { a }.response.beyond > 0.0;
    let other = if b.kind == PointKind::Peak { a } else { b }.response.beyond > 0.0;
    if after != other {
        return None;
    }
    let (za, zb) = (a.response.z, b.response.z);
    let rho = f64::midpoint(za.sqrt(), zb.sqrt());
    let z = rho * rho;
    let inside = z > za.min(zb) && z < za.max(zb) && (za / zb - 1.0).abs() > 1e-9;
    let response = flow.at(z, after).filter(|_| inside)?;
    Some(CurvePoint { response, kind: PointKind::Regular })
}
