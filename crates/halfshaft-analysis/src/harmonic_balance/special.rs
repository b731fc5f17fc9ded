//! What happens between the samples of a branch, located to the tolerance.
//!
//! Folds are zeros of the parameter's share of the tangent; branch points, period doublings and
//! Neimark-Sacker points zeros of a multiplier's distance from the unit circle; grazing contact a zero
//! of the distance of the extreme twist from a switching twist.

use halfshaft_results::SpecialKind;

use super::grazing::{Touch, touches};
use super::locating::Test;
use super::problem::{Axis, Metric};
use super::stability::{Crossing, Judge, Stability, crossings, may_be_a_meeting};
use super::tracer::{Sample, Tracer, refit};

/// A special point between sample `after` and the next.
#[derive(Clone, Debug)]
pub(crate) struct Special {
    pub(crate) kind: SpecialKind,
    pub(crate) after: usize,
    pub(crate) sample: Sample,
    pub(crate) stability: Option<Stability>,
    /// Change of the parameter when harmonics were last added, relative; the width of the bracket
    /// where none were.
    pub(crate) precision: f64,
    pub(crate) located: bool,
    /// Change of the unstable dimension.
    pub(crate) change: Option<i32>,
    pub(crate) note: Option<String>,
    /// What touches, at a grazing contact.
    pub(crate) touch: Option<Touch>,
}

impl Tracer<'_, '_> {
    /// Special points of a branch, in its order.
    pub(super) fn specials(
        &mut self,
        judge: &mut Judge,
        samples: &[Sample],
        stabilities: &[Stability],
    ) -> Vec<Special> {
        let mut found = Vec::new();
        for after in 0..samples.len().saturating_sub(1) {
            let pair = (&samples[after], &samples[after + 1]);
            let stability = (&stabilities[after], &stabilities[after + 1]);
            let mut here = self.between_pair(judge, after, pair, stability);
            // In the order of the branch.
            let metric = Metric { size: pair.0.metric.0, span: pair.0.metric.1 };
            let along = |special: &Special| {
                let u = refit(&special.sample.set, &pair.0.set, 1, &special.sample.u);
                let d: Vec<f64> = u.iter().zip(&pair.0.u).map(|(a, b)| a - b).collect();
                metric.dot((&d, special.sample.p - pair.0.p), (&pair.0.tangent, pair.0.tangent_p))
            };
            here.sort_by(|a, b| along(a).total_cmp(&along(b)));
            found.append(&mut here);
        }
        found
    }

    /// The folds of a branch alone.
    pub(super) fn folds(&mut self, judge: &mut Judge, samples: &[Sample]) -> Vec<Special> {
        let mut found = Vec::new();
        for (after, pair) in samples.windows(2).enumerate() {
            if pair[0].tangent_p * pair[1].tangent_p >= 0.0 {
                continue;
            }
            let Some((sample, precision)) =
                self.locate(judge, &Test::Fold, (&pair[0], &pair[1]), None)
            else {
                continue;
            };
            found.push(Special {
                kind: SpecialKind::Fold,
                after,
                sample,
                stability: None,
                precision,
                located: true,
                change: None,
                note: None,
                touch: None,
            });
        }
        found
    }

    fn between_pair(
        &mut self,
        judge: &mut Judge,
        after: usize,
        (from, to): (&Sample, &Sample),
        (before, behind): (&Stability, &Stability),
    ) -> Vec<Special> {
        let mut wanted: Vec<(SpecialKind, Test<'_>)> = Vec::new();
        let fold = from.tangent_p * to.tangent_p < 0.0;
        let crossed = from.orientation * to.orientation < 0.0;
        if fold {
            wanted.push((SpecialKind::Fold, Test::Fold));
        }
        let changes = crossings(before, behind);
        let mirrored = !before.half.is_empty();
        for crossing in &changes {
            match crossing {
                Crossing::MinusOne => {
                    wanted.push((SpecialKind::PeriodDoubling, Test::Crossing(*crossing)));
                }
                Crossing::Pair => {
                    wanted.push((SpecialKind::NeimarkSacker, Test::Crossing(*crossing)));
                }
                // Without the mirror symmetry a multiplier passes 1 at every fold.
                Crossing::One if mirrored => {
                    wanted.push((SpecialKind::BranchPoint, Test::Crossing(*crossing)));
                }
                Crossing::One => {}
            }
        }
        if crossed {
            wanted.push((SpecialKind::BranchPoint, Test::Orientation));
        }
        let change = i32::try_from(behind.unstable).unwrap_or(0)
            - i32::try_from(before.unstable).unwrap_or(0);
        let alone = wanted.len() == 1;
        let mut specials = self.grazing(judge, after, (from, to));
        if specials.len() == 1 && wanted.is_empty() {
            specials[0].change = Some(change);
        }
        for (kind, what) in wanted {
            let place = self.locate(judge, &what, (from, to), Some((before, behind)));
            if place.is_none()
                && let Test::Crossing(crossing) = what
                && may_be_a_meeting(before, behind, crossing)
            {
                continue;
            }
            let located = place.is_some();
            let (sample, precision) = place.unwrap_or_else(|| (from.clone(), f64::NAN));
            let stability = self.judge(judge, &sample).ok();
            specials.push(Special {
                kind,
                after,
                sample,
                stability,
                precision,
                located,
                change: alone.then_some(change),
                note: None,
                touch: None,
            });
        }
        specials
    }

    /// Whether special points of these curves are left to shooting: the excitation speed runs over a
    /// line with kinks.
    pub(super) fn shoots(&self) -> bool {
        matches!(self.problem.axis, Axis::Frequency)
            && self.problem.place.drive == 1.0
            && self.problem.system.line.has_kinks()
    }

    /// Where a twist begins or ceases to touch a switching twist between two samples.
    fn grazing(
        &mut self,
        judge: &mut Judge,
        after: usize,
        (from, to): (&Sample, &Sample),
    ) -> Vec<Special> {
        if matches!(self.problem.axis, Axis::Parameter(_)) {
            return Vec::new();
        }
        let touched = touches(&self.problem.system.line, from, to);
        if touched.is_empty() {
            return Vec::new();
        }
        let line = self.problem.system.line.clone();
        let mut specials = Vec::new();
        for touch in touched {
            let beyond = |sample: &Sample| touch.beyond(&line, sample);
            let place = self.locate(judge, &Test::Value(&beyond), (from, to), None);
            let Some((sample, precision)) = place else { continue };
            let stability = self.judge(judge, &sample).ok();
            specials.push(Special {
                kind: SpecialKind::GrazingContact,
                after,
                note: Some(touch.words(&line, &sample)),
                sample,
                stability,
                precision,
                located: true,
                change: None,
                touch: Some(touch),
            });
        }
        specials
    }
}
