//! The linear rest of a line with loops of shafts, by dense elimination.
//!
//! The shaft gets a reference stiffness `κ`, complex so that no undamped resonance of the line with
//! it lies on the real axis. With `Z` the dynamic stiffness of that line, `w` the direction of the
//! shaft, `y = Z⁻¹ w` and `C = wᵀ y`:
//!
//! ```text
//! (1 - C κ + C N) X = wᵀ Z⁻¹ Q
//! C'  = -yᵀ Z' y             C'' = 2 (Z' y)ᵀ Z⁻¹ (Z' y) - yᵀ Z'' y
//! ```

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::End;
use halfshaft_numerics::Complex;
use halfshaft_numerics::dense::{Lu, Matrix};

use super::drive::Drive;
use super::jet::{Jet, Scalar};
use super::limbs::Seen;

/// A linear shaft of the rest.
#[derive(Clone, Debug, PartialEq)]
struct Spring {
    /// Groups and signed ratios: `x = Σ ratio · angle`.
    ends: Vec<(usize, f64)>,
    stiffness: f64,
    damping: f64,
}

/// The linear rest of a line, loops allowed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Meshed {
    springs: Vec<Spring>,
    inertia: Vec<f64>,
    ground_damping: Vec<f64>,
    /// The nonlinear shaft: groups and signed ratios.
    own: Vec<(usize, f64)>,
    /// Size of the reference stiffness, N·m/rad.
    reference: f64,
    /// Whether no shaft is held at ground.
    free: bool,
}

fn direction(from: End, to: End) -> Vec<(usize, f64)> {
    from.into_iter().chain(to.map(|(group, ratio)| (group, -ratio))).collect()
}

impl Meshed {
    /// The rest without the connection `shaft`.
    pub(super) fn new(equations: &EquationsOfMotion, shaft: usize) -> Self {
        let spring = |connection: &halfshaft_dynamics::Connection| Spring {
            ends: direction(connection.from, connection.to),
            stiffness: connection.law.stiffness(0.0),
            damping: connection.damping,
        };
        let others = equations.connections.iter().enumerate().filter(|(index, _)| *index != shaft);
        let springs: Vec<Spring> = others.map(|(_, connection)| spring(connection)).collect();
        let own = &equations.connections[shaft];
        let reference = springs.iter().map(|s| s.stiffness.abs()).fold(0.0, f64::max);
        Self {
            springs,
            inertia: equations.inertia.clone(),
            ground_damping: equations.ground_damping.clone(),
            own: direction(own.from, own.to),
            reference: if reference > 0.0 { reference } else { 1.0 },
            free: !equations.network.grounded,
        }
    }

    /// Number of groups.
    pub(super) fn groups(&self) -> usize {
        self.inertia.len()
    }

    /// The same rest without damping.
    pub(super) fn undamped(&self) -> Self {
        let mut rest = self.clone();
        rest.ground_damping.fill(0.0);
        rest.springs.iter_mut().for_each(|spring| spring.damping = 0.0);
        rest
    }

    /// Stiffness of the rest at rest with the shaft's reference stiffness, first group held where
    /// the line is free.
    fn stiffness_at_rest(&self) -> Matrix {
        let mut matrix = Matrix::zeros(self.groups(), self.groups());
        let own = Spring { ends: self.own.clone(), stiffness: self.reference, damping: 0.0 };
        for spring in self.springs.iter().chain(std::iter::once(&own)) {
            for (row, a) in &spring.ends {
                for (column, b) in &spring.ends {
                    matrix[(*row, *column)] += spring.stiffness * a * b;
                }
            }
        }
        if self.free {
            for k in 0..self.groups() {
                (matrix[(0, k)], matrix[(k, 0)]) = (0.0, 0.0);
            }
            matrix[(0, 0)] = self.reference;
        }
        matrix
    }

    /// Angles at rest under torques on the groups and a torque `torque` of the shaft at twist
    /// `x`; `None` where the matrix has no inverse.
    pub(super) fn angles_at_rest(&self, forces: &[f64], x: f64, torque: f64) -> Option<Vec<f64>> {
        let mut right = forces.to_vec();
        for (group, ratio) in &self.own {
            right[*group] += ratio * (self.reference * x - torque);
        }
        if self.free {
            right[0] = 0.0;
        }
        Lu::new(&self.stiffness_at_rest()).ok()?.solve_in_place(&mut right).ok()?;
        Some(right)
    }

    /// `(c, t)` with `T + c x = t` for torque and twist of the shaft at rest under torques on the
    /// groups; `None` where the matrix has no inverse.
    pub(super) fn statics(&self, forces: &[f64]) -> Option<(f64, f64)> {
        let twist = |angles: &[f64]| self.own.iter().map(|(g, r)| r * angles[*g]).sum::<f64>();
        // x = x_f - C (T - κ x).
        let loaded = twist(&self.angles_at_rest(forces, 0.0, 0.0)?);
        let compliance = -twist(&self.angles_at_rest(&vec![0.0; forces.len()], 0.0, 1.0)?);
        let parallel = 1.0 / compliance - self.reference;
        // A shaft that alone joins two parts has nothing in parallel, but for rounding.
        let parallel = if parallel < 1e-9 * self.reference { 0.0 } else { parallel };
        Some((parallel, loaded / compliance))
    }

    /// Dynamic stiffness with the reference stiffness, as a real matrix of twice the order.
    fn dynamic_stiffness(&self, nu: f64) -> Matrix {
        let n = self.groups();
        let mut matrix = Matrix::zeros(2 * n, 2 * n);
        let mut add = |row: usize, column: usize, value: Complex| {
            matrix[(row, column)] += value.re;
            matrix[(row + n, column + n)] += value.re;
            matrix[(row, column + n)] -= value.im;
            matrix[(row + n, column)] += value.im;
        };
        for group in 0..n {
            let inertia = -nu * nu * self.inertia[group];
            add(group, group, Complex::new(inertia, nu * self.ground_damping[group]));
        }
        let spring = |s: &Spring| Complex::new(s.stiffness, nu * s.damping);
        let all = self.springs.iter().map(|s| (&s.ends, spring(s)));
        for (ends, value) in all.chain(std::iter::once((&self.own, self.kappa()))) {
            for (row, a) in ends {
                for (column, b) in ends {
                    add(*row, *column, value.scaled(a * b));
                }
            }
        }
        matrix
    }

    fn kappa(&self) -> Complex {
        Complex::new(self.reference, self.reference)
    }

    /// `Z' z`.
    fn slope_times(&self, nu: f64, z: &[Complex]) -> Vec<Complex> {
        let turned =
            |value: Complex, factor: f64| Complex::new(-factor * value.im, factor * value.re);
        let mut out: Vec<Complex> = (0..self.groups())
            .map(|g| {
                z[g].scaled(-2.0 * nu * self.inertia[g]) + turned(z[g], self.ground_damping[g])
            })
            .collect();
        for spring in self.springs.iter().filter(|spring| spring.damping != 0.0) {
            let sum = spring.ends.iter().map(|(g, r)| z[*g].scaled(*r));
            let twist = sum.fold(Complex::default(), |a, b| a + b);
            for (group, ratio) in &spring.ends {
                out[*group] = out[*group] + turned(twist, ratio * spring.damping);
            }
        }
        out
    }

    /// `a'' b` with `Z'' = -2 M`.
    fn bend(&self, a: &[Complex], b: &[Complex]) -> Complex {
        let terms = self.inertia.iter().zip(a).zip(b);
        terms.map(|((m, a), b)| (*a * *b).scaled(-2.0 * m)).fold(Complex::default(), |s, t| s + t)
    }

    /// What the nonlinear shaft sees at circular frequency `nu`; `None` where the line resonates
    /// without any damping and without moving the shaft.
    pub(super) fn seen(&self, nu: f64, drive: &Drive) -> Option<Seen<Jet>> {
        let lu = Lu::new(&self.dynamic_stiffness(nu)).ok()?;
        let mut torques = vec![Jet::default(); self.groups()];
        drive.add_to(nu, &mut torques);
        let part = |of: &dyn Fn(&Jet) -> Complex| torques.iter().map(of).collect::<Vec<Complex>>();
        let (q0, q1, q2) = (part(&|t| t.value), part(&|t| t.first), part(&|t| t.second));
        let y = solved(&lu, &self.unit())?;
        let moved = solved(&lu, &q0)?;
        let (slope_y, slope_moved) = (self.slope_times(nu, &y), self.slope_times(nu, &moved));
        let v = solved(&lu, &slope_y)?;
        let compliance = Jet {
            value: dot(&y, &self.unit()),
            first: -dot(&y, &slope_y),
            second: dot(&slope_y, &v).scaled(2.0) - self.bend(&y, &y),
        };
        let gamma = Jet {
            value: dot(&y, &q0),
            first: dot(&y, &q1) - dot(&y, &slope_moved),
            second: dot(&v, &slope_moved).scaled(2.0)
                - self.bend(&y, &moved)
                - dot(&v, &q1).scaled(2.0)
                + dot(&y, &q2),
        };
        let constant = |value: Complex| Jet::of(value, Complex::default(), Complex::default());
        let alpha = constant(Complex::from(1.0)) - compliance * constant(self.kappa());
        Some(Seen { alpha, beta: compliance, gamma }.scaled(1.0 / self.reference))
    }

    /// Complex amplitudes of all groups for the twist `x` of the shaft and its torque `torque`.
    pub(super) fn motion(
        &self,
        nu: f64,
        drive: &Drive,
        x: Complex,
        torque: Complex,
    ) -> Option<Vec<Complex>> {
        let lu = Lu::new(&self.dynamic_stiffness(nu)).ok()?;
        let mut torques = vec![Complex::default(); self.groups()];
        drive.add_to(nu, &mut torques);
        let own = self.kappa() * x - torque;
        for (group, ratio) in &self.own {
            torques[*group] = torques[*group] + own.scaled(*ratio);
        }
        solved(&lu, &torques)
    }

    fn unit(&self) -> Vec<Complex> {
        let mut unit = vec![Complex::default(); self.groups()];
        for (group, ratio) in &self.own {
            unit[*group] = unit[*group] + Complex::from(*ratio);
        }
        unit
    }
}

fn dot(a: &[Complex], b: &[Complex]) -> Complex {
    a.iter().zip(b).map(|(a, b)| *a * *b).fold(Complex::default(), |sum, term| sum + term)
}

fn solved(lu: &Lu, right: &[Complex]) -> Option<Vec<Complex>> {
    let mut both: Vec<f64> = right.iter().map(|z| z.re).chain(right.iter().map(|z| z.im)).collect();
    lu.solve_in_place(&mut both).ok()?;
    let (re, im) = both.split_at(right.len());
    Some(re.iter().zip(im).map(|(re, im)| Complex::new(*re, *im)).collect())
}
