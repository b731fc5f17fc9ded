//! The motion at one value of what is swept.

use halfshaft_numerics::dense::{Matrix, eigenvalues};
use halfshaft_numerics::observer::Observer;

use super::exponents::Exponents;
use super::repetition::{History, MOST_PERIODS, Repeats};
use super::stroboscope::{Ended, Stroboscope};

/// What is seen of a motion.
#[derive(Clone, Debug)]
pub(super) struct Visit {
    /// Periods after which it repeats; `None` where it does not.
    pub(super) period: Option<usize>,
    /// States at the beginning of the periods that are recorded.
    pub(super) states: Vec<Vec<f64>>,
    /// Largest Lyapunov exponent and the sum of all, 1/s.
    pub(super) exponents: (f64, f64),
    /// Half of peak to peak of the twist, rad.
    pub(super) amplitude: f64,
    /// Whether it does not repeat though neighbouring motions come together: it was still on its way.
    pub(super) settling: bool,
    /// Periods that were followed.
    pub(super) followed: usize,
    /// The state from which the next value goes on.
    pub(super) end: Vec<f64>,
}

/// How long a motion is followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Periods for settling.
    pub(super) transient: usize,
    /// Periods that are recorded of a motion that does not repeat.
    pub(super) points: usize,
    /// Error of a step, relative.
    pub(super) tolerance: f64,
}

/// Distance from its orbit, relative, at which a motion is told as repeating: at once, and after all its
/// time for settling.
const CLOSE: f64 = 1e-8;
const CLOSE_AT_LAST: f64 = 1e-3;
/// States of an orbit that are told apart are further than this from each other, relative.
const SAME: f64 = 1e-4;
const SAME_AT_LAST: f64 = 1e-2;
/// Errors of steps add up over a period to about this many times one of them.
const STEPS: f64 = 10.0;
/// Multipliers beyond 1 by more than this grow.
const UNSTABLE: f64 = 1e-6;
/// An orbit that repeats though it is not stable is left by this push, relative: on a mirror symmetry, say,
/// a computed motion stays where no real one would.
const PUSH: f64 = 1e-4;
/// Distances that shrink over the recorded time by more than e to this do so steadily.
const SETTLING: f64 = 3.0;
/// Periods before the recorded ones in which variations turn into their own directions.
const ALIGNED: usize = 32;

/// A motion while it is followed.
struct Following<'v, 'e> {
    strobe: &'v mut Stroboscope<'e>,
    state: Vec<f64>,
    history: History,
    exponents: Exponents,
    range: (f64, f64),
    followed: usize,
}

/// Follows the motion from a state.
pub(super) fn visit(
    strobe: &mut Stroboscope<'_>,
    start: &[f64],
    limits: Limits,
    observer: &dyn Observer,
) -> Result<Visit, Ended> {
    let mut motion = Following {
        exponents: Exponents::new(start.len()),
        state: start.to_vec(),
        history: History::default(),
        range: (f64::INFINITY, f64::NEG_INFINITY),
        followed: 0,
        strobe,
    };
    let error = STEPS * limits.tolerance;
    let repeats = Repeats { within: CLOSE.max(error), error, same: SAME };
    for settling in 0..limits.transient {
        if observer.cancelled() {
            return Err(Ended::Cancelled);
        }
        if settling + ALIGNED < limits.transient {
            motion.go()?;
        } else {
            motion.go_varied()?;
        }
        if let Some(period) = motion.history.period(repeats)
            && let Some(cycle) = motion.cycle(period)?
        {
            return Ok(cycle);
        }
    }
    motion.record(
        limits.points,
        Repeats { within: CLOSE_AT_LAST, error, same: SAME_AT_LAST },
        observer,
    )
}

impl Following<'_, '_> {
    fn go(&mut self) -> Result<(), Ended> {
        let state = self.strobe.next(&self.state)?;
        self.arrive(state);
        Ok(())
    }

    /// A period with its variations.
    fn go_varied(&mut self) -> Result<Matrix, Ended> {
        let (state, matrix) = self.strobe.varied(&self.state, &mut self.range)?;
        self.exponents.push(&matrix);
        self.arrive(state);
        Ok(matrix)
    }

    fn arrive(&mut self, state: Vec<f64>) {
        self.history.push(state.clone(), self.strobe.size(&state));
        self.state = state;
        self.followed += 1;
    }

    fn amplitude(&self) -> f64 {
        if self.range.0 <= self.range.1 { 0.5 * (self.range.1 - self.range.0) } else { 0.0 }
    }

    fn start_recording(&mut self) {
        self.exponents.restart();
        self.range = (f64::INFINITY, f64::NEG_INFINITY);
    }

    /// Once round an orbit that the motion has come to; `None` where it is not stable, after a push off it.
    fn cycle(&mut self, period: usize) -> Result<Option<Visit>, Ended> {
        self.start_recording();
        let mut matrices = Vec::with_capacity(period);
        for _ in 0..period {
            matrices.push(self.go_varied()?);
        }
        let (product, largest) = around(&matrices, self.state.len());
        if largest > 1.0 + UNSTABLE {
            self.push_off(&product);
            return Ok(None);
        }
        let sum = self.exponents.rates(self.strobe.period).1;
        Ok(Some(Visit {
            period: Some(period),
            states: self.history.last(period),
            exponents: (largest.ln() / (period as f64 * self.strobe.period), sum),
            amplitude: self.amplitude(),
            settling: false,
            followed: self.followed,
            end: self.state.clone(),
        }))
    }

    /// Moves the state along the direction that grows most.
    fn push_off(&mut self, product: &Matrix) {
        let mut growing = Exponents::new(self.state.len());
        (0..ALIGNED).for_each(|_| growing.push(product));
        let by = PUSH * self.strobe.size(&self.state);
        self.state.iter_mut().zip(growing.direction()).for_each(|(x, d)| *x += by * d);
        self.history.clear();
    }

    /// Records a motion that has not come to repeat in its time for settling.
    fn record(
        mut self,
        points: usize,
        repeats: Repeats,
        observer: &dyn Observer,
    ) -> Result<Visit, Ended> {
        self.start_recording();
        let mut states = Vec::with_capacity(points);
        let mut matrices: Vec<Matrix> = Vec::new();
        for _ in 0..points {
            if observer.cancelled() {
                return Err(Ended::Cancelled);
            }
            if matrices.len() == MOST_PERIODS {
                matrices.remove(0);
            }
            matrices.push(self.go_varied()?);
            states.push(self.state.clone());
        }
        let mut exponents = self.exponents.rates(self.strobe.period);
        let time = points as f64 * self.strobe.period;
        let period = self.history.period(repeats);
        let period = period.filter(|period| exponents.0 < 0.0 && *period <= points);
        if let Some(period) = period {
            states.drain(..points - period);
            let last = &matrices[matrices.len() - period..];
            let largest = around(last, self.state.len()).1;
            exponents.0 = largest.ln() / (period as f64 * self.strobe.period);
        }
        Ok(Visit {
            period,
            states,
            exponents,
            amplitude: self.amplitude(),
            settling: period.is_none() && exponents.0 * time < -SETTLING,
            followed: self.followed,
            end: self.state.clone(),
        })
    }
}

/// Product of the derivatives of periods in turn, and modulus of its largest eigenvalue.
fn around(matrices: &[Matrix], dimension: usize) -> (Matrix, f64) {
    let mut product = Matrix::identity(dimension);
    for matrix in matrices {
        product = matrix.mul(&product).unwrap_or(product);
    }
    let multipliers = eigenvalues(&product).unwrap_or_default();
    let largest = multipliers.iter().map(|m| m.modulus()).fold(0.0, f64::max);
    (product, largest)
}
