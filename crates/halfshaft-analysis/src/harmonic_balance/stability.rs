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
}

/// A multiplier beyond one by less than this is rounding.
pub(crate) const NEUTRAL: f64 = 1e-9;

impl Stability {
    /// The stability of a response with the given multipliers, which are those of half a period where
    /// it is mirrored then.
    pub(crate) fn of(raw: Vec<Complex>, mirrored: bool) -> Self {
        let squares = |m: &Complex| *m * *m;
        let (multipliers, half): (Vec<Complex>, Vec<Complex>) =
            if mirrored { (raw.iter().map(squares).collect(), raw) } else { (raw, Vec::new()) };
        let unstable = multipliers.iter().filter(|m| m.modulus() > 1.0 + NEUTRAL).count();
        Self { multipliers, half, unstable }
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
        let m = system.set.coefficients();
        let twists: Vec<(usize, Vec<f64>)> = (0..system.line.twists.len())
            .map(|index| {
                let mut twist = vec![0.0; m];
                system.twist(index, u, &mut twist);
                (system.line.twists[index].connection, twist)
            })
            .collect();
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

/// The ways in which the unstable dimension may have changed between two responses.
pub(super) fn crossings(before: &Stability, after: &Stability) -> Vec<Crossing> {
    [Crossing::One, Crossing::MinusOne, Crossing::Pair]
        .into_iter()
        .filter(|crossing| {
            let count = |s: &Stability| counted(s, *crossing);
            count(before) != count(after)
        })
        .collect()
}

/// How many multipliers lie outside on the side of a crossing.
pub(super) fn counted(stability: &Stability, crossing: Crossing) -> usize {
    let outside = |m: &&Complex| m.modulus() > 1.0 + NEUTRAL;
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
