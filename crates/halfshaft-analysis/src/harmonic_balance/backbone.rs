//! Backbone curves: phase resonance of the damped line, and free oscillation of the undamped one.
//!
//! In phase resonance the torques do no reactive work: `Re Σ conj(T_g) q_g = 0` at their own order. With
//! that one linear condition beside the equations, speed and drive are both unknown and follow from the
//! amplitude; the curve runs over the tips of all response curves, detached ones included, which it
//! meets where the drive is 1. For a line without damping the same condition makes the drive vanish:
//! what is left is the free nonlinear oscillation, with the drive as the unfolding parameter. Source:
//! M. Peeters, G. Kerschen, J. C. Golinval, J. Sound Vib. 330 (2011) 486 (phase resonance);
//! F. J. Muñoz-Almaraz et al., Physica D 181 (2003) 1 (unfolding).

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::blocks::{BlockSystem, Factors};
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Column, Table};

use super::answer::Setting;
use super::channels::{Channels, group_series, names};
use super::line::Line;
use super::problem::Failure;
use super::seeds::at_rest;
use super::system::{HarmonicSystem, Place};
use super::tracer::{LEAST_HARMONICS, MOST_HARMONICS, length, refit};
use crate::equilibrium::RestStates;
use crate::error::AnalysisError;
use crate::modal::elastic::lowest_modes;

/// A point of a backbone.
#[derive(Clone, Debug)]
pub(super) struct Resonant {
    pub(super) set: HarmonicSet,
    pub(super) u: Vec<f64>,
    pub(super) frequency: f64,
    pub(super) drive: f64,
    pub(super) tangent: (Vec<f64>, f64, f64),
}

/// How far a backbone is followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct BackboneSettings {
    pub(super) frequency: (f64, f64),
    pub(super) tolerance: f64,
    pub(super) harmonics: Option<usize>,
    /// Drive at which the curve of the damped line ends.
    pub(super) most_drive: f64,
    /// Size of the unknowns at which any curve ends.
    pub(super) most_size: f64,
}

/// Amplitude of the first point, as a part of the largest of interest.
const FIRST: f64 = 1e-3;
const MISS: f64 = 0.02;
const SHORTEST: f64 = 1e-7;
const MOST_SAMPLES: usize = 1500;
const MOST_ITERATIONS: usize = 9;
const CONVERGED: f64 = 1e-9;

/// The equations of phase resonance of one line.
pub(super) struct PhaseResonance {
    pub(super) system: HarmonicSystem,
    matrix: BlockSystem,
    factors: Option<Factors>,
    /// Order, over the base, at which the torques act.
    order: usize,
    /// Length by which speeds are measured, rad/s.
    span: f64,
}

impl PhaseResonance {
    pub(super) fn new(line: Line, set: HarmonicSet, base: f64, order: usize, span: f64) -> Self {
        let system = HarmonicSystem::new(line, set, base);
        Self { matrix: system.blocks(2), factors: None, system, order, span }
    }

    /// Row of the condition that the torques do no reactive work, of unit length.
    pub(super) fn phase_row(&self) -> Vec<f64> {
        // The derivative by the drive is minus the torque: (Re T, -Im T) beside (a, b) of q = a - i b.
        let m = self.system.set.coefficients();
        let mut row = vec![0.0; self.system.unknowns()];
        if let Some(place) = self.system.set.place_of(self.order) {
            for node in 0..self.system.line.nodes() {
                for at in [node * m + place, node * m + place + 1] {
                    row[at] = self.system.by_drive[at];
                }
            }
        }
        let size = length(&row);
        if size > 0.0 {
            row.iter_mut().for_each(|x| *x /= size);
        }
        row
    }

    /// Newton's method under `row · (u, Ω, drive) = target`.
    pub(super) fn correct(
        &mut self,
        point: &mut (Vec<f64>, f64, f64),
        row: (&[f64], f64, f64),
        target: f64,
    ) -> Result<(), Failure> {
        let mut before = f64::INFINITY;
        for iteration in 1..=MOST_ITERATIONS {
            let phase = self.prepare(point, row)?;
            let mut step: Vec<f64> = self.system.residual.iter().map(|r| -r).collect();
            let dot = |a: &[f64]| a.iter().zip(&point.0).map(|(a, b)| a * b).sum::<f64>();
            let mut border =
                [-dot(&phase), target - dot(row.0) - row.1 * point.1 - row.2 * point.2];
            let Some(factors) = &mut self.factors else { return Err(Failure::Singular) };
            factors.solve(&mut step, &mut border);
            point.0.iter_mut().zip(&step).for_each(|(u, s)| *u += s);
            point.1 += border[0];
            point.2 += border[1];
            let size = length(&step) / length(&point.0).max(f64::MIN_POSITIVE.sqrt())
                + (border[0] / self.span).abs();
            if !size.is_finite() || (iteration > 3 && size > 0.7 * before) {
                return if before < 1e3 * CONVERGED { Ok(()) } else { Err(Failure::NotConverged) };
            }
            if size <= CONVERGED {
                return Ok(());
            }
            before = size;
        }
        Err(Failure::NotConverged)
    }

    /// Evaluates and factorises; gives the row of the phase condition.
    fn prepare(
        &mut self,
        point: &(Vec<f64>, f64, f64),
        row: (&[f64], f64, f64),
    ) -> Result<Vec<f64>, Failure> {
        let place = Place { frequency: point.1, drive: point.2 };
        self.system.evaluate(&point.0, place, true);
        let phase = self.phase_row();
        self.system.fill(&mut self.matrix);
        self.matrix.set_column(0, &self.system.by_frequency);
        self.matrix.set_column(1, &self.system.by_drive);
        self.matrix.set_row(0, &phase);
        self.matrix.set_row(1, row.0);
        self.matrix.set_corner(1, 0, row.1);
        self.matrix.set_corner(1, 1, row.2);
        self.matrix.factorise(&mut self.factors).map_err(|_| Failure::Singular)?;
        Ok(phase)
    }

    pub(super) fn sample(
        &mut self,
        point: (Vec<f64>, f64, f64),
        row: (&[f64], f64, f64),
    ) -> Result<Resonant, Failure> {
        self.prepare(&point, row)?;
        let mut direction = vec![0.0; point.0.len()];
        let mut border = [0.0, 1.0];
        if let Some(factors) = &mut self.factors {
            factors.solve(&mut direction, &mut border);
        }
        let norm = (length(&direction) / length(&point.0)).hypot(border[0] / self.span);
        direction.iter_mut().for_each(|x| *x /= norm);
        Ok(Resonant {
            set: self.system.set.clone(),
            u: point.0,
            frequency: point.1,
            drive: point.2,
            tangent: (direction, border[0] / norm, border[1] / norm),
        })
    }

    pub(super) fn use_set(&mut self, set: &HarmonicSet) {
        if self.system.set != *set {
            *self = Self::new(
                self.system.line.clone(),
                set.clone(),
                self.system.base,
                self.order,
                self.span,
            );
        }
    }

    /// Follows the curve from its first point.
    fn follow(
        &mut self,
        start: Resonant,
        settings: &BackboneSettings,
        observer: &dyn Observer,
    ) -> Vec<Resonant> {
        let mut samples = vec![start];
        let mut step = 0.3;
        while samples.len() < MOST_SAMPLES && !observer.cancelled() {
            let Some(last) = samples.last() else { break };
            let next = loop {
                match self.try_step(last, step, settings) {
                    Ok((next, miss)) => {
                        let too_far = miss > 8.0 * MISS && step > 1e3 * SHORTEST;
                        step = (step * (MISS / miss.max(1e-12)).sqrt().clamp(0.3, 1.8)).min(0.35);
                        if !too_far {
                            break Some(next);
                        }
                    }
                    Err(_) => {
                        step *= 0.35;
                        if step < SHORTEST {
                            break None;
                        }
                    }
                }
            };
            let Some(next) = next else { break };
            let (low, high) = settings.frequency;
            let beyond = next.frequency < low
                || next.frequency > high
                || next.drive.abs() > settings.most_drive
                || length(&next.u) > settings.most_size;
            samples.push(next);
            if beyond {
                break;
            }
        }
        samples
    }

    pub(super) fn try_step(
        &mut self,
        last: &Resonant,
        step: f64,
        settings: &BackboneSettings,
    ) -> Result<(Resonant, f64), Failure> {
        let mut set = last.set.clone();
        self.use_set(&set);
        let size = length(&last.u);
        let along = &last.tangent;
        let straight = (
            last.u.iter().zip(&along.0).map(|(u, t)| u + step * t).collect::<Vec<f64>>(),
            last.frequency + step * along.1,
            last.drive + step * along.2,
        );
        let mut row: Vec<f64> = along.0.iter().map(|x| x / (size * size)).collect();
        let by_frequency = along.1 / (self.span * self.span);
        let target = row.iter().zip(&straight.0).map(|(a, b)| a * b).sum::<f64>()
            + by_frequency * straight.1;
        let mut point = straight.clone();
        self.correct(&mut point, (&row, by_frequency, 0.0), target)?;
        let off: Vec<f64> = point.0.iter().zip(&straight.0).map(|(a, b)| a - b).collect();
        let miss = (length(&off) / size).hypot((point.1 - straight.1) / self.span);
        while settings.harmonics.is_none()
            && self.system.truncation > settings.tolerance
            && set.highest() < MOST_HARMONICS
        {
            let next = set.up_to(set.highest() + 2.max(set.highest() / 5).next_multiple_of(2));
            point.0 = refit(&set, &next, 1, &point.0);
            row = refit(&set, &next, 1, &row);
            set = next;
            self.use_set(&set);
            self.correct(&mut point, (&row, by_frequency, 0.0), target)?;
        }
        let sample = self.sample(point, (&row, by_frequency, 0.0))?;
        Ok((sample, miss))
    }
}

/// A line without any damping.
fn undamped(equations: &EquationsOfMotion) -> EquationsOfMotion {
    let mut free = equations.clone();
    for connection in &mut free.connections {
        connection.damping = 0.0;
        connection.friction = None;
    }
    free.ground_damping.iter_mut().for_each(|d| *d = 0.0);
    if let Some(rigid) = &mut free.rigid {
        rigid.ground_damping = 0.0;
    }
    free
}

/// Modes that are looked at, the lowest.
const MOST_MODES: usize = 60;

/// Backbones of all modes that resonate in the range: each of the undamped line (with its `energy`),
/// then of the damped one in phase resonance (with its `drive`).
pub(super) fn backbones(
    setting: &Setting,
    states: &RestStates,
    settings: &BackboneSettings,
    observer: &dyn Observer,
) -> Result<Vec<Table>, AnalysisError> {
    let Some(rest) = states.primary() else { return Ok(Vec::new()) };
    let equations = &setting.line.equations;
    let modes = lowest_modes(equations, &rest.twists, MOST_MODES)?;
    let mut tables = Vec::new();
    let free = Rc::new(undamped(equations));
    for order in setting.orders() {
        for mode in &modes {
            let natural = mode.frequency() / (order as f64 * setting.base);
            let (low, high) = settings.frequency;
            if natural < 0.5 * low || natural > 2.0 * high || natural == 0.0 {
                continue;
            }
            for (line, conservative) in
                [(Line::new(Rc::clone(&free)), true), (setting.line.clone(), false)]
            {
                let wide = BackboneSettings { frequency: (0.3 * low, 3.0 * high), ..*settings };
                let Some(curve) =
                    curve(setting, line.clone(), (order, natural), &mode.shape, &wide, observer)
                else {
                    continue;
                };
                let curve: Vec<Resonant> = curve
                    .into_iter()
                    .filter(|p| p.frequency >= low && p.frequency <= high)
                    .collect();
                if curve.len() > 1 {
                    tables.push(table(&line, setting.base, &curve, conservative));
                }
            }
        }
    }
    Ok(tables)
}

/// One backbone from small amplitudes up; `None` where not even that can be found.
fn curve(
    setting: &Setting,
    line: Line,
    (order, natural): (usize, f64),
    shape: &[f64],
    settings: &BackboneSettings,
    observer: &dyn Observer,
) -> Option<Vec<Resonant>> {
    let odd = setting.odd && line.is_odd();
    let highest = settings.harmonics.unwrap_or(LEAST_HARMONICS.max(order));
    let set = if odd { HarmonicSet::odd(highest) } else { HarmonicSet::all(highest) };
    let span = settings.frequency.1 - settings.frequency.0;
    let mut resonance = PhaseResonance::new(line, set.clone(), setting.base, order, span);
    let mut u = at_rest(&resonance.system.line, &setting.rest, &set);
    let place = Place { frequency: natural, drive: 0.0 };
    resonance.system.evaluate(&u, place, false);
    let quadrature = resonance.phase_row();
    // The mode in quadrature with the torques: turned by a quarter from their own phase.
    let m = set.coefficients();
    let at = set.place_of(order)?;
    let (mut cosine, mut sine) = (0.0, 0.0);
    for (node, group) in resonance.system.line.skeleton.kept.iter().enumerate() {
        cosine += quadrature[node * m + at] * shape[*group];
        sine += quadrature[node * m + at + 1] * shape[*group];
    }
    let size = cosine.hypot(sine);
    if size == 0.0 {
        return None;
    }
    let largest = shape.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let amplitude = FIRST * settings.most_size / largest;
    let mut direction = vec![0.0; u.len()];
    for (node, group) in resonance.system.line.skeleton.kept.iter().enumerate() {
        direction[node * m + at] = -sine / size * shape[*group] / largest;
        direction[node * m + at + 1] = cosine / size * shape[*group] / largest;
    }
    u.iter_mut().zip(&direction).for_each(|(u, d)| *u += amplitude * largest * d);
    let held: f64 = direction.iter().zip(&u).map(|(a, b)| a * b).sum();
    let mut point = (u, natural, 0.0);
    resonance.correct(&mut point, (&direction, 0.0, 0.0), held).ok()?;
    let start = resonance.sample(point, (&direction, 0.0, 0.0)).ok()?;
    Some(resonance.follow(start, settings, observer))
}

/// A backbone as a table.
fn table(line: &Line, base: f64, curve: &[Resonant], conservative: bool) -> Table {
    let mut columns =
        vec![Column::new("frequency", "rad/s", curve.iter().map(|p| p.frequency).collect())];
    let channels = names(&line.equations);
    let rows: Vec<Vec<(f64, f64)>> = curve
        .iter()
        .map(|point| {
            let mut system = HarmonicSystem::new(line.clone(), point.set.clone(), base);
            let place = Place { frequency: point.frequency, drive: point.drive };
            let values = Channels::new(&point.set, 1).measure(&mut system, &point.u, place);
            values.iter().map(|value| (value.amplitude, value.harmonic1)).collect()
        })
        .collect();
    for (index, (name, unit)) in channels.into_iter().enumerate() {
        let amplitude = rows.iter().map(|row| row[index].0).collect();
        let harmonic = rows.iter().map(|row| row[index].1).collect();
        columns.push(Column::new(format!("{name}.amplitude"), unit, amplitude));
        columns.push(Column::new(format!("{name}.harmonic1"), unit, harmonic));
    }
    if conservative {
        let energies = curve.iter().map(|point| energy(line, base, point)).collect();
        columns.push(Column::new("energy", "J", energies));
    } else {
        columns.push(Column::new("drive", "1", curve.iter().map(|p| p.drive.abs()).collect()));
    }
    Table::new(columns)
}

/// Kinetic and potential energy at the beginning of the period, J.
fn energy(line: &Line, base: f64, point: &Resonant) -> f64 {
    let mut system = HarmonicSystem::new(line.clone(), point.set.clone(), base);
    let place = Place { frequency: point.frequency, drive: point.drive };
    let series = group_series(&mut system, &point.u, place);
    let m = point.set.coefficients();
    let speed = base * point.frequency;
    let (mut angles, mut speeds) = (Vec::new(), Vec::new());
    for coefficients in series.chunks_exact(m) {
        let (value, slope) = point.set.evaluate(coefficients, 0.0);
        angles.push(value);
        speeds.push(speed * slope);
    }
    let equations = &line.equations;
    let twists: Vec<f64> =
        (0..equations.connections.len()).map(|index| equations.twist(index, &angles)).collect();
    equations.kinetic_energy(&speeds) + equations.potential_energy(&twists)
}
