//! Dynamic stiffness and load of the kept groups at one harmonic, with the linear rest taken out.
//!
//! At the frequency `ν = j b Ω` of harmonic `j` the linear part of the line is
//! `(-ν² M + i ν C + K) q = τ` with complex amplitudes, a symmetric matrix on the graph of groups.
//! Each step of the [`Skeleton`] takes one group out exactly: `O(groups)` for a tree. Derivatives by
//! `Ω` are carried along (forward mode).

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;

use super::skeleton::Skeleton;

/// A complex number with its derivative by the excitation speed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Dual {
    pub(super) value: Complex,
    pub(super) slope: Complex,
}

impl Dual {
    pub(super) fn new(value: Complex, slope: Complex) -> Self {
        Self { value, slope }
    }

    fn times(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            slope: self.slope * other.value + self.value * other.slope,
        }
    }

    fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }

    fn scaled(self, factor: f64) -> Self {
        Self { value: self.value.scaled(factor), slope: self.slope.scaled(factor) }
    }

    fn add(&mut self, other: Self) {
        self.value = self.value + other.value;
        self.slope = self.slope + other.slope;
    }

    fn subtract(&mut self, other: Self) {
        self.value = self.value - other.value;
        self.slope = self.slope - other.slope;
    }
}

/// Linear part of a line at one harmonic.
#[derive(Clone, Debug, Default)]
pub(super) struct Condensed {
    /// Diagonal entry of each group; of kept ones what is left after elimination.
    pub(super) diagonal: Vec<Dual>,
    /// Entry of each edge.
    pub(super) edge: Vec<Dual>,
    /// Torque amplitude on each group.
    pub(super) load: Vec<Dual>,
}

/// A pivot below this part of the stiffest edge of its group is damped up to it: the group taken out
/// is at resonance there with its neighbours held, and a smaller pivot would cost more digits than
/// the damper of this size does. Only where the skeleton has too many undamped groups to keep them.
const VANISHING: f64 = 1e-8;
/// A pivot below this part of the stiffest connection is rounding, where no edge holds the group.
const EMPTY: f64 = 1e-13;

impl Condensed {
    /// Assembles and condenses the linear part at `ν = order_ratio · speed`; `self.load` must hold the
    /// loads on the groups. Which connections give their stiffness by their law instead is `nonlinear`.
    pub(super) fn condense(
        &mut self,
        equations: &EquationsOfMotion,
        skeleton: &Skeleton,
        stiffness: &[f64],
        nu: f64,
        nu_slope: f64,
    ) {
        let inertia = equations.inertia.iter().zip(&equations.ground_damping);
        self.diagonal.clear();
        self.diagonal.extend(inertia.map(|(m, d)| {
            let value = Complex::new(-nu * nu * m, nu * d);
            let slope = Complex::new(-2.0 * nu * m, *d).scaled(nu_slope);
            Dual::new(value, slope)
        }));
        self.edge.clear();
        self.edge.resize(skeleton.edges.len(), Dual::default());
        let mut size = 0.0_f64;
        for (index, connection) in equations.connections.iter().enumerate() {
            let z = Dual::new(
                Complex::new(stiffness[index], nu * connection.damping),
                Complex::new(0.0, nu_slope * connection.damping),
            );
            size = size.max(z.value.modulus());
            let mut product = 1.0;
            for (group, ratio) in [connection.from, connection.to].into_iter().flatten() {
                self.diagonal[group].add(z.scaled(ratio * ratio));
                product *= ratio;
            }
            if let Some(edge) = skeleton.edge_of[index] {
                self.edge[edge].add(z.scaled(-product));
            } else if let (Some((a, _)), Some((b, _))) = (connection.from, connection.to)
                && a == b
            {
                // Both ends turn with one group: the twist is a multiple of its angle.
                self.diagonal[a].add(z.scaled(-2.0 * product));
            }
        }
        self.eliminate(skeleton, size);
    }

    fn eliminate(&mut self, skeleton: &Skeleton, size: f64) {
        for step in &skeleton.steps {
            let mut pivot = self.diagonal[step.group];
            let held = step.around.iter().any(|(_, edge)| self.edge[*edge].value.modulus() > 0.0);
            if !held && pivot.value.modulus() <= EMPTY * size {
                // Nothing holds this group at this frequency (a mean that only dampers oppose).
                self.diagonal[step.group] = Dual::default();
                continue;
            }
            let own = step.around.iter().map(|(_, edge)| self.edge[*edge].value.modulus());
            let least = VANISHING * own.fold(0.0, f64::max);
            if pivot.value.modulus() < least {
                pivot.value = Complex::new(pivot.value.re, least);
                self.diagonal[step.group] = pivot;
            }
            for &(other, edge) in &step.around {
                let factor = self.edge[edge].over(pivot);
                let load = factor.times(self.load[step.group]);
                self.load[other].subtract(load);
                self.diagonal[other].subtract(factor.times(self.edge[edge]));
            }
            if let ([(_, one), (_, two)], Some(between)) = (&step.around[..], step.between) {
                let product = self.edge[*one].times(self.edge[*two]).over(pivot);
                self.edge[between].subtract(product);
            }
        }
    }

    /// Amplitudes of all groups from those of the kept ones, in place, under loads times `drive`.
    pub(super) fn recover(&self, skeleton: &Skeleton, drive: f64, amplitudes: &mut [Complex]) {
        for step in skeleton.steps.iter().rev() {
            let pivot = self.diagonal[step.group].value;
            let mut right = self.load[step.group].value.scaled(drive);
            for &(other, edge) in &step.around {
                right = right - self.edge[edge].value * amplitudes[other];
            }
            amplitudes[step.group] =
                if pivot.modulus() > 0.0 { right / pivot } else { Complex::default() };
        }
    }
}
