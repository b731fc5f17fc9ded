//! The questions and their settings, in SI.

use serde::Serialize;

use super::bifurcation::BifurcationQuestion;
use super::channel::InitialValue;
use super::linear::{CampbellQuestion, ForcedQuestion};
use super::simulate::SimulateQuestion;
use crate::format::words;

/// What is asked, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verb {
    /// Is the model sound? A summary of it.
    Check,
    /// All equilibria under the mean torques and the torque capacity.
    Static,
    /// Natural frequencies, damping and shapes about the equilibrium.
    Modes,
    /// Natural frequencies over the orders of the excitation: critical speeds.
    Campbell,
    /// Linear vibration over the excitation speed, order by order.
    Forced,
    /// A time history.
    Simulate,
    /// The response to a pulse or an initial twist.
    Shock,
    /// Periodic responses over excitation speed.
    Resonance,
    /// Fold curves in a plane of excitation speed and one parameter.
    Folds,
    /// Which initial state leads to which response at one excitation speed.
    Basins,
    /// What the line settles to on a stepwise sweep, period by period.
    Bifurcation,
}

impl Verb {
    /// All verbs with their names.
    pub const ALL: [(&'static str, Self); 11] = [
        ("check", Self::Check),
        ("static", Self::Static),
        ("modes", Self::Modes),
        ("campbell", Self::Campbell),
        ("forced", Self::Forced),
        ("simulate", Self::Simulate),
        ("shock", Self::Shock),
        ("resonance", Self::Resonance),
        ("folds", Self::Folds),
        ("basins", Self::Basins),
        ("bifurcation", Self::Bifurcation),
    ];

    /// Name of the verb.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, verb)| *verb == self).map_or("", |(name, _)| name)
    }
}

/// A question with all its settings.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Question {
    /// See [`Verb::Check`].
    Check,
    /// See [`Verb::Static`].
    Static,
    /// See [`Verb::Modes`].
    Modes(ModesQuestion),
    /// See [`Verb::Campbell`].
    Campbell(CampbellQuestion),
    /// See [`Verb::Forced`].
    Forced(ForcedQuestion),
    /// See [`Verb::Simulate`].
    Simulate(SimulateQuestion),
    /// See [`Verb::Shock`].
    Shock(ShockQuestion),
    /// See [`Verb::Resonance`].
    Resonance(ResonanceQuestion),
    /// See [`Verb::Folds`].
    Folds(FoldsQuestion),
    /// See [`Verb::Basins`].
    Basins(BasinsQuestion),
    /// See [`Verb::Bifurcation`].
    Bifurcation(BifurcationQuestion),
}

impl Question {
    /// What is asked, in one word.
    pub fn verb(&self) -> Verb {
        match self {
            Self::Check => Verb::Check,
            Self::Static => Verb::Static,
            Self::Modes(_) => Verb::Modes,
            Self::Campbell(_) => Verb::Campbell,
            Self::Forced(_) => Verb::Forced,
            Self::Simulate(_) => Verb::Simulate,
            Self::Shock(_) => Verb::Shock,
            Self::Resonance(_) => Verb::Resonance,
            Self::Folds(_) => Verb::Folds,
            Self::Basins(_) => Verb::Basins,
            Self::Bifurcation(_) => Verb::Bifurcation,
        }
    }
}

/// Settings of `modes`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ModesQuestion {
    /// Which equilibrium, counted from 1 as `static` lists them; `None` for the stable one
    /// nearest to zero twist.
    pub equilibrium: Option<usize>,
    /// How many of the lowest elastic modes; `None` for all of a line of a few hundred degrees of
    /// freedom, the lowest twenty of a longer one.
    pub count: Option<usize>,
}

/// State before the disturbance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// Everything at zero: the torques of the model act from then on.
    #[default]
    Rest,
    /// The stable equilibrium under the mean torques.
    Equilibrium,
}

impl Start {
    /// All states with their names.
    pub const ALL: [(&'static str, Self); 2] =
        [("rest", Self::Rest), ("equilibrium", Self::Equilibrium)];
    /// The names alone.
    pub const WORDS: [&'static str; Self::ALL.len()] = words(&Self::ALL);
}

/// Which equations answer a shock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ShockMethod {
    /// The whole line.
    #[default]
    Full,
    /// The load on its shaft with the drive end held.
    Clamped,
    /// Equation (14) of the manuscript as printed, with doubled coefficients.
    Published,
    /// Closed form by multiple scales.
    MultipleScales,
}

impl ShockMethod {
    /// All methods with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("full", Self::Full),
        ("clamped", Self::Clamped),
        ("published", Self::Published),
        ("multiple-scales", Self::MultipleScales),
    ];
    /// The names alone.
    pub const WORDS: [&'static str; Self::ALL.len()] = words(&Self::ALL);
}

/// Which single equation a closed form solves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ShockEquation {
    /// Equation (14) of the manuscript as printed.
    #[default]
    Published,
    /// The load with the drive end held.
    Clamped,
    /// The relative twist of the free two-mass line.
    Twist,
}

impl ShockEquation {
    /// All equations with their names.
    pub const ALL: [(&'static str, Self); 3] =
        [("published", Self::Published), ("clamped", Self::Clamped), ("twist", Self::Twist)];
    /// The names alone.
    pub const WORDS: [&'static str; Self::ALL.len()] = words(&Self::ALL);
}

/// Settings of `shock`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShockQuestion {
    /// Which equations.
    pub method: ShockMethod,
    /// Order of the multiple scales, 1 or 2.
    pub order: u8,
    /// Which equation multiple scales solve.
    pub equation: ShockEquation,
    /// Whether the velocity of the first order leaves out its slow terms, as the printed figures
    /// of the paper do.
    pub printed_velocity: bool,
    /// Disturbed initial values; without any the pulses of the model disturb.
    pub initial: Vec<InitialValue>,
    /// End of the time history, s.
    pub duration: f64,
    /// Output step, s; `None` for a two-thousandth of the duration.
    pub step: Option<f64>,
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// Whether to answer by all methods side by side.
    pub compare: bool,
}

impl Default for ShockQuestion {
    fn default() -> Self {
        Self {
            method: ShockMethod::Full,
            order: 2,
            equation: ShockEquation::Published,
            printed_velocity: false,
            initial: Vec::new(),
            duration: 5.0,
            step: None,
            tolerance: 1e-10,
            compare: false,
        }
    }
}

/// How periodic responses are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ResonanceMethod {
    /// As many harmonics as the tolerance needs, continued by arclength.
    #[default]
    HarmonicBalance,
    /// One harmonic of the whole line with one nonlinear connection: all responses.
    FirstHarmonic,
    /// Closed form: averaging of one mode.
    Averaged,
}

impl ResonanceMethod {
    /// All methods with their names.
    pub const ALL: [(&'static str, Self); 3] = [
        ("harmonic-balance", Self::HarmonicBalance),
        ("first-harmonic", Self::FirstHarmonic),
        ("averaged", Self::Averaged),
    ];
    /// The names alone.
    pub const WORDS: [&'static str; Self::ALL.len()] = words(&Self::ALL);
}

/// How the Floquet multipliers of periodic responses are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum StabilityMethod {
    /// The variational equation integrated over one period.
    #[default]
    Monodromy,
    /// Eigenvalues of Hill's matrix of the same harmonics.
    Hill,
}

impl StabilityMethod {
    /// All methods with their names.
    pub const ALL: [(&'static str, Self); 2] =
        [("monodromy", Self::Monodromy), ("hill", Self::Hill)];
    /// The names alone.
    pub const WORDS: [&'static str; Self::ALL.len()] = words(&Self::ALL);
}

/// Settings of `resonance`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResonanceQuestion {
    /// Range of the excitation speed Ω, rad/s; `None` for one about the resonance.
    pub frequency: Option<(f64, f64)>,
    /// How.
    pub method: ResonanceMethod,
    /// Which elastic mode, from 1.
    pub mode: usize,
    /// Which order excites; `None` for every order that meets the mode in the range. Harmonic
    /// balance takes all orders together.
    pub order: Option<f64>,
    /// At how many frequencies all responses are listed; harmonic balance takes it for about how
    /// many samples a branch has, `None` for as many as its shape asks.
    pub points: Option<usize>,
    /// Whether to hold chosen responses against integration of the full equations.
    pub verify: bool,
    /// Number of harmonics of the response; `None` for as many as the tolerance needs.
    pub harmonics: Option<usize>,
    /// Error of the waveform that is tolerated, relative to its amplitude.
    pub tolerance: f64,
    /// How the Floquet multipliers are found.
    pub stability: StabilityMethod,
    /// Whether backbone curves are wanted.
    pub backbone: bool,
    /// A number of the line to go through in place of the excitation speed, which then stays at the
    /// lower end of `frequency`.
    pub parameter: Option<ParameterRange>,
}

/// Samples that closed forms list where nobody says how many.
pub const DEFAULT_POINTS: usize = 1000;

impl Default for ResonanceQuestion {
    fn default() -> Self {
        Self {
            frequency: None,
            method: ResonanceMethod::default(),
            mode: 1,
            order: None,
            points: None,
            verify: false,
            harmonics: None,
            tolerance: 1e-6,
            stability: StabilityMethod::default(),
            backbone: false,
            parameter: None,
        }
    }
}

/// A parameter and the range that it runs through, in SI.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterRange {
    /// Address of a number of the line, or of a coefficient of the mode: `mode.alpha`,
    /// `mode.beta`, `mode.f`, `mode.omega_1`.
    pub address: String,
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
}

/// Settings of `folds`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FoldsQuestion {
    /// Range of the excitation speed Ω, rad/s; `None` for all.
    pub frequency: Option<(f64, f64)>,
    /// The other axis of the plane.
    pub parameter: ParameterRange,
    /// How.
    pub method: ResonanceMethod,
    /// Which elastic mode, from 1.
    pub mode: usize,
    /// Which order excites; `None` for the strongest.
    pub order: Option<f64>,
    /// About how many points describe a curve.
    pub points: usize,
    /// Number of harmonics of the response; `None` for as many as the tolerance needs.
    pub harmonics: Option<usize>,
    /// Error of the waveform that is tolerated, relative to its amplitude.
    pub tolerance: f64,
}

/// Settings of `basins`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BasinsQuestion {
    /// Excitation speed Ω, rad/s.
    pub frequency: f64,
    /// The shaft whose twist and rate of twist are varied at the start; `None` for the first nonlinear
    /// one.
    pub shaft: Option<String>,
    /// Range of its twist (rad) and of its rate (rad/s); `None` for one and a half times what the
    /// responses reach.
    pub window: Option<[(f64, f64); 2]>,
    /// Number of twists and of rates.
    pub grid: (usize, usize),
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// Periods of the excitation after which a motion that has reached no response is given up.
    pub periods: usize,
    /// The node on which the smallest shock from one response to another acts; `None` for that of the
    /// first torque with an order.
    pub shock: Option<String>,
}

impl Default for BasinsQuestion {
    fn default() -> Self {
        Self {
            frequency: 1.0,
            shaft: None,
            window: None,
            grid: (201, 201),
            tolerance: 1e-8,
            periods: 2000,
            shock: None,
        }
    }
}
