//! What the trajectories of an ensemble are, and what is to be learnt from them.

use super::Passage;
use crate::ode::Stop;

/// A trajectory, as its task sees and changes it.
#[derive(Debug)]
pub struct Trajectory<'t> {
    /// Its time.
    pub time: f64,
    /// Its state.
    pub state: &'t mut [f64],
    /// Its parameters.
    pub parameters: &'t mut [f64],
}

/// What lies ahead of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Time at which a step ends exactly and the task may change the trajectory or end it.
    pub goal: f64,
    /// Time up to the goal at which the task looks at the state, in passing; infinity for never.
    pub watch: f64,
}

impl Plan {
    /// To the goal without a look on the way.
    pub fn to(goal: f64) -> Self {
        Self { goal, watch: f64::INFINITY }
    }
}

/// An ensemble: trajectories by number. All run forwards in time.
///
/// What a method does may depend on its arguments alone: trajectories are taken by several threads in
/// no certain order.
pub trait Task: Sync {
    /// What is kept of a trajectory while it runs, and comes out in the end.
    type Memory: Send;

    /// Sets trajectory `index` at its start: time, state and parameters, all zero when it is called.
    fn begin(&self, index: usize, trajectory: &mut Trajectory<'_>) -> (Self::Memory, Plan);

    /// Looks at the state at a time that was asked for; returns the next such time, or `None` to end
    /// the trajectory here.
    fn watched(&self, _memory: &mut Self::Memory, _time: f64, _state: &[f64]) -> Option<f64> {
        Some(f64::INFINITY)
    }

    /// The trajectory is at its goal; it may be changed and sent on, or ended by `None`.
    fn arrived(&self, _memory: &mut Self::Memory, _: &mut Trajectory<'_>) -> Option<Plan> {
        None
    }

    /// The trajectory has passed from one band to the next.
    fn passed(&self, _memory: &mut Self::Memory, _passage: &Passage) {}
}

/// A trajectory that is through.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished<M> {
    /// What the task kept of it.
    pub memory: M,
    /// Time of the end.
    pub time: f64,
    /// State there.
    pub state: Vec<f64>,
    /// Steps taken, those tried in vain included.
    pub steps: usize,
    /// Why it ended before the task wanted it to; `None` if it did not.
    pub stop: Option<Stop>,
}

/// Where a trajectory starts and when it ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Time of the start.
    pub time: f64,
    /// State there.
    pub state: Vec<f64>,
    /// Parameters of the trajectory.
    pub parameters: Vec<f64>,
    /// Time of the end.
    pub end: f64,
}

/// A list of trajectories that run from their starts to their ends, counting passages on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Starts(pub Vec<Start>);

impl Task for Starts {
    /// Number of passages.
    type Memory = usize;

    fn begin(&self, index: usize, trajectory: &mut Trajectory<'_>) -> (usize, Plan) {
        let start = &self.0[index];
        trajectory.time = start.time;
        let copy = |to: &mut [f64], from: &[f64]| {
            to.iter_mut().zip(from).for_each(|(to, value)| *to = *value);
        };
        copy(trajectory.state, &start.state);
        copy(trajectory.parameters, &start.parameters);
        (0, Plan::to(start.end))
    }

    fn passed(&self, count: &mut usize, _: &Passage) {
        *count += 1;
    }
}
