//! From a line to the answer of `shock`.

use halfshaft_dynamics::{Active, EquationsOfMotion, Motion};
use halfshaft_model::Driveline;
use halfshaft_model::question::{
    ChannelQuantity, Question, ShockEquation, ShockMethod, ShockQuestion, Start,
};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    ChannelMetrics, Column, Header, HistoryMetrics, HistoryResult, Named, ShockDetails,
};

use super::closed::ClosedMotion;
use super::comparison;
use super::full::{self, final_twists, has_pulse, shaft_metrics};
use super::multiple_scales::{Expansion, Oscillator};
use super::single::{self, SingleEquation};
use crate::equilibrium::{self, RestState};
use crate::error::AnalysisError;
use crate::header::header;
use crate::modal::choose_equilibrium;
use crate::time_response::{
    DEFAULT_PARTS, TurningPoint, channel_metrics, energy_warning, history_columns, start_state,
};

/// A line at rest with a question about a shock to it.
pub(crate) struct ShockProblem<'q> {
    pub(crate) line: &'q Driveline,
    pub(crate) equations: EquationsOfMotion,
    pub(crate) rest: RestState,
    pub(crate) question: &'q ShockQuestion,
}

/// Answers `shock`.
pub(crate) fn solve(
    line: &Driveline,
    question: &ShockQuestion,
    observer: &dyn Observer,
) -> Result<HistoryResult, AnalysisError> {
    let mut equations = EquationsOfMotion::new(line)?;
    if !question.initial.is_empty() {
        // The initial state is the disturbance.
        equations.excitation.sources.iter_mut().for_each(|source| source.pulse = None);
    }
    let states = equilibrium::find_stable(&equations)?;
    let rest = choose_equilibrium(line, &equations, &states, None)?.clone();
    if question.initial.is_empty() && !has_pulse(&equations) {
        return Err(AnalysisError::NoDisturbance);
    }
    let problem = ShockProblem { line, equations, rest, question };
    let mut result = match question.method {
        ShockMethod::Full => problem.full(observer)?,
        ShockMethod::Clamped => problem.integrated(ShockEquation::Clamped, observer)?,
        ShockMethod::Published => problem.integrated(ShockEquation::Published, observer)?,
        ShockMethod::MultipleScales => problem.closed_form(observer)?,
    };
    if question.compare {
        comparison::add(&problem, &mut result, observer)?;
    }
    Ok(result)
}

impl ShockProblem<'_> {
    fn header(&self) -> Header {
        let mut header = header(self.line, &Question::Shock(self.question.clone()));
        let harmonic = self.equations.excitation.sources.iter().any(|s| !s.harmonics.is_empty());
        if harmonic {
            header.assumptions.push("harmonic torques are silent during the shock".to_owned());
        }
        if self.line.torques().iter().any(|t| t.pulse.is_some())
            && !self.question.initial.is_empty()
        {
            header.assumptions.push(
                "the model's pulses are silent, because the initial state is the disturbance"
                    .to_owned(),
            );
        }
        header
    }

    /// Twist of each shaft before the disturbance.
    fn equilibrium(&self) -> Named<f64> {
        let names = self.equations.connections.iter().map(|connection| connection.name.clone());
        names.zip(self.rest.twists.iter().copied()).collect()
    }

    /// State of the whole line right before time 0, with the initial values.
    pub(crate) fn full_state(&self) -> Result<Vec<f64>, AnalysisError> {
        let mut motion = Motion::new(&self.equations, Active::shock(), true);
        start_state(self.line, &mut motion, Start::Equilibrium, &self.question.initial)
    }

    fn full(&self, observer: &dyn Observer) -> Result<HistoryResult, AnalysisError> {
        let state = self.full_state()?;
        let run = full::integrate(&self.equations, &state, self.question, observer)?;
        let rest = final_twists(&self.equations, &self.rest.twists)?;
        let mut header = self.header();
        header.termination = run.termination.clone();
        header.assumptions.push(
            "the whole line is integrated, from its stable equilibrium under the mean torques"
                .to_owned(),
        );
        energy_warning(&mut header, &run.energy, self.question.tolerance);
        self.warn_of_snap(&mut header, &run.recorder.history, &run.recorder);
        let metrics = HistoryMetrics {
            shafts: shaft_metrics(&self.equations, &run, &rest, &self.rest.torques),
            channels: channel_metrics(&run.recorder),
            energy_balance: Some(run.energy),
            nodes: run.recorder.nodes(),
            integrators: run.integrators.clone(),
            events: run.events.summary(self.question.duration),
            steps: run.steps,
            evaluations: run.evaluations,
        };
        let shock = ShockDetails {
            method: "full".to_owned(),
            shaft: self.main_shaft(),
            variable: "twist and torque of each shaft; the twist is absolute".to_owned(),
            equilibrium: self.equilibrium(),
            coefficients: Named::default(),
            comparison: Vec::new(),
            comparison_history: None,
        };
        let columns = history_columns(run.recorder);
        let events = run.events.listed;
        Ok(HistoryResult {
            header,
            columns,
            metrics,
            events,
            orders: None,
            section: None,
            shock: Some(Box::new(shock)),
        })
    }

    /// Warns where a shaft passes the limit of its law.
    fn warn_of_snap(
        &self,
        header: &mut Header,
        history: &[Vec<f64>],
        recorder: &crate::time_response::Recorder<'_>,
    ) {
        for (index, connection) in self.equations.connections.iter().enumerate() {
            let limits = equilibrium::snap_limits(&connection.law);
            let channel = recorder.channels().of_connection(index, ChannelQuantity::Twist);
            let twists = &history[channel];
            let largest = twists.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let smallest = twists.iter().copied().fold(f64::INFINITY, f64::min);
            let past = |limit: f64| {
                format!(
                    "the {} is twisted past {limit:.4} rad, where its law carries less with every \
                     further degree",
                    connection.name
                )
            };
            let passed = [
                limits.positive.filter(|limit| largest > limit.twist),
                limits.negative.filter(|limit| smallest < limit.twist),
            ];
            let warnings = passed.into_iter().flatten().map(|limit| past(limit.twist));
            header.warnings.extend(warnings);
        }
    }

    /// The shaft that the answer is about: the first disturbed one, else the first.
    fn main_shaft(&self) -> String {
        let named = self.question.initial.iter().map(|value| value.channel.owner.clone());
        named
            .into_iter()
            .find(|name| self.equations.connection(name).is_some())
            .or_else(|| self.equations.connections.first().map(|c| c.name.clone()))
            .unwrap_or_default()
    }

    /// Initial `θ` and `θ'` of a single equation as the question gives them: by the name of the
    /// shaft's channels, which stand for `θ` there.
    pub(crate) fn single_start(&self) -> Result<(f64, f64), AnalysisError> {
        let (mut x, mut v) = (0.0, 0.0);
        for value in &self.question.initial {
            match value.channel.quantity {
                ChannelQuantity::Twist => x = value.value,
                ChannelQuantity::TwistRate => v = value.value,
                _ => {
                    return Err(AnalysisError::InitialValues {
                        reason: format!(
                            "{} is no variable of a single equation; give the shaft's twist",
                            value.channel.name()
                        ),
                    });
                }
            }
        }
        Ok((x, v))
    }

    fn integrated(
        &self,
        equation: ShockEquation,
        observer: &dyn Observer,
    ) -> Result<HistoryResult, AnalysisError> {
        let single = single::reduce(&self.equations, &self.rest, equation)?;
        let (x, v) = self.single_start()?;
        self.check_disturbed(&single, x, v)?;
        let run = full::integrate(&single.surrogate, &[x, v, 0.0, 0.0], self.question, observer)?;
        let rest = final_twists(&single.surrogate, &[0.0])?;
        let mut header = self.header();
        header.termination = run.termination.clone();
        header.assumptions.push(single_sentence(&single));
        energy_warning(&mut header, &run.energy, self.question.tolerance);
        let mut shafts = shaft_metrics(&single.surrogate, &run, &rest, &[single.static_torque]);
        let mut channels = channel_metrics(&run.recorder);
        let (energy, steps, evaluations) = (run.energy, run.steps, run.evaluations);
        let mut columns = history_columns(run.recorder);
        let shaft = self.equations.connections[single.connection].name.clone();
        physical_torque(&single, &shaft, &mut columns, &mut channels, &mut shafts);
        let metrics = HistoryMetrics {
            shafts,
            channels,
            energy_balance: Some(energy),
            steps,
            evaluations,
            ..HistoryMetrics::default()
        };
        let shock = self.details(single::name(equation), &single);
        Ok(HistoryResult {
            header,
            columns,
            metrics,
            events: Vec::new(),
            orders: None,
            section: None,
            shock: Some(Box::new(shock)),
        })
    }

    /// A single equation must be disturbed too: a pulse on a held end is none.
    pub(crate) fn check_disturbed(
        &self,
        single: &SingleEquation,
        x: f64,
        v: f64,
    ) -> Result<(), AnalysisError> {
        if x != 0.0 || v != 0.0 || has_pulse(&single.surrogate) {
            return Ok(());
        }
        Err(AnalysisError::MethodDoesNotFit {
            method: single::name(single.equation),
            reason: "the pulse acts on the drive end, which this equation holds".to_owned(),
        })
    }

    fn details(&self, method: &str, single: &SingleEquation) -> ShockDetails {
        let shaft = self.equations.connections[single.connection].name.clone();
        let Oscillator { omega, alpha, gamma, mu } = single.oscillator;
        let coefficients = [("omega_0", omega), ("alpha_0", alpha), ("gamma", gamma), ("mu", mu)];
        ShockDetails {
            method: method.to_owned(),
            variable: single.variable(&shaft),
            shaft,
            equilibrium: self.equilibrium(),
            coefficients: coefficients.map(|(name, value)| (name.to_owned(), value)).into(),
            comparison: Vec::new(),
            comparison_history: None,
        }
    }

    fn closed_form(&self, observer: &dyn Observer) -> Result<HistoryResult, AnalysisError> {
        let question = self.question;
        let single = single::reduce(&self.equations, &self.rest, question.equation)?;
        let (x, v) = self.single_start()?;
        self.check_disturbed(&single, x, v)?;
        let expansion = match question.order {
            1 if question.printed_velocity => Expansion::FirstAsPrinted,
            1 => Expansion::First,
            _ => Expansion::Second,
        };
        let closed = ClosedMotion::new(&single, question, (x, v), expansion, observer)?;
        let step = question.step.unwrap_or(question.duration / DEFAULT_PARTS);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
        let count = (question.duration / step * (1.0 + 1e-12) + 1e-9).floor() as u32;
        let times: Vec<f64> = (0..=count).map(|k| step * f64::from(k)).collect();
        let shaft = self.equations.connections[single.connection].name.clone();
        let columns = closed_columns(&closed, &times, &shaft);
        let mut header = self.header();
        header.assumptions.push(closed_sentence(&single, question.order, &closed));
        if expansion == Expansion::FirstAsPrinted {
            header.assumptions.push(
                "the velocity leaves out its slow terms, as the paper prints it, so it is not quite \
                 the derivative of the twist"
                    .to_owned(),
            );
        }
        if single.higher.iter().any(|coefficient| *coefficient != 0.0) {
            header.warnings.push(
                "the closed form leaves out the terms of the law beyond the cubic one".to_owned(),
            );
        }
        let metrics = HistoryMetrics {
            shafts: [(shaft, closed.metrics(question.duration))].into(),
            channels: column_metrics(&columns),
            ..HistoryMetrics::default()
        };
        let shock = self.details(&format!("multiple-scales, order {}", question.order), &single);
        Ok(HistoryResult {
            header,
            columns,
            metrics,
            events: Vec::new(),
            orders: None,
            section: None,
            shock: Some(Box::new(shock)),
        })
    }
}

fn closed_columns(closed: &ClosedMotion<'_>, times: &[f64], shaft: &str) -> Vec<Column> {
    let motion: Vec<(f64, f64)> = times.iter().map(|t| closed.at(*t)).collect();
    let torque = motion.iter().map(|(x, v)| closed.torque(*x, *v)).collect();
    vec![
        Column::new("time", "s", times.to_vec()),
        Column::new(format!("{shaft}.twist"), "rad", motion.iter().map(|m| m.0).collect()),
        Column::new(format!("{shaft}.twist_rate"), "rad/s", motion.iter().map(|m| m.1).collect()),
        Column::new(format!("{shaft}.torque"), "N·m", torque),
    ]
}

/// Extremes on the grid; a closed form has no steps to refine between.
fn column_metrics(columns: &[Column]) -> Named<ChannelMetrics> {
    let of = |values: &[f64]| {
        let minimum = values.iter().copied().fold(f64::INFINITY, f64::min);
        let maximum = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        ChannelMetrics { minimum, maximum, amplitude: (maximum - minimum) / 2.0, mean }
    };
    columns[1..].iter().map(|column| (column.name.clone(), of(&column.values))).collect()
}

/// The surrogate's torque is that of `θ`; the shaft's own stands in the answer.
fn physical_torque(
    single: &SingleEquation,
    shaft: &str,
    columns: &mut Vec<Column>,
    channels: &mut Named<ChannelMetrics>,
    shafts: &mut Named<halfshaft_results::ShaftMetrics>,
) {
    let own = [format!("{shaft}.twist"), format!("{shaft}.twist_rate"), format!("{shaft}.torque")];
    columns.retain(|column| column.name == "time" || own.contains(&column.name));
    channels.retain(|name, _| own.iter().any(|own| own == name));
    let mut peak = TurningPoint { time: 0.0, value: 0.0 };
    let times = columns[0].values.clone();
    if let Some(column) = columns.iter_mut().find(|column| column.name == own[2]) {
        for (value, time) in column.values.iter_mut().zip(&times) {
            *value = single.static_torque - *value;
            if value.abs() > peak.value.abs() {
                peak = TurningPoint { time: *time, value: *value };
            }
        }
    }
    if let Some(metrics) = channels.get_mut(&own[2]) {
        let (low, high) = (metrics.minimum, metrics.maximum);
        metrics.minimum = single.static_torque - high;
        metrics.maximum = single.static_torque - low;
        metrics.mean = single.static_torque - metrics.mean;
        // Extremes found between the samples are nearer to the truth than the samples.
        let exact =
            if -metrics.minimum > metrics.maximum { metrics.minimum } else { metrics.maximum };
        peak.value = exact;
    }
    if let Some(metrics) = shafts.get_mut(shaft) {
        metrics.peak_torque = peak.value;
        metrics.peak_torque_time = peak.time;
        metrics.dynamic_factor = metrics.dynamic_factor.map(|_| peak.value / metrics.static_torque);
    }
}

fn single_sentence(single: &SingleEquation) -> String {
    let what = match single.equation {
        ShockEquation::Published => {
            "equation (14) as published, which doubles stiffness and damping by adding the \
             perturbed equations of both ends; the full line is --method full"
        }
        ShockEquation::Clamped => "the load on its shaft with the drive end held",
        ShockEquation::Twist => "the relative twist of the free two-mass line",
    };
    let drag = if single.drag_left_out { "; damping to ground has no place in it" } else { "" };
    format!("{what}: {}{drag}", single.formula())
}

fn closed_sentence(single: &SingleEquation, order: u8, closed: &ClosedMotion<'_>) -> String {
    let after = if closed.from > 0.0 {
        format!(", from the integrated state at {:.6} s when the pulse has ended", closed.from)
    } else {
        String::new()
    };
    format!("multiple scales of order {order}{after}: {}", single_sentence(single))
}
