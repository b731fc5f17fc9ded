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

mod columns;
mod tangent;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::{Piece, Pieces};
use halfshaft_numerics::dense::Matrix;

use super::lanes::Rows;
use super::monodromy::Orbit;
use super::series::{Truncation, Waves};
use super::structure::Structure;
use super::whole_line::WholeLine;
use columns::Columns;
use tangent::Tangent;

/// Orbits at once.
pub(super) const ORBITS: usize = 8;
/// A number of each orbit.
type Lane = [f64; ORBITS];
/// Columns from which on a line fills the processor by itself.
const MANY: usize = 8;
/// Steps of the way to `end` at most.
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
        orbits.first()?;
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
        // Lanes that are left over are copies of the first.
        let lanes = std::array::from_fn(|lane| orbits.get(lane).unwrap_or(&orbits[0]));
        let inverse: Lane = lanes.map(|orbit| 1.0 / orbit.speed);
        let tangents = self.tangents(equations, &lanes, &inverse);
        let mut columns = Columns::<C>::new(line, tangents, inverse);
        let waves = Waves::new(orbits[0].set);
        let arch = pulp::Arch::new();
        let state = &mut columns;
        if matches!(arch, pulp::Arch::Scalar) {
            arch.dispatch(Period::<C, false> { columns: state, orbits, waves, end })?;
        } else {
            arch.dispatch(Period::<C, true> { columns: state, orbits, waves, end })?;
        }
        Some((0..orbits.len()).map(|lane| columns.matrix(line, lane)).collect())
    }

    /// What the connections oppose to changes.
    fn tangents(
        &self,
        equations: &EquationsOfMotion,
        lanes: &[&Orbit<'_>; ORBITS],
        inverse: &Lane,
    ) -> Vec<Tangent> {
        let connections = equations.connections.iter().zip(&self.laws).enumerate();
        let tangent = |(index, (connection, law)): (usize, (_, &Option<Piece>))| {
            let connection: &halfshaft_dynamics::Connection = connection;
            let twists = lanes.map(|orbit| {
                orbit.twists.iter().find(|(at, _)| *at == index).map(|(_, twist)| twist)
            });
            let law = law.as_ref().filter(|_| twists[0].is_some());
            let count = if law.is_some() { lanes[0].set.coefficients() } else { 0 };
            let coefficient = |at: usize| twists.map(|twist| twist.map_or(0.0, |twist| twist[at]));
            let constant = connection.law.stiffness(0.0);
            let mut stiffness = Rows::zeros(TERMS);
            stiffness[0] = inverse.map(|inverse| constant * inverse * inverse);
            Tangent {
                law: law.cloned(),
                twist: (0..count).map(coefficient).collect(),
                terms: if law.is_some() { TERMS } else { 1 },
                stiffness,
                damping: inverse.map(|inverse| connection.damping * inverse),
            }
        };
        connections.map(tangent).collect()
    }
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
        let scale = columns.inverse.map(|inverse| inverse * inverse);
        let mut phase = 0.0;
        for _ in 0..MOST_STEPS {
            waves.about(orbits[0].set, 1.0, phase, TRUNCATION.degree);
            for tangent in &mut columns.tangents {
                tangent.expand::<FUSED>(&waves, &orbits[0], (&scale, &mut x, &mut store));
            }
            for panel in 0..panels {
                columns.recur::<FUSED>(panel);
            }
            let left = end - phase;
            let count = (left / columns.reach()).ceil().max(1.0);
            if count.is_nan() || count > MOST_STEPS as f64 {
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
