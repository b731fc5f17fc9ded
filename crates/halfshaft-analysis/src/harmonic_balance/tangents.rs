//! Taylor series of the tangents of all connections along an orbit, as far as a step needs them.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::Piece;

use super::monodromy::Orbit;
use super::panels::Tangent;
use super::series::{MOST, Waves, friction_slope, stiffness};

/// Terms of a tangent stiffness that change a step by less than this part are left out.
const NEGLIGIBLE: f64 = 1e-15;
/// Terms beyond those that matter by which it is told that a series has died out.
const SPARE: usize = 4;

/// Where along an orbit tangents are expanded.
pub(super) struct Place<'p> {
    pub(super) equations: &'p EquationsOfMotion,
    pub(super) orbit: &'p Orbit<'p>,
    /// The piece of each nonlinear law that the twist is on.
    pub(super) pieces: &'p [Option<Piece>],
    pub(super) t: f64,
    /// Time over which the series are needed.
    pub(super) reach: f64,
}

/// Powers of time of the tangents.
pub(super) struct Degree {
    /// How far they were needed last.
    enough: usize,
    most: usize,
}

impl Degree {
    pub(super) fn new(most: usize) -> Self {
        Self { enough: most, most }
    }
}

impl Place<'_> {
    /// Writes the tangents of the nonlinear ones of the listed connections, ascending, as far as they
    /// matter: most die out long before the last power of time that the columns take.
    pub(super) fn expand(
        &self,
        list: &[usize],
        waves: &mut Waves,
        degree: &mut Degree,
        tangents: &mut [Tangent],
    ) {
        // Beyond this power the terms of all orders die out.
        let turn = 2.0 * self.orbit.set.highest() as f64 * self.orbit.speed * self.reach;
        if degree.enough as f64 <= turn {
            degree.enough = degree.most;
        }
        loop {
            let work = Work { place: self, list, waves, degree: degree.enough, tangents };
            let terms = pulp::Arch::new().dispatch(work);
            let died_out = terms + SPARE <= degree.enough + 1;
            let done = died_out || degree.enough == degree.most;
            degree.enough = if died_out { (terms + SPARE).min(degree.most) } else { degree.most };
            if done {
                return;
            }
        }
    }

    /// The same to a power of time; gives the number of terms that matter.
    #[inline(always)]
    fn expand_to(
        &self,
        list: &[usize],
        waves: &mut Waves,
        degree: usize,
        tangents: &mut [Tangent],
    ) -> usize {
        let mut x = [0.0; MOST + 1];
        let mut most = 0;
        waves.about(self.orbit.set, self.orbit.speed, self.t, degree);
        for (connection, twist) in self.orbit.twists {
            let Some(piece) = &self.pieces[*connection] else { continue };
            let Ok(place) = list.binary_search(connection) else { continue };
            let tangent = &mut tangents[place];
            let connection = &self.equations.connections[*connection];
            waves.sum(self.orbit.set, twist, &mut x);
            stiffness(piece, &x, degree, &mut tangent.stiffness);
            tangent.stiffness_terms = terms(&tangent.stiffness[..=degree], self.reach);
            most = most.max(tangent.stiffness_terms);
            if let Some(friction) = &connection.friction {
                friction_slope(friction, &x, degree, &mut tangent.damping);
                tangent.damping[0] += connection.damping;
                tangent.damping_terms = terms(&tangent.damping[..=degree], self.reach);
                most = most.max(tangent.damping_terms);
            }
        }
        most
    }
}

/// Tangents to a power of time, as work that runs with the widest instructions of the processor.
struct Work<'w, 'p> {
    place: &'w Place<'p>,
    list: &'w [usize],
    waves: &'w mut Waves,
    degree: usize,
    tangents: &'w mut [Tangent],
}

impl pulp::NullaryFnOnce for Work<'_, '_> {
    /// The number of terms that matter.
    type Output = usize;

    #[inline(always)]
    fn call(self) -> usize {
        self.place.expand_to(self.list, self.waves, self.degree, self.tangents)
    }
}

/// Tangents of the listed connections as if all were linear.
pub(super) fn linear_tangents(equations: &EquationsOfMotion, list: &[usize]) -> Vec<Tangent> {
    let zero = [0.0; MOST + 1];
    let of = |index: &usize| {
        let connection = &equations.connections[*index];
        let (mut stiffness, mut damping) = (zero, zero);
        stiffness[0] = connection.law.stiffness(0.0);
        damping[0] = connection.damping;
        Tangent { stiffness, stiffness_terms: 1, damping, damping_terms: 1 }
    };
    list.iter().map(of).collect()
}

/// Terms of a series until the rest is rounding over a step of the given length.
#[inline(always)]
fn terms(series: &[f64], reach: f64) -> usize {
    let mut power = 1.0;
    let mut largest = 0.0_f64;
    let mut last = 0;
    for (index, value) in series.iter().enumerate() {
        let size = (value * power).abs();
        largest = largest.max(size);
        if size > NEGLIGIBLE * largest {
            last = index;
        }
        power *= reach;
    }
    last + 1
}
