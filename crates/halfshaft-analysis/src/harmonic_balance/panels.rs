//! Columns of the variational equation, panel by panel, by Taylor series.
//!
//! A panel has as many columns as fit the registers and keep the coefficients of all groups in the
//! cache; all panels take the same steps.

use halfshaft_numerics::dense::Matrix;

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

/// Powers of time that are summed at once.
const TOGETHER: usize = 4;

/// Columns of the variational equation at one time.
pub(super) struct Panels<const W: usize> {
    /// Coordinates, then their rates, panel after panel.
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

/// One step of one panel, or only its coefficients where no step is given, as work that runs with the
/// widest instructions of the processor: a structure and no closure, because only that is sure to be
/// compiled with them.
struct PanelStep<'p, 'e, S: Structure, const W: usize, const FUSED: bool> {
    panels: &'p mut Panels<W>,
    structure: &'e S,
    tangents: &'e [Tangent],
    panel: usize,
    step: Option<f64>,
}

impl<S: Structure, const W: usize, const FUSED: bool> pulp::NullaryFnOnce
    for PanelStep<'_, '_, S, W, FUSED>
{
    /// The longest step that the terms of the panel allow.
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { panels, structure, tangents, panel, step } = self;
        panels.load(panel);
        let Panels { coordinates, twists, net, truncation, .. } = panels;
        structure.recur::<W, FUSED>(tangents, truncation.degree, coordinates, twists, net);
        let reach = panels.reach();
        if let Some(step) = step {
            panels.advance::<FUSED>(panel, step);
        }
        reach
    }
}

impl<const W: usize> Panels<W> {
    /// The columns that the structure starts with.
    pub(super) fn new(structure: &impl Structure, speed: f64, truncation: Truncation) -> Self {
        let (count, columns) = (structure.coordinates(), structure.columns());
        let panels = columns.div_ceil(W);
        let mut state = Rows::<W>::zeros(panels * 2 * count);
        structure.start(speed, &mut |column, power, values| {
            let from = (2 * (column / W) + power) * count;
            for (row, value) in state[from..from + count].iter_mut().zip(values) {
                row[column % W] = *value;
            }
        });
        Self {
            next: Rows::zeros(state.len()),
            state,
            coordinates: Rows::zeros(TERMS * count),
            twists: Rows::zeros(TERMS * structure.connections().len()),
            net: Rows::zeros(count),
            arch: pulp::Arch::new(),
            columns,
            count,
            speed,
            truncation,
        }
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
        let arch = self.arch;
        if matches!(arch, pulp::Arch::Scalar) {
            let panels = self;
            arch.dispatch(PanelStep::<_, W, false> { panels, structure, tangents, panel, step })
        } else {
            let panels = self;
            arch.dispatch(PanelStep::<_, W, true> { panels, structure, tangents, panel, step })
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
    fn load(&mut self, panel: usize) {
        let from = 2 * panel * self.count;
        self.coordinates[..2 * self.count]
            .copy_from_slice(&self.state[from..from + 2 * self.count]);
    }

    /// The step after which the last two terms are rounding beside the first.
    #[inline(always)]
    fn reach(&self) -> f64 {
        let scale = self.size(0).max(self.size(1) / self.speed);
        let degree = self.truncation.degree;
        // One after the other: a closure would not be compiled with the instructions at hand.
        let last = self.longest(scale, degree);
        last.min(self.longest(scale, degree - 1))
    }

    /// The step after which the term of a power is rounding beside `scale`.
    #[inline(always)]
    fn longest(&self, scale: f64, power: usize) -> f64 {
        match self.size(power) {
            0.0 => f64::INFINITY,
            size => (self.truncation.rounding * scale / size).powf(1.0 / power as f64),
        }
    }

    /// The largest of all coefficients of a power.
    #[inline(always)]
    fn size(&self, power: usize) -> f64 {
        let rows = &self.coordinates[power * self.count..(power + 1) * self.count];
        // Sizes are in the order of their bits, the maximum of which takes whole registers.
        let mut most = 0_i64;
        for value in rows.as_flattened() {
            let bits = value.abs().to_bits().cast_signed();
            most = if bits > most { bits } else { most };
        }
        f64::from_bits(most.cast_unsigned())
    }

    /// Writes coordinates and rates after `step` to the next state.
    #[inline(always)]
    fn advance<const FUSED: bool>(&mut self, panel: usize, step: f64) {
        let size = self.count * W;
        if W < 8 {
            return self.advance_few::<FUSED>(panel, step);
        }
        let next = &mut self.next.as_flattened_mut()[2 * panel * size..2 * (panel + 1) * size];
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
        for column in 0..n {
            for power in 0..2 {
                let scale = if power == 0 { 1.0 } else { 1.0 / self.speed };
                let from = (2 * (column / W) + power) * count;
                for (value, row) in values.iter_mut().zip(&self.state[from..from + count]) {
                    *value = scale * row[column % W];
                }
                structure.finish(power, &values, &mut |row, value| matrix[(row, column)] = value);
            }
        }
        matrix
    }
}

/// The terms of as many powers as are summed at once, each of `size` numbers; `None` where there are
/// fewer.
#[inline(always)]
fn split(terms: &[f64], size: usize) -> Option<[&[f64]; TOGETHER]> {
    if terms.len() != TOGETHER * size {
        return None;
    }
    let (low, high) = terms.split_at(2 * size);
    let ((first, second), (third, fourth)) = (low.split_at(size), high.split_at(size));
    Some([first, second, third, fourth])
}

/// A step of Horner's rule down to the next power, for values and their slopes.
#[inline(always)]
fn horner<const FUSED: bool>(step: f64, values: &mut [f64], slopes: &mut [f64], terms: &[f64]) {
    for ((value, slope), term) in values.iter_mut().zip(slopes).zip(terms) {
        *slope = sum::<FUSED>(step, *slope, *value);
        *value = sum::<FUSED>(step, *value, *term);
    }
}

/// Four such steps, down to the first of the powers.
#[inline(always)]
fn horner_of_four<const FUSED: bool>(
    step: f64,
    values: &mut [f64],
    slopes: &mut [f64],
    [a, b, c, d]: [&[f64]; TOGETHER],
) {
    let terms = a.iter().zip(b).zip(c.iter().zip(d));
    for ((value, slope), ((a, b), (c, d))) in values.iter_mut().zip(slopes).zip(terms) {
        let (mut v, mut s) = (*value, *slope);
        for term in [d, c, b, a] {
            s = sum::<FUSED>(step, s, v);
            v = sum::<FUSED>(step, v, *term);
        }
        (*value, *slope) = (v, s);
    }
}
