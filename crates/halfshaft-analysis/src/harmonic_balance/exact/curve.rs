//! Branches of orbits by pseudo-arclength continuation.
//!
//! The same steps as in [`super::super::tracer`], in the space of states at time 0: tangent and
//! curvature predict, Newton's method corrects in the plane across the tangent, and what the tangent
//! alone misses steers the step.

use halfshaft_numerics::observer::Observer;

use super::super::tracer::BranchEnd;
use super::closing::Rejoined;
use super::point::{Across, Kind, Metric, Point, point_of};
use super::touch::Turns;
use crate::shooting::{Lost, Orbit, Shooter};

/// The numbers of the continuation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Range of the running parameter.
    pub(super) range: (f64, f64),
    /// Miss of the tangent that is aimed at, in the metric.
    pub(super) miss: f64,
    /// Longest step, in the metric.
    pub(super) longest: f64,
    /// Points of a branch at most.
    pub(super) most_points: usize,
    /// Size of the orbit at which it counts as unbounded.
    pub(super) most_size: f64,
    /// A correction below this, relative, is the last.
    pub(super) enough: f64,
}

/// Shortest step, in the metric.
const SHORTEST: f64 = 1e-9;
/// Steps shorter than this do not leap.
const LEAST_LEAP: f64 = 2e-4;
/// Steps down to this are tried where the branch leaps to another.
const LEAP: f64 = 1e-6;
/// Part of a step in which direction may turn: cosine of the angle.
const LEAST_TURN: f64 = 0.5;
/// A twist that turns this near to a break of its law, relative to the swing, grazes it.
const GRAZING: f64 = 1e-3;

/// A family of orbits that is followed.
pub(super) struct Curve<'c, 'e> {
    pub(super) shooter: Shooter<'e>,
    pub(super) kind: Kind,
    pub(super) limits: Limits,
    pub(super) observer: &'c dyn Observer,
    /// Whether the line has mirror images of its orbits.
    pub(super) odd: bool,
    /// The orbit behind the last one where the branch came back to another.
    pub(super) beyond: Option<Point>,
    turns: Turns,
    pub(super) steps: usize,
    pub(super) corrections: usize,
}

/// Why a step was not taken.
enum Refused {
    Lost(Lost),
    /// The tangent missed by so much.
    TooFar(f64),
}

impl From<Lost> for Refused {
    fn from(lost: Lost) -> Self {
        Self::Lost(lost)
    }
}

impl<'c, 'e> Curve<'c, 'e> {
    pub(super) fn new(
        shooter: &Shooter<'e>,
        kind: Kind,
        odd: bool,
        limits: Limits,
        observer: &'c dyn Observer,
    ) -> Self {
        let turns = Turns::new(shooter.equations());
        let mut shooter = shooter.of_kind(kind.base, kind.mirrored);
        shooter.set_enough(limits.enough);
        let beyond = None;
        Self { shooter, kind, limits, observer, odd, beyond, turns, steps: 0, corrections: 0 }
    }

    pub(super) fn metric(&self, size: f64) -> Metric {
        let (low, high) = self.limits.range;
        Metric { size, span: (high - low).max(f64::MIN_POSITIVE.sqrt()) }
    }

    /// An orbit as a point of a branch.
    pub(super) fn point(
        &mut self,
        orbit: Orbit,
        along: Option<(&[f64], f64)>,
    ) -> Result<Point, Lost> {
        let span = self.metric(1.0).span;
        point_of(&mut self.shooter, orbit, span, self.kind.mirrored, along, &self.turns)
    }

    /// The orbit in the plane across a direction, from a guess that lies in it.
    pub(super) fn across(
        &mut self,
        metric: &Metric,
        along: (&[f64], f64),
        place: (&[f64], f64),
        guess: (&[f64], f64),
    ) -> Result<Orbit, Lost> {
        self.corrections += 1;
        let across = Across::new(metric, self.shooter.reference(), along, place);
        self.shooter.correct(guess.0, guess.1, &across.plane())
    }

    /// The orbit between two points in the plane across their chord, at a part (0 to 1) of it.
    pub(super) fn between(&mut self, from: &Point, to: &Point, part: f64) -> Result<Orbit, Lost> {
        let metric = self.metric(from.size);
        let (chord, chord_p, length) = metric.step(from, to);
        let direction = |point: &Point| {
            let along = metric.dot((&point.tangent, point.tangent_p), (&chord, chord_p)) / length;
            length / along
        };
        let (at_from, at_to) = (direction(from), direction(to));
        let s = part;
        // Hermite's cubic through both points with their directions.
        let weights = [
            (1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s),
            at_from * s * (1.0 - s) * (1.0 - s),
            s * s * (3.0 - 2.0 * s),
            at_to * s * s * (s - 1.0),
        ];
        let mix = |values: [f64; 4]| weights.iter().zip(values).map(|(w, x)| w * x).sum::<f64>();
        let guess: Vec<f64> = (0..chord.len())
            .map(|k| mix([from.state()[k], from.tangent[k], to.state()[k], to.tangent[k]]))
            .collect();
        let guess_p = mix([from.p(), from.tangent_p, to.p(), to.tangent_p]);
        let place: Vec<f64> = from.state().iter().zip(&chord).map(|(x, c)| x + part * c).collect();
        let place_p = from.p() + part * chord_p;
        self.across(&metric, (&chord, chord_p), (&place, place_p), (&guess, guess_p))
    }

    /// The same as a point.
    pub(super) fn point_between(
        &mut self,
        from: &Point,
        to: &Point,
        part: f64,
    ) -> Result<Point, Lost> {
        let orbit = self.between(from, to, part)?;
        let (chord, chord_p, _) = self.metric(from.size).step(from, to);
        self.point(orbit, Some((&chord, chord_p)))
    }

    /// Follows the branch from `start` in the direction of `sign` times its tangent.
    pub(super) fn follow(&mut self, start: &Point, sign: f64) -> (Vec<Point>, BranchEnd) {
        let mut points = vec![start.clone().oriented(sign)];
        let mut step = 0.02_f64.min(self.limits.longest);
        let (low, high) = self.limits.range;
        let images = self.images(start);
        let end = loop {
            if self.observer.cancelled() {
                break BranchEnd::Cancelled;
            }
            if points.len() >= self.limits.most_points {
                break BranchEnd::SampleLimit;
            }
            match self.advance(&points, &mut step) {
                Ok(next) if next.p() < low || next.p() > high => {
                    let border = if next.p() < low { low } else { high };
                    let last = points.last().and_then(|last| self.border(last, &next, border));
                    points.extend(last);
                    break BranchEnd::Range;
                }
                Ok(next) => {
                    if points.len() > 3 && self.comes_back(&points, &next) {
                        points.push(points[0].clone());
                        break BranchEnd::Closed;
                    }
                    let last = &points[points.len() - 1];
                    match self.rejoins(last, &next) {
                        Rejoined::No => {}
                        Rejoined::Yes => {
                            self.beyond = Some(next);
                            break BranchEnd::Enough;
                        }
                        Rejoined::Suddenly => {
                            let (_, _, taken) = self.metric(last.size).step(last, &next);
                            step = 0.3 * taken.min(step);
                            if step > LEAP {
                                continue;
                            }
                            break self.why(Lost::NotConverged, points.last());
                        }
                    }
                    let place =
                        |state: &Vec<f64>| self.passes(last, &next, (state, start.p()), start.size);
                    if points.len() > 3 && images.iter().any(place) {
                        points.push(points[0].clone());
                        break BranchEnd::Closed;
                    }
                    let unbounded = next.size > self.limits.most_size;
                    points.push(next);
                    if unbounded {
                        break BranchEnd::Unbounded;
                    }
                }
                Err(lost) => break self.why(lost, points.last()),
            }
        };
        (points, end)
    }

    /// Whether a twist turns next to a break of its law.
    pub(super) fn grazes(&self, point: &Point) -> bool {
        point.turns.nearest(self.shooter.equations()) < GRAZING * point.size
    }

    /// Why no step was small enough.
    fn why(&self, lost: Lost, last: Option<&Point>) -> BranchEnd {
        match lost {
            Lost::Chattering => BranchEnd::Chattering,
            _ if last.is_some_and(|last| self.grazes(last)) => BranchEnd::Grazing,
            _ => BranchEnd::StepTooSmall,
        }
    }

    /// The next point after the last.
    fn advance(&mut self, points: &[Point], step: &mut f64) -> Result<Point, Lost> {
        let Some(last) = points.last() else { return Err(Lost::NotConverged) };
        let before = points.len().checked_sub(2).map(|at| &points[at]);
        loop {
            self.steps += 1;
            let factor = |miss: f64, aim: f64| (aim / miss.max(1e-12)).sqrt().clamp(0.3, 1.8);
            match self.try_step(last, before, *step) {
                Ok((next, miss)) => {
                    let longer = *step * factor(miss, self.limits.miss);
                    *step = longer.min(self.limits.longest);
                    return Ok(next);
                }
                Err(Refused::TooFar(miss)) if *step > 1e3 * SHORTEST => {
                    *step *= factor(miss, self.limits.miss);
                }
                Err(refused) => {
                    *step *= 0.35;
                    if *step < SHORTEST {
                        return Err(match refused {
                            Refused::Lost(lost) => lost,
                            Refused::TooFar(_) => Lost::NotConverged,
                        });
                    }
                }
            }
        }
    }

    /// One step of the given length; also how far the tangent alone misses.
    fn try_step(
        &mut self,
        last: &Point,
        before: Option<&Point>,
        step: f64,
    ) -> Result<(Point, f64), Refused> {
        let metric = self.metric(last.size);
        let ahead = |x: &f64, t: &f64| x + step * t;
        let straight: Vec<f64> =
            last.state().iter().zip(&last.tangent).map(|(x, t)| ahead(x, t)).collect();
        let straight_p = ahead(&last.p(), &last.tangent_p);
        if straight_p <= 0.0 {
            return Err(Lost::NotConverged.into());
        }
        let (mut guess, mut guess_p) = (straight.clone(), straight_p);
        if let Some(before) = before {
            bend(&metric, last, before, step, (&mut guess, &mut guess_p));
        }
        let along = (last.tangent.as_slice(), last.tangent_p);
        let place = (straight.as_slice(), straight_p);
        let orbit = self.across(&metric, along, place, (&guess, guess_p))?;
        let away: Vec<f64> = orbit.state.iter().zip(&straight).map(|(a, b)| a - b).collect();
        let miss = metric.norm(&away, orbit.frequency - straight_p);
        if miss > 6.0 * self.limits.miss && step > 1e3 * SHORTEST {
            return Err(Refused::TooFar(miss));
        }
        let next = self.point(orbit, Some(along))?;
        let turn = metric.dot((&next.tangent, next.tangent_p), along);
        let turn = turn / metric.norm(&next.tangent, next.tangent_p);
        // A change of orientation without a branch point is a leap to another branch.
        let leapt = next.orientation * last.orientation < 0.0 && step > LEAST_LEAP;
        if leapt || (turn < LEAST_TURN && step > 1e2 * SHORTEST) {
            return Err(Lost::NotConverged.into());
        }
        Ok((next, miss))
    }

    /// The orbit at the border of the range, between two points.
    fn border(&mut self, inside: &Point, outside: &Point, border: f64) -> Option<Point> {
        let part = (border - inside.p()) / (outside.p() - inside.p());
        let guess = self.between(inside, outside, part).ok()?;
        self.corrections += 1;
        let orbit = self.shooter.at(&guess.state, border).ok()?;
        self.point(orbit, Some((&inside.tangent, inside.tangent_p))).ok()
    }
}

/// Adds the branch's bend to a prediction: a parabola through the last point with its tangent and the
/// point before.
fn bend(
    metric: &Metric,
    last: &Point,
    before: &Point,
    step: f64,
    (state, p): (&mut [f64], &mut f64),
) {
    let (back, back_p, _) = metric.step(last, before);
    let along = (last.tangent.as_slice(), last.tangent_p);
    let travelled = -metric.dot((&back, back_p), along);
    let factor = (step / travelled).powi(2);
    if travelled <= 0.0 || factor > 9.0 {
        return;
    }
    for ((x, back), along) in state.iter_mut().zip(&back).zip(&last.tangent) {
        *x += factor * (back + travelled * along);
    }
    *p += factor * (back_p + travelled * last.tangent_p);
}
