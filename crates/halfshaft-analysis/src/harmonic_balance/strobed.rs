//! Branches as states whenever a period of the excitation begins, for whoever lets the line run.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::ResonanceQuestion;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{SpecialKind, Status};

use super::answer::{Setting, over_speed, reference, refuse};
use super::branches::{Collected, TracedBranch};
use super::channels::group_series;
use super::line::Line;
use super::orbits::state_at;
use super::parameter_answer::over_parameter;
use super::system::{HarmonicSystem, Place};
use super::tracer::Sample;
use crate::error::AnalysisError;
use crate::shooting::Coordinates;

/// A response at one value of what runs along its branch.
#[derive(Clone, Debug)]
pub(crate) struct Strobe {
    /// Excitation speed (rad/s) or number of the line.
    pub(crate) p: f64,
    /// `None` where it is not known.
    pub(crate) stable: Option<bool>,
    /// The state at the beginning of each period of the excitation until it repeats.
    pub(crate) states: Vec<Vec<f64>>,
}

/// A branch of them.
#[derive(Clone, Debug)]
pub(crate) struct StrobedResponses {
    pub(crate) periods: u32,
    pub(crate) origin: String,
    /// Samples in the order of the branch.
    pub(crate) samples: Vec<Strobe>,
    /// Folds and the like, each with the number of the sample that it follows.
    pub(crate) specials: Vec<(SpecialKind, Status, usize, Strobe)>,
}

/// A line about to be swept.
pub(crate) struct Prepared {
    /// Order of the fundamental: a period of the excitation lasts 2π over its speed.
    pub(crate) base: f64,
    /// Range of the excitation speed, rad/s.
    pub(crate) range: (f64, f64),
    /// The shaft whose twist stands for the response.
    pub(crate) shaft: String,
}

impl Prepared {
    /// Prepares a line for a range of speeds (`None` for about its resonance).
    pub(crate) fn new(
        equations: &Rc<EquationsOfMotion>,
        frequency: Option<(f64, f64)>,
    ) -> Result<Self, AnalysisError> {
        let setting = Setting::of_any(Rc::clone(equations), frequency, 1)?;
        let shaft = reference(&setting).to_owned();
        Ok(Self { base: setting.base, range: setting.range, shaft })
    }
}

/// All branches that `resonance` finds; rates of their states are over `reference` (rad/s).
pub(crate) fn strobed(
    line: &Driveline,
    question: &ResonanceQuestion,
    reference: f64,
    observer: &dyn Observer,
) -> Result<Vec<StrobedResponses>, AnalysisError> {
    let equations = Rc::new(EquationsOfMotion::new(line)?);
    let own = Setting::of_any(equations, question.frequency, question.mode)?;
    let Some(range) = &question.parameter else {
        let collected = over_speed(&own, question, observer)?;
        let member = |p: f64| Some((own.line.clone(), p));
        return Ok(Looking { setting: &own, member: &member, reference }.all(&collected));
    };
    refuse(&own.line.equations)?;
    let frequency = own.range.0;
    let over = over_parameter(line, question, range, &own, observer)?;
    let member = |p: f64| Some((over.member(p)?, frequency));
    Ok(Looking { setting: &over.setting, member: &member, reference }.all(&over.collected))
}

/// How branches are looked at.
struct Looking<'s> {
    setting: &'s Setting,
    /// The line and the excitation speed at a value.
    member: &'s dyn Fn(f64) -> Option<(Line, f64)>,
    reference: f64,
}

impl Looking<'_> {
    fn all(&self, collected: &Collected) -> Vec<StrobedResponses> {
        let mut all = Vec::new();
        for branch in &collected.branches {
            all.push(self.branch(branch, false));
            // Of responses whose mirror symmetry is broken one is followed; a motion may go to its twin.
            if self.setting.odd && branch.samples.iter().any(|sample| !sample.set.is_odd()) {
                all.push(self.branch(branch, true));
            }
        }
        all
    }

    fn branch(&self, branch: &TracedBranch, twin: bool) -> StrobedResponses {
        let look = |sample: &Sample, stable| self.strobe(branch, sample, stable, twin);
        let known = branch.stability.iter().map(|s| s.is_known().then(|| s.is_stable()));
        let samples = branch.samples.iter().zip(known);
        let specials = branch.specials.iter().filter_map(|special| {
            let strobe = look(&special.sample, None)?;
            let status = if special.located { Status::Located } else { Status::Bracketed };
            Some((special.kind, status, special.after, strobe))
        });
        let mirrored = if twin { ", mirrored" } else { "" };
        StrobedResponses {
            periods: branch.periods,
            origin: format!("{}{mirrored}", branch.origin),
            samples: samples.filter_map(|(sample, stable)| look(sample, stable)).collect(),
            specials: specials.collect(),
        }
    }

    fn strobe(
        &self,
        branch: &TracedBranch,
        sample: &Sample,
        stable: Option<bool>,
        twin: bool,
    ) -> Option<Strobe> {
        let (line, frequency) = (self.member)(sample.p)?;
        let coordinates = Coordinates::new(&line.equations, self.reference);
        let speed = branch.base * frequency;
        let mut system = HarmonicSystem::new(line.clone(), sample.set.clone(), branch.base);
        let series = group_series(&mut system, &sample.u, Place { frequency, drive: 1.0 });
        let turn = std::f64::consts::TAU / f64::from(branch.periods.max(1));
        let at = |period: u32| {
            let phase = turn * (f64::from(period) + if twin { 0.5 } else { 0.0 });
            let mut state = state_at(&line, &sample.set, &series, speed, phase, &coordinates);
            if twin {
                state.iter_mut().for_each(|x| *x = -*x);
            }
            state
        };
        Some(Strobe { p: sample.p, stable, states: (0..branch.periods.max(1)).map(at).collect() })
    }
}
