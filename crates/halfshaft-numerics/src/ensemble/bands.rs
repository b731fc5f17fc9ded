//! Where the equations change: a quantity leaves the band in which they hold.

use super::Lanes;
use crate::polynomial::first_exit;

/// A quantity and the two levels between which the equations hold as they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Band {
    /// The series that is watched: coordinates first, then helpers.
    pub series: usize,
    /// The parameter with the lower level; minus infinity for none.
    pub lower: usize,
    /// The parameter with the upper level; infinity for none.
    pub upper: usize,
}

/// A trajectory on its way out of a band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// The band that is left.
    pub band: usize,
    /// Whether by its upper end.
    pub up: bool,
    /// When.
    pub time: f64,
    /// How fast the watched quantity changes there.
    pub rate: f64,
}

/// The first exit of one lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exit {
    pub(super) band: usize,
    pub(super) up: bool,
    pub(super) after: f64,
}

/// The level that a lane has just passed, on which it may still be: band and upper end.
pub(super) type Entered = Option<(usize, bool)>;

/// Whether any lane may leave a band within its step: where the sum of all terms is less than the
/// distance, none does.
#[inline(always)]
pub(super) fn may_leave<L: Lanes>(x: &[L], lower: L, upper: L, step: L) -> bool {
    let zero = L::splat(0.0);
    let reach = x[1..].iter().rev().fold(zero, |sum, term| (sum + term.abs()) * step);
    let below = (x[0] - lower).any(reach, |distance, reach| distance <= reach);
    below | (upper - x[0]).any(reach, |distance, reach| distance <= reach)
}

/// The earliest exit within `step` of one lane from a band, if it comes before `best`.
pub(super) fn exit(
    x: &[f64],
    levels: [f64; 2],
    step: f64,
    band: usize,
    entered: Entered,
    best: Option<Exit>,
) -> Option<Exit> {
    let mut best = best;
    let mut ends = [(false, levels[0], 1.0), (true, levels[1], -1.0)];
    // The end that lies ahead is mostly the one: the other then need not be looked at any further.
    if x.get(1).is_some_and(|rate| *rate > 0.0) {
        ends.reverse();
    }
    for (up, level, sign) in ends {
        if !level.is_finite() {
            continue;
        }
        let reach = best.map_or(step, |exit| exit.after);
        let on_it = entered == Some((band, up));
        if let Some(after) = first_exit(x, reach, level, sign, on_it)
            && best.is_none_or(|exit| after < exit.after)
        {
            best = Some(Exit { band, up, after });
        }
    }
    best
}
