//! Whether a branch has come back: to where it began, to that some periods later, or to the branch that
//! it branches off.

use super::super::closing::passes;
use super::curve::Curve;
use super::point::Point;
use crate::shooting::{Lost, length};

/// Orbits farther than this from the chord of two points are not between them, in the metric.
pub(super) const REACH: f64 = 0.1;
/// Orbits this near, relative to their swing, are the same.
pub(super) const SAME: f64 = 1e-5;
/// An own part below this of the swing is none.
const VANISHED: f64 = 1e-6;
/// An own part below this of the swing may vanish within a step.
const NEAR: f64 = 3e-3;
/// An own part that shrinks to this part of itself where it changes its sign passes through nothing.
const SHRUNK: f64 = 0.3;
/// How far beside the place at which it should vanish it is also looked at, as a part of the way there.
const BESIDE: f64 = 0.2;

/// How a step relates to the branch that a branch branches off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rejoined {
    No,
    /// It comes back to it.
    Yes,
    /// It leapt to it from afar.
    Suddenly,
}

impl Curve<'_, '_> {
    /// States at time 0 of the same orbit begun a period of the excitation later, and of its mirror
    /// images; without itself.
    pub(super) fn images(&mut self, point: &Point) -> Vec<Vec<f64>> {
        let mut images = Vec::new();
        let periods = self.kind.periods;
        let halves = if self.odd && !self.kind.mirrored { 2 * periods } else { periods };
        for half in 1..halves {
            let part = f64::from(half) / f64::from(halves);
            let Ok(mut state) = self.shooter.after(point.state(), point.p(), part, |_| {}) else {
                continue;
            };
            if halves != periods && half % 2 == 1 {
                state.iter_mut().for_each(|x| *x = -*x);
            }
            images.push(state);
        }
        images
    }

    /// Whether a state at the parameter of a point lies between two points: corrected in the plane
    /// across their chord in which the state lies, these are the same.
    pub(super) fn passes(
        &mut self,
        from: &Point,
        to: &Point,
        (state, p): (&[f64], f64),
        size: f64,
    ) -> bool {
        let metric = self.metric(size);
        let (chord, chord_p, reach) = metric.step(from, to);
        if reach == 0.0 {
            return false;
        }
        let d: Vec<f64> = state.iter().zip(from.state()).map(|(x, a)| x - a).collect();
        let d_p = p - from.p();
        let part = metric.dot((&d, d_p), (&chord, chord_p)) / (reach * reach);
        if !(-0.05..=1.05).contains(&part) {
            return false;
        }
        let off: Vec<f64> = d.iter().zip(&chord).map(|(d, c)| d - part * c).collect();
        if metric.norm(&off, d_p - part * chord_p) > REACH {
            return false;
        }
        // The plane of the pair's own metric.
        let own = self.metric(from.size);
        let length = own.norm(&chord, chord_p);
        let part = own.dot((&d, d_p), (&chord, chord_p)) / (length * length);
        let Ok(orbit) = self.between(from, to, part) else { return false };
        let away: Vec<f64> = orbit.state.iter().zip(state).map(|(a, b)| a - b).collect();
        metric.norm(&away, orbit.frequency - p) < SAME
    }

    /// Whether the step from the last point to `next` passes the first point in its direction.
    pub(super) fn comes_back(&self, points: &[Point], next: &Point) -> bool {
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return false };
        let metric = self.metric(first.size);
        let ahead = (first.tangent.as_slice(), first.tangent_p);
        let from_first = |point: &Point| {
            let (d, d_p, distance) = metric.step(first, point);
            (distance, metric.dot((&d, d_p), ahead))
        };
        let (step, step_p, length) = metric.step(last, next);
        let forward = metric.dot((&step, step_p), ahead);
        passes(from_first(last), from_first(next), forward, length)
    }

    /// The part of a state that the branch from which it branches off lacks: it repeats earlier, or
    /// mirrors itself. `None` for orbits that have no such part.
    pub(super) fn own_part(&mut self, point: &Point) -> Result<Option<Vec<f64>>, Lost> {
        let kind = self.kind;
        let (part, sign) = match kind.periods {
            1 if self.odd && !kind.mirrored => (0.5, 1.0),
            1 => return Ok(None),
            periods => {
                let divides = |d: &u32| periods.is_multiple_of(*d);
                let least = (2..=periods).find(divides).unwrap_or(periods);
                (1.0 / f64::from(least), -1.0)
            }
        };
        let after = self.shooter.after(point.state(), point.p(), part, |_| {})?;
        Ok(Some(point.state().iter().zip(&after).map(|(x, y)| x + sign * y).collect()))
    }

    /// How a branch relates to the one that it branches off in a step.
    pub(super) fn rejoins(&mut self, last: &Point, next: &Point) -> Rejoined {
        if self.kind.periods == 1 && (!self.odd || self.kind.mirrored) {
            return Rejoined::No;
        }
        let (Ok(Some(own)), Ok(Some(before))) = (self.own_part(next), self.own_part(last)) else {
            return Rejoined::No;
        };
        if length(&own) < VANISHED * next.size {
            let near = length(&before) < NEAR * last.size;
            return if near { Rejoined::Yes } else { Rejoined::Suddenly };
        }
        if self.turns_over(last, next, &before, &own) { Rejoined::Yes } else { Rejoined::No }
    }

    /// Whether the own part passes through nothing in a step.
    fn turns_over(&mut self, last: &Point, next: &Point, before: &[f64], own: &[f64]) -> bool {
        let dot: f64 = own.iter().zip(before).map(|(a, b)| a * b).sum();
        let (size, earlier) = (length(own), length(before));
        if dot >= 0.0 {
            return false;
        }
        let part = earlier / (earlier + size);
        let beside = BESIDE * part.min(1.0 - part);
        // Where the branches cross Newton's method may fail.
        [part, part + beside, part - beside].into_iter().any(|part| {
            let there = self.point_between(last, next, part).map(|point| self.own_part(&point));
            let there = there.ok().and_then(|own| own.ok().flatten());
            there.is_some_and(|there| length(&there) < SHRUNK * size.min(earlier))
        })
    }
}
