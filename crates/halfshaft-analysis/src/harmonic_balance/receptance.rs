//! How a line answers to torques at a few of its connections, frequency by frequency.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_numerics::blocks::{BlockSystem, Factors, Pattern};

/// A line with its nonlinear connections held by springs.
pub(super) struct Receptance<'e> {
    equations: &'e EquationsOfMotion,
    nonlinear: &'e [usize],
    /// Stiffness of these springs, N·m/rad.
    pub(super) held: Vec<f64>,
    system: BlockSystem,
    factors: Option<Factors>,
}

/// What unit torques at the connections move.
pub(super) struct Moved {
    /// rad/s.
    pub(super) frequency: f64,
    /// Angles of the groups for each connection: real and imaginary parts.
    pub(super) angles: Vec<(Vec<f64>, Vec<f64>)>,
    /// Twist of each connection for each.
    pub(super) twists: Vec<Complex>,
}

impl<'e> Receptance<'e> {
    pub(super) fn new(equations: &'e EquationsOfMotion, nonlinear: &'e [usize]) -> Self {
        let ends = equations.connections.iter().filter_map(|c| Some((c.from?.0, c.to?.0)));
        let pattern = Pattern::new(equations.groups(), ends);
        let typical = equations.connections.iter().map(|c| c.law.stiffness(0.0).abs());
        let typical = typical.fold(0.0, f64::max);
        let held = nonlinear.iter().map(|index| {
            let own = equations.connections[*index].law.stiffness(0.0).abs();
            if own > 0.0 { own } else { typical.max(f64::MIN_POSITIVE) }
        });
        Self {
            held: held.collect(),
            system: BlockSystem::new(pattern, 2, 0),
            factors: None,
            equations,
            nonlinear,
        }
    }

    /// The answers at `nu` rad/s; none where the line is at resonance without damping.
    pub(super) fn moved(&mut self, nu: f64) -> Option<Moved> {
        self.assemble(nu);
        self.system.factorise(&mut self.factors).ok()?;
        let factors = self.factors.as_mut()?;
        let groups = self.equations.groups();
        let (mut angles, mut twists) = (Vec::new(), Vec::new());
        let mut load = vec![0.0; groups];
        let mut x = vec![0.0; 2 * groups];
        for index in self.nonlinear {
            load.fill(0.0);
            self.equations.add_direction(*index, 1.0, &mut load);
            x.chunks_exact_mut(2).zip(&load).for_each(|(x, q)| x.copy_from_slice(&[*q, 0.0]));
            factors.solve(&mut x, &mut []);
            let part = |at: usize| x.iter().skip(at).step_by(2).copied().collect::<Vec<f64>>();
            let (real, imaginary) = (part(0), part(1));
            for other in self.nonlinear {
                let twist = |angles: &[f64]| self.equations.twist(*other, angles);
                twists.push(Complex::new(twist(&real), twist(&imaginary)));
            }
            angles.push((real, imaginary));
        }
        Some(Moved { frequency: nu, angles, twists })
    }

    fn assemble(&mut self, nu: f64) {
        let equations = self.equations;
        self.system.clear();
        for (group, (m, d)) in equations.inertia.iter().zip(&equations.ground_damping).enumerate() {
            self.add(group, group, Complex::new(-nu * nu * m, nu * d));
        }
        for (index, connection) in equations.connections.iter().enumerate() {
            // Of what a nonlinear connection damps only that it does is used.
            let held = self.nonlinear.binary_search(&index).ok();
            let k = held.map_or_else(|| connection.law.stiffness(0.0), |place| self.held[place]);
            let c = if held.is_some() { 0.0 } else { connection.damping };
            let z = Complex::new(k, nu * c);
            let ends = [connection.from, connection.to.map(|(group, ratio)| (group, -ratio))];
            for (a, r) in ends.into_iter().flatten() {
                for (b, s) in ends.into_iter().flatten() {
                    self.add(a, b, z.scaled(r * s));
                }
            }
        }
    }

    fn add(&mut self, row: usize, column: usize, z: Complex) {
        let block = self.system.block_mut(row, column);
        for (entry, value) in block.iter_mut().zip([z.re, -z.im, z.im, z.re]) {
            *entry += value;
        }
    }
}
