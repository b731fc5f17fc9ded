//! From a line to the answer of `resonance --method harmonic-balance`.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{Question, ResonanceQuestion};
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Branch, Effort, Header, Named, ResonanceResult};

use super::backbone::{BackboneSettings, backbones};
use super::branches::{Collected, Job};
use super::jumps::jumps;
use super::line::Line;
use super::measured::Measured;
use super::messages::messages;
use super::problem::Axis;
use super::range::default_range;
use super::seeds::{Seed, drive_curve};
use super::system::Place;
use super::tips::tips;
use super::tracer::{Counted, FIRST, LONGEST, MISS, TraceSettings, length};
use crate::equilibrium;
use crate::error::AnalysisError;
use crate::header::header;
use crate::verification::common_order;

/// A line about to be asked for its periodic responses.
#[derive(Debug)]
pub(crate) struct Setting {
    pub(crate) line: Line,
    /// Twists at rest.
    pub(crate) rest: Vec<f64>,
    /// Order of the fundamental.
    pub(crate) base: f64,
    /// Whether responses mirror themselves after half a period.
    pub(crate) odd: bool,
    pub(crate) range: (f64, f64),
}

/// Speeds between the ends of the range at which further responses are looked for.
const INNER_SEEDS: u32 = 7;

impl Setting {
    /// Prepares a line for a range of speeds (`None` for about the resonance of a mode).
    pub(crate) fn new(
        equations: Rc<EquationsOfMotion>,
        frequency: Option<(f64, f64)>,
        mode: usize,
    ) -> Result<Self, AnalysisError> {
        refuse(&equations)?;
        Self::of_any(equations, frequency, mode)
    }

    /// The same, also where torques jump: for shooting alone.
    pub(super) fn of_any(
        equations: Rc<EquationsOfMotion>,
        frequency: Option<(f64, f64)>,
        mode: usize,
    ) -> Result<Self, AnalysisError> {
        let orders = equations.excitation.orders();
        if orders.is_empty() {
            let reason = "no torque has an amplitude".to_owned();
            return Err(AnalysisError::NoExcitation { reason });
        }
        let Some(base) = common_order(&orders) else {
            return Err(AnalysisError::MethodDoesNotFit {
                method: "harmonic-balance",
                reason: "the orders of the torques have no common period".to_owned(),
            });
        };
        let states = equilibrium::find_stable(&equations)?;
        let none = vec![0.0; equations.connections.len()];
        let rest = states.primary().map_or(none, |state| state.twists.clone());
        let range = match frequency {
            Some(range) => range,
            None => default_range(&equations, &states, mode)?,
        };
        let line = Line::new(equations);
        let mirrors = |order: &f64| (order / base).round() % 2.0 == 1.0;
        let odd = line.is_odd() && orders.iter().all(mirrors);
        Ok(Self { line, rest, base, odd, range })
    }

    /// Orders of the excitation over the base, ascending.
    pub(super) fn orders(&self) -> Vec<usize> {
        let orders = self.line.equations.excitation.orders().into_iter();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small counts")]
        let whole = orders.map(|order| (order / self.base).round() as usize);
        whole.collect()
    }

    /// Highest order of the excitation over the base.
    pub(super) fn excited(&self) -> usize {
        self.orders().last().copied().unwrap_or(1).max(1)
    }

    /// Seeds at the ends of the range and between them, and at the tips of resonances, with their
    /// speed and where they come from.
    pub(super) fn seeds(
        &self,
        harmonics: Option<usize>,
        observer: &dyn Observer,
        counted: &mut Counted,
    ) -> Vec<(Seed, f64, String)> {
        self.seeds_between(INNER_SEEDS, harmonics, observer, counted)
    }

    /// The same with a number of speeds between the ends.
    pub(super) fn seeds_between(
        &self,
        inner: u32,
        harmonics: Option<usize>,
        observer: &dyn Observer,
        counted: &mut Counted,
    ) -> Vec<(Seed, f64, String)> {
        let (low, high) = self.range;
        let at = |k: u32| low + (high - low) * f64::from(k) / f64::from(inner + 1);
        let inner = (1..=inner).map(|k| (at(k), format!("response at {:.6} rad/s", at(k))));
        let ends =
            [(low, "low end of the range".to_owned()), (high, "high end of the range".to_owned())];
        let (highest, orders) = (self.excited(), self.orders());
        let set = if self.odd { HarmonicSet::odd(highest) } else { HarmonicSet::all(highest) };
        let mut seeds = Vec::new();
        let mut curves = Vec::new();
        for (frequency, origin) in ends.into_iter().chain(inner) {
            let frequency = if frequency == 0.0 { 1e-3 * high } else { frequency };
            let curve = drive_curve(
                &self.line, &self.rest, self.base, &set, &orders, frequency, observer, counted,
            );
            let found = curve.seeds.iter().cloned();
            seeds.extend(found.map(|seed| (seed, frequency, origin.clone())));
            curves.push(curve);
        }
        for (seed, frequency) in tips(self, curves, harmonics, observer, counted) {
            seeds.push((seed, frequency, format!("resonance at {frequency:.6} rad/s")));
        }
        seeds
    }

    /// Settings of a continuation over the range.
    pub(super) fn trace_settings(&self, tolerance: f64, harmonics: Option<usize>) -> TraceSettings {
        TraceSettings {
            range: self.range,
            tolerance,
            harmonics,
            miss: MISS,
            floored: false,
            first: FIRST,
            longest: LONGEST,
            most_samples: 4000,
            most_size: 1e9,
        }
    }
}

/// Refuses what harmonics cannot represent, by name: a damper that acts in contact only makes the
/// torque jump where the contact opens. Shooting follows such lines.
pub(super) fn refuse(equations: &EquationsOfMotion) -> Result<(), AnalysisError> {
    let jumps = |c: &&halfshaft_dynamics::Connection| !c.damps_in_gap && c.damping != 0.0;
    match equations.connections.iter().find(jumps) {
        Some(connection) if !connection.law.is_linear() => Err(AnalysisError::MethodDoesNotFit {
            method: "harmonic-balance",
            reason: format!(
                "the damper of {} acts in contact only, so its torque jumps where the contact opens: \
                 such a line is followed over the speed only, with the number of harmonics left open, \
                 and where it has few inertias; take damping_acts = \"always\", or \
                 --method first-harmonic",
                connection.name
            ),
        }),
        _ => Ok(()),
    }
}

/// All branches over the excitation speed.
pub(super) fn over_speed(
    setting: &Setting,
    question: &ResonanceQuestion,
    observer: &dyn Observer,
) -> Result<Collected, AnalysisError> {
    if let Some(collected) = super::exact::collect(setting, question, observer) {
        return Ok(collected);
    }
    refuse(&setting.line.equations)?;
    Ok(by_harmonics(setting, question, observer))
}

/// Answers `resonance` by harmonic balance.
pub(crate) fn solve(
    line: &Driveline,
    question: &ResonanceQuestion,
    observer: &dyn Observer,
) -> Result<ResonanceResult, AnalysisError> {
    let equations = Rc::new(EquationsOfMotion::new(line)?);
    let setting = Setting::of_any(Rc::clone(&equations), question.frequency, question.mode)?;
    if let Some(range) = &question.parameter {
        refuse(&equations)?;
        return super::parameter_answer::solve(line, question, range, &setting, observer);
    }
    let collected = over_speed(&setting, question, observer)?;
    let header = header(line, &Question::Resonance(question.clone()));
    let mut measured = Measured::new(&setting, None);
    let mut result = assemble(&setting, &collected, &mut measured, header);
    result.jumps = jumps(&setting, &collected.branches);
    messages(&setting, question, &collected, &mut result);
    if question.backbone {
        refuse(&equations)?;
        result.backbones = drawn_backbones(&setting, &equations, question, &collected, observer)?;
    }
    if question.verify {
        super::verify::verify(&setting, &collected, &mut result, observer)?;
    }
    Ok(result)
}

/// Curves of phase resonance up to somewhat beyond the branches.
fn drawn_backbones(
    setting: &Setting,
    equations: &EquationsOfMotion,
    question: &ResonanceQuestion,
    collected: &Collected,
    observer: &dyn Observer,
) -> Result<Vec<halfshaft_results::Table>, AnalysisError> {
    let largest = collected.branches.iter().flat_map(|branch| &branch.samples);
    let largest = largest.map(|sample| length(&sample.u)).fold(0.0, f64::max);
    let settings = BackboneSettings {
        frequency: setting.range,
        tolerance: question.tolerance,
        harmonics: question.harmonics,
        most_drive: 3.0,
        most_size: 1.5 * largest,
    };
    let states = equilibrium::find_stable(equations)?;
    backbones(setting, &states, &settings, observer)
}

/// All branches with harmonics as unknowns.
pub(super) fn by_harmonics(
    setting: &Setting,
    question: &ResonanceQuestion,
    observer: &dyn Observer,
) -> Collected {
    let mut counted = Counted::default();
    let settings = trace_settings(setting, question);
    let seeds = setting.seeds(question.harmonics, observer, &mut counted);
    let job = Job {
        line: &setting.line,
        axis: Axis::Frequency,
        place: Place { frequency: setting.range.0, drive: 1.0 },
        base: setting.base,
        settings,
        observer,
        doublings: true,
        stability: question.stability,
        judged: true,
    };
    let mut collected = job.collect(&seeds);
    super::settling::settle(setting, &job, &mut collected);
    collected.counted.add(counted);
    collected
}

/// Settings of the continuation that a question asks for.
pub(super) fn trace_settings(setting: &Setting, question: &ResonanceQuestion) -> TraceSettings {
    let mut settings = setting.trace_settings(question.tolerance, question.harmonics);
    if let Some(points) = question.points {
        settings.longest = (4.0 / points.max(2) as f64).min(LONGEST);
    }
    settings
}

/// The branches as a result.
pub(super) fn assemble(
    setting: &Setting,
    collected: &Collected,
    measured: &mut Measured<'_>,
    header: Header,
) -> ResonanceResult {
    let branches: Vec<Branch> = collected.branches.iter().map(|b| measured.branch(b)).collect();
    let samples = collected.branches.iter().map(|branch| branch.samples.len()).sum();
    let peaks =
        branches.iter().filter(|branch| branch.periods == 1).filter_map(|b| peak(setting, b));
    ResonanceResult {
        header,
        peaks: peaks.collect(),
        jumps: Vec::new(),
        branches,
        scaling: Vec::new(),
        backbones: Vec::new(),
        verification: Vec::new(),
        effort: Some(Effort {
            samples,
            steps: collected.counted.steps,
            iterations: collected.counted.iterations,
            seeds: collected.counted.seeds,
        }),
    }
}

/// The sample with the largest swing of the first shaft of the line that is nonlinear, or of the
/// first.
fn peak(setting: &Setting, branch: &Branch) -> Option<Named<f64>> {
    let reference = reference(setting);
    let values = branch.values(&format!("{reference}.twist.amplitude"));
    let best =
        (0..values.len()).reduce(|best, k| if values[k] > values[best] { k } else { best })?;
    Some(branch.columns.iter().map(|c| (c.name.clone(), c.values[best])).collect())
}

/// The shaft whose twist stands for the response.
pub(super) fn reference(setting: &Setting) -> &str {
    let index = setting.line.twists.first().map_or(0, |twist| twist.connection);
    &setting.line.equations.connections[index].name
}
