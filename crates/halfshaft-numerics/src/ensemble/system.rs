//! What can be integrated over lanes.

use super::{Band, Lanes};

/// Equations of motion `q'' = a(t, q, q')` by their Taylor series in time.
///
/// Every trajectory has parameters of its own. All methods must depend on their arguments alone.
pub trait SeriesSystem: Sync {
    /// Number of coordinates `q`, at least one. States are `[q.., q'..]`.
    fn coordinates(&self) -> usize;

    /// Number of parameters of a trajectory.
    fn parameters(&self) -> usize;

    /// Number of series beside those of the coordinates that the recurrence needs.
    fn helpers(&self) -> usize;

    /// Fills the coefficients of all coordinates and of the helpers that bands watch, given those of
    /// the powers 0 and 1 of the coordinates.
    ///
    /// To be marked `#[inline(always)]`, so that it is compiled for the instructions in use.
    fn expand<L: Lanes>(&self, expansion: &mut Expansion<'_, L>);

    /// The bands in which the equations hold.
    fn bands(&self) -> &[Band] {
        &[]
    }

    /// A trajectory has left a band by its upper or lower end: changes its parameters, those of the
    /// band's ends included.
    fn pass(&self, _band: usize, _up: bool, _parameters: &mut dyn Parameters) {}
}

/// The parameters of one trajectory, wherever they stand.
pub trait Parameters {
    /// The parameter of that number.
    fn get(&self, number: usize) -> f64;

    /// Gives it another value.
    fn set(&mut self, number: usize, value: f64);
}

impl Parameters for &mut [f64] {
    fn get(&self, number: usize) -> f64 {
        self[number]
    }

    fn set(&mut self, number: usize, value: f64) {
        self[number] = value;
    }
}

/// The series about one time of all trajectories of a batch.
pub struct Expansion<'e, L> {
    /// Coefficients of a series: powers from 0 to one less.
    pub terms: usize,
    /// The times.
    pub time: L,
    /// Parameters of the trajectories.
    pub parameters: &'e [L],
    /// Coordinates, one after the other, `terms` coefficients each.
    pub coordinates: &'e mut [L],
    /// Helpers in the same way.
    pub helpers: &'e mut [L],
}

/// A system of ordinary differential equations `y' = f(t, y)` over lanes.
///
/// Every trajectory has parameters of its own. All methods must depend on their arguments alone.
pub trait LaneSystem: Sync {
    /// Number of components of the state, at least one.
    fn dimension(&self) -> usize;

    /// Number of parameters of a trajectory.
    fn parameters(&self) -> usize;

    /// Writes `f(t, state)` to `rate`.
    ///
    /// To be marked `#[inline(always)]`, so that it is compiled for the instructions in use.
    fn derivative<L: Lanes>(&self, time: L, parameters: &[L], state: &[L], rate: &mut [L]);
}
