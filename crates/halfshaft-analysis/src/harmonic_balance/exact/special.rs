//! Special points between two orbits of a branch, located to rounding.

use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_results::SpecialKind;

use super::super::stability::{
    Crossing, counted, crosses, crossings, halved, may_be_a_meeting, test,
};
use super::curve::Curve;
use super::point::Point;
use super::touch::{Touch, touches};

/// A special point between point `after` and the next.
#[derive(Clone, Debug)]
pub(super) struct ExactSpecial {
    pub(super) kind: SpecialKind,
    pub(super) after: usize,
    pub(super) point: Point,
    /// Relative change of the parameter that the search left open.
    pub(super) precision: f64,
    pub(super) located: bool,
    /// Change of the unstable dimension.
    pub(super) change: Option<i32>,
    pub(super) note: Option<String>,
}

/// What is zero at a special point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Test {
    Fold,
    Crossing(Crossing),
    /// The branch's orientation, which only has a sign.
    Orientation,
    Touch(Touch),
}

/// Part of the distance of two orbits to which a place is found.
const FINE: f64 = 1e-14;

impl Test {
    fn value(self, point: &Point) -> f64 {
        match self {
            Self::Fold => point.tangent_p,
            Self::Orientation => point.orientation,
            Self::Touch(touch) => touch.beyond(&point.turns),
            Self::Crossing(crossing) => test(&point.stability, crossing),
        }
    }

    /// What tells the sides apart where the value is undefined on one of them.
    fn side(self, point: &Point) -> Option<usize> {
        match self {
            Self::Crossing(crossing) => Some(counted(&point.stability, crossing)),
            _ => None,
        }
    }

    /// Whether the test is truly zero.
    fn is_zero(self, point: &Point) -> bool {
        let Self::Crossing(crossing) = self else { return true };
        crosses(&point.stability, crossing)
    }
}

impl Curve<'_, '_> {
    /// Special points of a branch, in its order.
    pub(super) fn specials(&mut self, points: &[Point], grazing: bool) -> Vec<ExactSpecial> {
        let mut found = Vec::new();
        for after in 0..points.len().saturating_sub(1) {
            let (from, to) = (&points[after], &points[after + 1]);
            if from.p() == to.p() && from.state() == to.state() {
                continue;
            }
            let mut here = self.between_pair(after, (from, to), grazing);
            let metric = self.metric(from.size);
            let along = |special: &ExactSpecial| {
                let (d, d_p, _) = metric.step(from, &special.point);
                metric.dot((&d, d_p), (&from.tangent, from.tangent_p))
            };
            here.sort_by(|a, b| along(a).total_cmp(&along(b)));
            found.append(&mut here);
        }
        found
    }

    fn between_pair(
        &mut self,
        after: usize,
        (from, to): (&Point, &Point),
        grazing: bool,
    ) -> Vec<ExactSpecial> {
        let wanted = wanted(from, to);
        let unstable = |point: &Point| i32::try_from(point.stability.unstable).unwrap_or(0);
        let change = unstable(to) - unstable(from);
        let alone = wanted.len() == 1;
        let mut specials = Vec::new();
        if grazing {
            let equations = self.shooter.equations();
            for touch in touches(equations, self.kind.mirrored, &from.turns, &to.turns) {
                let Some(place) = self.locate(Test::Touch(touch), from, to) else { continue };
                let note = Some(touch.words(equations, &place.0.turns));
                let change = wanted.is_empty().then_some(change);
                let kind = SpecialKind::GrazingContact;
                specials.push(special(kind, after, from, Some(place), change, note));
            }
        }
        for (kind, what) in wanted {
            let place = self.locate(what, from, to);
            if place.is_none()
                && let Test::Crossing(crossing) = what
                && may_be_a_meeting(&from.stability, &to.stability, crossing)
            {
                continue;
            }
            specials.push(special(kind, after, from, place, alone.then_some(change), None));
        }
        specials
    }

    /// The zero of a test between two points, and how well its parameter is known, relative.
    fn locate(&mut self, what: Test, from: &Point, to: &Point) -> Option<(Point, f64)> {
        let sides = (what.side(from), what.side(to));
        let values = (what.value(from), what.value(to));
        let (low, high) = halved((0.0, 1.0), values, sides, |part| {
            let point = self.point_between(from, to, part).ok()?;
            Some((what.value(&point), what.side(&point)))
        })?;
        let settings = RootSettings {
            absolute_tolerance: FINE.max(self.limits.enough * self.limits.enough),
            relative_tolerance: 0.0,
            ..RootSettings::default()
        };
        self.shooter.set_enough(0.0);
        let mut last: Option<(f64, f64)> = None;
        let mut nearest: Option<(f64, f64)> = None;
        let root = find_root(
            |part| {
                let point = match part {
                    0.0 => Ok(from.clone()),
                    1.0 => Ok(to.clone()),
                    _ => self.point_between(from, to, part),
                };
                let Ok(point) = point else { return f64::NAN };
                nearest = last.replace((part, point.p()));
                what.value(&point)
            },
            low,
            high,
            settings,
        );
        let point = root.ok().and_then(|root| self.point_between(from, to, root.value).ok());
        self.shooter.set_enough(self.limits.enough);
        let point = point?;
        // What the last two places differ by, at the rate at which the parameter changes there.
        let left = nearest.map_or(f64::NAN, |(_, p)| (p - point.p()).abs() / point.p().abs());
        let precision = left.min((to.p() - from.p()).abs() / point.p().abs()).max(f64::EPSILON);
        what.is_zero(&point).then_some((point, precision))
    }
}

/// What changes between two points, apart from what touches.
fn wanted(from: &Point, to: &Point) -> Vec<(SpecialKind, Test)> {
    let mut wanted = Vec::new();
    if from.tangent_p * to.tangent_p < 0.0 {
        wanted.push((SpecialKind::Fold, Test::Fold));
    }
    let mirrored = !from.stability.half.is_empty();
    for crossing in crossings(&from.stability, &to.stability) {
        let kind = match crossing {
            Crossing::MinusOne => SpecialKind::PeriodDoubling,
            Crossing::Pair => SpecialKind::NeimarkSacker,
            // Without the mirror symmetry a multiplier passes 1 at every fold.
            Crossing::One if mirrored => SpecialKind::BranchPoint,
            Crossing::One => continue,
        };
        wanted.push((kind, Test::Crossing(crossing)));
    }
    if from.orientation * to.orientation < 0.0 {
        let known = wanted.iter().any(|(kind, _)| *kind == SpecialKind::BranchPoint);
        if !known {
            wanted.push((SpecialKind::BranchPoint, Test::Orientation));
        }
    }
    wanted
}

fn special(
    kind: SpecialKind,
    after: usize,
    from: &Point,
    place: Option<(Point, f64)>,
    change: Option<i32>,
    note: Option<String>,
) -> ExactSpecial {
    let located = place.is_some();
    let (point, precision) = place.unwrap_or_else(|| (from.clone(), f64::NAN));
    ExactSpecial { kind, after, point, precision, located, change, note }
}
