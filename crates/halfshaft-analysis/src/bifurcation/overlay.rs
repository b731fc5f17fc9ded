//! The continued branches beside the motions, and which of them a motion that repeats is on.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{BifurcationQuestion, ResonanceQuestion};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Column, Named, SpecialPoint, StrobedBranch};

use super::stroboscope::Look;
use super::sweep::{Family, Row};
use crate::error::AnalysisError;
use crate::harmonic_balance::{Strobe, StrobedResponses, strobed};
use crate::shooting::{Shooter, length};

/// Motions this near to a response, relative, are on it.
const SAME: f64 = 1e-4;
/// Guesses from a branch that are further from the motion than this, relative, are not tried.
const NEAR: f64 = 0.3;
/// Guesses that are tried at most, the nearest first.
const MOST_TRIED: usize = 4;

/// The branches over the range of a sweep.
pub(super) fn branches(
    line: &Driveline,
    question: &BifurcationQuestion,
    family: &Family<'_>,
    observer: &dyn Observer,
) -> Result<Vec<StrobedResponses>, AnalysisError> {
    let asked = ResonanceQuestion {
        frequency: Some(family.speeds),
        parameter: question.parameter.clone(),
        ..ResonanceQuestion::default()
    };
    strobed(line, &asked, family.look.reference, observer)
}

/// Finds for every motion that repeats the branch that it is on.
pub(super) fn assign(
    rows: &mut [Row],
    branches: &[StrobedResponses],
    family: &Family<'_>,
) -> Result<(), AnalysisError> {
    for row in rows {
        let Ok(seen) = &row.seen else { continue };
        let Some(period) = seen.period else { continue };
        let (equations, frequency) = family.at(row.value)?;
        let motion = Motion { equations: &equations, frequency, look: family.look, period };
        row.branch = motion.branch(row.value, &seen.states, branches);
    }
    Ok(())
}

/// A motion that repeats.
struct Motion<'m> {
    equations: &'m EquationsOfMotion,
    frequency: f64,
    look: Look,
    period: usize,
}

impl Motion<'_> {
    /// The branch with an exact orbit at the motion's own states.
    fn branch(
        &self,
        value: f64,
        states: &[Vec<f64>],
        branches: &[StrobedResponses],
    ) -> Option<usize> {
        let first = states.first()?;
        let size = states.iter().map(|state| length(state)).fold(0.0, f64::max);
        let mut guesses: Vec<(f64, usize, Vec<f64>)> = Vec::new();
        for (index, branch) in branches.iter().enumerate() {
            if branch.periods as usize != self.period {
                continue;
            }
            let at = crossings(branch, value).into_iter().flatten();
            guesses.extend(at.map(|guess| (apart(&guess, first), index, guess)));
        }
        guesses.retain(|(distance, ..)| *distance <= NEAR * size);
        guesses.sort_by(|a, b| a.0.total_cmp(&b.0));
        guesses.truncate(MOST_TRIED);
        let found = guesses.into_iter().find(|(_, _, guess)| {
            self.orbit(guess).is_some_and(|orbit| apart(&orbit, first) <= SAME * size)
        });
        found.map(|(_, index, _)| index)
    }

    /// The periodic orbit next to a guess.
    fn orbit(&self, guess: &[f64]) -> Option<Vec<f64>> {
        let base = self.look.base / self.period as f64;
        let mut shooter = Shooter::new(self.equations, base, self.frequency, false);
        let coordinates = shooter.coordinates();
        let factor = self.look.reference / coordinates.reference;
        let mut state = guess.to_vec();
        state.resize(coordinates.dimension(), 0.0);
        coordinates.scale_rates(&mut state, factor);
        let mut orbit = shooter.at(&state, self.frequency).ok()?.state;
        coordinates.scale_rates(&mut orbit, 1.0 / factor);
        Some(orbit)
    }
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    length(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>())
}

/// States at all phases wherever a branch passes a value, straight from sample to sample.
fn crossings(branch: &StrobedResponses, value: f64) -> Vec<Vec<Vec<f64>>> {
    let path = path(branch);
    let mut found = Vec::new();
    for pair in path.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        if (a.p - value) * (b.p - value) > 0.0 {
            continue;
        }
        let part = if a.p == b.p { 0.0 } else { (value - a.p) / (b.p - a.p) };
        let between = |(a, b): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect()
        };
        found.push(a.states.iter().zip(&b.states).map(between).collect());
    }
    found
}

/// Samples and special points in the order of the branch.
fn path(branch: &StrobedResponses) -> Vec<&Strobe> {
    let mut path = Vec::with_capacity(branch.samples.len() + branch.specials.len());
    for (index, sample) in branch.samples.iter().enumerate() {
        path.push(sample);
        let here = branch.specials.iter().filter(|(_, _, after, _)| *after == index);
        path.extend(here.map(|(_, _, _, strobe)| strobe));
    }
    path
}

/// A branch as a result.
pub(super) fn told(
    branch: &StrobedResponses,
    (swept, unit): (&str, &str),
    shaft: &str,
    point: impl Fn(&[f64]) -> [f64; 2],
) -> StrobedBranch {
    let samples = &branch.samples;
    let all = |of: &dyn Fn(&Strobe) -> f64| samples.iter().map(of).collect::<Vec<f64>>();
    let mut columns = vec![Column::new(swept, unit, all(&|sample| sample.p))];
    for period in 0..branch.periods.max(1) as usize {
        let number = if period == 0 { String::new() } else { format!(".{}", period + 1) };
        for (index, (word, unit)) in [("twist", "rad"), ("twist_rate", "rad/s")].iter().enumerate()
        {
            let values = all(&|sample| point(&sample.states[period])[index]);
            columns.push(Column::new(format!("{shaft}.{word}{number}"), *unit, values));
        }
    }
    let stable = |sample: &Strobe| sample.stable.map_or(f64::NAN, |s| f64::from(u8::from(s)));
    columns.push(Column::new("stable", "1", all(&stable)));
    let special_points = branch.specials.iter().map(|(kind, status, _, strobe)| {
        let [twist, rate] = point(&strobe.states[0]);
        let values: Named<f64> = [
            (swept.to_owned(), strobe.p),
            (format!("{shaft}.twist"), twist),
            (format!("{shaft}.twist_rate"), rate),
        ]
        .into_iter()
        .collect();
        SpecialPoint::new(*kind, *status, values)
    });
    StrobedBranch {
        periods: branch.periods,
        origin: branch.origin.clone(),
        columns,
        special_points: special_points.collect(),
    }
}
