//! Answer of `resonance`.

use serde::{Deserialize, Serialize};

use crate::{Column, Header, Named, SpecialKind, SpecialPoint, Table};

/// A connected piece of the response curve: a table with its special points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Branch {
    /// `frequency`, then the values of each channel, `stable`, `unstable_dimension`. Harmonic
    /// balance adds `largest_multiplier` (modulus of the largest Floquet multiplier), `harmonics`
    /// (highest one kept) and `truncation` (estimate of the error of the waveform that the harmonics
    /// left out make, relative to its amplitude).
    pub columns: Vec<Column>,
    /// Folds, ends and the like on this branch, in its direction.
    pub special_points: Vec<SpecialPoint>,
    /// Whether the branch closes on itself: a detached response where nothing else joins it.
    #[serde(default)]
    pub closed: bool,
    /// Periods of the excitation that one period of the response takes.
    #[serde(default = "one")]
    pub periods: u32,
    /// What the branch was found from, e.g. "low end of the range", "period doubling at 3.2 rad/s".
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub origin: String,
    /// Why the branch ends where it does.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub ends: String,
    /// Floquet multipliers of each sample as `[real, imaginary]`, the largest modulus first, at most
    /// eight; empty where the method knows none.
    #[serde(
        default,
        skip_serializing_if = "Vec::is_empty",
        deserialize_with = "crate::number::read"
    )]
    pub multipliers: Vec<Vec<[f64; 2]>>,
}

fn one() -> u32 {
    1
}

/// The effort of a continuation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Effort {
    /// Samples of all branches.
    pub samples: usize,
    /// Steps that were tried, rejected ones included.
    pub steps: usize,
    /// Newton iterations.
    pub iterations: usize,
    /// Starting points from which Newton's method was tried.
    pub seeds: usize,
}

impl Branch {
    /// A branch of a closed form: columns and special points, nothing more to tell.
    pub fn plain(columns: Vec<Column>, special_points: Vec<SpecialPoint>) -> Self {
        Self {
            columns,
            special_points,
            closed: false,
            periods: 1,
            origin: String::new(),
            ends: String::new(),
            multipliers: Vec::new(),
        }
    }

    /// Whether the branch is a response by itself, which no other joins: no slow sweep gets there.
    pub fn is_detached(&self) -> bool {
        let joins = |kind: SpecialKind| match kind {
            SpecialKind::BranchPoint => true,
            // Of a response of one period it is where others leave it, not where it hangs on another.
            SpecialKind::PeriodDoubling => self.periods > 1,
            _ => false,
        };
        self.closed && !self.special_points.iter().any(|point| joins(point.kind))
    }

    /// Values of the column of that name; empty where there is none.
    pub fn values(&self, name: &str) -> &[f64] {
        self.columns
            .iter()
            .find(|column| column.name == name)
            .map_or(&[], |column| column.values.as_slice())
    }
}

/// How a mode of the line becomes the oscillator of the theory,
/// `x'' + omega_1² x + alpha x³ + beta x' = f cos((omega_1 + sigma) t)`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeScaling {
    /// Which elastic mode, from 1.
    pub mode: usize,
    /// What the mode is, in words.
    pub label: String,
    /// The shaft whose twist beyond equilibrium is `x`.
    pub shaft: String,
    /// Inertia of the mode per unit of `x`, kg·m².
    #[serde(deserialize_with = "crate::number::read")]
    pub modal_inertia: f64,
    /// Order of the excitation: `omega_1 + sigma = order · frequency`.
    #[serde(deserialize_with = "crate::number::read")]
    pub order: f64,
    /// Natural frequency, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub omega_1: f64,
    /// Effective cubic coefficient `cubic - 10 quadratic² / (9 omega_1²)`, 1/(rad² s²).
    #[serde(deserialize_with = "crate::number::read")]
    pub alpha: f64,
    /// Damping coefficient, 1/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub beta: f64,
    /// Excitation amplitude, rad/s².
    #[serde(deserialize_with = "crate::number::read")]
    pub f: f64,
    /// `3 alpha / (8 omega_1)`: backbone `sigma = kappa rho²`.
    #[serde(deserialize_with = "crate::number::read")]
    pub kappa: f64,
    /// Coefficients of `x²` to `x⁷` in the equation before averaging, as `x2` to `x7`.
    #[serde(deserialize_with = "crate::number::read")]
    pub coefficients: Named<f64>,
    /// Twist of each shaft per unit of `x`.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist_per_x: Named<f64>,
    /// Smallest `f` at which the response folds, rad/s²; `None` where it never does.
    pub fold_threshold_f: Option<f64>,
    /// The same as the factor by which the model's amplitudes must grow.
    pub fold_threshold_factor: Option<f64>,
    /// Amplitude of `x` at the cusp, where the threshold lies, rad.
    pub fold_threshold_rho: Option<f64>,
    /// The scaling as a sentence.
    pub statement: String,
}

/// Where the response jumps on slow sweeps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JumpSpeeds {
    /// Direction of the sweep: `up` or `down`.
    pub sweep: String,
    /// Excitation speed of the jump, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: f64,
    /// The same in revolutions per minute.
    #[serde(deserialize_with = "crate::number::read")]
    pub rpm: f64,
    /// Channel whose first harmonic the amplitudes are of: the twist of a shaft.
    pub channel: String,
    /// First harmonic before the jump, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub before: f64,
    /// First harmonic after the jump, rad; `None` where no other stable response exists.
    pub after: Option<f64>,
}

/// One response, predicted and by integration of the full equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VerifiedPoint {
    /// Excitation speed, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: f64,
    /// Channel that is compared: the twist of a shaft.
    pub channel: String,
    /// Predicted amplitude of the first harmonic of the twist, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub predicted: f64,
    /// The same from a periodic orbit of the full equations, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub integrated: f64,
    /// Half of peak to peak of that orbit, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub integrated_amplitude: f64,
    /// Predicted over integrated, less 1.
    #[serde(deserialize_with = "crate::number::read")]
    pub relative_difference: f64,
    /// Whether the prediction says stable.
    pub predicted_stable: bool,
    /// Whether all Floquet multipliers of the orbit lie inside the unit circle.
    pub integrated_stable: bool,
    /// Largest modulus of the Floquet multipliers of the orbit.
    #[serde(deserialize_with = "crate::number::read")]
    pub largest_multiplier: f64,
    /// The same as predicted, where the method knows it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub predicted_multiplier: Option<f64>,
    /// Largest change of the state over one period of the orbit, relative.
    #[serde(deserialize_with = "crate::number::read")]
    pub orbit_residual: f64,
}

/// Answer of `resonance`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResonanceResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// All responses, piece by piece.
    pub branches: Vec<Branch>,
    /// How the line was scaled to the oscillator, once for each exciting order.
    pub scaling: Vec<ModeScaling>,
    /// The largest response of each exciting order: `frequency`, `sigma`, `rho` and channels.
    #[serde(deserialize_with = "crate::number::read")]
    pub peaks: Vec<Named<f64>>,
    /// Backbone of each exciting order: `frequency`, `sigma`, `rho` and channels.
    pub backbones: Vec<Table>,
    /// Where slow sweeps jump.
    pub jumps: Vec<JumpSpeeds>,
    /// What the continuation cost, where there was one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub effort: Option<Effort>,
    /// Responses checked by integration.
    pub verification: Vec<VerifiedPoint>,
}

impl ResonanceResult {
    /// The twist by which the responses are told and drawn, e.g. `half-shaft.twist`: the one that the
    /// result itself speaks of, or else the one that swings most.
    pub fn leading_channel(&self) -> Option<String> {
        let scaled = self.scaling.first().map(|scaling| format!("{}.twist", scaling.shaft));
        let jumps = self.jumps.iter().map(|jump| jump.channel.clone());
        let checks = self.verification.iter().map(|point| point.channel.clone());
        let named = scaled.into_iter().chain(jumps).chain(checks);
        let known = |channel: &String| {
            MEASURES.iter().any(|measure| self.has_column(&format!("{channel}.{measure}")))
        };
        named.into_iter().find(known).or_else(|| self.largest_twist())
    }

    /// Whether any branch has a column of that name.
    pub fn has_column(&self, name: &str) -> bool {
        self.branches.iter().any(|branch| !branch.values(name).is_empty())
    }

    fn largest_twist(&self) -> Option<String> {
        let columns = self.branches.iter().flat_map(|branch| &branch.columns);
        let twists = columns.filter_map(|column| {
            let (channel, measure) = column.name.rsplit_once('.')?;
            let swings = MEASURES.contains(&measure) && channel.ends_with(".twist");
            let finite = column.values.iter().copied().filter(|value| value.is_finite());
            let most = finite.reduce(f64::max).filter(|_| swings)?;
            Some((channel, most))
        });
        Some(twists.max_by(|a, b| a.1.total_cmp(&b.1))?.0.to_owned())
    }
}

/// What of a channel tells how far it swings, the better one for comparison first.
const MEASURES: [&str; 2] = ["harmonic1", "amplitude"];
