//! Branches of orbits that branch off: of twice the period, of broken symmetry, and others.

use halfshaft_numerics::dense::{Lu, Matrix};
use halfshaft_results::SpecialKind;

use super::super::tracer::BranchEnd;
use super::curve::Curve;
use super::explorer::{ExactBranch, Explorer};
use super::point::{Kind, Point};
use super::special::ExactSpecial;
use crate::shooting::{Lost, Orbit, length};

/// Branches that are asked for what branches off.
const MOST_BRANCHES: usize = 24;
/// Forks that are asked at most.
const MOST_FORKS: usize = 40;
/// How far from a fork the first orbit of the other branch is looked for, relative to the swing.
const OFFSETS: [f64; 5] = [1e-2, 3e-3, 3e-2, 1e-3, 1e-4];
/// Inverse iterations for a null vector, and the shift that keeps the matrix regular.
const ITERATIONS: usize = 5;
const SHIFT: f64 = 1e-9;
/// Points nearer than this, relative, are the same.
const SAME_POINT: f64 = 1e-4;

/// What parts a branch from the one that it branches off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Parting {
    /// The state differs from that a period of the old branch later.
    Doubling,
    /// The state differs from the mirror image of that half a period later.
    Mirror,
    /// Nothing but its size.
    None,
}

impl Parting {
    fn words(self) -> &'static str {
        match self {
            Self::Doubling => "period doubling",
            Self::Mirror | Self::None => "branch point",
        }
    }
}

/// A point where a branch branches off.
struct Fork {
    kind: Kind,
    /// The old orbit as one of the new branch, with the direction of that.
    point: Point,
}

impl Explorer<'_, '_> {
    /// Follows what branches off at branch points and period doublings.
    pub(super) fn branch_off(&mut self) {
        let (mut at, mut asked) = (0, 0);
        while at < self.branches.len() && at < MOST_BRANCHES {
            let branch = self.branches[at].clone();
            for special in branch.specials.iter().filter(|special| special.located) {
                if self.observer.cancelled() {
                    return;
                }
                let Some(parting) = parts(&branch, special) else { continue };
                let (low, high) = self.forks;
                if !(low..=high).contains(&special.point.p()) {
                    continue;
                }
                asked += 1;
                if asked > MOST_FORKS {
                    return;
                }
                match self.switch(&branch, special, parting) {
                    Ok(Some(found)) => self.branches.push(found),
                    Ok(None) => {}
                    Err(_) => self.messages.push(format!(
                        "the branch that parts at the {} at {:.6} was not found",
                        parting.words(),
                        special.point.p()
                    )),
                }
            }
            at += 1;
        }
    }

    /// The branch that crosses at a special point, unless it is known.
    fn switch(
        &mut self,
        branch: &ExactBranch,
        special: &ExactSpecial,
        parting: Parting,
    ) -> Result<Option<ExactBranch>, Lost> {
        let fork = self.fork(branch, special, parting)?;
        if self.ends_at(&fork) {
            return Ok(None);
        }
        let mut curve = self.curve(fork.kind);
        let start = first(&mut curve, &fork)?;
        let known = parting != Parting::None && self.is_known(&mut curve, &start);
        if known {
            return Ok(None);
        }
        let origin = format!("{} at {:.6}", parting.words(), special.point.p());
        let found = if parting == Parting::None {
            if self.is_known(&mut curve, &start) {
                return Ok(None);
            }
            self.both_ways(&mut curve, &start, origin)
        } else {
            let (points, end) = curve.follow(&start, 1.0);
            let (mut points, end) = self.joined(&mut curve, points, end);
            points.insert(0, fork.point.clone());
            // The fork itself is no special point of the new branch.
            let last = points.len() - usize::from(end == BranchEnd::Enough);
            let mut specials = curve.specials(&points[1..last], self.grazing);
            specials.iter_mut().for_each(|special| special.after += 1);
            let ends = [BranchEnd::Enough, end];
            ExactBranch { kind: fork.kind, points, specials, ends, origin }
        };
        self.count(&curve);
        Ok(Some(found))
    }

    /// The fork at a special point.
    fn fork(
        &self,
        branch: &ExactBranch,
        special: &ExactSpecial,
        parting: Parting,
    ) -> Result<Fork, Lost> {
        let (old, orbit) = (branch.kind, &special.point.orbit);
        let kind = match parting {
            Parting::Doubling => Kind { base: old.base / 2.0, periods: 2 * old.periods, ..old },
            Parting::Mirror => Kind { mirrored: false, ..old },
            Parting::None => old,
        };
        let reference = self.shooter.reference();
        let n = orbit.state.len();
        let (mut tangent, tangent_p) = match parting {
            Parting::Doubling => (null_vector(&shifted(&orbit.matrix, 1.0))?, 0.0),
            Parting::Mirror => (null_vector(&shifted(&orbit.matrix, -1.0))?, 0.0),
            Parting::None => {
                let along = (&special.point.tangent, special.point.tangent_p / reference);
                let shooter = self.shooter.of_kind(old.base, old.mirrored);
                let bordered =
                    shooter.bordered(&orbit.matrix, &orbit.by_frequency, along.0, along.1);
                let mut both = null_vector(&bordered)?;
                let by_reference = both.pop().unwrap_or(0.0);
                (both, by_reference * reference)
            }
        };
        // The orbit over the new period: the map twice.
        let orbit = if parting == Parting::None {
            orbit.clone()
        } else {
            let matrix = orbit.matrix.mul(&orbit.matrix).map_err(|_| Lost::Singular)?;
            Orbit { matrix, ..orbit.clone() }
        };
        let metric = self.curve(kind).metric(special.point.size);
        let scale = 1.0 / metric.norm(&tangent, tangent_p);
        (0..n).for_each(|k| tangent[k] *= scale);
        let point = Point { orbit, tangent, tangent_p: scale * tangent_p, ..special.point.clone() };
        Ok(Fork { kind, point })
    }

    /// Whether a known branch begins or ends at a fork.
    fn ends_at(&self, fork: &Fork) -> bool {
        let metric = self.curve(fork.kind).metric(fork.point.size);
        let close = |point: &Point| metric.step(&fork.point, point).2 < SAME_POINT;
        let same = self.branches.iter().filter(|other| other.kind == fork.kind);
        same.filter(|other| other.ends.contains(&BranchEnd::Enough)).any(|other| {
            [other.points.first(), other.points.last()].into_iter().flatten().any(close)
        })
    }

    /// Ends a branch that came back to another at the point where they meet, as far as that is known.
    pub(super) fn joined(
        &self,
        curve: &mut Curve<'_, '_>,
        mut points: Vec<Point>,
        end: BranchEnd,
    ) -> (Vec<Point>, BranchEnd) {
        let beyond = curve.beyond.take();
        let (Some(last), Some(beyond)) = (points.last(), beyond) else { return (points, end) };
        let parting = if curve.kind.periods == 1 { Parting::Mirror } else { Parting::Doubling };
        let meeting = self.meeting(last, &beyond, curve.kind, parting);
        // Where laws bend hard branches also meet where an orbit begins to touch.
        let end = if meeting.is_none() && curve.grazes(last) { BranchEnd::Grazing } else { end };
        points.extend(meeting);
        (points, end)
    }

    /// The fork at which a branch comes back between two points.
    fn meeting(&self, a: &Point, b: &Point, kind: Kind, parting: Parting) -> Option<Point> {
        let metric = self.curve(kind).metric(a.size);
        let reach = metric.step(a, b).2;
        let forks = self.branches.iter().flat_map(|branch| {
            branch.specials.iter().filter(|special| special.located).filter_map(move |special| {
                meets(branch, special, parting).then_some((branch, special))
            })
        });
        let near = forks.map(|(branch, special)| {
            let away = metric.step(a, &special.point).2.min(metric.step(b, &special.point).2);
            (away, branch, special)
        });
        let near = near.filter(|(away, _, _)| *away < reach);
        let (_, branch, special) = near.min_by(|x, y| x.0.total_cmp(&y.0))?;
        let point = self.fork(branch, special, parting).ok()?;
        if point.kind != kind {
            return None;
        }
        let mut point = point.point;
        (point.tangent, point.tangent_p) = (a.tangent.clone(), a.tangent_p);
        Some(point)
    }
}

/// What branches off at a special point of a branch, if anything that is followed.
fn parts(branch: &ExactBranch, special: &ExactSpecial) -> Option<Parting> {
    let mirrored = branch.kind.mirrored;
    match special.kind {
        // Branches of twice the period are not asked where they double again.
        SpecialKind::PeriodDoubling if branch.kind.periods == 1 && !mirrored => {
            Some(Parting::Doubling)
        }
        SpecialKind::BranchPoint if mirrored => Some(Parting::Mirror),
        SpecialKind::BranchPoint => Some(Parting::None),
        _ => None,
    }
}

/// Whether a branch that parts in a way may come back to a special point of another.
fn meets(branch: &ExactBranch, special: &ExactSpecial, parting: Parting) -> bool {
    match parting {
        Parting::Doubling => special.kind == SpecialKind::PeriodDoubling && !branch.kind.mirrored,
        _ => parts(branch, special) == Some(parting),
    }
}

/// `matrix + shift I`.
fn shifted(matrix: &Matrix, shift: f64) -> Matrix {
    Matrix::from_fn(matrix.rows(), matrix.columns(), |i, j| {
        matrix[(i, j)] + if i == j { shift } else { 0.0 }
    })
}

/// The vector that a singular matrix takes to nothing, of unit length, by inverse iteration.
fn null_vector(matrix: &Matrix) -> Result<Vec<f64>, Lost> {
    let n = matrix.rows();
    let lu = Lu::new(&shifted(matrix, SHIFT)).map_err(|_| Lost::Singular)?;
    // A fixed start that has a share of everything.
    let mut v: Vec<f64> = (0..n).map(|k| 1.0 + 0.3 * (k as f64 * 1.7).sin()).collect();
    for _ in 0..ITERATIONS {
        lu.solve_in_place(&mut v).map_err(|_| Lost::Singular)?;
        let size = length(&v);
        if !size.is_finite() || size == 0.0 {
            return Err(Lost::Singular);
        }
        v.iter_mut().for_each(|x| *x /= size);
    }
    Ok(v)
}

/// The first orbit beside a fork on the new branch, its direction away from the fork.
fn first(curve: &mut Curve<'_, '_>, fork: &Fork) -> Result<Point, Lost> {
    let point = &fork.point;
    let metric = curve.metric(point.size);
    let along = (point.tangent.as_slice(), point.tangent_p);
    let mut why = Lost::NotConverged;
    for offset in OFFSETS {
        let state: Vec<f64> =
            point.state().iter().zip(&point.tangent).map(|(x, t)| x + offset * t).collect();
        let p = point.p() + offset * point.tangent_p;
        let place = (state.as_slice(), p);
        let found = curve.across(&metric, along, place, place);
        match found.and_then(|orbit| curve.point(orbit, Some(along))) {
            Ok(found) if metric.step(point, &found).2 < 10.0 * offset => return Ok(found),
            Ok(_) => {}
            Err(lost) => why = lost,
        }
    }
    Err(why)
}
