//! The motion of the full line from one time to another, with its variations: Taylor steps that end
//! where a twist passes from one piece of its law to another.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::dense::Matrix;
use halfshaft_numerics::polynomial::first_exit;

use super::columns::Columns;
use super::coordinates::Coordinates;
use super::motion::Motion;
use super::series::Series;

/// Why a motion could not be followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lost {
    /// A twist passed from piece to piece too often within a period.
    Chattering,
    /// Too many steps, or something ceased to be finite.
    RanAway,
    /// Newton's method did not converge.
    NotConverged,
    /// The equations for the orbit have no unique solution.
    Singular,
}

/// Where a motion has come to.
#[derive(Clone, Debug)]
pub(crate) struct Arrived {
    pub(crate) state: Vec<f64>,
    /// Derivative of the state by time over the reference speed.
    pub(crate) rate: Vec<f64>,
    /// Derivatives of the state by that at the start and by the excitation speed; `None` where not
    /// wanted.
    pub(crate) variation: Option<(Matrix, Vec<f64>)>,
}

/// One Taylor step as others see it.
pub(crate) struct Step<'s> {
    pub(crate) from: f64,
    pub(crate) length: f64,
    pub(super) angles: &'s [Series],
    pub(super) twists: &'s [Series],
}

/// Size of the last terms of a step relative to the motion where nobody tolerates more.
const ROUNDING: f64 = 1e-17;
/// The last terms are this part of the error that is tolerated: the terms left out are less than them.
const SAFETY: f64 = 0.1;
/// Steps at most.
const MOST_STEPS: usize = 100_000;
/// Passages between pieces at most.
pub(crate) const MOST_PASSAGES: usize = 5_000;

/// A line that can be set in motion.
#[derive(Clone, Debug)]
pub(crate) struct Flow<'e> {
    motion: Motion<'e>,
    columns: Columns,
    pub(crate) coordinates: Coordinates,
    /// Size of the last terms of a step relative to the motion.
    last_terms: f64,
}

impl<'e> Flow<'e> {
    pub(crate) fn new(equations: &'e EquationsOfMotion, reference: f64) -> Self {
        let coordinates = Coordinates::new(equations, reference);
        let columns = Columns::new(equations, &coordinates);
        Self { motion: Motion::new(equations), columns, coordinates, last_terms: ROUNDING }
    }

    /// Sets the error of a step that is tolerated, relative to the motion, in place of rounding.
    pub(crate) fn set_tolerance(&mut self, tolerance: f64) {
        self.last_terms = (SAFETY * tolerance).max(ROUNDING);
    }

    /// Sets the factor on all harmonic torques.
    pub(crate) fn set_drive(&mut self, drive: f64) {
        self.motion.drive = drive;
    }

    /// Makes the drive the parameter of the variations, in place of the excitation speed.
    pub(crate) fn vary_drive(&mut self) {
        self.columns.by_drive = true;
    }

    pub(crate) fn equations(&self) -> &'e EquationsOfMotion {
        self.motion.equations
    }

    /// The motion from `state` at time 0 to time `end` at excitation speed `frequency`.
    pub(crate) fn run(
        &mut self,
        state: &[f64],
        frequency: f64,
        end: f64,
        varied: bool,
        mut see: impl FnMut(&Step<'_>),
    ) -> Result<Arrived, Lost> {
        let equations = self.motion.equations;
        self.begin(state);
        if varied {
            self.columns.start(equations, &self.coordinates);
        }
        // The boundary that each connection passed last, while it is still on it.
        let mut entered: Option<(usize, f64)> = None;
        let (mut t, mut steps, mut passages) = (0.0, 0, 0);
        while t < end {
            self.motion.expand(t, frequency);
            let mut step = self.motion.reach(self.coordinates.reference, self.last_terms);
            if varied {
                self.columns.expand(&self.motion, t, frequency);
                step = step.min(self.columns.reach(self.coordinates.reference, self.last_terms));
            }
            let whole = end - t;
            // A sliver left over would cost a step of its own.
            let last = whole <= 1.001 * step;
            let step = if last { whole } else { step };
            steps += 1;
            if steps > MOST_STEPS || !step.is_finite() || step <= 0.0 {
                return Err(Lost::RanAway);
            }
            let exit = self.exit(step, entered);
            let length = exit.map_or(step, |exit| exit.time);
            see(&Step {
                from: t,
                length,
                angles: &self.motion.angles,
                twists: &self.motion.twists,
            });
            self.motion.advance(length);
            if varied {
                self.columns.advance(length);
            }
            t = if last && exit.is_none() { end } else { t + length };
            entered = None;
            if let Some(exit) = exit {
                passages += 1;
                if passages > MOST_PASSAGES {
                    return Err(Lost::Chattering);
                }
                entered = Some((exit.connection, exit.level));
                self.pass(&exit, varied);
            }
        }
        self.arrived(frequency, t, varied)
    }

    fn begin(&mut self, state: &[f64]) {
        let equations = self.motion.equations;
        let groups = equations.groups();
        let (mut angles, mut speeds) = (vec![0.0; groups], vec![0.0; groups]);
        self.coordinates.spread(equations, state, &mut angles, &mut speeds);
        for (series, (angle, speed)) in
            self.motion.angles.iter_mut().zip(angles.iter().zip(&speeds))
        {
            (series[0], series[1]) = (*angle, *speed);
        }
        self.motion.settle();
    }

    /// The first passage within a step.
    fn exit(&self, step: f64, entered: Option<(usize, f64)>) -> Option<Exit> {
        let mut first: Option<Exit> = None;
        for (index, acting) in self.motion.acting.iter().enumerate() {
            let piece = &acting.pieces.list()[acting.active];
            for (level, sign) in [(piece.from, 1.0), (piece.to, -1.0)] {
                if !level.is_finite() {
                    continue;
                }
                let reach = first.map_or(step, |exit| exit.time);
                let on_it = entered == Some((index, level));
                let twist = &self.motion.twists[index];
                if let Some(time) = first_exit(twist, reach, level, sign, on_it)
                    && first.is_none_or(|exit| time < exit.time)
                {
                    first = Some(Exit { time, connection: index, level, up: sign < 0.0 });
                }
            }
        }
        first
    }

    /// Goes to the next piece.
    fn pass(&mut self, exit: &Exit, varied: bool) {
        let connection = &self.motion.equations.connections[exit.connection];
        let acting = &mut self.motion.acting[exit.connection];
        let before = acting.damping(connection);
        let next = if exit.up { acting.active + 1 } else { acting.active - 1 };
        acting.go_to(next);
        let change = acting.damping(connection) - before;
        if varied && change != 0.0 {
            self.columns.jump(self.motion.equations, exit.connection, change);
        }
    }

    fn arrived(&mut self, frequency: f64, t: f64, varied: bool) -> Result<Arrived, Lost> {
        let equations = self.motion.equations;
        self.motion.expand(t, frequency);
        let of = |power: usize| -> Vec<f64> {
            self.motion.angles.iter().map(|series| series[power]).collect()
        };
        let (angles, speeds) = (of(0), of(1));
        let accelerations: Vec<f64> = of(2).iter().map(|q| 2.0 * q).collect();
        let mut state = vec![0.0; self.coordinates.dimension()];
        let mut rate = state.clone();
        self.coordinates.gather(equations, &angles, &speeds, &mut state);
        self.coordinates.gather(equations, &speeds, &accelerations, &mut rate);
        rate.iter_mut().for_each(|v| *v /= self.coordinates.reference);
        if !state.iter().chain(&rate).all(|value| value.is_finite()) {
            return Err(Lost::RanAway);
        }
        let variation = varied.then(|| self.columns.finish(equations, &self.coordinates));
        Ok(Arrived { state, rate, variation })
    }
}

/// A twist that leaves its piece.
#[derive(Clone, Copy, Debug)]
struct Exit {
    time: f64,
    connection: usize,
    level: f64,
    /// Whether to the piece above.
    up: bool,
}
