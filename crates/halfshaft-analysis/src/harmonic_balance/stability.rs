//! Stability of responses: multipliers, unstable dimension, and which kind of multiplier crosses.

use halfshaft_model::question::StabilityMethod;
use halfshaft_numerics::Complex;

use super::monodromy::{Orbit, Variational};
use super::problem::Failure;
use super::system::{HarmonicSystem, Place};

/// Multipliers of a response.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stability {
    /// The multipliers over one period, largest modulus first.
    pub(crate) multipliers: Vec<Complex>,
    /// The same over half a period where the response mirrors itself then, in the same order: a
    /// fold has -1 there, a loss of the mirror symmetry +1.
    pub(crate) half: Vec<Complex>,
    pub(crate) unstable: usize,
    /// Error of the multipliers by rounding: what the largest of them leaves to the others.
    rounding: f64,
}

/// A multiplier beyond one by less than this is rounding.
pub(crate) const NEUTRAL: f64 = 1e-9;
/// Rounding of a matrix of multipliers, relative to the largest.
const ROUNDING: f64 = 3e-14;

impl Stability {
    /// The stability of a response with the given multipliers, which are those of half a period where
    /// it is mirrored then.
    pub(crate) fn of(raw: Vec<Complex>, mirrored: bool) -> Self {
        let squares = |m: &Complex| *m * *m;
        let largest = raw.iter().map(|m| m.modulus()).fold(0.0, f64::max);
        let rounding = ROUNDING * largest * if mirrored { 2.0 } else { 1.0 };
        let rounding = if rounding.is_finite() { rounding } else { 0.0 };
        let (multipliers, half): (Vec<Complex>, Vec<Complex>) =
            if mirrored { (raw.iter().map(squares).collect(), raw) } else { (raw, Vec::new()) };
        let mut stability = Self { multipliers, half, unstable: 0, rounding };
        let outside = stability.multipliers.iter().filter(|m| stability.is_outside(**m)).count();
        stability.unstable = outside;
        stability
    }

    /// Whether a multiplier lies outside of the unit circle beyond rounding.
    fn is_outside(&self, multiplier: Complex) -> bool {
        multiplier.modulus() > 1.0 + NEUTRAL + self.rounding
    }

    pub(crate) fn is_stable(&self) -> bool {
        self.unstable == 0 && self.is_known()
    }

    /// Whether the multipliers were found.
    pub(crate) fn is_known(&self) -> bool {
        !self.multipliers.is_empty()
    }

    /// Modulus of the largest multiplier; NaN where none was found.
    pub(crate) fn largest(&self) -> f64 {
        self.multipliers.first().map_or(f64::NAN, |m| m.modulus())
    }
}

/// How a multiplier meets the unit circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Crossing {
    /// At +1, other than at a fold.
    One,
    /// At -1.
    MinusOne,
    /// As a complex pair.
    Pair,
}

/// Finds multipliers of responses of one line.
pub(super) struct Judge {
    variational: Variational,
    method: StabilityMethod,
}

impl Judge {
    pub(super) fn new(system: &HarmonicSystem, method: StabilityMethod) -> Self {
        let line = &system.line;
        let variational = Variational::new(&line.equations, &line.skeleton.nonlinear);
        Self { variational, method }
    }

    /// How it finds them.
    pub(super) fn method(&self) -> StabilityMethod {
        self.method
    }

    /// The stability of a response.
    pub(super) fn stability(
        &mut self,
        system: &HarmonicSystem,
        u: &[f64],
        place: Place,
    ) -> Result<Stability, Failure> {
        let twists = twists(system, u);
        let speed = system.fundamental(place);
        let orbit = Orbit { set: &system.set, speed, twists: &twists };
        let equations = &system.line.equations;
        if self.method == StabilityMethod::Monodromy {
            match self.variational.multipliers(equations, &orbit) {
                Ok(raw) => return Ok(Stability::of(raw, system.set.is_odd())),
                // A line too stiff to be integrated stays so: Hill's method does not integrate.
                Err(_) => self.method = StabilityMethod::Hill,
            }
        }
        let raw = match super::hill::multipliers(equations, &orbit) {
            Ok(raw) => raw,
            // Hill's method does not converge where kinks leave too many harmonics.
            Err(_) => self
                .variational
                .multipliers(equations, &orbit)
                .map_err(|_| Failure::NotConverged)?,
        };
        Ok(Stability::of(raw, system.set.is_odd()))
    }

    /// The stability of many responses over the harmonics of `system`, `None` for those to be found one
    /// by one; `None` where that is all of them.
    pub(super) fn stabilities(
        &self,
        system: &HarmonicSystem,
        responses: &[(&[f64], Place)],
    ) -> Option<Vec<Option<Stability>>> {
        if self.method != StabilityMethod::Monodromy {
            return None;
        }
        let list: Vec<_> = responses.iter().map(|(u, _)| twists(system, u)).collect();
        let mut orbits = Vec::with_capacity(list.len());
        for ((_, place), twists) in responses.iter().zip(&list) {
            orbits.push(Orbit { set: &system.set, speed: system.fundamental(*place), twists });
        }
        let all = self.variational.multipliers_of_all(&system.line.equations, &orbits)?;
        let of = |raw| Stability::of(raw, system.set.is_odd());
        Some(all.into_iter().map(|raw| raw.map(of)).collect())
    }
}

/// Coefficients of the twist of each nonlinear connection at a response.
fn twists(system: &HarmonicSystem, u: &[f64]) -> Vec<(usize, Vec<f64>)> {
    let of = |(index, twist): (usize, &super::line::NonlinearTwist)| {
        let mut coefficients = vec![0.0; system.set.coefficients()];
        system.twist(index, u, &mut coefficients);
        (twist.connection, coefficients)
    };
    system.line.twists.iter().enumerate().map(of).collect()
}

/// A number that passes through zero where a multiplier crosses the unit circle in the given way;
/// NaN where no multiplier of that kind is there.
pub(super) fn test(stability: &Stability, crossing: Crossing) -> f64 {
    let real = |m: &&Complex| m.im == 0.0;
    match crossing {
        Crossing::One => {
            let list =
                if stability.half.is_empty() { &stability.multipliers } else { &stability.half };
            nearest(list.iter().filter(real).map(|m| m.re - 1.0))
        }
        Crossing::MinusOne => {
            -nearest(stability.multipliers.iter().filter(real).map(|m| m.re + 1.0))
        }
        Crossing::Pair => {
            let pairs = stability.multipliers.iter().filter(|m| m.im > 0.0);
            nearest(pairs.map(|m| m.modulus() - 1.0))
        }
    }
}

fn nearest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(
        f64::NAN,
        |best, value| if value.abs() < best.abs() || best.is_nan() { value } else { best },
    )
}

/// The complex multiplier nearest to the unit circle, its angle in radians.
pub(super) fn pair_angle(stability: &Stability) -> f64 {
    let pairs = stability.multipliers.iter().filter(|m| m.im > 0.0);
    pairs
        .min_by(|a, b| (a.modulus() - 1.0).abs().total_cmp(&(b.modulus() - 1.0).abs()))
        .map_or(f64::NAN, |m| m.argument())
}

/// A pair of multipliers nearer to the real axis than this is none, rad.
const LEAST_ANGLE: f64 = 1e-5;

/// Whether a test is truly zero at a response: where multipliers meet on the real axis, away from the
/// unit circle, it may change its sign by a jump.
pub(super) fn crosses(stability: &Stability, crossing: Crossing) -> bool {
    let turned = crossing != Crossing::Pair || pair_angle(stability).sin().abs() > LEAST_ANGLE;
    test(stability, crossing).abs() < 1e-6 && turned
}

/// Halvings until a test has opposite signs at both ends.
const MOST_HALVINGS: usize = 40;

/// A bracket within another at whose ends a test has opposite signs. A test may be undefined at one end;
/// what counts then is on which side it is: `sides` of both ends, and `at` gives value and side at a part
/// of the way.
pub(super) fn halved(
    (mut low, mut high): (f64, f64),
    (mut at_low, mut at_high): (f64, f64),
    sides: (Option<usize>, Option<usize>),
    mut at: impl FnMut(f64) -> Option<(f64, Option<usize>)>,
) -> Option<(f64, f64)> {
    for _ in 0..MOST_HALVINGS {
        if at_low * at_high <= 0.0 {
            break;
        }
        if sides.0 == sides.1 {
            return None;
        }
        let middle = f64::midpoint(low, high);
        let (value, side) = at(middle)?;
        if side == sides.0 {
            (low, at_low) = (middle, value);
        } else {
            (high, at_high) = (middle, value);
        }
    }
    (at_low * at_high <= 0.0).then_some((low, high))
}

/// The ways in which the unstable dimension may have changed between two responses.
pub(super) fn crossings(before: &Stability, after: &Stability) -> Vec<Crossing> {
    let moved = |crossing| counted(before, crossing) != counted(after, crossing);
    let apart = |crossing| counted(before, crossing).abs_diff(counted(after, crossing));
    let even = |crossing| apart(crossing).is_multiple_of(2);
    // Pairs that became real outside of the circle, or real ones that became a pair, cross nothing.
    if before.unstable == after.unstable && even(Crossing::One) && even(Crossing::MinusOne) {
        return Vec::new();
    }
    let mut all = vec![Crossing::One, Crossing::MinusOne, Crossing::Pair];
    all.retain(|crossing| moved(*crossing));
    all
}

/// Whether a crossing that was not found may have been two multipliers meeting outside of the circle.
pub(super) fn may_be_a_meeting(before: &Stability, after: &Stability, crossing: Crossing) -> bool {
    let moved = counted(before, crossing).abs_diff(counted(after, crossing));
    let change = before.unstable.abs_diff(after.unstable);
    match crossing {
        Crossing::Pair => change != 2,
        Crossing::MinusOne | Crossing::One => moved.is_multiple_of(2),
    }
}

/// How many multipliers lie outside on the side of a crossing.
pub(super) fn counted(stability: &Stability, crossing: Crossing) -> usize {
    let outside = |m: &&Complex| stability.is_outside(**m);
    match crossing {
        Crossing::One => {
            let list =
                if stability.half.is_empty() { &stability.multipliers } else { &stability.half };
            list.iter().filter(outside).filter(|m| m.im == 0.0 && m.re > 0.0).count()
        }
        Crossing::MinusOne => {
            let real = |m: &&Complex| m.im == 0.0 && m.re < 0.0;
            stability.multipliers.iter().filter(outside).filter(real).count()
        }
        Crossing::Pair => {
            stability.multipliers.iter().filter(outside).filter(|m| m.im > 0.0).count()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stability(list: &[(f64, f64)]) -> Stability {
        Stability::of(list.iter().map(|(re, im)| Complex::new(*re, *im)).collect(), false)
    }

    // Source: by hand. What crosses the circle, and what only meets outside of it.
    #[test]
    fn meetings_outside_of_the_circle_cross_nothing() {
        let pair = stability(&[(-3.0, 1.0), (-3.0, -1.0), (0.1, 0.0)]);
        let two = stability(&[(-4.0, 0.0), (-2.5, 0.0), (0.1, 0.0)]);
        assert!(crossings(&pair, &two).is_empty() && crossings(&two, &pair).is_empty());
        let inside = stability(&[(-0.9, 0.0), (0.1, 0.0), (0.05, 0.0)]);
        let doubled = stability(&[(-1.1, 0.0), (0.1, 0.0), (0.05, 0.0)]);
        assert_eq!(crossings(&inside, &doubled), [Crossing::MinusOne]);
        assert!(!may_be_a_meeting(&inside, &doubled, Crossing::MinusOne));
        let torus = stability(&[(0.2, 1.0), (0.2, -1.0), (0.05, 0.0)]);
        assert_eq!(crossings(&inside, &torus), [Crossing::Pair]);
        assert!(!may_be_a_meeting(&inside, &torus, Crossing::Pair));
        // One left through -1 while a pair outside became real.
        let three = stability(&[(-4.0, 0.0), (-2.5, 0.0), (-1.2, 0.0)]);
        assert!(crossings(&pair, &three).contains(&Crossing::MinusOne));
    }

    // Source: the product of a matrix of two digits apart: 1e20 and 0.5 leave rounding of 1e4 beside it.
    #[test]
    fn what_the_largest_multiplier_leaves_to_the_others_counts_for_nothing() {
        let sharp = stability(&[(1e20, 0.0), (-3e4, 0.0), (2e3, 0.0)]);
        assert_eq!((sharp.unstable, counted(&sharp, Crossing::MinusOne)), (1, 0));
        let mild = stability(&[(1e6, 0.0), (-1.5, 0.0), (0.3, 0.0)]);
        assert_eq!((mild.unstable, counted(&mild, Crossing::MinusOne)), (2, 1));
        let beyond = stability(&[(f64::INFINITY, 0.0), (2.0, 0.0)]);
        assert!(!beyond.is_stable());
    }
}
