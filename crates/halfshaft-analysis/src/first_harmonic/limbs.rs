//! The linear rest of a line as seen from the nonlinear shaft, limb by limb.
//!
//! Without the shaft the groups fall into trees: one hangs at each of its ends (where that is not
//! ground), and others may stand apart between shafts to ground. A shaft to ground is no limb but
//! adds to the stiffness of its group. From the tips inwards each limb is replaced by the dynamic
//! stiffness and torque that its parent feels:
//!
//! ```text
//! S_p ← S_p + r_p² s S_c / (s r_c² + S_c)         (springs in series: nothing is subtracted)
//! Q_p ← Q_p + r_p r_c s Q_c / (s r_c² + S_c)      s = k + i ν c
//! ```
//!
//! so that the work and the rounding stay in proportion to the number of groups.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::End;
use halfshaft_numerics::Complex;

use super::drive::Drive;
use super::jet::Scalar;

/// A shaft of the rest between a group and the one nearer to the root of its tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limb {
    pub(super) child: (usize, f64),
    pub(super) parent: (usize, f64),
    pub(super) stiffness: f64,
    pub(super) damping: f64,
}

/// The linear rest of a line, cut into trees.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Limbs {
    /// Tips first.
    pub(super) limbs: Vec<Limb>,
    /// Inertia, damping and stiffness to ground of each group.
    inertia: Vec<f64>,
    ground_damping: Vec<f64>,
    ground_stiffness: Vec<f64>,
    /// Ends of the nonlinear shaft.
    pub(super) ends: [End; 2],
    /// Roots of trees that the shaft does not touch.
    pub(super) apart: Vec<usize>,
}

/// What the shaft sees of the rest: `(α + β N) X = γ` for the complex stiffness `N` of the shaft
/// between the ends and its twist `X`. Scaled so that `β` is of the size of one; without poles,
/// whatever the frequency.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Seen<S> {
    pub(super) alpha: S,
    pub(super) beta: S,
    pub(super) gamma: S,
}

/// Dynamic stiffness and torque of each group with all limbs beyond it taken in.
#[derive(Clone, Debug, Default)]
pub(super) struct Gathered<S> {
    pub(super) stiffness: Vec<S>,
    pub(super) torque: Vec<S>,
}

impl Limbs {
    /// The rest without the connection `shaft`, all other connections with their stiffness at zero
    /// twist; `None` where loops of shafts are left.
    pub(super) fn new(equations: &EquationsOfMotion, shaft: usize) -> Option<Self> {
        let groups = equations.groups();
        let mut at: Vec<Vec<usize>> = vec![Vec::new(); groups];
        let mut ground_stiffness = vec![0.0; groups];
        let mut ground_damping = equations.ground_damping.clone();
        for (index, connection) in equations.connections.iter().enumerate() {
            if index == shaft {
                continue;
            }
            match (connection.from, connection.to) {
                (Some((from, _)), Some((to, _))) => {
                    at[from].push(index);
                    at[to].push(index);
                }
                (Some((group, ratio)), None) | (None, Some((group, ratio))) => {
                    ground_stiffness[group] += ratio * ratio * connection.law.stiffness(0.0);
                    ground_damping[group] += ratio * ratio * connection.damping;
                }
                (None, None) => {}
            }
        }
        let own = &equations.connections[shaft];
        let ends = [own.from, own.to];
        let mut search = Search {
            equations,
            at,
            reached: vec![false; groups],
            walked: vec![false; equations.connections.len()],
            limbs: Vec::new(),
        };
        for (group, _) in ends.into_iter().flatten() {
            if search.reached[group] || !search.spread(group) {
                return None;
            }
        }
        let mut apart = Vec::new();
        for group in 0..groups {
            if !search.reached[group] {
                apart.push(group);
                if !search.spread(group) {
                    return None;
                }
            }
        }
        let mut limbs = search.limbs;
        limbs.reverse();
        let inertia = equations.inertia.clone();
        Some(Self { limbs, inertia, ground_damping, ground_stiffness, ends, apart })
    }

    /// Number of groups.
    pub(super) fn groups(&self) -> usize {
        self.inertia.len()
    }

    /// Takes in all limbs at circular frequency `nu` under the given drive.
    pub(super) fn gather<S: Scalar>(&self, nu: f64, drive: &Drive, into: &mut Gathered<S>) {
        into.torque.clear();
        into.torque.resize(self.groups(), S::default());
        drive.add_to(nu, &mut into.torque);
        self.take_in(nu, into);
    }

    /// Takes in all limbs under the torques on the groups that `into` holds.
    pub(super) fn take_in<S: Scalar>(&self, nu: f64, into: &mut Gathered<S>) {
        let real = Complex::from;
        into.stiffness.clear();
        let own = self.inertia.iter().zip(&self.ground_damping).zip(&self.ground_stiffness);
        into.stiffness.extend(own.map(|((m, c), k)| {
            let value = Complex::new(k - nu * nu * m, nu * c);
            S::of(value, Complex::new(-2.0 * nu * m, *c), real(-2.0 * m))
        }));
        for limb in &self.limbs {
            let ((child, own), (parent, lever)) = (limb.child, limb.parent);
            let Some((spring, pivot)) = limb.spring(nu, into.stiffness[child]) else { continue };
            let (share, lever) = (spring / pivot, lever / own);
            into.stiffness[parent] =
                into.stiffness[parent] + (share * into.stiffness[child]).times(lever * lever);
            into.torque[parent] = into.torque[parent] + (share * into.torque[child]).times(lever);
        }
    }

    /// What the nonlinear shaft sees at circular frequency `nu`.
    pub(super) fn seen<S: Scalar>(
        &self,
        nu: f64,
        drive: &Drive,
        gathered: &mut Gathered<S>,
    ) -> Seen<S> {
        self.gather(nu, drive, gathered);
        let one = S::of(Complex::from(1.0), Complex::default(), Complex::default());
        let at = |(group, ratio): (usize, f64)| {
            (gathered.stiffness[group], gathered.torque[group], ratio)
        };
        let seen = match self.ends.map(|end| end.map(at)) {
            [Some((s_p, q_p, r_p)), Some((s_q, q_q, r_q))] => Seen {
                alpha: s_p * s_q,
                beta: s_q.times(r_p * r_p) + s_p.times(r_q * r_q),
                gamma: (q_p * s_q).times(r_p) - (q_q * s_p).times(r_q),
            },
            [Some((s, q, r)), None] => Seen { alpha: s, beta: one.times(r * r), gamma: q.times(r) },
            [None, Some((s, q, r))] => {
                Seen { alpha: s, beta: one.times(r * r), gamma: q.times(-r) }
            }
            [None, None] => Seen { alpha: one, beta: S::default(), gamma: S::default() },
        };
        seen.scaled(self.size(gathered))
    }

    /// Size of `β`.
    fn size<S: Scalar>(&self, gathered: &Gathered<S>) -> f64 {
        let at = |(group, ratio): (usize, f64)| (gathered.stiffness[group].value(), ratio);
        match self.ends.map(|end| end.map(at)) {
            [Some((s_p, r_p)), Some((s_q, r_q))] => {
                r_p * r_p * s_q.modulus() + r_q * r_q * s_p.modulus()
            }
            [Some((_, r)), None] | [None, Some((_, r))] => r * r,
            [None, None] => 1.0,
        }
    }

    /// Complex amplitudes of all groups for the twist `x` of the shaft and its torque `torque`.
    pub(super) fn motion(
        &self,
        nu: f64,
        gathered: &Gathered<Complex>,
        x: Complex,
        torque: Complex,
    ) -> Vec<Complex> {
        let mut angles = vec![Complex::default(); self.groups()];
        for (end, angle) in self.ends.iter().zip(self.end_angles(gathered, x, torque)) {
            if let Some((group, _)) = end {
                angles[*group] = angle;
            }
        }
        for group in &self.apart {
            angles[*group] = gathered.torque[*group] / gathered.stiffness[*group];
        }
        for limb in self.limbs.iter().rev() {
            let ((child, own), (parent, lever)) = (limb.child, limb.parent);
            let Some((spring, pivot)) = limb.spring(nu, gathered.stiffness[child]) else {
                continue;
            };
            let pull = (spring * angles[parent]).scaled(lever * own);
            angles[child] = (gathered.torque[child] + pull) / pivot.scaled(own * own);
        }
        angles
    }

    /// Angles of the two end groups. The stiffer side gives its own; the other follows from the
    /// twist, because at a resonance of its own it takes any. Where both sides turn freely (at rest)
    /// the first stays at zero.
    fn end_angles(
        &self,
        gathered: &Gathered<Complex>,
        x: Complex,
        torque: Complex,
    ) -> [Complex; 2] {
        let free = |end: (usize, f64), sign: f64| {
            let (group, ratio) = end;
            if gathered.stiffness[group] == Complex::default() {
                return Complex::default();
            }
            (gathered.torque[group] + torque.scaled(sign * ratio)) / gathered.stiffness[group]
        };
        match self.ends {
            [Some(p), Some(q)] => {
                let per_twist = |(group, ratio): (usize, f64)| {
                    gathered.stiffness[group].modulus() / (ratio * ratio)
                };
                if per_twist(p) >= per_twist(q) {
                    let angle = free(p, -1.0);
                    [angle, (angle.scaled(p.1) - x).scaled(1.0 / q.1)]
                } else {
                    let angle = free(q, 1.0);
                    [(angle.scaled(q.1) + x).scaled(1.0 / p.1), angle]
                }
            }
            [Some((_, ratio)), None] => [x.scaled(1.0 / ratio), Complex::default()],
            [None, Some((_, ratio))] => [Complex::default(), x.scaled(-1.0 / ratio)],
            [None, None] => [Complex::default(); 2],
        }
    }

    /// The same rest at rest: no inertia, no damping.
    pub(super) fn at_rest(&self) -> Self {
        let mut rest = self.clone();
        rest.inertia.fill(0.0);
        rest.ground_damping.fill(0.0);
        rest.limbs.iter_mut().for_each(|limb| limb.damping = 0.0);
        rest
    }

    /// The same rest without damping.
    pub(super) fn undamped(&self) -> Self {
        let mut rest = self.clone();
        rest.ground_damping.fill(0.0);
        rest.limbs.iter_mut().for_each(|limb| limb.damping = 0.0);
        rest
    }
}

impl Limb {
    /// Complex stiffness of the shaft, and the sum of it and what is beyond, over the square of the
    /// child's ratio; `None` where the shaft transmits nothing. A sum of exactly zero (a resonance of
    /// the limb held at its parent, without any damping) is moved by rounding.
    fn spring<S: Scalar>(&self, nu: f64, beyond: S) -> Option<(S, S)> {
        let value = Complex::new(self.stiffness, nu * self.damping);
        let spring = S::of(value, Complex::new(0.0, self.damping), Complex::default());
        let pivot = spring + beyond.times(1.0 / (self.child.1 * self.child.1));
        let least = f64::EPSILON * value.modulus();
        if least == 0.0 {
            return None;
        }
        if pivot.value().modulus() < least {
            let nudge = S::of(Complex::from(least), Complex::default(), Complex::default());
            return Some((spring, pivot + nudge));
        }
        Some((spring, pivot))
    }
}

impl<S: Scalar> Seen<S> {
    /// All three over a size.
    pub(super) fn scaled(self, size: f64) -> Self {
        let factor = 1.0 / size;
        Self {
            alpha: self.alpha.times(factor),
            beta: self.beta.times(factor),
            gamma: self.gamma.times(factor),
        }
    }
}

/// Spreads over groups from root to root.
struct Search<'e> {
    equations: &'e EquationsOfMotion,
    /// Connections at each group, each until it has been walked.
    at: Vec<Vec<usize>>,
    reached: Vec<bool>,
    walked: Vec<bool>,
    /// Parents before children.
    limbs: Vec<Limb>,
}

impl Search<'_> {
    /// Walks the tree at a root; false where a loop closes.
    fn spread(&mut self, root: usize) -> bool {
        let mut queue = vec![root];
        self.reached[root] = true;
        while let Some(group) = queue.pop() {
            for index in std::mem::take(&mut self.at[group]) {
                if std::mem::replace(&mut self.walked[index], true) {
                    continue;
                }
                let connection = &self.equations.connections[index];
                let (Some(from), Some(to)) = (connection.from, connection.to) else { continue };
                let (parent, child) = if from.0 == group { (from, to) } else { (to, from) };
                if self.reached[child.0] {
                    return false;
                }
                self.reached[child.0] = true;
                self.limbs.push(Limb {
                    child,
                    parent,
                    stiffness: connection.law.stiffness(0.0),
                    damping: connection.damping,
                });
                queue.push(child.0);
            }
        }
        true
    }
}
