//! The motion from the beginning of a period of the excitation to that of the next.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::dense::Matrix;

use crate::equilibrium;
use crate::shooting::{Flow, Lost, Turn, length};
use crate::time_response::reaches;

/// Why a motion is not followed any further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ended {
    /// It grew beyond all measure.
    Escaped,
    /// A contact opens and closes too often to be followed.
    Chattering,
    /// Whoever watches wants no more.
    Cancelled,
}

/// How motions are looked at along a whole sweep.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    /// Order of the fundamental of the excitation.
    pub(super) base: f64,
    /// Speed over which rates of states are, rad/s.
    pub(super) reference: f64,
    /// Error of a step, relative.
    pub(super) tolerance: f64,
    /// The shaft that is looked at: its connection, and its place among the tree's twists.
    pub(super) connection: usize,
    pub(super) place: usize,
}

/// One line at one excitation speed.
pub(super) struct Stroboscope<'e> {
    flow: Flow<'e>,
    look: Look,
    frequency: f64,
    /// Period of the excitation, s.
    pub(super) period: f64,
    /// The state at rest, about which sizes are measured.
    pub(super) rest: Vec<f64>,
    /// Twists past which nothing holds the line back.
    reaches: Vec<(usize, f64)>,
    turns: Vec<Turn>,
}

impl<'e> Stroboscope<'e> {
    pub(super) fn new(equations: &'e EquationsOfMotion, look: Look, frequency: f64) -> Self {
        let mut flow = Flow::new(equations, look.reference);
        flow.set_tolerance(look.tolerance);
        let mut rest = vec![0.0; flow.coordinates.dimension()];
        let states = equilibrium::find_stable(equations).ok();
        if let Some(state) = states.as_ref().and_then(|states| states.primary()) {
            for (x, edge) in rest.iter_mut().zip(&equations.network.tree) {
                *x = state.twists[edge.shaft];
            }
        }
        Self {
            flow,
            look,
            frequency,
            period: std::f64::consts::TAU / (look.base * frequency),
            rest,
            reaches: reaches(equations),
            turns: Vec::new(),
        }
    }

    /// Twist (rad) and rate of twist (rad/s) of the shaft in a state.
    pub(super) fn point(&self, state: &[f64]) -> [f64; 2] {
        let rate = self.look.place + self.flow.equations().network.tree.len();
        [state[self.look.place], self.look.reference * state[rate]]
    }

    /// Distance of a state from rest.
    pub(super) fn size(&self, state: &[f64]) -> f64 {
        let away: Vec<f64> = state.iter().zip(&self.rest).map(|(x, rest)| x - rest).collect();
        length(&away)
    }

    /// The state a period on.
    pub(super) fn next(&mut self, state: &[f64]) -> Result<Vec<f64>, Ended> {
        let arrived = self.flow.run(state, self.frequency, self.period, false, |_| {});
        self.held(arrived.map_err(ended)?.state)
    }

    /// The same with its derivatives by the state before; the greatest and least twist of the shaft widen
    /// `range`.
    pub(super) fn varied(
        &mut self,
        state: &[f64],
        range: &mut (f64, f64),
    ) -> Result<(Vec<f64>, Matrix), Ended> {
        let (turns, connection) = (&mut self.turns, self.look.connection);
        turns.clear();
        let arrived = self
            .flow
            .run(state, self.frequency, self.period, true, |step| step.turns(connection, turns));
        let arrived = arrived.map_err(ended)?;
        for turn in &self.turns {
            *range = (range.0.min(turn.twist), range.1.max(turn.twist));
        }
        let matrix = arrived.variation.map(|(matrix, _)| matrix).ok_or(Ended::Escaped)?;
        Ok((self.held(arrived.state)?, matrix))
    }

    /// A state that something still holds back.
    fn held(&self, state: Vec<f64>) -> Result<Vec<f64>, Ended> {
        let lost = |(tree, reach): &(usize, f64)| state[*tree].abs() > *reach;
        if self.reaches.iter().any(lost) { Err(Ended::Escaped) } else { Ok(state) }
    }
}

fn ended(lost: Lost) -> Ended {
    match lost {
        Lost::Chattering => Ended::Chattering,
        Lost::RanAway | Lost::NotConverged | Lost::Singular => Ended::Escaped,
    }
}
