//! From a line to the answer of `resonance --method harmonic-balance`.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{Question, ResonanceQuestion};
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Branch, Column, Effort, Header, Named, ResonanceResult, SpecialKind, SpecialPoint, Status,
};

use super::backbone::{BackboneSettings, backbones};
use super::branches::{Collected, Job, TracedBranch};
use super::channels::{ChannelValue, Channels, named, names};
use super::jumps::jumps;
use super::line::Line;
use super::messages::messages;
use super::problem::Axis;
use super::range::default_range;
use super::seeds::{Seed, drive_curve};
use super::stability::Stability;
use super::system::{HarmonicSystem, Place};
use super::tips::tips;
use super::tracer::{BranchEnd, Counted, LONGEST, MISS, Sample, TraceSettings, length};
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
        let (low, high) = self.range;
        let at = |k: u32| low + (high - low) * f64::from(k) / f64::from(INNER_SEEDS + 1);
        let inner = (1..=INNER_SEEDS).map(|k| (at(k), format!("a response at {:.6} rad/s", at(k))));
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
            seeds.push((seed, frequency, format!("a resonance at {frequency:.6} rad/s")));
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
            longest: LONGEST,
            most_samples: 20_000,
            most_size: 1e9,
        }
    }
}

/// Refuses what harmonics cannot represent, by name: a damper that acts in contact only makes the
/// torque jump where the contact opens. Shooting follows such lines.
fn refuse(equations: &EquationsOfMotion) -> Result<(), AnalysisError> {
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
    let collected = match super::exact::collect(&setting, question, observer) {
        Some(collected) => collected,
        None => {
            refuse(&equations)?;
            by_harmonics(&setting, question, observer)
        }
    };
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
fn by_harmonics(
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

/// Measures channels, one set of harmonics at a time.
pub(super) struct Measured<'s> {
    setting: &'s Setting,
    systems: Vec<(HarmonicSystem, Channels)>,
    /// What runs in place of the excitation speed.
    along: Option<Along<'s>>,
}

/// A number of the line that runs along the branches.
#[derive(Clone, Copy)]
pub(super) struct Along<'s> {
    pub(super) address: &'s str,
    pub(super) unit: &'static str,
    pub(super) frequency: f64,
    /// The line at each value.
    pub(super) family: &'s dyn Fn(f64) -> Option<Line>,
}

impl<'s> Measured<'s> {
    pub(super) fn new(setting: &'s Setting, along: Option<Along<'s>>) -> Self {
        Self { setting, systems: Vec::new(), along }
    }

    /// Values of all channels at a sample of a branch over the excitation speed.
    pub(super) fn values(&mut self, sample: &Sample, base: f64, periods: u32) -> Vec<ChannelValue> {
        let same = |(system, channels): &(HarmonicSystem, Channels)| {
            *channels.set() == sample.set && system.base == base
        };
        let at = self.systems.iter().position(same).unwrap_or_else(|| {
            let system = HarmonicSystem::new(self.setting.line.clone(), sample.set.clone(), base);
            self.systems.push((system, Channels::new(&sample.set, periods)));
            self.systems.len() - 1
        });
        let (system, channels) = &mut self.systems[at];
        let mut place = Place { frequency: sample.p, drive: 1.0 };
        if let Some(along) = &self.along {
            place.frequency = along.frequency;
            if let Some(line) = (along.family)(sample.p) {
                system.replace(line);
            }
        }
        channels.measure(system, &sample.u, place)
    }

    /// Speed, and the number that runs in its place, of a sample.
    fn place(&self, sample: &Sample) -> Vec<(String, &'static str, f64)> {
        let speed = self.along.map_or(sample.p, |along| along.frequency);
        let mut place = vec![("frequency".to_owned(), "rad/s", speed)];
        if let Some(along) = &self.along {
            place.push((along.address.to_owned(), along.unit, sample.p));
        }
        place
    }

    fn branch(&mut self, branch: &TracedBranch) -> Branch {
        let rows: Vec<Vec<ChannelValue>> =
            branch.samples.iter().map(|s| self.values(s, branch.base, branch.periods)).collect();
        let of = |value: &dyn Fn(usize) -> f64| (0..rows.len()).map(value).collect::<Vec<f64>>();
        let mut columns: Vec<Column> = Vec::new();
        let places: Vec<_> = branch.samples.iter().map(|sample| self.place(sample)).collect();
        for (index, (name, unit, _)) in places.first().into_iter().flatten().enumerate() {
            columns.push(Column::new(name.clone(), *unit, of(&|k| places[k][index].2)));
        }
        for (index, (name, unit)) in names(&self.setting.line.equations).into_iter().enumerate() {
            let mut add = |word: &str, value: &dyn Fn(&ChannelValue) -> f64| {
                let values = rows.iter().map(|row| value(&row[index])).collect();
                columns.push(Column::new(format!("{name}.{word}"), unit, values));
            };
            add("amplitude", &|v| v.amplitude);
            add("mean", &|v| v.mean);
            add("harmonic1", &|v| v.harmonic1);
        }
        let stability = &branch.stability;
        columns.push(Column::new(
            "stable",
            "1",
            of(&|k| {
                let stable = f64::from(u8::from(stability[k].is_stable()));
                if stability[k].is_known() { stable } else { f64::NAN }
            }),
        ));
        columns.push(Column::new("unstable_dimension", "1", of(&|k| stability[k].unstable as f64)));
        columns.push(Column::new("largest_multiplier", "1", of(&|k| stability[k].largest())));
        columns.push(Column::new(
            "harmonics",
            "1",
            of(&|k| branch.samples[k].set.highest() as f64),
        ));
        columns.push(Column::new("truncation", "1", of(&|k| branch.samples[k].truncation)));
        let mut special_points: Vec<SpecialPoint> = Vec::new();
        special_points.extend(self.end(branch, true));
        special_points.extend(branch.specials.iter().map(|special| self.special(branch, special)));
        special_points.extend(self.end(branch, false));
        Branch {
            columns,
            special_points,
            closed: branch.closed(),
            periods: branch.periods,
            origin: branch.origin.clone(),
            ends: described(branch),
            multipliers: stability.iter().map(leading).collect(),
        }
    }

    fn point(&mut self, branch: &TracedBranch, sample: &Sample) -> Named<f64> {
        let values = self.values(sample, branch.base, branch.periods);
        let mut all: Named<f64> = Named::new();
        all.extend(self.place(sample).into_iter().map(|(name, _, value)| (name, value)));
        all.extend(named(&self.setting.line.equations, &values));
        all
    }

    fn special(
        &mut self,
        branch: &TracedBranch,
        special: &super::special::Special,
    ) -> SpecialPoint {
        let mut values = self.point(branch, &special.sample);
        if let Some(stability) = &special.stability {
            values.insert("largest_multiplier".to_owned(), stability.largest());
            if special.kind == SpecialKind::NeimarkSacker {
                values
                    .insert("multiplier_angle".to_owned(), super::stability::pair_angle(stability));
            }
        }
        if special.kind == SpecialKind::PeriodDoubling {
            values.insert("multiplier_angle".to_owned(), std::f64::consts::PI);
        }
        values.insert("harmonics".to_owned(), special.sample.set.highest() as f64);
        if special.precision.is_finite() {
            values.insert("precision".to_owned(), special.precision);
        }
        let status = if special.located { Status::Located } else { Status::Bracketed };
        let mut point = SpecialPoint::new(special.kind, status, values);
        point.unstable_dimension_change = special.change;
        point.note.clone_from(&special.note);
        point
    }

    /// The end of a branch that is not closed and did not begin at another.
    fn end(&mut self, branch: &TracedBranch, first: bool) -> Option<SpecialPoint> {
        let end = branch.ends[usize::from(!first)];
        if branch.closed() || end == BranchEnd::Enough {
            return None;
        }
        let sample = if first { branch.samples.first() } else { branch.samples.last() }?;
        Some(SpecialPoint::new(SpecialKind::End, Status::Located, self.point(branch, sample)))
    }
}

/// Multipliers of each sample that are kept.
const KEPT_MULTIPLIERS: usize = 8;

fn leading(stability: &Stability) -> Vec<[f64; 2]> {
    stability.multipliers.iter().take(KEPT_MULTIPLIERS).map(|m| [m.re, m.im]).collect()
}

fn described(branch: &TracedBranch) -> String {
    let of = |end: BranchEnd| match end {
        BranchEnd::Range => "at the border of the range",
        BranchEnd::Closed => "where it began",
        BranchEnd::StepTooSmall => "where no step was small enough to go on",
        BranchEnd::SampleLimit => "after as many samples as allowed",
        BranchEnd::Unbounded => "where the response grows beyond all measure",
        BranchEnd::Chattering => "where a contact closes and opens too often to be followed",
        BranchEnd::Grazing => "where a twist grazes a break of its law",
        BranchEnd::Cancelled => "where it was stopped",
        BranchEnd::Enough => "where it meets another branch",
    };
    if branch.closed() {
        return "closed".to_owned();
    }
    let [from, to] = branch.ends.map(of);
    if from == to { from.to_owned() } else { format!("{from}, and {to}") }
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
