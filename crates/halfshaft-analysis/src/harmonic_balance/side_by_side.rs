//! Monodromy matrices of several orbits of a small smooth line at once, an orbit in each lane.
//!
//! The same Taylor series as in [`super::monodromy`], over the phase of the response in place of time:
//! with `' = d/dθ`, `θ = ω t`, each orbit has its own
//!
//! ```text
//! M q'' = -Σ_e w_e [ k_e(θ) x_e / ω² + c_e x_e' / ω ] - D q' / ω
//! ```
//!
//! while the waves of the orders, the steps and all indices are those of every orbit. A line of few
//! groups leaves most of the width of the processor unused otherwise.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::{Piece, Pieces};
use halfshaft_numerics::dense::Matrix;

use super::lanes::Rows;
use super::monodromy::Orbit;
use super::series::{Truncation, Waves};
use super::structure::{Structure, axpy, sums};
use super::whole_line::WholeLine;

/// Orbits at once.
pub(super) const ORBITS: usize = 8;
/// A number of each orbit.
type Lane = [f64; ORBITS];
/// Columns from which on a line fills the processor by itself.
const MANY: usize = 8;
/// Steps a period at most.
const MOST_STEPS: usize = 400;
/// How far the series go.
const TRUNCATION: Truncation = Truncation::SHORT;
/// Coefficients of a series.
const TERMS: usize = TRUNCATION.degree + 1;

/// A line whose orbits can be taken side by side.
#[derive(Clone, Debug)]
pub(super) struct SideBySide {
    /// The one piece of the law of each connection; `None` for linear ones.
    laws: Vec<Option<Piece>>,
}

impl SideBySide {
    /// `None` for a line of many groups, with friction, or with laws of several pieces, which orbits
    /// leave at phases of their own.
    pub(super) fn new(equations: &EquationsOfMotion, laws: &[Option<Pieces>]) -> Option<Self> {
        let few = WholeLine::new(equations).columns() <= MANY;
        let rubs = equations.connections.iter().any(|c| c.friction.is_some());
        let single = |law: &Option<Pieces>| match law.as_ref().map(Pieces::list) {
            None => Some(None),
            Some([piece]) => Some(Some(piece.clone())),
            Some(_) => None,
        };
        let laws = laws.iter().map(single).collect::<Option<_>>()?;
        (few && !rubs).then_some(Self { laws })
    }

    /// The fundamental matrices of [`ORBITS`] orbits at most, all over the same harmonics, from phase
    /// 0 to `end`, in twists and their rates over the fundamental frequency; `None` where the steps
    /// are too many.
    pub(super) fn monodromy(
        &self,
        equations: &EquationsOfMotion,
        orbits: &[Orbit<'_>],
        end: f64,
    ) -> Option<Vec<Matrix>> {
        let line = WholeLine::new(equations);
        if line.columns() <= 2 {
            self.run::<2>(equations, &line, orbits, end)
        } else {
            self.run::<4>(equations, &line, orbits, end)
        }
    }

    fn run<const C: usize>(
        &self,
        equations: &EquationsOfMotion,
        line: &WholeLine<'_>,
        orbits: &[Orbit<'_>],
        end: f64,
    ) -> Option<Vec<Matrix>> {
        let mut columns = Columns::<C>::new(line, self.tangents(equations, orbits));
        let waves = Waves::new(orbits.first()?.set);
        let arch = pulp::Arch::new();
        let state = &mut columns;
        if matches!(arch, pulp::Arch::Scalar) {
            arch.dispatch(Period::<C, false> { columns: state, orbits, waves, end })?;
        } else {
            arch.dispatch(Period::<C, true> { columns: state, orbits, waves, end })?;
        }
        Some((0..orbits.len()).map(|lane| columns.matrix(line, lane)).collect())
    }

    /// What the connections oppose to changes, the lanes that are left over as copies of the first.
    fn tangents(&self, equations: &EquationsOfMotion, orbits: &[Orbit<'_>]) -> Vec<Tangent> {
        let of = |lane: usize| orbits.get(lane).unwrap_or(&orbits[0]);
        let inverse: Lane = std::array::from_fn(|lane| 1.0 / of(lane).speed);
        let connections = equations.connections.iter().zip(&self.laws).enumerate();
        let tangent = |(index, (connection, law)): (usize, (_, &Option<Piece>))| {
            let connection: &halfshaft_dynamics::Connection = connection;
            let twist = |lane: usize| {
                of(lane).twists.iter().find(|(at, _)| *at == index).map(|(_, twist)| twist)
            };
            let law = law.as_ref().filter(|_| twist(0).is_some());
            let count = if law.is_some() { of(0).set.coefficients() } else { 0 };
            let coefficient = |at: usize| -> Lane {
                std::array::from_fn(|lane| twist(lane).map_or(0.0, |twist| twist[at]))
            };
            let constant = connection.law.stiffness(0.0);
            let mut stiffness = Rows::zeros(TERMS);
            stiffness[0] = inverse.map(|inverse| constant * inverse * inverse);
            Tangent {
                law: law.cloned(),
                twist: (0..count).map(coefficient).collect(),
                terms: if law.is_some() { TERMS } else { 1 },
                stiffness,
                damping: inverse.map(|inverse| connection.damping * inverse),
                inverse,
            }
        };
        connections.map(tangent).collect()
    }
}

/// Tangent stiffness and damping of one connection in all orbits, over the phase.
struct Tangent {
    law: Option<Piece>,
    /// Coefficients of the twist.
    twist: Vec<Lane>,
    /// Coefficients of the stiffness by power of the phase.
    stiffness: Rows<ORBITS>,
    terms: usize,
    damping: Lane,
    /// One over the fundamental frequencies.
    inverse: Lane,
}

impl Tangent {
    /// Writes the stiffness `P'(x - origin)` along the twist about the phase of `waves`; `x` and
    /// `store` have a row for each power.
    #[inline(always)]
    fn expand<const FUSED: bool>(
        &mut self,
        waves: &Waves,
        orbit: &Orbit<'_>,
        x: &mut [Lane],
        store: &mut [Lane],
    ) {
        let Some(law) = &self.law else { return };
        waves.sums(orbit.set, &self.twist, x);
        x[0] = x[0].map(|x| x - law.origin);
        let out = &mut self.stiffness[..];
        out.fill([0.0; ORBITS]);
        let powers = law.torque.coefficients().iter().enumerate().skip(1).rev();
        for (step, (power, k)) in powers.enumerate() {
            match step {
                0 => {}
                1 => {
                    let highest = out[0];
                    for (out, x) in out.iter_mut().zip(&*x) {
                        *out = std::array::from_fn(|lane| highest[lane] * x[lane]);
                    }
                }
                _ => {
                    store.copy_from_slice(out);
                    product::<FUSED>(store, x, out);
                }
            }
            out[0] = out[0].map(|sum| sum + power as f64 * k);
        }
        let scale: Lane = self.inverse.map(|inverse| inverse * inverse);
        for row in out {
            *row = std::array::from_fn(|lane| row[lane] * scale[lane]);
        }
    }
}

/// Product of two series of as many terms, cut off after as many.
#[inline(always)]
fn product<const FUSED: bool>(a: &[Lane], b: &[Lane], out: &mut [Lane]) {
    for (power, out) in out.iter_mut().enumerate() {
        let mut sum = [0.0; ORBITS];
        for (a, b) in a[..=power].iter().zip(b[..=power].iter().rev()) {
            add_product::<FUSED>(a, b, &mut sum);
        }
        *out = sum;
    }
}

/// `out += a b` in each lane.
#[inline(always)]
fn add_product<const FUSED: bool>(a: &Lane, b: &Lane, out: &mut Lane) {
    for lane in 0..ORBITS {
        out[lane] = super::structure::sum::<FUSED>(a[lane], b[lane], out[lane]);
    }
}

/// The columns of all matrices at one phase, `C` in a panel.
struct Columns<const C: usize> {
    tangents: Vec<Tangent>,
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
    columns: usize,
}

impl<const C: usize> Columns<C> {
    fn new(line: &WholeLine<'_>, tangents: Vec<Tangent>) -> Self {
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
        let inverse = tangents.first().map_or([0.0; ORBITS], |tangent| tangent.inverse);
        let body = |(m, d): (&f64, &f64)| (1.0 / m, inverse.map(|inverse| d * inverse));
        let bodies = equations.inertia.iter().zip(&equations.ground_damping).map(body).collect();
        let ends = equations.connections.iter();
        let ends = ends.map(|c| [c.from, c.to.map(|(group, ratio)| (group, -ratio))]).collect();
        Self {
            twists: Rows::zeros(tangents.len() * TERMS * C),
            net: Rows::zeros(groups * C),
            tangents,
            coordinates,
            bodies,
            ends,
            groups,
            columns,
        }
    }

    /// All coefficients of a panel from those of powers 0 and 1.
    #[inline(always)]
    fn recur<const FUSED: bool>(&mut self, panel: usize) {
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
    fn reach(&self) -> f64 {
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
    fn advance<const FUSED: bool>(&mut self, step: f64) {
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
    fn matrix(&self, line: &WholeLine<'_>, lane: usize) -> Matrix {
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

/// All steps from phase 0 to `end`, as work that runs with the widest instructions of the processor.
struct Period<'p, 'o, const C: usize, const FUSED: bool> {
    columns: &'p mut Columns<C>,
    orbits: &'p [Orbit<'o>],
    waves: Waves,
    end: f64,
}

impl<const C: usize, const FUSED: bool> pulp::NullaryFnOnce for Period<'_, '_, C, FUSED> {
    /// Nothing where the steps are too many.
    type Output = Option<()>;

    #[inline(always)]
    fn call(self) -> Option<()> {
        let Self { columns, orbits, mut waves, end } = self;
        let panels = columns.columns.div_ceil(C);
        let (mut x, mut store) = (Rows::<ORBITS>::zeros(TERMS), Rows::<ORBITS>::zeros(TERMS));
        let mut phase = 0.0;
        for _ in 0..MOST_STEPS {
            waves.about(orbits[0].set, 1.0, phase, TRUNCATION.degree);
            for tangent in &mut columns.tangents {
                tangent.expand::<FUSED>(&waves, &orbits[0], &mut x, &mut store);
            }
            for panel in 0..panels {
                columns.recur::<FUSED>(panel);
            }
            let left = end - phase;
            let count = (left / columns.reach()).ceil().max(1.0);
            if !(count <= MOST_STEPS as f64) {
                return None;
            }
            columns.advance::<FUSED>(left / count);
            if count == 1.0 {
                return Some(());
            }
            phase += left / count;
        }
        None
    }
}
