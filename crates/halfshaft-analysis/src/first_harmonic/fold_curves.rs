//! All fold curves of a plane.
//!
//! At rows of the parameter all branches are followed and all their folds located. From each fold
//! that no curve has passed yet a curve is followed both ways, past the folds of the rows. A closed
//! fold curve that lives between two rows would be missed.

use halfshaft_numerics::observer::Observer;

use super::curve::{Kind, follow};
use super::family::{Family, Spot};
use super::fold_path::{Fold, FoldPath, Special};
use super::grid::Grid;
use super::path::{dot, norm};
use super::responses::Finder;
use super::setting::even;

/// A fold curve.
#[derive(Clone, Debug, Default)]
pub(super) struct FoldCurve {
    pub(super) folds: Vec<Fold>,
    /// Why it ends inside the plane; empty where it does not.
    pub(super) ends: String,
}

/// All fold curves of a plane.
#[derive(Clone, Debug, Default)]
pub(super) struct FoldCurves {
    pub(super) curves: Vec<FoldCurve>,
    pub(super) specials: Vec<Special>,
    /// Rows at which the line could not be had.
    pub(super) gaps: usize,
    /// Folds of rows that the curves past them did not come by.
    pub(super) unmatched: usize,
    pub(super) cancelled: bool,
}

/// The plane.
pub(super) struct Plane<'f> {
    pub(super) family: &'f Family<'f>,
    /// Range of circular frequencies, rad/s.
    pub(super) window: (f64, f64),
    /// Range of the parameter.
    pub(super) range: (f64, f64),
    /// About how many points describe a curve.
    pub(super) points: usize,
}

/// Rows at which all folds are found.
const ROWS: usize = 25;
/// Frequencies of each row at which all responses are found.
const COLUMNS: usize = 120;
/// Smallest scaled step.
const SHORTEST: f64 = 1e-8;

/// Folds of a row, and whether a curve has passed them.
type Row = Vec<(Spot, bool)>;

impl Plane<'_> {
    /// Finds and follows all fold curves.
    pub(super) fn curves(&self, observer: &dyn Observer) -> FoldCurves {
        let mut result = FoldCurves::default();
        let values = even(self.range.0, self.range.1, ROWS);
        let mut rows: Vec<Row> = Vec::with_capacity(ROWS);
        #[expect(clippy::cast_precision_loss, reason = "a few rows")]
        for (index, value) in values.iter().enumerate() {
            if observer.cancelled() {
                result.cancelled = true;
                return result;
            }
            observer.progress(0.6 * index as f64 / ROWS as f64);
            let folds = self.row(*value, &|| observer.cancelled());
            result.gaps += usize::from(folds.is_none());
            rows.push(folds.unwrap_or_default());
        }
        let path = FoldPath { family: self.family, width: self.window.1 - self.window.0 };
        for row in 0..rows.len() {
            for index in 0..rows[row].len() {
                if rows[row][index].1 {
                    continue;
                }
                if observer.cancelled() {
                    result.cancelled = true;
                    return result;
                }
                rows[row][index].1 = true;
                let seed = rows[row][index].0;
                let mut walker = Walker {
                    plane: self,
                    path: &path,
                    values: &values,
                    rows: &mut rows,
                    result: &mut result,
                };
                walker.curve(&seed, (row, index));
            }
        }
        result
    }

    /// All folds at a value of the parameter; `None` where the line cannot be had.
    fn row(&self, parameter: f64, cancelled: &dyn Fn() -> bool) -> Option<Row> {
        let problem = self.family.at(parameter)?;
        let finder = Finder::new(&problem);
        let grid =
            Grid::new(&problem, &finder, even(self.window.0, self.window.1, COLUMNS), cancelled);
        let curve = follow(&problem, grid, cancelled);
        let samples = curve.pieces.iter().flat_map(|piece| &piece.samples);
        let folds = samples.filter(|sample| sample.kind == Kind::Fold);
        let spot = |response: &super::responses::Response| Spot {
            nu: response.nu,
            u: response.amplitude().ln(),
            parameter,
            mean: response.at.mean,
        };
        Some(folds.map(|sample| (spot(&sample.response), false)).collect())
    }

    fn contains(&self, spot: &Spot) -> bool {
        let inside = |x: f64, (from, to): (f64, f64)| from <= x && x <= to;
        inside(spot.nu, self.window) && inside(spot.parameter, self.range)
    }
}

/// Where a walk ended.
enum Ending {
    Border,
    Closed,
    Early(String),
}

struct Walker<'w, 'f> {
    plane: &'w Plane<'f>,
    path: &'w FoldPath<'f>,
    values: &'w [f64],
    rows: &'w mut Vec<Row>,
    result: &'w mut FoldCurves,
}

impl Walker<'_, '_> {
    /// Follows the curve through a fold of a row.
    fn curve(&mut self, seed: &Spot, origin: (usize, usize)) {
        let Some(start) = self.path.fold(seed, &[0.0, 0.0, 1.0]) else { return };
        let mut curve = FoldCurve { folds: vec![start], ends: String::new() };
        let forward = self.walk(&start, origin, &mut curve.folds);
        let mut closed = false;
        match forward {
            Ending::Closed => closed = true,
            Ending::Early(reason) => curve.ends = reason,
            Ending::Border => {}
        }
        if !closed {
            curve.folds.reverse();
            let direction = start.direction.map(|d| -d);
            let back = Fold { direction, forward: !start.forward, ..start };
            if let Ending::Early(reason) = self.walk(&back, origin, &mut curve.folds) {
                curve.ends = reason;
            }
        }
        if curve.folds.len() > 1 {
            self.result.curves.push(curve);
        }
    }

    fn longest(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let points = self.plane.points.max(20) as f64;
        (6.0 / points).min(0.05)
    }

    fn walk(&mut self, start: &Fold, origin: (usize, usize), folds: &mut Vec<Fold>) -> Ending {
        let longest = self.longest();
        let (mut fold, mut length) = (*start, 0.2 * longest);
        for _ in 0..20 * self.plane.points.max(100) {
            let next = loop {
                match self.step(&fold, length) {
                    Some((next, easy)) => {
                        length = (length * if easy { 1.5 } else { 1.0 }).min(longest);
                        break next;
                    }
                    None => length *= 0.5,
                }
                if length < SHORTEST {
                    return Ending::Early(self.stuck(&fold.spot));
                }
            };
            if let Some(ending) = self.pass(&fold, &next, origin, folds) {
                return ending;
            }
            folds.push(next);
            fold = next;
        }
        Ending::Early("the curve has more points than are kept".to_owned())
    }

    fn step(&self, fold: &Fold, length: f64) -> Option<(Fold, bool)> {
        let guess = self.path.ahead(fold, length);
        let (next, iterations) = self.path.correct(&guess, &fold.direction, &fold.direction)?;
        let straight = dot(&next.direction, &fold.direction);
        let moved = norm(&self.path.between(&guess, &next.spot));
        (next.forward == fold.forward && straight > 0.97 && moved < 0.3 * length)
            .then_some((next, straight > 0.993 && iterations <= 5))
    }

    fn stuck(&self, spot: &Spot) -> String {
        format!(
            "the steps became too small at {:.6} rad/s and {:.6}",
            spot.nu / self.plane.family.order,
            spot.parameter
        )
    }

    /// What lies between two neighbours: special points, rows, the border.
    fn pass(
        &mut self,
        from: &Fold,
        to: &Fold,
        origin: (usize, usize),
        folds: &mut Vec<Fold>,
    ) -> Option<Ending> {
        let specials = self.path.specials(from, to);
        for special in specials {
            if !self.plane.contains(&special.spot) {
                continue;
            }
            if let Some(fold) = self.path.fold(&special.spot, &from.direction)
                && special.precision.is_some()
            {
                folds.push(fold);
            }
            self.result.specials.push(special);
        }
        for row in self.rows_between(from.spot.parameter, to.spot.parameter) {
            let Some(fold) = self.on_row(from, to, self.values[row]) else {
                self.result.unmatched += 1;
                continue;
            };
            if !self.plane.contains(&fold.spot) {
                continue;
            }
            if self.meet(row, &fold.spot, origin, folds.len()) {
                folds.push(fold);
                return Some(Ending::Closed);
            }
        }
        if !self.plane.contains(&to.spot) {
            folds.extend(self.on_border(from, to));
            return Some(Ending::Border);
        }
        None
    }

    /// Rows passed on the way from one value to another, in that order.
    fn rows_between(&self, from: f64, to: f64) -> Vec<usize> {
        let (low, high) = (from.min(to), from.max(to));
        let inside = |value: &f64| *value > low && *value <= high;
        let mut rows: Vec<usize> =
            (0..self.values.len()).filter(|row| inside(&self.values[*row])).collect();
        if to < from {
            rows = (0..self.values.len())
                .filter(|row| self.values[*row] >= low && self.values[*row] < high)
                .rev()
                .collect();
        }
        rows
    }

    fn share(&self, from: &Fold, to: &Fold, share: f64) -> Spot {
        let mix = |a: f64, b: f64| a + share * (b - a);
        let (a, b) = (from.spot, to.spot);
        Spot {
            nu: mix(a.nu, b.nu),
            u: mix(a.u, b.u),
            parameter: mix(a.parameter, b.parameter),
            mean: mix(a.mean, b.mean),
        }
    }

    /// The fold at a value of the parameter between two neighbours.
    fn on_row(&self, from: &Fold, to: &Fold, value: f64) -> Option<Fold> {
        let share = (value - from.spot.parameter) / (to.spot.parameter - from.spot.parameter);
        let guess = Spot { parameter: value, ..self.share(from, to, share) };
        let found = self.path.correct(&guess, &[0.0, 0.0, 1.0], &from.direction);
        found.map(|(fold, _)| Fold { spot: Spot { parameter: value, ..fold.spot }, ..fold })
    }

    /// The fold on the border of the plane between two neighbours.
    fn on_border(&self, from: &Fold, to: &Fold) -> Option<Fold> {
        let (a, b) = (from.spot, to.spot);
        let [low, high] = [self.plane.range.0, self.plane.range.1];
        if b.parameter < low || b.parameter > high {
            let fold = self.on_row(from, to, b.parameter.clamp(low, high));
            if fold.is_some_and(|fold| self.plane.contains(&fold.spot)) {
                return fold;
            }
        }
        let nu = b.nu.clamp(self.plane.window.0, self.plane.window.1);
        let guess = Spot { nu, ..self.share(from, to, (nu - a.nu) / (b.nu - a.nu)) };
        let (fold, _) = self.path.correct(&guess, &[1.0, 0.0, 0.0], &from.direction)?;
        let fold = Fold { spot: Spot { nu, ..fold.spot }, ..fold };
        self.plane.contains(&fold.spot).then_some(fold)
    }

    /// Marks the fold of a row that a curve comes by; true where it is the one it began at.
    fn meet(&mut self, row: usize, spot: &Spot, origin: (usize, usize), so_far: usize) -> bool {
        let distance = |other: &Spot| norm(&self.path.between(spot, other));
        let nearest = self.rows[row]
            .iter()
            .enumerate()
            .min_by(|(_, a), (_, b)| distance(&a.0).total_cmp(&distance(&b.0)))
            .filter(|(_, (other, _))| distance(other) < 1e-5)
            .map(|(index, _)| index);
        let Some(index) = nearest else {
            self.result.unmatched += 1;
            return false;
        };
        if self.rows[row][index].1 {
            if (row, index) == origin {
                return so_far > 2;
            }
            self.result.unmatched += 1;
        }
        self.rows[row][index].1 = true;
        false
    }
}
