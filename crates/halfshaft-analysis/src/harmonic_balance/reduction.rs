//! A few modes in place of a long linear line, for its variational equation.
//!
//! A line acts on its nonlinear connections through its receptance there. The responses of the line
//! to torques at these connections, taken at a few frequencies, span a space in which mass, damping and
//! stiffness keep their form (Galerkin), and the receptance of what is left is that of the whole line at
//! these frequencies. More are added where the two differ most, until they agree to [`AGREEMENT`] at
//! all frequencies up to twice those of the orbit. Modes that the connections do not move are
//! left out with their multipliers, which are those of the linear line; modes above these
//! frequencies stand for many and are rough. Source: A. Antoulas, C.
//! Beattie, S. Gugercin, *Interpolatory Methods for Model Reduction* (2020), chapters 3 and 8.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::dense::{Matrix, symmetric_eigen};

use super::modes::Modes;
use super::receptance::{Moved, Receptance};

/// Groups from which on it pays.
const LONG: usize = 24;
/// Nonlinear connections at most.
const FEW: usize = 4;
/// Frequencies at which the receptances are compared.
const COMPARED: usize = 96;
/// To what they agree, relative to the largest between their neighbours.
const AGREEMENT: f64 = 1e-10;
/// A direction of which less is new is rounding.
const NEW: f64 = 1e-9;

/// The modes of one line, kept while the line stays the same.
#[derive(Clone, Debug)]
pub(super) struct Reduction {
    nonlinear: Vec<usize>,
    /// What the modes depend on, with the highest frequency they hold for.
    made_for: Option<(Vec<f64>, f64)>,
    modes: Option<Modes>,
}

impl Reduction {
    /// A reduction to what the given connections see.
    pub(super) fn new(nonlinear: &[usize]) -> Self {
        let mut nonlinear = nonlinear.to_vec();
        nonlinear.sort_unstable();
        Self { nonlinear, made_for: None, modes: None }
    }

    /// The modes, where a few are as good as the line.
    pub(super) fn modes(&self) -> Option<&Modes> {
        self.modes.as_ref()
    }

    /// Makes the modes for a line and for orbits whose highest harmonic is at `highest` rad/s.
    pub(super) fn prepare(&mut self, equations: &EquationsOfMotion, highest: f64) {
        let few = !self.nonlinear.is_empty() && self.nonlinear.len() <= FEW;
        if equations.groups() < LONG || !few {
            return;
        }
        let key = self.key(equations);
        if self.made_for.as_ref().is_some_and(|(known, top)| *known == key && 2.0 * highest <= *top)
        {
            return;
        }
        let top = 3.0 * highest;
        self.modes = reduce(equations, &self.nonlinear, top);
        self.made_for = Some((key, top));
    }

    fn key(&self, equations: &EquationsOfMotion) -> Vec<f64> {
        let linear = |index: &usize| self.nonlinear.binary_search(index).is_err();
        let list = (0..equations.connections.len()).filter(linear);
        let rest = list.flat_map(|index| {
            let connection = &equations.connections[index];
            [connection.law.stiffness(0.0), connection.damping]
        });
        equations.inertia.iter().chain(&equations.ground_damping).copied().chain(rest).collect()
    }
}

/// The modes, or none where they would not be few.
fn reduce(equations: &EquationsOfMotion, nonlinear: &[usize], top: f64) -> Option<Modes> {
    let mut receptance = Receptance::new(equations, nonlinear);
    let at = |k: usize| top * (k as f64 + 0.5) / COMPARED as f64;
    let moved: Option<Vec<Moved>> = (0..COMPARED).map(|k| receptance.moved(at(k))).collect();
    let moved = moved?;
    let mut basis = Basis::new(equations);
    let mut next: Vec<usize> = (0..4).map(|k| (2 * k + 1) * COMPARED / 8).collect();
    let most = 2 * equations.groups() / 3;
    loop {
        for at in &next {
            for angles in &moved[*at].angles {
                basis.add(&angles.0);
                basis.add(&angles.1);
            }
        }
        if basis.vectors.len() > most {
            return None;
        }
        let modes = projected(equations, nonlinear, &basis.vectors)?;
        let worst = (0..COMPARED)
            .map(|k| (k, apart(&receptance, &modes, &moved[k])))
            .max_by(|a, b| a.1.total_cmp(&b.1))?;
        // Chosen before and still apart: as near as rounding lets it come.
        let again = next == [worst.0];
        if worst.1 <= AGREEMENT || (again && worst.1 <= 1e3 * AGREEMENT) {
            return sharpened(&mut receptance, basis, &modes, (top, most)).or(Some(modes));
        }
        if again {
            return None;
        }
        next = vec![worst.0];
    }
}

/// The modes once more with what torques move at the frequency of each: a mode that the connections
/// hardly feel is told by that alone.
fn sharpened(
    receptance: &mut Receptance<'_>,
    mut basis: Basis<'_>,
    modes: &Modes,
    (top, most): (f64, usize),
) -> Option<Modes> {
    let squares = modes.squares.iter().filter(|square| **square > 0.0);
    for nu in squares.map(|square| square.sqrt()).filter(|nu| *nu <= top) {
        for angles in receptance.moved(nu)?.angles {
            basis.add(&angles.0);
            basis.add(&angles.1);
        }
    }
    if basis.vectors.len() > most {
        return None;
    }
    projected(basis.equations, &modes.connections, &basis.vectors)
}

/// Difference of the receptances at one frequency, over their size.
fn apart(receptance: &Receptance<'_>, modes: &Modes, moved: &Moved) -> f64 {
    let Some(other) = modes.receptance(moved.frequency, &receptance.held) else {
        return f64::INFINITY;
    };
    let size = moved.twists.iter().map(|z| z.modulus()).fold(f64::MIN_POSITIVE, f64::max);
    let difference = moved.twists.iter().zip(&other).map(|(a, b)| (*a - *b).modulus());
    difference.fold(0.0, f64::max) / size
}

/// Directions that are orthonormal in the inertia, without the motion as a whole.
struct Basis<'e> {
    equations: &'e EquationsOfMotion,
    vectors: Vec<Vec<f64>>,
}

impl<'e> Basis<'e> {
    fn new(equations: &'e EquationsOfMotion) -> Self {
        Self { equations, vectors: Vec::new() }
    }

    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        self.equations.inertia.iter().zip(a).zip(b).map(|((m, a), b)| m * a * b).sum()
    }

    fn add(&mut self, angles: &[f64]) {
        let mut vector = angles.to_vec();
        let before = self.product(&vector, &vector).sqrt();
        // Twice is enough.
        for _ in 0..2 {
            if let Some(rigid) = &self.equations.rigid {
                let mean = rigid.mean(&vector);
                vector.iter_mut().zip(&rigid.speeds).for_each(|(q, r)| *q -= mean * r);
            }
            for known in &self.vectors {
                let part = self.product(known, &vector);
                vector.iter_mut().zip(known).for_each(|(q, v)| *q -= part * v);
            }
        }
        let size = self.product(&vector, &vector).sqrt();
        if size > NEW * before && size > 0.0 {
            vector.iter_mut().for_each(|q| *q /= size);
            self.vectors.push(vector);
        }
    }
}

/// The line in the given directions.
fn projected(
    equations: &EquationsOfMotion,
    nonlinear: &[usize],
    basis: &[Vec<f64>],
) -> Option<Modes> {
    let order = basis.len();
    let mut stiffness = Matrix::zeros(order, order);
    let twists = |index: usize, vectors: &[Vec<f64>]| -> Vec<f64> {
        vectors.iter().map(|v| equations.twist(index, v)).collect()
    };
    let linear = |index: &usize| nonlinear.binary_search(index).is_err();
    for index in (0..equations.connections.len()).filter(linear) {
        let x = twists(index, basis);
        let k = equations.connections[index].law.stiffness(0.0);
        for row in 0..order {
            let factor = k * x[row];
            stiffness.row_mut(row).iter_mut().zip(&x).for_each(|(out, x)| *out += factor * x);
        }
    }
    let modes = symmetric_eigen(&stiffness).ok()?;
    // The basis turned into modes, then the motion as a whole.
    let mut vectors: Vec<Vec<f64>> = (0..order)
        .map(|mode| {
            let mut vector = vec![0.0; equations.groups()];
            for (row, known) in basis.iter().enumerate() {
                let part = modes.vectors[(row, mode)];
                vector.iter_mut().zip(known).for_each(|(q, v)| *q += part * v);
            }
            vector
        })
        .collect();
    let mut squares = modes.values.clone();
    let whole = super::structure::with_speed(equations);
    if let (true, Some(rigid)) = (whole, &equations.rigid) {
        vectors.push(rigid.speeds.iter().map(|r| r / rigid.inertia.sqrt()).collect());
        squares.push(0.0);
    }
    let count = vectors.len();
    let mut damping = vec![0.0; count * count];
    let mut add = |factor: f64, x: &[f64]| {
        for (row, own) in damping.chunks_exact_mut(count).zip(x) {
            row.iter_mut().zip(x).for_each(|(out, x)| *out += factor * own * x);
        }
    };
    for index in (0..equations.connections.len()).filter(linear) {
        let c = equations.connections[index].damping;
        if c != 0.0 {
            add(c, &twists(index, &vectors));
        }
    }
    for (group, d) in equations.ground_damping.iter().enumerate().filter(|(_, d)| **d != 0.0) {
        add(*d, &vectors.iter().map(|v| v[group]).collect::<Vec<f64>>());
    }
    let directions = nonlinear.iter().flat_map(|index| twists(*index, &vectors)).collect();
    Some(Modes { squares, damping, directions, connections: nonlinear.to_vec(), whole })
}
