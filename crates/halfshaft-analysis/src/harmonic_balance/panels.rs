//! Columns of the variational equation, panel by panel, by Taylor series.
//!
//! A panel has as many columns as fit the registers and keep the coefficients of all groups in the
//! cache; all panels take the same steps.

use halfshaft_numerics::dense::Matrix;

use super::horner::{TOGETHER, horner, horner_of_four, split};
use super::lanes::Rows;
use super::series::{MOST, Series, Truncation};
use super::structure::{Structure, sum, sums, times};

/// Tangent stiffness and damping of one connection over a step.
#[derive(Clone)]
pub(super) struct Tangent {
    pub(super) stiffness: Series,
    pub(super) stiffness_terms: usize,
    pub(super) damping: Series,
    pub(super) damping_terms: usize,
}

/// Coefficients of a row.
pub(super) const TERMS: usize = MOST + 1;

/// Columns of a last panel that has no more: it costs two thirds of one of 16.
const NARROW: usize = 8;

/// Columns of the variational equation at one time.
pub(super) struct Panels<const W: usize> {
    /// Coordinates, then their rates, panel after panel. Here as below rows of the narrow panel follow
    /// each other closely.
    state: Rows<W>,
    next: Rows<W>,
    /// Coefficients of the panel at hand: power, coordinate.
    coordinates: Rows<W>,
    /// The same of twists: connection, power.
    twists: Rows<W>,
    net: Rows<W>,
    columns: usize,
    count: usize,
    /// Rates are measured by it.
    speed: f64,
    truncation: Truncation,
    /// Instructions of the processor at hand.
    arch: pulp::Arch,
}

/// One step of one panel of `N` columns, or only its coefficients where no step is given, as work that
/// runs with the widest instructions of the processor: a structure and no closure, because only that is
/// sure to be compiled with them.
struct PanelStep<'p, 'e, S: Structure, const W: usize, const N: usize, const FUSED: bool> {
    panels: &'p mut Panels<W>,
    structure: &'e S,
    tangents: &'e [Tangent],
    panel: usize,
    step: Option<f64>,
}

impl<S: Structure, const W: usize, const N: usize, const FUSED: bool> pulp::NullaryFnOnce
    for PanelStep<'_, '_, S, W, N, FUSED>
{
    /// The longest step that the terms of the panel allow.
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { panels, structure, tangents, panel, step } = self;
        panels.load::<N>(panel);
        let Panels { coordinates, twists, net, truncation, speed, count, .. } = panels;
        let coordinates = narrow::<W, N>(coordinates);
        let (twists, net) = (narrow::<W, N>(twists), narrow::<W, N>(net));
        structure.recur::<N, FUSED>(tangents, truncation.degree, coordinates, twists, net);
        let reach = reach(*truncation, *speed, coordinates, *count);
        if let Some(step) = step {
            panels.advance::<N, FUSED>(panel, step);
        }
        reach
    }
}

impl<const W: usize> Panels<W> {
    /// The columns that the structure starts with.
    pub(super) fn new(structure: &impl Structure, speed: f64, truncation: Truncation) -> Self {
        let (count, columns) = (structure.coordinates(), structure.columns());
        let panels = columns.div_ceil(W);
        let mut panels = Self {
            state: Rows::zeros(panels * 2 * count),
            next: Rows::zeros(panels * 2 * count),
            coordinates: Rows::zeros(TERMS * count),
            twists: Rows::zeros(TERMS * structure.connections().len()),
            net: Rows::zeros(count),
            arch: pulp::Arch::new(),
            columns,
            count,
            speed,
            truncation,
        };
        panels.begin(structure);
        panels
    }

    /// Sets the columns of the start in a state of zeros.
    fn begin(&mut self, structure: &impl Structure) {
        structure.start(self.speed, &mut |column, power, values| {
            let (from, width) = self.place(column, power);
            let state = self.state.as_flattened_mut();
            for (at, value) in values.iter().enumerate() {
                state[from + at * width] = *value;
            }
        });
    }

    /// Columns of a panel.
    fn width(&self, panel: usize) -> usize {
        if W > NARROW && self.columns - panel * W <= NARROW { NARROW } else { W }
    }

    /// Where coefficients of a column (power 0 or 1) begin in the state, and how far apart they are.
    fn place(&self, column: usize, power: usize) -> (usize, usize) {
        let (panel, lane) = (column / W, column % W);
        let width = self.width(panel);
        (panel * 2 * self.count * W + power * self.count * width + lane, width)
    }

    /// The longest step that the terms of all panels allow.
    pub(super) fn longest_step(&mut self, structure: &impl Structure, tangents: &[Tangent]) -> f64 {
        let panels = self.state.len() / (2 * self.count);
        (0..panels)
            .map(|panel| self.work(structure, tangents, panel, None))
            .fold(f64::INFINITY, f64::min)
    }

    /// Computes one panel, with products and sums in one where the processor can.
    fn work(
        &mut self,
        structure: &impl Structure,
        tangents: &[Tangent],
        panel: usize,
        step: Option<f64>,
    ) -> f64 {
        if self.width(panel) < W {
            self.work_on::<_, NARROW>(structure, tangents, panel, step)
        } else {
            self.work_on::<_, W>(structure, tangents, panel, step)
        }
    }

    /// The same for a panel of `N` columns.
    fn work_on<S: Structure, const N: usize>(
        &mut self,
        structure: &S,
        tangents: &[Tangent],
        panel: usize,
        step: Option<f64>,
    ) -> f64 {
        let (arch, panels) = (self.arch, self);
        if matches!(arch, pulp::Arch::Scalar) {
            arch.dispatch(PanelStep::<_, W, N, false> { panels, structure, tangents, panel, step })
        } else {
            arch.dispatch(PanelStep::<_, W, N, true> { panels, structure, tangents, panel, step })
        }
    }

    /// Moves all panels on by `step`, which is made shorter where their terms do not allow it; gives
    /// the longest step that they would have allowed.
    pub(super) fn step(
        &mut self,
        structure: &impl Structure,
        tangents: &[Tangent],
        step: &mut f64,
    ) -> f64 {
        let panels = self.state.len() / (2 * self.count);
        loop {
            let mut longest = f64::INFINITY;
            for panel in 0..panels {
                longest = longest.min(self.work(structure, tangents, panel, Some(*step)));
                if longest < 0.8 * *step {
                    break;
                }
            }
            if longest >= 0.8 * *step || longest.is_nan() {
                std::mem::swap(&mut self.state, &mut self.next);
                return longest;
            }
            *step = 0.95 * longest;
        }
    }

    #[inline(always)]
    fn load<const N: usize>(&mut self, panel: usize) {
        let from = 2 * panel * self.count;
        let state = self.state[from..].as_flattened().as_chunks::<N>().0;
        let coordinates = narrow::<W, N>(&mut self.coordinates);
        coordinates[..2 * self.count].copy_from_slice(&state[..2 * self.count]);
    }

    /// Writes coordinates and rates after `step` to the next state.
    #[inline(always)]
    fn advance<const N: usize, const FUSED: bool>(&mut self, panel: usize, step: f64) {
        if N < 8 {
            return self.advance_few::<FUSED>(panel, step);
        }
        let size = self.count * N;
        let from = 2 * panel * self.count * W;
        let next = &mut self.next.as_flattened_mut()[from..from + 2 * size];
        let (values, slopes) = next.split_at_mut(size);
        values.fill(0.0);
        slopes.fill(0.0);
        let terms = &self.coordinates.as_flattened()[..(self.truncation.degree + 1) * size];
        let (starts, later) = terms.split_at(2 * size);
        // q = q0 + q1 t + t² v(t): value and slope of v by Horner's rule.
        for terms in later.rchunks(TOGETHER * size) {
            if let Some(four) = split(terms, size) {
                horner_of_four::<FUSED>(step, values, slopes, four);
            } else {
                terms.rchunks(size).for_each(|row| horner::<FUSED>(step, values, slopes, row));
            }
        }
        let starts = starts[..size].iter().zip(&starts[size..]);
        for ((value, slope), (start, rate)) in values.iter_mut().zip(slopes).zip(starts) {
            let double = sum::<FUSED>(step, *slope, 2.0 * *value);
            *slope = sum::<FUSED>(step, double, *rate);
            *value = sum::<FUSED>(step, sum::<FUSED>(step, *value, *rate), *start);
        }
    }

    /// The same for few columns, coordinate by coordinate.
    #[inline(always)]
    fn advance_few<const FUSED: bool>(&mut self, panel: usize, step: f64) {
        let count = self.count;
        let from = 2 * panel * count;
        for at in 0..count {
            let (mut value, mut slope) = ([0.0_f64; W], [0.0_f64; W]);
            let mut place = self.truncation.degree * count + at;
            while place >= 2 * count {
                slope = sums::<W, FUSED>(step, &slope, &value);
                value = sums::<W, FUSED>(step, &value, &self.coordinates[place]);
                place -= count;
            }
            let (rate, start) = (&self.coordinates[count + at], &self.coordinates[at]);
            let slope = sums::<W, FUSED>(step, &slope, &times(2.0, &value));
            self.next[from + count + at] = sums::<W, FUSED>(step, &slope, rate);
            let value = sums::<W, FUSED>(step, &value, rate);
            self.next[from + at] = sums::<W, FUSED>(step, &value, start);
        }
    }

    /// The columns as a square matrix.
    pub(super) fn finish(&self, structure: &impl Structure) -> Matrix {
        let (count, n) = (self.count, self.columns);
        let mut matrix = Matrix::zeros(n, n);
        let mut values = vec![0.0; count];
        let state = self.state.as_flattened();
        for column in 0..n {
            for power in 0..2 {
                let scale = if power == 0 { 1.0 } else { 1.0 / self.speed };
                let (from, width) = self.place(column, power);
                for (at, value) in values.iter_mut().enumerate() {
                    *value = scale * state[from + at * width];
                }
                structure.finish(power, &values, &mut |row, value| matrix[(row, column)] = value);
            }
        }
        matrix
    }
}

/// A store as rows of a panel of `N` columns.
#[inline(always)]
fn narrow<const W: usize, const N: usize>(rows: &mut [[f64; W]]) -> &mut [[f64; N]] {
    rows.as_flattened_mut().as_chunks_mut().0
}

/// The step after which the last two terms are rounding beside the first, rates measured by `speed`.
#[inline(always)]
fn reach<const N: usize>(
    truncation: Truncation,
    speed: f64,
    coordinates: &[[f64; N]],
    count: usize,
) -> f64 {
    let Truncation { degree, rounding } = truncation;
    let rounding = rounding * size(coordinates, 0, count).max(size(coordinates, 1, count) / speed);
    // One after the other: a closure would not be compiled with the instructions at hand.
    let last = longest(rounding, size(coordinates, degree, count), degree);
    last.min(longest(rounding, size(coordinates, degree - 1, count), degree - 1))
}

/// The step after which the term of a power is `rounding`.
#[inline(always)]
fn longest(rounding: f64, size: f64, power: usize) -> f64 {
    if size == 0.0 { f64::INFINITY } else { (rounding / size).powf(1.0 / power as f64) }
}

/// The largest of all coefficients of a power.
#[inline(always)]
fn size<const N: usize>(coordinates: &[[f64; N]], power: usize, count: usize) -> f64 {
    let rows = &coordinates[power * count..(power + 1) * count];
    // Sizes are in the order of their bits, the maximum of which takes whole registers.
    let mut most = 0_i64;
    for value in rows.as_flattened() {
        let bits = value.abs().to_bits().cast_signed();
        most = if bits > most { bits } else { most };
    }
    f64::from_bits(most.cast_unsigned())
}
