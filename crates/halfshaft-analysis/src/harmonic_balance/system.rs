//! The equations of harmonic balance at a given response: residual, Jacobian, derivatives.
//!
//! Unknowns are the Fourier coefficients of the kept groups' angles over the phase `θ = b Ω t`, with
//! `b` the base order. Residual, per node: `Z q + Σ w f - τ`, where `Z` and `τ` are the condensed linear
//! part ([`super::condensed`]) and `f` the coefficients of the nonlinear torques by alternating
//! frequency-time. A free line's mean angle is pinned at the last node.

use halfshaft_dynamics::laws::Pieces;
use halfshaft_numerics::Complex;
use halfshaft_numerics::blocks::BlockSystem;
use halfshaft_numerics::harmonics::{HarmonicSet, Sampler, add_product};

use super::alternating::{Work, add_rate, combine, differentiate, neglected, samples_for};
use super::condensed::{Condensed, Dual};
use super::kinks::{Force, KinkTransform, Spectra};
use super::line::Line;
use super::switching::phases;

/// Where a response is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Excitation speed, rad/s.
    pub(crate) frequency: f64,
    /// Factor on all harmonic torques.
    pub(crate) drive: f64,
}

/// The equations with everything evaluated at one response.
#[derive(Clone, Debug)]
pub(super) struct HarmonicSystem {
    pub(super) line: Line,
    pub(super) set: HarmonicSet,
    /// Order of the fundamental: the phase runs at `base · Ω`.
    pub(super) base: f64,
    sampler: Sampler,
    condensed: Vec<Condensed>,
    place: Option<Place>,
    pub(super) residual: Vec<f64>,
    pub(super) by_frequency: Vec<f64>,
    pub(super) by_drive: Vec<f64>,
    /// `∂f/∂x` of each nonlinear connection, `m` by `m`.
    products: Vec<f64>,
    /// Estimate of the error that the orders left out make, relative to the amplitude.
    pub(super) truncation: f64,
    work: Work,
    /// Pieces of the laws of the nonlinear connections.
    pieces: Vec<Pieces>,
    kinks: KinkTransform,
}

impl HarmonicSystem {
    pub(super) fn new(line: Line, set: HarmonicSet, base: f64) -> Self {
        let count = samples_for(&line, &set);
        let m = set.coefficients();
        let unknowns = line.nodes() * m;
        let sampler = Sampler::new(count);
        let nonlinear = line.twists.len();
        let work = Work {
            twist: vec![0.0; m],
            rate: vec![0.0; m],
            force: vec![0.0; m],
            samples: vec![0.0; count],
            torque: vec![0.0; count],
            slope: vec![0.0; count],
            rate_slope: vec![0.0; count],
            spectra: Spectra::default(),
            rate_product: vec![0.0; m * m],
        };
        Self {
            condensed: vec![Condensed::default(); set.orders().len()],
            residual: vec![0.0; unknowns],
            by_frequency: vec![0.0; unknowns],
            by_drive: vec![0.0; unknowns],
            products: vec![0.0; nonlinear * m * m],
            truncation: 0.0,
            place: None,
            sampler,
            work,
            pieces: line.pieces(),
            kinks: KinkTransform::default(),
            line,
            set,
            base,
        }
    }

    /// Number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        self.residual.len()
    }

    /// A block system of this shape.
    pub(super) fn blocks(&self, borders: usize) -> BlockSystem {
        BlockSystem::new(self.line.skeleton.pattern.clone(), self.set.coefficients(), borders)
    }

    /// Frequency of the fundamental, rad/s.
    pub(super) fn fundamental(&self, place: Place) -> f64 {
        self.base * place.frequency
    }

    /// Condenses the linear part at an excitation speed; loads are those of drive 1.
    /// Takes another line of the same shape.
    pub(super) fn replace(&mut self, line: Line) {
        self.pieces = line.pieces();
        self.line = line;
        self.place = None;
    }

    fn prepare(&mut self, place: Place) {
        if self.place.is_some_and(|known| known.frequency == place.frequency) {
            self.place = Some(place);
            return;
        }
        let equations = &self.line.equations;
        for (&order, condensed) in self.set.orders().iter().zip(&mut self.condensed) {
            let slope = order as f64 * self.base;
            condensed.load.clear();
            condensed.load.resize(equations.groups(), Dual::default());
            if order == 0 {
                for (load, mean) in condensed.load.iter_mut().zip(&self.line.mean) {
                    load.value = Complex::from(*mean);
                }
            } else {
                add_loads(&self.line, slope, place.frequency, &mut condensed.load);
            }
            let nu = slope * place.frequency;
            let skeleton = &self.line.skeleton;
            condensed.condense(equations, skeleton, &self.line.stiffness, nu, slope);
        }
        self.place = Some(place);
    }

    /// Evaluates residual and derivatives at `u`; the Jacobian's parts only where wanted.
    pub(super) fn evaluate(&mut self, u: &[f64], place: Place, jacobian: bool) {
        self.prepare(place);
        self.linear(u, place.drive);
        let largest = (0..self.line.twists.len())
            .map(|index| self.nonlinear(index, u, place, jacobian))
            .fold(0.0, f64::max);
        self.truncation = largest;
        if let Some(pin) = self.pin() {
            self.residual[pin] = u[pin];
            self.by_frequency[pin] = 0.0;
            self.by_drive[pin] = 0.0;
        }
    }

    /// Place of the unknown that is pinned: the mean angle of the last node of a free line.
    fn pin(&self) -> Option<usize> {
        let free = self.line.free && !self.set.is_odd();
        free.then(|| self.line.skeleton.pattern.last() * self.set.coefficients())
    }

    fn linear(&mut self, u: &[f64], drive: f64) {
        let m = self.set.coefficients();
        self.residual.fill(0.0);
        self.by_frequency.fill(0.0);
        self.by_drive.fill(0.0);
        for ((order, place), condensed) in self.set.places().zip(&self.condensed) {
            let amplitude = |node: usize| match order {
                0 => Complex::from(u[node * m + place]),
                _ => Complex::new(u[node * m + place], -u[node * m + place + 1]),
            };
            let add = |out: &mut [f64], node: usize, value: Complex| {
                out[node * m + place] += value.re;
                if order > 0 {
                    out[node * m + place + 1] -= value.im;
                }
            };
            let factor = if order == 0 { 1.0 } else { drive };
            for (node, &group) in self.line.skeleton.kept.iter().enumerate() {
                let (z, load, q) =
                    (condensed.diagonal[group], condensed.load[group], amplitude(node));
                add(&mut self.residual, node, z.value * q - load.value.scaled(factor));
                add(&mut self.by_frequency, node, z.slope * q - load.slope.scaled(factor));
                if order > 0 {
                    add(&mut self.by_drive, node, -load.value);
                }
            }
            for &(edge, a, b) in &self.line.skeleton.kept_edges {
                let z = condensed.edge[edge];
                for (row, column) in [(a, b), (b, a)] {
                    let q = amplitude(column);
                    add(&mut self.residual, row, z.value * q);
                    add(&mut self.by_frequency, row, z.slope * q);
                }
            }
        }
    }

    /// Adds one nonlinear connection; gives its truncation estimate.
    fn nonlinear(&mut self, index: usize, u: &[f64], place: Place, jacobian: bool) -> f64 {
        let m = self.set.coefficients();
        let speed = self.base * place.frequency;
        let twist = &self.line.twists[index];
        let connection = &self.line.equations.connections[twist.connection];
        let work = &mut self.work;
        combine(twist, u, m, &mut work.twist);
        self.sampler.samples(&self.set, &work.twist, &mut work.samples);
        if connection.friction.is_some() {
            differentiate(&self.set, &work.twist, speed, &mut work.rate);
        }
        let pieces = &self.pieces[index];
        let phases = phases(pieces, &self.set, &work.twist, &work.samples);
        if phases.is_empty() {
            work.sample(connection, &mut self.sampler, &self.set, jacobian);
        } else {
            let force = Force {
                set: &self.set,
                twist: &work.twist,
                rate: &work.rate,
                pieces,
                friction: connection.friction.as_ref(),
            };
            self.kinks.transform(&force, &phases, &mut work.spectra);
        }
        work.spectra.torque.coefficients(&self.set, &mut work.force);
        for (node, factor) in &twist.parts {
            let target = &mut self.residual[node * m..(node + 1) * m];
            target.iter_mut().zip(&work.force).for_each(|(r, f)| *r += factor * f);
        }
        let truncation =
            neglected(&work.spectra.torque, &self.set, speed, twist.mobility, &work.twist);
        if jacobian {
            let product = &mut self.products[index * m * m..(index + 1) * m * m];
            product.fill(0.0);
            add_product(&self.set, &work.spectra.slope, 1.0, product);
            if connection.friction.is_some() {
                work.rate_product.fill(0.0);
                add_product(&self.set, &work.spectra.rate_slope, 1.0, &mut work.rate_product);
                add_rate(&self.set, &work.rate_product, speed, product);
                for (node, factor) in &twist.parts {
                    let target = &mut self.by_frequency[node * m..(node + 1) * m];
                    for (row, target) in work.rate_product.chunks_exact(m).zip(target) {
                        let sum: f64 = row.iter().zip(&work.rate).map(|(p, v)| p * v).sum();
                        *target += factor * sum / place.frequency;
                    }
                }
            }
        }
        truncation
    }

    /// Writes the Jacobian at the response last evaluated into a block system; its border is left.
    pub(super) fn fill(&self, matrix: &mut BlockSystem) {
        let m = self.set.coefficients();
        matrix.clear();
        for ((order, place), condensed) in self.set.places().zip(&self.condensed) {
            let mut add = |row: usize, column: usize, z: Complex| {
                let block = matrix.block_mut(row, column);
                block[place * m + place] += z.re;
                if order > 0 {
                    block[place * m + place + 1] += z.im;
                    block[(place + 1) * m + place] -= z.im;
                    block[(place + 1) * m + place + 1] += z.re;
                }
            };
            for (node, &group) in self.line.skeleton.kept.iter().enumerate() {
                add(node, node, condensed.diagonal[group].value);
            }
            for &(edge, a, b) in &self.line.skeleton.kept_edges {
                add(a, b, condensed.edge[edge].value);
                add(b, a, condensed.edge[edge].value);
            }
        }
        for (twist, product) in self.line.twists.iter().zip(self.products.chunks_exact(m * m)) {
            for (row, row_factor) in &twist.parts {
                for (column, column_factor) in &twist.parts {
                    let factor = row_factor * column_factor;
                    let block = matrix.block_mut(*row, *column);
                    block.iter_mut().zip(product).for_each(|(b, p)| *b += factor * p);
                }
            }
        }
        if self.pin().is_some() {
            self.pin_row(matrix);
        }
    }

    fn pin_row(&self, matrix: &mut BlockSystem) {
        let m = self.set.coefficients();
        let last = self.line.skeleton.pattern.last();
        let others: Vec<usize> = (self.line.skeleton.kept_edges.iter())
            .filter_map(|(_, a, b)| match (*a == last, *b == last) {
                (true, _) => Some(*b),
                (_, true) => Some(*a),
                _ => None,
            })
            .collect();
        for node in others {
            matrix.block_mut(last, node)[..m].fill(0.0);
        }
        let own = matrix.block_mut(last, last);
        own[..m].fill(0.0);
        own[0] = 1.0;
    }

    /// Complex amplitudes of all groups at the harmonic of `index` in the set.
    pub(super) fn group_amplitudes(
        &mut self,
        u: &[f64],
        place: Place,
        index: usize,
    ) -> Vec<Complex> {
        self.prepare(place);
        let m = self.set.coefficients();
        let order = self.set.orders()[index];
        let at = self.set.place(index);
        let condensed = &self.condensed[index];
        let mut amplitudes = vec![Complex::default(); self.line.equations.groups()];
        for (node, group) in self.line.skeleton.kept.iter().enumerate() {
            let imaginary = if order == 0 { 0.0 } else { -u[node * m + at + 1] };
            amplitudes[*group] = Complex::new(u[node * m + at], imaginary);
        }
        let drive = if order == 0 { 1.0 } else { place.drive };
        condensed.recover(&self.line.skeleton, drive, &mut amplitudes);
        amplitudes
    }

    /// Coefficients of the twist of nonlinear connection `index`.
    pub(super) fn twist(&self, index: usize, u: &[f64], out: &mut [f64]) {
        combine(&self.line.twists[index], u, self.set.coefficients(), out);
    }
}

/// Loads of drive 1 at the harmonic whose order is `order`.
fn add_loads(line: &Line, order: f64, frequency: f64, loads: &mut [Dual]) {
    let sources = line.equations.excitation.sources.iter();
    for source in sources.filter(|source| source.own_frequency.is_none()) {
        let (growth, slope) = (source.growth(frequency), source.growth_slope(frequency));
        for harmonic in &source.harmonics {
            if (harmonic.order - order).abs() <= 1e-9 * order {
                let torque =
                    Complex::from_polar(source.ratio * harmonic.amplitude_nm, harmonic.phase_rad);
                let load = &mut loads[source.group];
                load.value = load.value + torque.scaled(growth);
                load.slope = load.slope + torque.scaled(slope);
            }
        }
    }
}
