//! All branches of a response over a range of frequencies.
//!
//! At every frequency of a grid *all* responses are known. From each that no branch has passed yet, a
//! branch is followed both ways; it must come by known responses only, each once. So no branch that
//! reaches across a frequency of the grid can be missed, closed ones included, and none can be taken
//! for another.

use super::grid::Grid;
use super::locate;
use super::path::{Corrected, Direction, Path, Place, dot};
use super::problem::Problem;
use super::responses::{Response, response};

/// What a sample of a branch is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// On the grid, or between for a smooth picture.
    Regular,
    /// Exactly on a fold.
    Fold,
    /// Where the amplitude is greatest.
    Peak,
    /// Where the branch ends.
    End,
}

/// A sample of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    pub(super) response: Response,
    pub(super) kind: Kind,
}

/// A connected piece of the response.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) samples: Vec<Sample>,
    pub(super) closed: bool,
    /// Frequency at which it was found, rad/s.
    pub(super) found_at: f64,
    /// Why it ends before the range does; empty where it does not.
    pub(super) ends: String,
}

/// All branches.
#[derive(Clone, Debug, Default)]
pub(super) struct Curve {
    pub(super) pieces: Vec<Piece>,
    /// Responses of the grid that no branch came by exactly, and responses met that the grid does not
    /// know.
    pub(super) unmatched: usize,
    /// Places of the grid at which two responses could not be told apart.
    pub(super) open: usize,
    pub(super) steps: usize,
    pub(super) iterations: usize,
    /// Starting points.
    pub(super) seeds: usize,
    pub(super) cancelled: bool,
}

/// Largest scaled step, and the smallest before a branch is given up.
const LONGEST: f64 = 0.12;
const SHORTEST: f64 = 1e-9;
/// Shares of the range in one unit of scaled length.
const UNITS: f64 = 12.0;
/// Most samples of a branch.
const MOST_SAMPLES: usize = 60_000;

/// Follows all branches through a grid.
pub(super) fn follow(problem: &Problem, mut grid: Grid, cancelled: &dyn Fn() -> bool) -> Curve {
    let mut curve = follow_once(problem, &mut grid, LONGEST, cancelled);
    for longest in [LONGEST / 4.0, LONGEST / 16.0] {
        if curve.unmatched == 0 || curve.cancelled {
            break;
        }
        // A step took one branch for another: once more with shorter ones.
        grid.rows.iter_mut().flatten().for_each(|known| known.passed = false);
        let again = follow_once(problem, &mut grid, longest, cancelled);
        if again.unmatched < curve.unmatched {
            curve = again;
        }
    }
    curve
}

fn follow_once(
    problem: &Problem,
    grid: &mut Grid,
    longest: f64,
    cancelled: &dyn Fn() -> bool,
) -> Curve {
    let mut curve = Curve { open: grid.open, ..Curve::default() };
    let (Some(first), Some(last)) = (grid.nus.first(), grid.nus.last()) else { return curve };
    let path = Path {
        problem,
        width: (last - first).max(f64::MIN_POSITIVE) / UNITS,
        least: 1e-7 * grid.largest(),
    };
    for row in 0..grid.nus.len() {
        for index in 0..grid.rows[row].len() {
            if grid.rows[row][index].passed {
                continue;
            }
            if cancelled() {
                curve.cancelled = true;
                return curve;
            }
            grid.rows[row][index].passed = true;
            curve.seeds += 1;
            let mut tracer = Tracer { path: &path, grid, curve: &mut curve, longest };
            if let Some(mut piece) = tracer.piece(row, index) {
                piece.samples = with_peaks(&path, piece.samples);
                curve.pieces.push(piece);
            }
        }
    }
    curve
}

/// Where a walk ended.
enum Ending {
    /// At the border of the range.
    Border,
    /// Where it began.
    Closed,
    /// Before the border.
    Early(String),
}

struct Tracer<'t, 'p> {
    path: &'t Path<'p>,
    grid: &'t mut Grid,
    curve: &'t mut Curve,
    /// Longest scaled step.
    longest: f64,
}

impl Tracer<'_, '_> {
    /// The branch through a response of the grid.
    fn piece(&mut self, row: usize, index: usize) -> Option<Piece> {
        let seed = self.grid.rows[row][index].response;
        let start = Place { nu: seed.nu, twist: seed.twist, at: seed.at };
        let last = self.grid.nus.len() - 1;
        let border = row == 0 || row == last;
        let kind = if border { Kind::End } else { Kind::Regular };
        let mut samples = vec![Sample { response: seed, kind }];
        let (forward, sense) = self.path.direction(&start, &[1.0, 0.0, 0.0])?;
        let back = forward.map(|d| -d);
        let origin = (row, index);
        let mut ends = String::new();
        let mut closed = false;
        // From a border only one way leads inside.
        if row < last {
            match self.walk(start, (forward, sense), origin, &mut samples) {
                Ending::Closed => closed = true,
                Ending::Early(reason) => ends = reason,
                Ending::Border => {}
            }
        }
        if !closed && row > 0 {
            samples.reverse();
            if let Ending::Early(reason) = self.walk(start, (back, !sense), origin, &mut samples) {
                ends = reason;
            }
        }
        (samples.len() > 1).then_some(Piece { samples, closed, found_at: seed.nu, ends })
    }

    /// Follows the branch one way and adds its samples.
    fn walk(
        &mut self,
        start: Place,
        (direction, sense): (Direction, bool),
        origin: (usize, usize),
        samples: &mut Vec<Sample>,
    ) -> Ending {
        let (mut place, mut direction, mut length) = (start, direction, 0.1 * self.longest);
        for _ in 0..MOST_SAMPLES {
            let step = match self.step(&place, (&direction, sense), &mut length) {
                Ok(step) => step,
                Err(reason) => {
                    if let Some(last) = samples.last_mut() {
                        last.kind = Kind::End;
                    }
                    return Ending::Early(reason);
                }
            };
            self.curve.iterations += step.iterations;
            if let Some(ending) = self.between((&place, &direction), &step, origin, samples) {
                return ending;
            }
            samples.push(self.sample(&step.place, Kind::Regular));
            (place, direction) = (step.place, step.direction);
        }
        Ending::Early("the branch has more samples than are kept".to_owned())
    }

    /// One accepted step; shortened until the curve bends little on it.
    fn step(
        &mut self,
        place: &Place,
        (direction, sense): (&Direction, bool),
        length: &mut f64,
    ) -> Result<Corrected, String> {
        loop {
            self.curve.steps += 1;
            let predicted = self.path.ahead(place, direction, *length);
            let corrected = self.path.correct(&predicted, direction);
            let good = corrected.filter(|found| {
                let straight = dot(&found.direction, direction);
                found.forward == sense
                    && straight > 0.97
                    && found.moved < 0.25 * *length
                    && found.iterations <= 6
            });
            if let Some(found) = good {
                let straight = dot(&found.direction, direction);
                let easy = straight > 0.995 && found.moved < 0.05 * *length;
                *length = (*length * if easy { 1.6 } else { 1.0 }).min(self.longest);
                return Ok(found);
            }
            *length *= 0.5;
            if *length < SHORTEST {
                return Err(self.stuck(place));
            }
        }
    }

    /// Why a branch cannot be followed beyond a place.
    fn stuck(&self, place: &Place) -> String {
        let shaft = &self.path.problem.equations.connections[self.path.problem.shaft].name;
        let frequency = place.nu / self.path.problem.order;
        let a = place.twist.modulus();
        if place.at.held.abs() <= 1e-3 * (place.at.slope.abs() + place.at.force.abs() / a) {
            return format!(
                "at {frequency:.6} rad/s and a swing of {a:.6} rad the law of the {shaft} no longer \
                 holds the mean torque"
            );
        }
        format!("the steps became too small at {frequency:.6} rad/s and a swing of {a:.6} rad")
    }

    /// What lies between a place and the next: frequencies of the grid, a fold, the border.
    fn between(
        &mut self,
        (from, direction): (&Place, &Direction),
        step: &Corrected,
        origin: (usize, usize),
        samples: &mut Vec<Sample>,
    ) -> Option<Ending> {
        let even = |share: f64| share;
        if direction[0] * step.direction[0] >= 0.0 {
            return self.crossings((from, &step.place), even, origin, samples);
        }
        // The branch turns between: up to the fold and then back.
        let fold = self.turn(from, direction, step);
        let up = |share: f64| 1.0 - (1.0 - share).sqrt();
        if let Some(ending) = self.crossings((from, &fold), up, origin, samples) {
            return Some(ending);
        }
        samples.push(self.sample(&fold, Kind::Fold));
        self.crossings((&fold, &step.place), f64::sqrt, origin, samples)
    }

    /// Adds the samples at the frequencies of the grid between two places; `bent` is the share of
    /// the way in the twist for a share of the way in the frequency.
    fn crossings(
        &mut self,
        (from, to): (&Place, &Place),
        bent: impl Fn(f64) -> f64,
        origin: (usize, usize),
        samples: &mut Vec<Sample>,
    ) -> Option<Ending> {
        let ascending = to.nu > from.nu;
        let nus = &self.grid.nus;
        let rows: Vec<usize> = if ascending {
            (nus.partition_point(|nu| *nu <= from.nu)..nus.partition_point(|nu| *nu <= to.nu))
                .collect()
        } else {
            (nus.partition_point(|nu| *nu < to.nu)..nus.partition_point(|nu| *nu < from.nu))
                .rev()
                .collect()
        };
        for row in rows {
            let nu = self.grid.nus[row];
            let share = (nu - from.nu) / (to.nu - from.nu);
            let guess = Place { nu, twist: mixed(from, to, bent(share)), at: to.at };
            let found = self.path.at_frequency(&guess, nu);
            let border = row == 0 || row + 1 == self.grid.nus.len();
            let kind = if border { Kind::End } else { Kind::Regular };
            match found.map(|found| found.place) {
                Some(place) => {
                    if let Some(closed) = self.meet(row, &place, origin, samples.len()) {
                        samples.push(self.sample(&place, Kind::Regular));
                        return closed.then_some(Ending::Closed);
                    }
                    samples.push(self.sample(&place, kind));
                }
                None => self.curve.unmatched += 1,
            }
            if border {
                return Some(Ending::Border);
            }
        }
        None
    }

    /// Marks the response of the grid that the branch comes by; `Some(true)` where it is the one that
    /// the branch began at.
    fn meet(
        &mut self,
        row: usize,
        place: &Place,
        origin: (usize, usize),
        so_far: usize,
    ) -> Option<bool> {
        let Some(index) = self.grid.nearest(row, place) else {
            self.curve.unmatched += 1;
            return None;
        };
        let known = &mut self.grid.rows[row][index];
        if known.passed {
            if (row, index) == origin && so_far > 2 {
                return Some(true);
            }
            self.curve.unmatched += 1;
        }
        known.passed = true;
        None
    }

    fn sample(&self, place: &Place, kind: Kind) -> Sample {
        sampled(self.path.problem, place, kind)
    }

    /// The place at which a branch turns between two places: by Newton's method, else by halving.
    fn turn(&mut self, from: &Place, direction: &Direction, step: &Corrected) -> Place {
        let problem = self.path.problem;
        if let Some(fold) = locate::fold(problem, from, &step.place) {
            return fold;
        }
        let (mut near, mut far) = (*from, step.place);
        let mut along = *direction;
        for _ in 0..60 {
            let gap = self.path.between(&near, &far);
            let length = 0.5 * dot(&gap, &gap).sqrt();
            let ahead = self.path.ahead(&near, &along, length);
            let Some(middle) = self.path.correct(&ahead, &along) else { break };
            if middle.direction[0] * direction[0] > 0.0 {
                (near, along) = (middle.place, middle.direction);
            } else {
                far = middle.place;
            }
            if let Some(fold) = locate::fold(problem, &near, &far) {
                return fold;
            }
            if length < 1e-13 {
                break;
            }
        }
        near
    }
}

/// Puts the local maxima of the amplitude into a list of samples.
fn with_peaks(path: &Path, samples: Vec<Sample>) -> Vec<Sample> {
    let place = |sample: &Sample| {
        let Response { nu, twist, at, .. } = sample.response;
        Place { nu, twist, at }
    };
    let size = |sample: &Sample| sample.response.amplitude();
    let mut peaks: Vec<(usize, Sample)> = Vec::new();
    for (index, window) in samples.windows(3).enumerate() {
        let [before, middle, after] = window else { continue };
        if size(middle) < size(before) || size(middle) <= size(after) {
            continue;
        }
        let Some(peak) = locate::peak(path.problem, &place(middle)) else { continue };
        // Where along the chord from the one before to the one after?
        let (a, b, c) = (place(before), place(middle), place(after));
        let chord = path.between(&a, &c);
        let along = |to: &Place| dot(&chord, &path.between(&a, to)) / dot(&chord, &chord);
        let (own, at) = (along(&peak), along(&b));
        if !(own > 0.0 && own < 1.0) || peak.twist.modulus() < (1.0 - 1e-9) * size(middle) {
            continue;
        }
        let sample = sampled(path.problem, &peak, Kind::Peak);
        peaks.push((if own < at { index + 1 } else { index + 2 }, sample));
    }
    let mut all = samples;
    peaks.into_iter().rev().for_each(|(at, peak)| all.insert(at, peak));
    all
}

fn sampled(problem: &Problem, place: &Place, kind: Kind) -> Sample {
    let point = problem.value(place.nu).unwrap_or_default();
    let mut response = response(problem, &point, place.twist.modulus(), &place.at);
    response.twist = place.twist;
    Sample { response, kind }
}

/// A twist between two, turned and stretched evenly.
fn mixed(from: &Place, to: &Place, share: f64) -> halfshaft_numerics::Complex {
    (from.twist).scaled(1.0 - share) + to.twist.scaled(share)
}
