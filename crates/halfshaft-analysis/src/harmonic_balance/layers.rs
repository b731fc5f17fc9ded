//! Single layers of harmonic balance for benches: what one law, residual, Newton step, orbit, stability
//! costs beside a whole curve. Not for use elsewhere.

use std::hint::black_box;
use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::StabilityMethod;
use halfshaft_numerics::observer::Silent;

use super::answer::Setting;
use super::branches::Job;
use super::problem::{Axis, Problem};
use super::side_by_side::ORBITS;
use super::stability::Judge;
use super::system::{HarmonicSystem, Place};
use super::tracer::{Counted, Sample, Tracer, length};

/// A line with one of its responses.
#[derive(Debug)]
pub struct Layers {
    setting: Setting,
    base: f64,
    sample: Sample,
    tolerance: f64,
}

impl Layers {
    /// The response of `line` nearest to the middle of a range of speeds (rad/s); `None` where none
    /// was found.
    pub fn new(line: &Driveline, range: (f64, f64), tolerance: f64) -> Option<Self> {
        let equations = Rc::new(EquationsOfMotion::new(line).ok()?);
        let setting = Setting::new(equations, Some(range), 1).ok()?;
        let middle = f64::midpoint(range.0, range.1);
        let collected = job(&setting, tolerance).collect(&seeds(&setting));
        let branch = collected.branches.first()?;
        let near = |sample: &&Sample| (sample.p - middle).abs();
        let sample = branch.samples.iter().min_by(|a, b| near(a).total_cmp(&near(b)))?.clone();
        Some(Self { base: branch.base, sample, setting, tolerance })
    }

    /// Number of unknowns of the response.
    pub fn unknowns(&self) -> usize {
        self.sample.u.len()
    }

    fn place(&self) -> Place {
        Place { frequency: self.sample.p, drive: 1.0 }
    }

    /// The response's equations.
    pub fn system(&self) -> Equations {
        let line = self.setting.line.clone();
        let system = HarmonicSystem::new(line, self.sample.set.clone(), self.base);
        let problem = Problem::new(system, Axis::Frequency, self.place());
        let judge = Judge::new(&problem.system, StabilityMethod::Monodromy);
        let (u, place) = (self.sample.u.clone(), self.place());
        let moved = u.iter().enumerate();
        let moved = moved.map(|(k, u)| u + 1e-3 * length(&self.sample.u) * (k as f64).sin());
        Equations { moved: moved.collect(), problem, judge, u, place }
    }

    /// Seeds of all branches; their number.
    pub fn seeds(&self) -> usize {
        seeds(&self.setting).len()
    }

    /// The branch through the response, without stability; its number of samples.
    pub fn branch(&self) -> usize {
        let line = self.setting.line.clone();
        let system = HarmonicSystem::new(line, self.sample.set.clone(), self.base);
        let problem = Problem::new(system, Axis::Frequency, self.place());
        let settings = self.setting.trace_settings(self.tolerance, None);
        let mut tracer = Tracer::new(problem, settings, &Silent);
        let there = tracer.follow(&self.sample, 1.0).0.len();
        there + tracer.follow(&self.sample, -1.0).0.len()
    }
}

/// The equations at the response, ready to be evaluated again and again.
pub struct Equations {
    problem: Problem<'static>,
    judge: Judge,
    u: Vec<f64>,
    moved: Vec<f64>,
    place: Place,
}

impl std::fmt::Debug for Equations {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Equations").finish_non_exhaustive()
    }
}

impl Equations {
    /// Residual.
    pub fn residual(&mut self) {
        self.problem.system.evaluate(black_box(&self.u), self.place, false);
    }

    /// Residual and Jacobian.
    pub fn jacobian(&mut self) {
        self.problem.system.evaluate(black_box(&self.u), self.place, true);
    }

    /// One step of Newton's method: residual, Jacobian, factors, solution.
    pub fn newton_step(&mut self) {
        let none = vec![0.0; self.u.len()];
        let mut step = self.u.clone();
        let mut p = 0.0;
        let done = self.problem.evaluate(black_box(&self.u), self.place.frequency);
        if done.is_ok() && self.problem.factorise(&none, 1.0).is_ok() {
            self.problem.solve(&mut step, &mut p);
        }
        black_box(&step);
    }

    /// A response from a guess that is a thousandth off; whether it was found.
    pub fn orbit(&mut self) -> bool {
        let mut u = self.moved.clone();
        let size = length(&u);
        self.problem.at(&mut u, self.place.frequency, size).is_ok()
    }

    /// The multipliers of the response; their number.
    pub fn stability(&mut self) -> usize {
        let found = self.judge.stability(&self.problem.system, black_box(&self.u), self.place);
        found.map_or(0, |stability| stability.multipliers.len())
    }

    /// The same of as many copies of the response as lanes hold, which a small line is asked for at once; `None` for
    /// another.
    pub fn stabilities(&self) -> Option<usize> {
        let copies = vec![(black_box(&self.u[..]), self.place); ORBITS];
        let all = self.judge.stabilities(&self.problem.system, &copies)?;
        Some(all.iter().flatten().map(|stability| stability.multipliers.len()).sum())
    }
}

fn seeds(setting: &Setting) -> Vec<(super::seeds::Seed, f64, String)> {
    setting.seeds(None, &Silent, &mut Counted::default())
}

fn job(setting: &Setting, tolerance: f64) -> Job<'_, 'static> {
    Job {
        line: &setting.line,
        axis: Axis::Frequency,
        place: Place { frequency: setting.range.0, drive: 1.0 },
        base: setting.base,
        settings: setting.trace_settings(tolerance, None),
        observer: &Silent,
        doublings: false,
        judged: false,
        stability: StabilityMethod::Monodromy,
    }
}
