//! A batch of trajectories that go their own ways: each lane has its own step, and a lane whose
//! trajectory is through takes the next one at once.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::instructions::Job;
use super::stepper::Stepper;
use super::{Finished, Lanes, Plan, Task, Trajectory};
use crate::observer::Observer;
use crate::ode::Stop;

/// Progress is told after so many trajectories.
const TOLD_EVERY: usize = 64;

/// What all threads share.
pub(super) struct Shared<'e, T> {
    pub(super) task: &'e T,
    pub(super) count: usize,
    pub(super) step_limit: usize,
    pub(super) observer: &'e dyn Observer,
    pub(super) next: AtomicUsize,
    pub(super) done: AtomicUsize,
}

/// Trajectories with their numbers.
pub(super) type Numbered<M> = Vec<(usize, Finished<M>)>;

/// The trajectory in a lane.
struct Running<M> {
    index: usize,
    memory: M,
}

/// The lanes of one thread.
pub(super) struct Batch<'e, T: Task, S, L> {
    shared: &'e Shared<'e, T>,
    stepper: S,
    running: Vec<Option<Running<T::Memory>>>,
    goal: L,
    watch: L,
    steps: L,
    state: Vec<f64>,
    parameters: Vec<f64>,
    inside: Vec<L>,
    finished: Numbered<T::Memory>,
}

impl<T: Task, S: Stepper<L>, L: Lanes> Job for Batch<'_, T, S, L> {
    type Output = Numbered<T::Memory>;

    #[inline(always)]
    fn run(mut self) -> Numbered<T::Memory> {
        let limit = L::splat(self.shared.step_limit as f64);
        while self.running.iter().any(Option::is_some) {
            let goal = if S::LOOKS_INSIDE { self.goal } else { self.goal.smaller(self.watch) };
            let lost = self.stepper.step(goal);
            self.steps = self.steps + L::splat(1.0);
            if !self.stepper.passes().is_empty() {
                self.tell_passages();
            }
            let time = self.stepper.time();
            if self.watch.any(time, |watch, time| watch <= time) {
                self.look();
            }
            let through = time.any(self.goal, |time, goal| time >= goal);
            let out = lost.any(limit, |lost, _| lost > 0.0);
            let tired = self.steps.any(limit, |steps, limit| steps >= limit);
            if through | out | tired {
                self.settle(lost);
            }
        }
        self.finished
    }
}

impl<'e, T: Task, S: Stepper<L>, L: Lanes> Batch<'e, T, S, L> {
    pub(super) fn new(shared: &'e Shared<'e, T>, stepper: S) -> Self {
        let zero = L::splat(0.0);
        let mut batch = Self {
            running: (0..L::COUNT).map(|_| None).collect(),
            goal: zero,
            watch: L::splat(f64::INFINITY),
            steps: zero,
            state: vec![0.0; stepper.dimension()],
            parameters: vec![0.0; stepper.parameters()],
            inside: vec![zero; stepper.dimension()],
            finished: Vec::new(),
            shared,
            stepper,
        };
        (0..L::COUNT).for_each(|lane| batch.refill(lane));
        batch
    }

    /// Takes the next trajectory into a lane, or leaves it idle: at its goal for ever.
    #[cold]
    #[inline(never)]
    fn refill(&mut self, lane: usize) {
        self.running[lane] = None;
        let cancelled = self.shared.observer.cancelled();
        let next = |shared: &Shared<'_, T>| shared.next.fetch_add(1, Ordering::Relaxed);
        let index = if cancelled { usize::MAX } else { next(self.shared) };
        self.state.fill(0.0);
        self.parameters.fill(0.0);
        let mut time = 0.0;
        let mut plan = Plan::to(0.0);
        if index < self.shared.count {
            let (state, parameters) = (&mut self.state[..], &mut self.parameters[..]);
            let mut trajectory = Trajectory { time, state, parameters };
            let (memory, first) = self.shared.task.begin(index, &mut trajectory);
            (time, plan) = (trajectory.time, first);
            self.running[lane] = Some(Running { index, memory });
        }
        self.stepper.set(lane, time, &self.state, &self.parameters);
        self.steps.set(lane, 0.0);
        self.plan(lane, plan);
    }

    /// All run forwards: a goal that lies behind is here, a watch that lies behind is none.
    fn plan(&mut self, lane: usize, plan: Plan) {
        let time = self.stepper.time().get(lane);
        self.goal.set(lane, if plan.goal > time { plan.goal } else { time });
        self.watch.set(lane, if plan.watch > time { plan.watch } else { f64::INFINITY });
    }

    #[cold]
    #[inline(never)]
    fn tell_passages(&mut self) {
        for pass in self.stepper.passes() {
            if let Some(running) = &mut self.running[pass.lane] {
                self.shared.task.passed(&mut running.memory, &pass.passage);
            }
        }
    }

    /// Shows states inside the last steps until no watch lies there any more.
    #[inline(always)]
    fn look(&mut self) {
        loop {
            let time = self.stepper.time();
            if !self.watch.any(time, |watch, time| watch <= time) {
                return;
            }
            let at = self.watch.smaller(time);
            self.stepper.inside(at, &mut self.inside);
            for lane in 0..L::COUNT {
                if self.watch.get(lane) <= time.get(lane) {
                    self.show(lane, at.get(lane));
                }
            }
        }
    }

    fn show(&mut self, lane: usize, at: f64) {
        self.state.iter_mut().zip(&self.inside).for_each(|(value, from)| *value = from.get(lane));
        let Some(running) = &mut self.running[lane] else {
            self.watch.set(lane, f64::INFINITY);
            return;
        };
        match self.shared.task.watched(&mut running.memory, at, &self.state) {
            // Watches go forwards.
            Some(next) if next > at => self.watch.set(lane, next),
            Some(_) => self.watch.set(lane, f64::INFINITY),
            None => {
                let state = self.state.clone();
                self.finish(lane, at, state, None);
                self.refill(lane);
            }
        }
    }

    /// Looks after lanes that are at their goals or cannot go on.
    #[cold]
    #[inline(never)]
    fn settle(&mut self, lost: L) {
        for lane in 0..L::COUNT {
            let Some(running) = &mut self.running[lane] else { continue };
            let time = self.stepper.time().get(lane);
            let limit = self.shared.step_limit;
            let tired = self.steps.get(lane) >= limit as f64;
            let arrives = time >= self.goal.get(lane);
            // A trajectory that was put into the lane just now has not been stepped yet.
            let lost = if self.steps.get(lane) == 0.0 { 0.0 } else { lost.get(lane) };
            if !arrives && !tired && lost == 0.0 {
                continue;
            }
            self.stepper.get(lane, &mut self.state, &mut self.parameters);
            let finite = lost <= 1.0 && self.state.iter().all(|value| value.is_finite());
            let stop = match (finite, arrives, lost > 0.0) {
                (false, ..) => Some(Stop::NonFinite { time }),
                (true, true, _) => None,
                (true, false, true) => Some(Stop::StepTooSmall { time, step: 0.0 }),
                (true, false, false) => Some(Stop::StepLimit { time, limit }),
            };
            let (state, parameters) = (&mut self.state[..], &mut self.parameters[..]);
            let mut trajectory = Trajectory { time, state, parameters };
            let task = self.shared.task;
            let plan = match stop {
                None => task.arrived(&mut running.memory, &mut trajectory),
                Some(_) => None,
            };
            let time = trajectory.time;
            match plan {
                Some(plan) => {
                    self.stepper.set(lane, time, &self.state, &self.parameters);
                    self.plan(lane, plan);
                }
                None => {
                    let state = self.state.clone();
                    self.finish(lane, time, state, stop);
                    self.refill(lane);
                }
            }
        }
    }

    fn finish(&mut self, lane: usize, time: f64, state: Vec<f64>, stop: Option<Stop>) {
        let Some(Running { index, memory }) = self.running[lane].take() else { return };
        let steps = self.steps.get(lane) as usize;
        self.finished.push((index, Finished { memory, time, state, steps, stop }));
        let done = self.shared.done.fetch_add(1, Ordering::Relaxed) + 1;
        if done.is_multiple_of(TOLD_EVERY) {
            self.shared.observer.progress(done as f64 / self.shared.count as f64);
        }
    }
}
