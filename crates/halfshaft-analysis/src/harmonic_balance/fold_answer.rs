//! From a line to the answer of `folds --method harmonic-balance`.
//!
//! Response curves at a few values of the parameter give folds; from each that lies on no known curve
//! a curve of folds is followed through the plane.

use std::cell::Cell;
use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::question::{FoldsQuestion, Question, StabilityMethod};
use halfshaft_model::{ChangeError, Driveline};
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_results::{
    Column, FoldsResult, Header, Named, Reason, SpecialKind, SpecialPoint, Status, Table,
    Termination,
};

use super::answer::Setting;
use super::branches::Job;
use super::channels::{Channels, names};
use super::fold_points::on_curve;
use super::fold_system::{FoldSample, FoldSystem};
use super::fold_trace::{FoldCurve, FoldSettings, FoldTracer};
use super::line::{Line, nonlinear};
use super::lines::Lines;
use super::problem::{Axis, Problem};
use super::system::{HarmonicSystem, Place};
use super::tracer::Counted;
use crate::error::AnalysisError;
use crate::header::header;

/// Values of the parameter at which response curves are followed, beside the model's own.
const SLICES: u32 = 5;
/// Speeds between the ends of the window at which responses are looked for at each of them.
const INNER_SEEDS: u32 = 3;
/// How much more error is tolerated where laws have kinks.
const AT_KINKS: f64 = 100.0;

/// Answers `folds` by harmonic balance.
pub(crate) fn solve(
    line: &Driveline,
    question: &FoldsQuestion,
    observer: &dyn Observer,
) -> Result<FoldsResult, AnalysisError> {
    let parameter = line.parameter(&question.parameter.address).map_err(ChangeError::Address)?;
    let lines = Lines::new(line, parameter);
    let (from, to) = (question.parameter.from, question.parameter.to);
    let own = lines.parameter.value(line).filter(|value| (from..=to).contains(value));
    let slice = |k: u32| from + (to - from) * f64::from(k) / f64::from(SLICES - 1);
    let mut values: Vec<f64> = own.into_iter().collect();
    values.extend((0..SLICES).rev().map(slice));
    let window = window(&lines, &values, question)?;
    let first = values.iter().find_map(|value| lines.at(*value));
    let kinks = first.is_some_and(|equations| Line::new(equations).has_kinks());
    let cut = Cell::new(false);
    let plane = Plane { lines: &lines, question, window, values: &values, kinks, cut };
    let (curves, counted, cancelled) = plane.curves(observer)?;
    let mut result = plane.result(line, &curves, counted, observer)?;
    if cancelled {
        let detail = "not all values of the parameter were gone through".to_owned();
        result.header.termination = Termination::early(Reason::Cancelled, detail);
    }
    Ok(result)
}

/// The range of speeds: what was asked for, or about the resonances at all values of the parameter.
fn window(
    lines: &Lines<'_>,
    values: &[f64],
    question: &FoldsQuestion,
) -> Result<(f64, f64), AnalysisError> {
    if let Some(range) = question.frequency {
        return Ok(range);
    }
    let mut window: Option<(f64, f64)> = None;
    let mut failure = None;
    for equations in values.iter().filter_map(|value| lines.at(*value)) {
        match Setting::new(equations, None, question.mode) {
            Ok(setting) => {
                let (low, high) = setting.range;
                window = Some(window.map_or((low, high), |(a, b)| (a.min(low), b.max(high))));
            }
            Err(error) => failure = Some(error),
        }
    }
    match (window, failure) {
        (Some((low, high)), _) => {
            Ok(((low - 0.25 * (high - low)).max(0.5 * low), high + 0.25 * (high - low)))
        }
        (None, Some(error)) => Err(error),
        (None, None) => {
            Err(AnalysisError::NoExcitation { reason: "the line does not exist".to_owned() })
        }
    }
}

/// The plane of speed and parameter.
pub(super) struct Plane<'p, 'q> {
    pub(super) lines: &'p Lines<'q>,
    pub(super) question: &'p FoldsQuestion,
    pub(super) window: (f64, f64),
    values: &'p [f64],
    /// Whether laws have kinks.
    kinks: bool,
    /// Whether at some value more responses were left than were followed.
    cut: Cell<bool>,
}

/// A line of the family that stands for all: shape, oddness, base.
pub(super) struct Shape {
    line: Line,
    pub(super) odd: bool,
    pub(super) base: f64,
    flags: Vec<bool>,
}

impl Plane<'_, '_> {
    fn settings(&self) -> FoldSettings {
        let points = self.question.points.max(8) as f64;
        FoldSettings {
            frequency: self.window,
            parameter: (self.question.parameter.from, self.question.parameter.to),
            tolerance: self.tolerance(),
            harmonics: self.question.harmonics,
            longest: (8.0 / points).min(0.2),
        }
    }

    /// Error of the waveform that is tolerated: more where laws have kinks, at which harmonics die out
    /// slowly and a curve of folds would take thousands of times many of them.
    fn tolerance(&self) -> f64 {
        let asked = self.question.tolerance;
        if self.kinks { (AT_KINKS * asked).clamp(asked, 1e-3_f64.max(asked)) } else { asked }
    }

    /// What all lines of the family have in common.
    fn shape(&self) -> Result<Shape, AnalysisError> {
        let mut shape: Option<Shape> = None;
        for equations in self.values.iter().filter_map(|value| self.lines.at(*value)) {
            let flags = nonlinear(&equations);
            let setting = match Setting::new(equations, Some(self.window), self.question.mode) {
                // Without torques nothing folds, but beside it there may be something.
                Err(AnalysisError::NoExcitation { .. }) => continue,
                setting => setting?,
            };
            shape = Some(match shape {
                None => Shape { odd: setting.odd, base: setting.base, flags, line: setting.line },
                Some(known) => {
                    let flags: Vec<bool> =
                        known.flags.iter().zip(&flags).map(|(a, b)| *a || *b).collect();
                    Shape { odd: known.odd && setting.odd, flags, ..known }
                }
            });
        }
        shape.ok_or_else(|| AnalysisError::NoExcitation {
            reason: "the line does not exist".to_owned(),
        })
    }

    fn curves(
        &self,
        observer: &dyn Observer,
    ) -> Result<(Vec<FoldCurve>, Counted, bool), AnalysisError> {
        let shape = self.shape()?;
        let family = |value: f64| self.lines.at(value);
        let axis = Axis::Parameter(&family);
        let mut curves: Vec<FoldCurve> = Vec::new();
        let mut counted = Counted::default();
        for (index, &value) in self.values.iter().enumerate() {
            let part = Part::of(observer, index, self.values.len());
            part.progress(0.0);
            if observer.cancelled() {
                return Ok((curves, counted, true));
            }
            let Some(equations) = self.lines.at(value) else { continue };
            let folds = self.folds_at(&shape, equations, observer, &mut counted)?;
            for (set, u, frequency) in folds {
                let known = |curve: &FoldCurve| on_curve(curve, frequency, value, &u, &set);
                if curves.iter().any(known) {
                    continue;
                }
                let Some(equations) = self.lines.at(value) else { continue };
                let line = Line::flagged(equations, &shape.flags);
                let system = HarmonicSystem::new(line, set.clone(), shape.base);
                let place = Place { frequency, drive: 1.0 };
                let system = FoldSystem::new(Problem::new(system, axis, place));
                let mut tracer =
                    FoldTracer { system, settings: self.settings(), observer, counted };
                if let Ok(start) = tracer.start(&set, &u, frequency, value) {
                    curves.push(tracer.trace(&start));
                }
                counted = tracer.counted;
            }
        }
        Ok((curves, counted, false))
    }

    /// Folds of the response curve at one value of the parameter.
    fn folds_at(
        &self,
        shape: &Shape,
        equations: Rc<EquationsOfMotion>,
        observer: &dyn Observer,
        counted: &mut Counted,
    ) -> Result<Vec<(HarmonicSet, Vec<f64>, f64)>, AnalysisError> {
        let own = Rc::clone(&equations);
        let mut setting = match Setting::new(own, Some(self.window), self.question.mode) {
            Err(AnalysisError::NoExcitation { .. }) => return Ok(Vec::new()),
            setting => setting?,
        };
        setting.odd = shape.odd;
        setting.line = Line::flagged(equations, &shape.flags);
        let seeds = setting.seeds_between(INNER_SEEDS, self.question.harmonics, observer, counted);
        let job = Job {
            line: &setting.line,
            axis: Axis::Frequency,
            place: Place { frequency: self.window.0, drive: 1.0 },
            base: shape.base,
            settings: setting.trace_settings(self.tolerance(), self.question.harmonics),
            observer,
            doublings: false,
            stability: StabilityMethod::default(),
            judged: false,
        };
        let collected = job.collect(&seeds);
        self.cut.set(self.cut.get() || collected.cut);
        let folds = collected.branches.iter().flat_map(|branch| &branch.specials);
        let folds = folds.filter(|special| special.kind == SpecialKind::Fold && special.located);
        Ok(folds.map(|f| (f.sample.set.clone(), f.sample.u.clone(), f.sample.p)).collect())
    }

    fn result(
        &self,
        line: &Driveline,
        curves: &[FoldCurve],
        counted: Counted,
        observer: &dyn Observer,
    ) -> Result<FoldsResult, AnalysisError> {
        let shape = self.shape()?;
        let mut header = header(line, &Question::Folds(self.question.clone()));
        if curves.is_empty() {
            header.warnings.push(format!(
                "no fold between {:.6} and {:.6} rad/s for {} from {} to {}",
                self.window.0,
                self.window.1,
                self.question.parameter.address,
                self.question.parameter.from,
                self.question.parameter.to
            ));
        }
        if self.cut.get() {
            header.warnings.push(
                "responses are so many here that not all were searched for folds; ask for a narrower range"
                    .to_owned(),
            );
        }
        self.say(&counted, &mut header);
        let tables = curves.iter().map(|curve| self.table(&shape, curve)).collect();
        let specials = curves.iter().flat_map(|curve| &curve.specials);
        let special_points = specials
            .map(|special| {
                let mut values: Named<f64> = self
                    .names(&shape)
                    .into_iter()
                    .map(|(name, _)| name)
                    .zip(self.row(&shape, &special.sample))
                    .collect();
                values.insert("precision".to_owned(), special.precision);
                SpecialPoint::new(special.kind, Status::Located, values)
            })
            .collect();
        Ok(FoldsResult {
            header,
            curves: tables,
            special_points,
            parameter: self.question.parameter.address.clone(),
            parameter_unit: self.lines.parameter.unit().to_owned(),
            parameter_value: self.lines.parameter.value(line),
            scaling: None,
            responses: self.count(&shape, curves, observer),
        })
    }

    fn say(&self, counted: &Counted, header: &mut Header) {
        let at: Vec<String> = self.values.iter().map(|value| format!("{value:.6}")).collect();
        header.assumptions.push(format!(
            "curves were looked for from the folds at {} = {}; a curve that passes none of these values \
             is not found",
            self.question.parameter.address,
            at.join(", ")
        ));
        if self.kinks && self.question.harmonics.is_none() {
            header.assumptions.push(format!(
                "laws with kinks: waveforms along the curves are held to {:.0e}; `resonance` locates the \
                 folds at one value by exact orbits",
                self.tolerance()
            ));
        }
        header
            .assumptions
            .push(format!("{} steps and {} Newton iterations", counted.steps, counted.iterations));
    }

    fn names(&self, shape: &Shape) -> Vec<(String, String)> {
        let mut all = vec![
            ("frequency".to_owned(), "rad/s".to_owned()),
            (self.question.parameter.address.clone(), self.lines.parameter.unit().to_owned()),
        ];
        let channels = names(&shape.line.equations).into_iter();
        all.extend(channels.map(|(name, unit)| (format!("{name}.harmonic1"), unit.to_owned())));
        all.push(("opens".to_owned(), "1".to_owned()));
        all.push(("harmonics".to_owned(), "1".to_owned()));
        all
    }

    fn row(&self, shape: &Shape, sample: &FoldSample) -> Vec<f64> {
        let mut row = vec![sample.frequency, sample.parameter];
        let place = Place { frequency: sample.frequency, drive: 1.0 };
        if let Some(equations) = self.lines.at(sample.parameter) {
            let line = Line::flagged(equations, &shape.flags);
            let mut system = HarmonicSystem::new(line, sample.set.clone(), shape.base);
            let values = Channels::new(&sample.set, 1).measure(&mut system, &sample.u, place);
            row.extend(values.iter().map(|value| value.harmonic1));
        }
        row.push(sample.opens());
        row.push(sample.set.highest() as f64);
        row
    }

    fn table(&self, shape: &Shape, curve: &FoldCurve) -> Table {
        let rows: Vec<Vec<f64>> =
            curve.samples.iter().map(|sample| self.row(shape, sample)).collect();
        let columns = self.names(shape).into_iter().enumerate().map(|(index, (name, unit))| {
            Column::new(name, unit, rows.iter().map(|row| row[index]).collect())
        });
        Table::new(columns.collect())
    }
}
