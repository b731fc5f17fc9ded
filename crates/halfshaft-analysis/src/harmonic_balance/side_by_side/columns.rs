//! Columns of the monodromy matrices of several orbits, from step to step.

use halfshaft_numerics::dense::Matrix;

use super::super::lanes::Rows;
use super::super::structure::{Structure, axpy, sums};
use super::super::whole_line::WholeLine;
use super::tangent::{Tangent, add_product};
use super::{Lane, ORBITS, TERMS, TRUNCATION};

/// The columns of all matrices at one phase, `C` in a panel.
pub(super) struct Columns<const C: usize> {
    pub(super) tangents: Vec<Tangent>,
    /// One over the fundamental frequencies.
    pub(super) inverse: Lane,
    /// Coefficients of the coordinates: panel, power, coordinate, column.
    coordinates: Rows<ORBITS>,
    /// Of the twists of the panel at hand: connection, power, column.
    twists: Rows<ORBITS>,
    /// Coordinate, column.
    net: Rows<ORBITS>,
    /// One over the inertia, and the damping to ground over it, of each coordinate.
    bodies: Vec<(f64, Lane)>,
    ends: Vec<[Option<(usize, f64)>; 2]>,
    groups: usize,
    pub(super) columns: usize,
}

impl<const C: usize> Columns<C> {
    pub(super) fn new(line: &WholeLine<'_>, tangents: Vec<Tangent>, inverse: Lane) -> Self {
        let equations = line.equations();
        let (groups, columns) = (line.coordinates(), line.columns());
        let panels = columns.div_ceil(C);
        let mut coordinates = Rows::<ORBITS>::zeros(panels * TERMS * groups * C);
        line.start(1.0, &mut |column, power, values| {
            let first = (column / C * TERMS + power) * groups * C + column % C;
            for (at, value) in values.iter().enumerate() {
                coordinates[first + at * C] = [*value; ORBITS];
            }
        });
        let body = |(m, d): (&f64, &f64)| (1.0 / m, inverse.map(|inverse| d * inverse));
        let bodies = equations.inertia.iter().zip(&equations.ground_damping).map(body).collect();
        let ends = equations.connections.iter();
        let ends = ends.map(|c| [c.from, c.to.map(|(group, ratio)| (group, -ratio))]).collect();
        Self {
            twists: Rows::zeros(tangents.len() * TERMS * C),
            net: Rows::zeros(groups * C),
            tangents,
            inverse,
            coordinates,
            bodies,
            ends,
            groups,
            columns,
        }
    }

    /// All coefficients of a panel from those of powers 0 and 1.
    #[inline(always)]
    pub(super) fn recur<const FUSED: bool>(&mut self, panel: usize) {
        let groups = self.groups;
        let size = TERMS * groups;
        let q = &mut self.coordinates.as_chunks_mut::<C>().0[panel * size..(panel + 1) * size];
        let net = self.net.as_chunks_mut::<C>().0;
        let rows = self.twists.as_chunks_mut::<C>().0;
        for (ends, row) in self.ends.iter().zip(rows.chunks_exact_mut(TERMS)) {
            row[0] = twist::<C, FUSED>(ends, &q[..groups]);
        }
        for power in 0..TERMS - 2 {
            let (known, later) = q.split_at_mut((power + 2) * groups);
            let rates = &known[(power + 1) * groups..];
            let next = (power + 1) as f64;
            net.fill([[0.0; ORBITS]; C]);
            let rows = rows.chunks_exact_mut(TERMS);
            for ((ends, tangent), row) in self.ends.iter().zip(&self.tangents).zip(rows) {
                row[power + 1] = twist::<C, FUSED>(ends, rates);
                let torque = torque::<C, FUSED>(tangent, row, power);
                for (group, ratio) in ends.iter().flatten() {
                    for (net, torque) in net[*group].iter_mut().zip(&torque) {
                        axpy::<ORBITS, FUSED>(-ratio, torque, net);
                    }
                }
            }
            let bodies = self.bodies.iter().zip(&*net).zip(rates).zip(later);
            for ((((yielding, damping), net), rates), out) in bodies {
                let factor = yielding / (next * (next + 1.0));
                let slowed = damping.map(|damping| -next * damping);
                for ((net, rate), out) in net.iter().zip(rates).zip(out) {
                    let mut sum = *net;
                    add_product::<FUSED>(&slowed, rate, &mut sum);
                    *out = sum.map(|sum| factor * sum);
                }
            }
        }
    }

    /// The step after which the last two terms of all orbits are rounding beside the first.
    #[inline(always)]
    pub(super) fn reach(&self) -> f64 {
        let last = TERMS - 1;
        let [mut first, mut high, mut low] = [[0.0_f64; ORBITS]; 3];
        for panel in self.coordinates.chunks_exact(TERMS * self.groups * C) {
            let width = self.groups * C;
            let of = |power: usize| &panel[power * width..(power + 1) * width];
            let parts = of(0).iter().zip(of(1)).zip(of(last - 1)).zip(of(last));
            for (((value, rate), before), end) in parts {
                for lane in 0..ORBITS {
                    first[lane] = first[lane].max(value[lane].abs()).max(rate[lane].abs());
                    low[lane] = low[lane].max(before[lane].abs());
                    high[lane] = high[lane].max(end[lane].abs());
                }
            }
        }
        let steps = [(low, last - 1), (high, last)].map(|(sizes, power)| {
            let ratios = sizes.iter().zip(&first).map(|(size, first)| size / first);
            (TRUNCATION.rounding / ratios.fold(0.0, f64::max)).powf(1.0 / power as f64)
        });
        steps[0].min(steps[1])
    }

    /// Moves all columns on by a step, by Horner's rule for values and slopes.
    #[inline(always)]
    pub(super) fn advance<const FUSED: bool>(&mut self, step: f64) {
        let width = self.groups * C;
        for panel in self.coordinates.chunks_exact_mut(TERMS * width) {
            for at in 0..width {
                let (mut value, mut slope) = ([0.0; ORBITS], [0.0; ORBITS]);
                for power in (0..TERMS).rev() {
                    slope = sums::<ORBITS, FUSED>(step, &slope, &value);
                    value = sums::<ORBITS, FUSED>(step, &value, &panel[power * width + at]);
                }
                (panel[at], panel[width + at]) = (value, slope);
            }
        }
    }

    /// The matrix of one orbit.
    pub(super) fn matrix(&self, line: &WholeLine<'_>, lane: usize) -> Matrix {
        let mut matrix = Matrix::zeros(self.columns, self.columns);
        let mut values = vec![0.0; self.groups];
        for column in 0..self.columns {
            for power in 0..2 {
                let first = (column / C * TERMS + power) * self.groups * C + column % C;
                for (at, value) in values.iter_mut().enumerate() {
                    *value = self.coordinates[first + at * C][lane];
                }
                line.finish(power, &values, &mut |row, value| matrix[(row, column)] = value);
            }
        }
        matrix
    }
}

/// Twist of a connection in all columns of a panel.
#[inline(always)]
fn twist<const C: usize, const FUSED: bool>(
    ends: &[Option<(usize, f64)>; 2],
    angles: &[[Lane; C]],
) -> [Lane; C] {
    let mut twist = [[0.0; ORBITS]; C];
    for (group, ratio) in ends.iter().flatten() {
        for (twist, angle) in twist.iter_mut().zip(&angles[*group]) {
            axpy::<ORBITS, FUSED>(*ratio, angle, twist);
        }
    }
    twist
}

/// Coefficient of the torque of a connection at a power of the phase.
#[inline(always)]
fn torque<const C: usize, const FUSED: bool>(
    tangent: &Tangent,
    row: &[[Lane; C]],
    power: usize,
) -> [Lane; C] {
    let next = (power + 1) as f64;
    let damping = tangent.damping.map(|damping| next * damping);
    let mut torque = [[0.0; ORBITS]; C];
    for (torque, rate) in torque.iter_mut().zip(&row[power + 1]) {
        *torque = std::array::from_fn(|lane| damping[lane] * rate[lane]);
    }
    let terms = tangent.terms.min(power + 1);
    for (k, x) in tangent.stiffness[..terms].iter().zip(row[..=power].iter().rev()) {
        for (torque, x) in torque.iter_mut().zip(x) {
            add_product::<FUSED>(k, x, torque);
        }
    }
    torque
}
