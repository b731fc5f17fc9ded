//! The linear rest of a line, whether a tree or with loops.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;

use super::drive::Drive;
use super::jet::{Jet, Scalar};
use super::limbs::{Gathered, Limbs, Seen};
use super::meshed::Meshed;
use crate::equilibrium::RunningState;

/// The linear rest of a line.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Rest {
    /// Without loops: work in proportion to the number of groups.
    Tree(Limbs),
    /// With loops: dense elimination.
    Meshed(Meshed),
}

/// Statics of the shaft: `T + parallel · x = asked`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Statics {
    /// Stiffness of the rest in parallel, N·m/rad: zero unless the shaft closes a loop.
    pub(super) parallel: f64,
    /// Torque asked of both together at zero twist, N·m.
    pub(super) asked: f64,
}

impl Rest {
    /// The rest of a line without the connection `shaft`.
    pub(super) fn new(equations: &EquationsOfMotion, shaft: usize) -> Self {
        Limbs::new(equations, shaft)
            .map_or_else(|| Self::Meshed(Meshed::new(equations, shaft)), Self::Tree)
    }

    /// What the shaft sees at circular frequency `nu`, with derivatives; `None` at a resonance that
    /// moves the line but not the shaft, without any damping.
    pub(super) fn jet(
        &self,
        nu: f64,
        drive: &Drive,
        work: &mut Gathered<Jet>,
    ) -> Option<Seen<Jet>> {
        let seen = match self {
            Self::Tree(limbs) => limbs.seen(nu, drive, work),
            Self::Meshed(meshed) => meshed.seen(nu, drive)?,
        };
        seen.is_finite().then_some(seen)
    }

    /// The same without derivatives.
    pub(super) fn value(
        &self,
        nu: f64,
        drive: &Drive,
        work: &mut Gathered<Complex>,
    ) -> Option<Seen<Complex>> {
        let seen = match self {
            Self::Tree(limbs) => limbs.seen(nu, drive, work),
            Self::Meshed(meshed) => {
                let Seen { alpha, beta, gamma } = meshed.seen(nu, drive)?;
                Seen { alpha: alpha.value, beta: beta.value, gamma: gamma.value }
            }
        };
        seen.is_finite().then_some(seen)
    }

    /// Complex amplitudes of all groups for the twist `x` of the shaft and its torque `torque`.
    pub(super) fn motion(
        &self,
        nu: f64,
        drive: &Drive,
        x: Complex,
        torque: Complex,
    ) -> Option<Vec<Complex>> {
        match self {
            Self::Tree(limbs) => {
                let mut work = Gathered::default();
                limbs.gather(nu, drive, &mut work);
                Some(limbs.motion(nu, &work, x, torque))
            }
            Self::Meshed(meshed) => meshed.motion(nu, drive, x, torque),
        }
    }

    /// The same rest without damping.
    pub(super) fn undamped(&self) -> Self {
        match self {
            Self::Tree(limbs) => Self::Tree(limbs.undamped()),
            Self::Meshed(meshed) => Self::Meshed(meshed.undamped()),
        }
    }

    /// Statics of the shaft under torques on the groups; `None` where there are none.
    pub(super) fn statics(&self, forces: &[f64]) -> Option<Statics> {
        match self {
            Self::Tree(limbs) => Some(tree_statics(limbs, forces)),
            Self::Meshed(meshed) => {
                let (parallel, asked) = meshed.statics(forces)?;
                Some(Statics { parallel, asked })
            }
        }
    }

    /// Angles at rest for the mean twist `x` of the shaft and its mean torque `torque`; those of a
    /// free line up to a turn of the whole.
    pub(super) fn angles_at_rest(&self, forces: &[f64], x: f64, torque: f64) -> Option<Vec<f64>> {
        match self {
            Self::Tree(limbs) => {
                let rest = limbs.at_rest();
                let gathered = gathered_at_rest(&rest, forces);
                let (x, torque) = (Complex::from(x), Complex::from(torque));
                let angles = rest.motion(0.0, &gathered, x, torque);
                // What is free to turn has no angle of its own.
                let angle = |z: &Complex| if z.re.is_finite() { z.re } else { 0.0 };
                Some(angles.iter().map(angle).collect())
            }
            Self::Meshed(meshed) => meshed.angles_at_rest(forces, x, torque),
        }
    }
}

/// Mean torques on the groups that the shafts carry, those of preloads in linear shafts included,
/// N·m.
pub(super) fn mean_forces(equations: &EquationsOfMotion, shaft: usize) -> Vec<f64> {
    let mut forces = RunningState::of(equations).forces;
    for (index, connection) in equations.connections.iter().enumerate() {
        if index != shaft {
            equations.add_direction(index, -connection.law.torque(0.0), &mut forces);
        }
    }
    forces
}

fn gathered_at_rest(rest: &Limbs, forces: &[f64]) -> Gathered<Complex> {
    let torque = forces.iter().map(|force| Complex::from(*force)).collect();
    let mut gathered = Gathered { stiffness: Vec::new(), torque };
    rest.take_in(0.0, &mut gathered);
    gathered
}

fn tree_statics(limbs: &Limbs, forces: &[f64]) -> Statics {
    let rest = limbs.at_rest();
    let gathered = gathered_at_rest(&rest, forces);
    let side = |(group, ratio): (usize, f64)| {
        (gathered.stiffness[group].re, gathered.torque[group].re, ratio)
    };
    // Springs in series are summed without subtraction, so a side that is free to turn has a
    // stiffness of exactly zero, and what it is loaded with passes through the shaft.
    let free = |(stiffness, torque, ratio): (f64, f64, f64), sign: f64| {
        let asked = sign * torque / ratio;
        (stiffness == 0.0).then_some(Statics { parallel: 0.0, asked })
    };
    let [p, q] = limbs.ends.map(|end| end.map(side));
    if let Some(statics) = p.and_then(|p| free(p, 1.0)).or_else(|| q.and_then(|q| free(q, -1.0))) {
        return statics;
    }
    let compliance = |end: Option<(f64, f64, f64)>| end.map_or(0.0, |(s, _, r)| r * r / s);
    let twist = |end: Option<(f64, f64, f64)>| end.map_or(0.0, |(s, t, r)| r * t / s);
    let parallel = 1.0 / (compliance(p) + compliance(q));
    Statics { parallel, asked: (twist(p) - twist(q)) * parallel }
}

impl<S: Scalar> Seen<S> {
    fn is_finite(&self) -> bool {
        let finite = |z: Complex| z.re.is_finite() && z.im.is_finite();
        [self.alpha, self.beta, self.gamma].into_iter().all(|part| finite(part.value()))
    }
}
