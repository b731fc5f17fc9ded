//! Seeds followed to branches, told apart from those known.

use halfshaft_numerics::observer::Observer;

use super::super::branches::TracedBranch;
use super::super::tracer::{BranchEnd, Counted};
use super::closing::SAME;
use super::curve::{Curve, Limits};
use super::point::{Kind, Point};
use super::special::ExactSpecial;
use crate::shooting::{Shooter, length};

/// A branch of orbits.
#[derive(Clone, Debug)]
pub(super) struct ExactBranch {
    pub(super) kind: Kind,
    pub(super) points: Vec<Point>,
    pub(super) specials: Vec<ExactSpecial>,
    pub(super) ends: [BranchEnd; 2],
    pub(super) origin: String,
}

/// A guess at an orbit.
#[derive(Clone, Debug)]
pub(in super::super) struct Guess {
    pub(in super::super) kind: Kind,
    pub(in super::super) state: Vec<f64>,
    pub(in super::super) p: f64,
    pub(in super::super) origin: String,
}

/// Follows branches of one line over one parameter.
pub(super) struct Explorer<'x, 'e> {
    pub(super) shooter: Shooter<'e>,
    pub(super) limits: Limits,
    pub(super) observer: &'x dyn Observer,
    /// Whether the line has mirror images of its orbits.
    pub(super) odd: bool,
    /// Parameters between which branches that branch off are followed.
    pub(super) forks: (f64, f64),
    /// Whether grazing contact is looked for.
    pub(super) grazing: bool,
    pub(super) branches: Vec<ExactBranch>,
    pub(super) counted: Counted,
    pub(super) messages: Vec<String>,
}

impl<'x, 'e> Explorer<'x, 'e> {
    pub(super) fn new(
        shooter: Shooter<'e>,
        limits: Limits,
        odd: bool,
        grazing: bool,
        observer: &'x dyn Observer,
    ) -> Self {
        Self {
            shooter,
            limits,
            observer,
            odd,
            grazing,
            forks: (f64::NEG_INFINITY, f64::INFINITY),
            branches: Vec::new(),
            counted: Counted::default(),
            messages: Vec::new(),
        }
    }

    pub(super) fn curve(&self, kind: Kind) -> Curve<'x, 'e> {
        Curve::new(&self.shooter, kind, self.odd, self.limits, self.observer)
    }

    pub(super) fn count(&mut self, curve: &Curve<'_, '_>) {
        self.counted.steps += curve.steps;
        self.counted.iterations += curve.corrections;
    }

    /// Follows the branch through the orbit near a guess, unless there is none or it is known;
    /// whether there is an orbit.
    pub(super) fn add(&mut self, guess: &Guess) -> bool {
        let mut curve = self.curve(guess.kind);
        let Ok(orbit) = curve.shooter.at(&guess.state, guess.p) else { return false };
        let Ok(start) = curve.point(orbit, None) else { return false };
        if self.is_known(&mut curve, &start) || is_shorter(&mut curve, &start) {
            return true;
        }
        self.counted.seeds += 1;
        let branch = self.both_ways(&mut curve, &start, guess.origin.clone());
        self.count(&curve);
        self.branches.push(branch);
        true
    }

    /// Whether an orbit, or the same some periods later, or its mirror image, lies on a branch.
    pub(super) fn is_known(&self, curve: &mut Curve<'_, '_>, point: &Point) -> bool {
        let mut images = curve.images(point);
        images.push(point.state().to_vec());
        let same: Vec<&ExactBranch> =
            self.branches.iter().filter(|branch| branch.kind == curve.kind).collect();
        same.into_iter()
            .any(|branch| images.iter().any(|state| lies_on(curve, &branch.points, state, point)))
    }

    pub(super) fn both_ways(
        &mut self,
        curve: &mut Curve<'_, '_>,
        start: &Point,
        origin: String,
    ) -> ExactBranch {
        let (low, high) = self.limits.range;
        let (mut points, mut ends) = (Vec::new(), [BranchEnd::Range; 2]);
        let rising = if start.tangent_p < 0.0 { -1.0 } else { 1.0 };
        if start.p() > low {
            let (back, end) = curve.follow(start, -rising);
            let (back, end) = self.joined(curve, back, end);
            ends[0] = end;
            points = back;
            if end == BranchEnd::Closed {
                ends[1] = end;
            } else {
                points.reverse();
                points = points.into_iter().map(|point| point.oriented(-1.0)).collect();
            }
        }
        if ends[1] != BranchEnd::Closed && start.p() < high {
            let (ahead, end) = curve.follow(start, rising);
            let (ahead, end) = self.joined(curve, ahead, end);
            ends[1] = end;
            points.truncate(points.len().saturating_sub(1));
            points.extend(ahead);
        }
        // Where branches meet directions are those of neither.
        let first = usize::from(ends[0] == BranchEnd::Enough);
        let last = points.len().saturating_sub(usize::from(ends[1] == BranchEnd::Enough));
        let mut specials = curve.specials(&points[first..last.max(first)], self.grazing);
        specials.iter_mut().for_each(|special| special.after += first);
        ExactBranch { kind: curve.kind, points, specials, ends, origin }
    }

    /// Drops branches that run along another.
    pub(super) fn merge(&mut self) {
        let mut at = 0;
        while at < self.branches.len() {
            let piece = self.branches[at].clone();
            let mut curve = self.curve(piece.kind);
            let longer = self.branches.iter().enumerate().filter(|(other, whole)| {
                *other != at
                    && whole.kind == piece.kind
                    && (whole.points.len(), at) > (piece.points.len(), *other)
            });
            let longer: Vec<&ExactBranch> = longer.map(|(_, whole)| whole).collect();
            let count = piece.points.len();
            let places = [count / 4, count / 2, 3 * count / 4];
            let along = |whole: &&ExactBranch, curve: &mut Curve<'_, '_>| {
                places.iter().all(|place| {
                    let point = &piece.points[*place];
                    lies_on(curve, &whole.points, point.state(), point)
                })
            };
            let duplicate = count > 0 && longer.iter().any(|whole| along(whole, &mut curve));
            if duplicate {
                self.branches.remove(at);
            } else {
                at += 1;
            }
        }
    }
}

/// Whether an orbit of several periods is one of fewer.
fn is_shorter(curve: &mut Curve<'_, '_>, point: &Point) -> bool {
    let periods = curve.kind.periods;
    (1..periods).filter(|part| periods.is_multiple_of(*part)).any(|part| {
        let share = f64::from(part) / f64::from(periods);
        let after = curve.shooter.after(point.state(), point.p(), share, |_| {});
        after.is_ok_and(|state| {
            let away: Vec<f64> = state.iter().zip(point.state()).map(|(a, b)| a - b).collect();
            length(&away) < SAME * point.size
        })
    })
}

/// Whether a state at the parameter of a point lies on a branch.
pub(super) fn lies_on(
    curve: &mut Curve<'_, '_>,
    points: &[Point],
    state: &[f64],
    like: &Point,
) -> bool {
    let place = (state, like.p());
    points.windows(2).any(|pair| curve.passes(&pair[0], &pair[1], place, like.size))
}

impl From<ExactBranch> for TracedBranch {
    /// The branch without its responses.
    fn from(branch: ExactBranch) -> Self {
        Self {
            samples: Vec::new(),
            stability: branch.points.into_iter().map(|point| point.stability).collect(),
            specials: Vec::new(),
            base: branch.kind.base,
            periods: branch.kind.periods,
            origin: branch.origin,
            ends: branch.ends,
        }
    }
}
