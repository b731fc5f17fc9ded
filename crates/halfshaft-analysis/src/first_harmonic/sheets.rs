//! The first harmonic of any law over the amplitude, as certified cells.
//!
//! The mean in balance does not depend on the frequency. So the curves `m(a)` are covered once, on a
//! lattice of amplitudes, by cells in each of which exactly one mean is held (`M_0 + κ > 0`), with
//! bounds on the harmonic `F` and its slope there. At each frequency the equation is then tried on
//! the cells. Means that are not held, tops of a softening law, have no cells: no lasting motion
//! stays there. Within 1e-6 of an amplitude at which a mean ceases to be held there may be no cell
//! either.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use super::enclosure::{LawBounds, Region};
use super::shaft_law::{Balanced, ShaftLaw, contact_moments};

/// Ratio of neighbouring amplitudes of the lattice.
const RATIO: f64 = 1.06;
/// Intervals of amplitude are halved down to this part.
const NARROWEST: f64 = 1e-6;
/// Most boxes looked at for the means of one interval of amplitudes.
const MOST_BOXES: usize = 4000;

/// One mean over an interval of amplitudes, with bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    pub(super) from: f64,
    pub(super) to: f64,
    /// At the middle.
    pub(super) middle: f64,
    pub(super) at: Balanced,
    /// How far the slope `dF/da` may be from that at the middle.
    pub(super) slope_radius: f64,
    /// The same of the contact's first harmonic.
    pub(super) contact_radius: f64,
    /// How fast the mean may change with the amplitude.
    pub(super) drift: f64,
}

impl Cell {
    /// Half of the width.
    pub(super) fn radius(&self) -> f64 {
        0.5 * (self.to - self.from)
    }
}

/// The cells of a law.
pub(super) struct Sheets {
    law: ShaftLaw,
    bounds: LawBounds,
    contact: Option<LawBounds>,
    made: RefCell<HashMap<i32, Rc<Vec<Cell>>>>,
}

impl Sheets {
    pub(super) fn new(law: &ShaftLaw) -> Self {
        let bounds = LawBounds::new(&law.law, law.statics.parallel, law.statics.asked);
        let contact = law.contact.as_ref().map(|(_, law)| LawBounds::new(law, 0.0, 0.0));
        Self { law: law.clone(), bounds, contact, made: RefCell::default() }
    }

    /// Calls `visit` for every cell between two amplitudes.
    pub(super) fn each(&self, from: f64, to: f64, mut visit: impl FnMut(&Cell)) {
        if !(from > 0.0 && to >= from && to.is_finite()) {
            return;
        }
        #[expect(clippy::cast_possible_truncation, reason = "logarithms of numbers")]
        let place = |amplitude: f64| (amplitude.ln() / RATIO.ln()).floor() as i32;
        for index in place(from)..=place(to) {
            let cells = self.at(index);
            cells.iter().for_each(&mut visit);
        }
    }

    fn at(&self, index: i32) -> Rc<Vec<Cell>> {
        if let Some(cells) = self.made.borrow().get(&index) {
            return Rc::clone(cells);
        }
        let end = |index: i32| (f64::from(index) * RATIO.ln()).exp();
        let mut cells = Vec::new();
        self.cover(end(index), end(index + 1), &mut cells);
        let cells = Rc::new(cells);
        self.made.borrow_mut().insert(index, Rc::clone(&cells));
        cells
    }

    /// Covers an interval of amplitudes, in halves where need be.
    fn cover(&self, from: f64, to: f64, cells: &mut Vec<Cell>) {
        if let Some(found) = self.certified(from, to) {
            cells.extend(found);
        } else if to - from > NARROWEST * to {
            let middle = f64::midpoint(from, to);
            self.cover(from, middle, cells);
            self.cover(middle, to, cells);
        }
    }

    /// The cells of an interval; `None` where its means cannot be told apart.
    fn certified(&self, from: f64, to: f64) -> Option<Vec<Cell>> {
        let middle = f64::midpoint(from, to);
        if self.law.symmetric {
            return Some(vec![self.symmetric_cell(from, to, middle)]);
        }
        let radius = 0.5 * (to - from);
        let means = self.held_means(middle, 0.0, &[])?;
        let cells: Option<Vec<(Cell, f64)>> =
            means.iter().map(|mean| self.cell(from, to, *mean)).collect();
        let cells = cells?;
        if !self.bounds.rises {
            // Nothing else may be held anywhere in the interval.
            let known: Vec<(f64, f64)> =
                cells.iter().map(|(cell, r)| (cell.at.mean - r, cell.at.mean + r)).collect();
            if known.windows(2).any(|pair| pair[0].1 >= pair[1].0) {
                return None;
            }
            if !self.held_means(middle, radius, &known)?.is_empty() {
                return None;
            }
        }
        Some(cells.into_iter().map(|(cell, _)| cell).collect())
    }

    fn symmetric_cell(&self, from: f64, to: f64, middle: f64) -> Cell {
        let at = self.law.balanced(middle, 0.0).unwrap_or_default();
        let amplitude_radius = 0.5 * (to - from);
        let region = Region { mean: 0.0, mean_radius: 0.0, amplitude: middle, amplitude_radius };
        let radii = self.bounds.moment_radii(&region);
        let contact_radius = self.contact_radius(&region, (0.0, 0.0), 1.0, [0.0; 3]);
        Cell { from, to, middle, at, slope_radius: 2.0 * radii[2], contact_radius, drift: 0.0 }
    }

    /// The cell of a mean at the middle of an interval, and the half width of the box of means in
    /// which it is proven to stay, alone.
    fn cell(&self, from: f64, to: f64, mean: f64) -> Option<(Cell, f64)> {
        let (middle, radius) = (f64::midpoint(from, to), 0.5 * (to - from));
        let at = self.law.balanced(middle, mean)?;
        let mean = at.mean;
        let [_, m1, m2] = self.law.swing(mean, middle).moments;
        let mut room = (2.0 * m1.abs() / at.held).max(0.5) * radius;
        for _ in 0..5 {
            let region =
                Region { mean, mean_radius: room, amplitude: middle, amplitude_radius: radius };
            let [r0, r1, r2] = self.bounds.moment_radii(&region);
            let least = at.held - r0;
            if least <= 0.0 {
                return None;
            }
            let drift = (m1.abs() + r1) / least;
            if drift * radius <= room {
                let [low, high] = slopes(m1, m2, at.held, [r0, r1, r2]);
                let slope_radius = (high - at.slope).max(at.slope - low);
                let contact_radius =
                    self.contact_radius(&region, (mean, m1), at.held, [r0, r1, r2]);
                let cell = Cell { from, to, middle, at, slope_radius, contact_radius, drift };
                return Some((cell, room));
            }
            room = 1.5 * drift * radius;
        }
        None
    }

    /// Bounds of a part of a cell.
    pub(super) fn part(&self, cell: &Cell, from: f64, to: f64) -> Option<Cell> {
        let middle = f64::midpoint(from, to);
        if self.law.symmetric {
            return Some(self.symmetric_cell(from, to, middle));
        }
        let at = self.law.balanced(middle, cell.at.mean)?;
        let radius = 0.5 * (to - from);
        let region = Region {
            mean: at.mean,
            mean_radius: cell.drift * radius,
            amplitude: middle,
            amplitude_radius: radius,
        };
        let [_, m1, m2] = self.law.swing(at.mean, middle).moments;
        let radii = self.bounds.moment_radii(&region);
        if at.held <= radii[0] {
            return None;
        }
        let [low, high] = slopes(m1, m2, at.held, radii);
        let slope_radius = (high - at.slope).max(at.slope - low);
        let drift = ((m1.abs() + radii[1]) / (at.held - radii[0])).min(cell.drift);
        let contact_radius = self.contact_radius(&region, (at.mean, m1), at.held, radii);
        Some(Cell { from, to, middle, at, slope_radius, contact_radius, drift })
    }

    /// How far the slope of the contact's first harmonic over a region may be from that at its
    /// middle, where the mean and `M_1` are given.
    fn contact_radius(
        &self,
        region: &Region,
        (mean, m1): (f64, f64),
        held: f64,
        [r0, r1, _]: [f64; 3],
    ) -> f64 {
        let (Some(bounds), Some((_, law))) = (&self.contact, &self.law.contact) else { return 0.0 };
        let [_, c1, c2] = bounds.moment_radii(region);
        if self.law.symmetric {
            return 2.0 * c2;
        }
        let [_, own, _] = contact_moments(law, mean, region.amplitude);
        // 2 C_2 - 2 C_1 M_1/(M_0 + κ).
        let product = (own * m1).abs();
        let away = own.abs() * r1 + m1.abs() * c1 + r1 * c1;
        let follows = product * r0 / (held * (held - r0)) + away / (held - r0);
        2.0 * (c2 + follows)
    }

    /// All means held at amplitudes within `radius` of `amplitude`, outside the intervals of means
    /// that are known; with a radius only whether there are any. `None` where that stays open.
    fn held_means(&self, amplitude: f64, radius: f64, known: &[(f64, f64)]) -> Option<Vec<f64>> {
        let reach = self.bounds.far + amplitude + radius;
        let mut found: Vec<f64> = Vec::new();
        let mut edges = vec![-1.001 * reach];
        edges.extend(known.iter().flat_map(|(from, to)| [*from, *to]));
        edges.push(1.001 * reach);
        let mut waiting: Vec<(f64, f64)> =
            edges.chunks_exact(2).rev().map(|pair| (pair[0], pair[1])).collect();
        let mut looked = 0;
        while let Some((from, to)) = waiting.pop() {
            if from >= to {
                continue;
            }
            looked += 1;
            if looked > MOST_BOXES {
                return None;
            }
            match self.look(from, to, amplitude, radius) {
                Look::Nothing => {}
                Look::Held if radius == 0.0 => found.extend(self.only_mean(from, to, amplitude)),
                Look::Held if self.sides_agree(from, to, amplitude, radius) => {}
                _ if to - from <= 1e-9 * reach => {
                    if radius > 0.0 {
                        return None;
                    }
                }
                _ => {
                    let middle = f64::midpoint(from, to);
                    waiting.push((middle, to));
                    waiting.push((from, middle));
                }
            }
        }
        found.dedup_by(|b, a| (*b - *a).abs() <= 1e-12 * reach);
        Some(found)
    }

    /// What bounds say of an interval of means at some amplitudes.
    fn look(&self, from: f64, to: f64, amplitude: f64, amplitude_radius: f64) -> Look {
        let (mean, mean_radius) = (f64::midpoint(from, to), 0.5 * (to - from));
        let swing = self.law.swing(mean, amplitude);
        let region = Region { mean, mean_radius, amplitude, amplitude_radius };
        let [r0, r1, _] = self.bounds.moment_radii(&region);
        let held = swing.moments[0] + self.law.statics.parallel;
        let change =
            (held.abs() + r0) * mean_radius + (swing.moments[1].abs() + r1) * amplitude_radius;
        if swing.imbalance.abs() > change || held + r0 <= 0.0 {
            return Look::Nothing;
        }
        if held > r0 { Look::Held } else { Look::Open }
    }

    /// Whether the imbalance has one sign at both ends of an interval of means in which it rises, at
    /// all amplitudes: then no mean is in it.
    fn sides_agree(&self, from: f64, to: f64, amplitude: f64, amplitude_radius: f64) -> bool {
        let side = |mean: f64| {
            let swing = self.law.swing(mean, amplitude);
            let region = Region { mean, mean_radius: 0.0, amplitude, amplitude_radius };
            let [_, r1, _] = self.bounds.moment_radii(&region);
            let change = (swing.moments[1].abs() + r1) * amplitude_radius;
            if swing.imbalance.abs() > change { swing.imbalance } else { f64::NAN }
        };
        side(from) > 0.0 || side(to) < 0.0
    }

    /// The mean in an interval in which the imbalance rises, if there is one.
    fn only_mean(&self, from: f64, to: f64, amplitude: f64) -> Option<f64> {
        let imbalance = |mean: f64| self.law.swing(mean, amplitude).imbalance;
        let (mut low, mut high) = (from, to);
        if imbalance(low) > 0.0 || imbalance(high) < 0.0 {
            return None;
        }
        // Halving until Newton's method takes over; what it finds must lie inside.
        for _ in 0..8 {
            let middle = f64::midpoint(low, high);
            if imbalance(middle) > 0.0 { high = middle } else { low = middle }
        }
        let inside = |mean: &f64| (from..=to).contains(mean);
        self.law.mean(amplitude, f64::midpoint(low, high)).filter(inside).or_else(|| {
            for _ in 0..60 {
                let middle = f64::midpoint(low, high);
                if imbalance(middle) > 0.0 { high = middle } else { low = middle }
            }
            Some(f64::midpoint(low, high))
        })
    }
}

/// What bounds say of an interval of means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look {
    /// No mean is held in it.
    Nothing,
    /// The imbalance rises throughout.
    Held,
    /// Too wide to tell.
    Open,
}

/// Range of `2 M_2 - 2 M_1²/(M_0 + κ)`.
fn slopes(m1: f64, m2: f64, held: f64, [r0, r1, r2]: [f64; 3]) -> [f64; 2] {
    let most = (m1.abs() + r1).powi(2) / (held - r0);
    let least = (m1.abs() - r1).max(0.0).powi(2) / (held + r0);
    [2.0 * (m2 - r2 - most), 2.0 * (m2 + r2 - least)]
}
