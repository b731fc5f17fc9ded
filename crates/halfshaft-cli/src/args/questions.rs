//! The questions with their options, as text.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use halfshaft::model::question::{
    DryFriction, IntegratorChoice, ShockEquation, ShockMethod, Start, SweepDirection,
};
use halfshaft::{QuestionText, Verb};

use super::common::Common;
use super::linear::{Campbell, Forced};
use super::periodic::{Folds, Resonance};
use super::words::OneOf;

/// Questions about a line.
#[derive(Debug, Subcommand)]
pub enum Ask {
    /// Is the model sound? A summary of what it says
    #[command(after_help = "Examples:
  halfshaft check my-line.toml
  halfshaft check my-line.toml --out line.svg      a sketch of the line")]
    Check(Model),
    /// All equilibria under the mean torques, and how much torque each shaft can carry
    #[command(after_help = "Examples:
  halfshaft static my-line.toml
  halfshaft static --set gearbox.ratio=1.79         the built-in example in another gear
  halfshaft static --out wind-up.svg                torque over twist")]
    Static(Model),
    /// Natural frequencies, damping and mode shapes about the equilibrium
    ///
    /// Of a line of more than 400 degrees of freedom the lowest 20, unless --count says otherwise. Where
    /// a gearbox lists its ratios the lowest modes come gear by gear as well.
    #[command(after_help = "Examples:
  halfshaft modes my-line.toml
  halfshaft modes long-line.toml --count 40
  halfshaft modes --json | jq '.modes[].frequency'")]
    Modes(Modes),
    /// Critical speeds: where orders of the excitation meet natural frequencies
    ///
    /// The Campbell diagram with a table of its crossings: which mode, which order, how far from the
    /// operating range, and the torque that this order and mode alone would make in the shaft that they
    /// load most. Gear by gear where a gearbox lists its ratios.
    #[command(after_help = "Examples:
  halfshaft campbell my-line.toml --operating 800rpm..6000rpm --out campbell.svg
  halfshaft campbell my-line.toml --orders 0.5,1,2,4 --frequency 0rpm..7000rpm")]
    Campbell(Campbell),
    /// Linear vibration over the excitation speed, order by order and all together
    ///
    /// Torques of shafts (half of their range over a period), accelerations of nodes and heat in dampers,
    /// with the phases of all sources: orders add up in time, not by their magnitudes. Small vibrations
    /// about the equilibrium; `resonance` answers for what is not linear. Gear by gear where a gearbox
    /// lists its ratios.
    #[command(after_help = "Examples:
  halfshaft forced my-line.toml --frequency 800rpm..6000rpm --out forced.svg
  halfshaft forced my-line.toml --shaft crankshaft --orders 2,4,6
  halfshaft forced my-line.toml --points 1000 --out forced.csv")]
    Forced(Forced),
    /// A time history of the full equations
    ///
    /// Torques act from time 0 on. The channels are SHAFT.twist, .twist_rate, .torque (spring
    /// and damper together) and NODE.angle, .speed.
    #[command(after_help = "Examples:
  halfshaft simulate my-line.toml --duration 2s --out history.csv
  halfshaft simulate --start equilibrium --frequency 200rpm --out history.svg
  halfshaft simulate --initial \"half-shaft.twist=1 rad\" --tolerance 1e-12
  halfshaft simulate --frequency 26rad/s --duration 700s --record 500s..700s")]
    Simulate(Simulate),
    /// The response to a torque pulse or an initial twist, with metrics
    ///
    /// Without --initial the pulses of the model disturb the line; with it, the initial state does.
    ///
    /// Methods: full (the whole line; the one to trust), clamped (the load with the drive end
    /// held), published (equation (14) of Han and He 2018 as printed, which doubles stiffness and
    /// damping), multiple-scales (closed form; only this one has --order, --equation and
    /// --printed-velocity). In the last three, twist and twist_rate stand for θ, the advance of the
    /// load end over the equilibrium, and an initial twist is θ(0).
    #[command(after_help = "Examples:
  halfshaft shock my-line.toml --compare --out shock.svg
  halfshaft shock --method published --initial \"half-shaft.twist=1 rad\"
  halfshaft shock --method multiple-scales --order 1 --equation twist")]
    Shock(Shock),
    /// Periodic responses over excitation speed: all branches, stability, special points
    ///
    /// How the line swings while the torques oscillate, at every excitation speed of the range: all
    /// responses that coexist, which of them are stable, and where a slow sweep jumps.
    ///
    /// Methods: harmonic-balance (the whole line with all its orders, as many harmonics as the
    /// tolerance needs; the one to trust), first-harmonic (one harmonic of a line with one nonlinear
    /// shaft, which finds every response, detached ones too), averaged (closed form of one mode near
    /// its resonance, in microseconds; the scaling to x'' + omega_1² x + alpha x³ + beta x' = f
    /// cos((omega_1 + sigma) t) is printed with it).
    ///
    /// Not searched: responses that repeat only after several periods of the excitation and that no
    /// period doubling of a listed response gives birth to; they are found only where nothing else is
    /// stable, or, for laws with kinks, where the line let run settles to one. Of responses whose
    /// mirror symmetry is broken one is listed, not its mirrored twin.
    ///
    /// With --parameter the speed stays and a number of the model changes instead.
    #[command(after_help = "Examples:
  halfshaft resonance my-line.toml --verify
  halfshaft resonance --frequency 3Hz..5Hz --backbone --out response.svg
  halfshaft resonance --frequency 4.1Hz --parameter \"engine torque.amplitude=0..900\"
  halfshaft resonance --method averaged --set \"engine torque.amplitude=900\" --json")]
    Resonance(Resonance),
    /// Fold curves in a plane of excitation speed and one parameter, with cusps
    ///
    /// At a fold two responses meet and vanish, so that the line jumps to another one; at a cusp
    /// two fold curves meet, and beyond it nothing jumps any more. Where a fold curve turns, a
    /// detached response is born or joins another. The parameter is any number of the model by its
    /// address; with --method averaged also a coefficient of the scaled equation: mode.alpha,
    /// mode.beta, mode.f, mode.omega_1.
    #[command(after_help = "Examples:
  halfshaft folds --parameter \"engine torque.amplitude=100..2000\"
  halfshaft folds --parameter \"half-shaft.damping=1..100 N·m·s/rad\" --out folds.svg
  halfshaft folds --method averaged --parameter \"mode.f=1..20\"")]
    Folds(Folds),
    /// Which initial state leads to which response, at one excitation speed
    ///
    /// All responses that the line settles to at this speed, and a map of the twists and rates of twist
    /// of one shaft at time 0 by the response that they lead to. Everything else starts at rest in the
    /// equilibrium, while the torques act from time 0 on. Every state of the grid is followed until a
    /// stable response catches it.
    ///
    /// Where there are several responses, also the smallest shock that throws the line from each to
    /// each other: an impulse of torque on one node, at the worst moment, in the worse direction.
    #[command(after_help = "Examples:
  halfshaft basins --frequency 4.12Hz
  halfshaft basins my-line.toml --frequency 26rad/s --grid 400 --out basins.png
  halfshaft basins my-line.toml --frequency 26rad/s --window \"-5rad..5rad,-120rad/s..120rad/s\"
  halfshaft basins my-line.toml --frequency 26rad/s --shock vehicle")]
    Basins(Basins),
    /// What the line settles to on a stepwise sweep, seen once a period: the bifurcation diagram
    ///
    /// At every value of the excitation speed (or, with --parameter, of a number of the model at one
    /// speed) the motion goes on from where it was at the value before, so that hysteresis shows. It is
    /// followed by integration until it repeats or --transient is over; then the twist and its rate are
    /// recorded whenever a period of the excitation begins: one repetition of a motion that repeats,
    /// --points periods of any other. Each motion has its period, its largest Lyapunov exponent and the
    /// branch of `resonance` that it lies on.
    #[command(after_help = "Examples:
  halfshaft bifurcation my-line.toml --frequency 3Hz..5Hz --out diagram.png
  halfshaft bifurcation --frequency 4.1Hz --parameter \"engine torque.amplitude=0..800\"
  halfshaft bifurcation my-line.toml --frequency 20rad/s..30rad/s --direction up --steps 1000")]
    Bifurcation(Bifurcation),
}

/// The model that is asked about, and what to do with the answer.
#[derive(Args, Debug)]
pub struct Model {
    /// Model file (TOML) [default: the built-in example]
    #[arg(value_name = "MODEL")]
    pub model: Option<PathBuf>,
    #[command(flatten)]
    pub common: Common,
}

#[derive(Args, Debug)]
pub struct Modes {
    #[command(flatten)]
    pub model: Model,
    /// Which equilibrium, as `static` numbers them [default: the stable one nearest zero twist]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub equilibrium: Option<String>,
    /// How many of the lowest elastic modes [default: all, or 20 of a line of more than 400 degrees of
    /// freedom]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub count: Option<String>,
}

#[derive(Args, Debug)]
pub struct Simulate {
    #[command(flatten)]
    pub model: Model,
    /// End of the time history [default: 5s]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub duration: Option<String>,
    /// State before the initial values: everything zero, or the stable equilibrium [default: rest]
    #[arg(long, value_name = "START", value_parser = OneOf(&Start::WORDS))]
    pub start: Option<String>,
    /// A value at time 0: "half-shaft.twist=1 rad", "engine.speed=900 rpm" (repeatable)
    #[arg(long, value_name = "CHANNEL=VALUE")]
    pub initial: Vec<String>,
    /// Excitation speed Ω, e.g. 4Hz; a run-up 600rpm..3000rpm or a run-down 3000rpm..600rpm moves it over
    /// the duration; without it torques that have an order are silent
    #[arg(long, value_name = "SPEED|A..B", allow_hyphen_values = true)]
    pub frequency: Option<String>,
    /// Rate of a run-up or run-down in place of its duration, e.g. 50rpm/s
    #[arg(long, value_name = "RATE", allow_hyphen_values = true)]
    pub rate: Option<String>,
    /// Dry friction: exact sticks and slides, smoothed is what harmonic balance takes [default: exact]
    #[arg(long, value_name = "WAY", value_parser = OneOf(&DryFriction::WORDS))]
    pub friction: Option<String>,
    /// Which integrator; automatic goes over to an implicit one where the equations are stiff
    /// [default: automatic]
    #[arg(long, value_name = "METHOD", value_parser = OneOf(&IntegratorChoice::WORDS))]
    pub integrator: Option<String>,
    /// Channel whose spectra over the orders are told [default: the torque of the first nonlinear shaft]
    #[arg(long, value_name = "CHANNEL")]
    pub orders: Option<String>,
    /// Time between two rows of the output [default: a two-thousandth of what is recorded]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub step: Option<String>,
    /// Relative tolerance of the integration [default: 1e-10]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Times to keep and to measure, e.g. 500s..700s [default: all]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    pub record: Option<String>,
}

#[derive(Args, Debug)]
pub struct Shock {
    #[command(flatten)]
    pub model: Model,
    /// Which equations [default: full]
    #[arg(long, value_name = "METHOD", value_parser = OneOf(&ShockMethod::WORDS))]
    pub method: Option<String>,
    /// Multiple scales: of which order [default: 2]
    #[arg(
        long,
        value_name = "ORDER",
        value_parser = OneOf(&["1", "2"]),
        allow_hyphen_values = true
    )]
    pub order: Option<String>,
    /// Multiple scales: of which equation [default: published]
    #[arg(long, value_name = "EQUATION", value_parser = OneOf(&ShockEquation::WORDS))]
    pub equation: Option<String>,
    /// Multiple scales, order 1: leave the slow terms out of the velocity, as the paper's figures do
    #[arg(long)]
    pub printed_velocity: bool,
    /// Disturb by "half-shaft.twist=1 rad" in place of the model's pulses (repeatable)
    #[arg(long, value_name = "CHANNEL=VALUE")]
    pub initial: Vec<String>,
    /// End of the time history [default: 5s]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub duration: Option<String>,
    /// Time between two rows of the output [default: a two-thousandth of the duration]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub step: Option<String>,
    /// Relative tolerance of the integration [default: 1e-10]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Answer by all methods side by side
    #[arg(long)]
    pub compare: bool,
}

#[derive(Args, Debug)]
pub struct Basins {
    #[command(flatten)]
    pub model: Model,
    /// Excitation speed Ω, e.g. 4Hz or 240rpm
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true)]
    pub frequency: Option<String>,
    /// Number of twists and of rates: 200, or 300x200 [default: 201]
    #[arg(long, value_name = "N|NxM", allow_hyphen_values = true)]
    pub grid: Option<String>,
    /// Twists and rates of twist at time 0, e.g. "-2rad..2rad,-50rad/s..50rad/s" [default: one and a
    /// half times what the responses reach]
    #[arg(long, value_name = "A..B,C..D", allow_hyphen_values = true)]
    pub window: Option<String>,
    /// Shaft whose twist and rate are varied [default: the first nonlinear one]
    #[arg(long, value_name = "NAME")]
    pub shaft: Option<String>,
    /// Relative tolerance of the integration [default: 1e-8]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Periods of the excitation after which a motion is given up [default: 2000]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub periods: Option<String>,
    /// Node on which the smallest shock from one response to another acts [default: that of the first
    /// torque with an order]
    #[arg(long, value_name = "NODE")]
    pub shock: Option<String>,
}

impl Basins {
    fn text(&self) -> QuestionText {
        QuestionText {
            frequency: self.frequency.clone(),
            grid: self.grid.clone(),
            window: self.window.clone(),
            shaft: self.shaft.clone(),
            tolerance: self.tolerance.clone(),
            periods: self.periods.clone(),
            shock: self.shock.clone(),
            ..QuestionText::default()
        }
    }
}

#[derive(Args, Debug)]
pub struct Bifurcation {
    #[command(flatten)]
    pub model: Model,
    /// Range of the excitation speed Ω, e.g. 3Hz..5Hz; one speed with --parameter [default: about the
    /// resonance]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    pub frequency: Option<String>,
    /// A number of the model to go through at one speed: "half-shaft.damping=1..100"
    #[arg(long, value_name = "ADDRESS=A..B")]
    pub parameter: Option<String>,
    /// Number of values, both ends included [default: 200]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub steps: Option<String>,
    /// Periods of the excitation for settling at each value, at most [default: what the line's damping takes,
    /// from 200 to 20000]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub transient: Option<String>,
    /// Periods that are recorded of a motion that does not repeat [default: 64]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub points: Option<String>,
    /// Shaft whose twist and rate are recorded [default: the first nonlinear one]
    #[arg(long, value_name = "NAME")]
    pub shaft: Option<String>,
    /// Relative error of a step of the integration [default: 1e-9]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Which way to sweep [default: both]
    #[arg(long, value_name = "DIRECTION", value_parser = OneOf(&SweepDirection::WORDS))]
    pub direction: Option<String>,
    /// Leave out the branches that `resonance` continues over the same range
    #[arg(long)]
    pub no_branches: bool,
}

impl Bifurcation {
    fn text(&self) -> QuestionText {
        QuestionText {
            frequency: self.frequency.clone(),
            parameter: self.parameter.clone(),
            steps: self.steps.clone(),
            transient: self.transient.clone(),
            points: self.points.clone(),
            shaft: self.shaft.clone(),
            tolerance: self.tolerance.clone(),
            direction: self.direction.clone(),
            no_branches: self.no_branches,
            ..QuestionText::default()
        }
    }
}

impl Ask {
    /// The model, to complete its flags.
    pub fn model_mut(&mut self) -> &mut Model {
        match self {
            Self::Check(model) | Self::Static(model) => model,
            Self::Modes(modes) => &mut modes.model,
            Self::Campbell(campbell) => &mut campbell.model,
            Self::Forced(forced) => &mut forced.model,
            Self::Simulate(simulate) => &mut simulate.model,
            Self::Shock(shock) => &mut shock.model,
            Self::Resonance(resonance) => &mut resonance.model,
            Self::Folds(folds) => &mut folds.model,
            Self::Basins(basins) => &mut basins.model,
            Self::Bifurcation(bifurcation) => &mut bifurcation.model,
        }
    }

    /// The verb, the model and the options in words.
    pub fn question(&self) -> (Verb, &Model, QuestionText) {
        let none = QuestionText::default();
        match self {
            Self::Check(model) => (Verb::Check, model, none),
            Self::Static(model) => (Verb::Static, model, none),
            Self::Modes(modes) => {
                let (equilibrium, count) = (modes.equilibrium.clone(), modes.count.clone());
                (Verb::Modes, &modes.model, QuestionText { equilibrium, count, ..none })
            }
            Self::Campbell(campbell) => (Verb::Campbell, &campbell.model, campbell.text()),
            Self::Forced(forced) => (Verb::Forced, &forced.model, forced.text()),
            Self::Simulate(simulate) => (Verb::Simulate, &simulate.model, simulate.text()),
            Self::Shock(shock) => (Verb::Shock, &shock.model, shock.text()),
            Self::Resonance(resonance) => (Verb::Resonance, &resonance.model, resonance.text()),
            Self::Folds(folds) => (Verb::Folds, &folds.model, folds.text()),
            Self::Basins(basins) => (Verb::Basins, &basins.model, basins.text()),
            Self::Bifurcation(bifurcation) => {
                (Verb::Bifurcation, &bifurcation.model, bifurcation.text())
            }
        }
    }
}

impl Simulate {
    fn text(&self) -> QuestionText {
        QuestionText {
            duration: self.duration.clone(),
            start: self.start.clone(),
            initial: self.initial.clone(),
            frequency: self.frequency.clone(),
            rate: self.rate.clone(),
            friction: self.friction.clone(),
            orders: self.orders.clone(),
            integrator: self.integrator.clone(),
            step: self.step.clone(),
            tolerance: self.tolerance.clone(),
            record: self.record.clone(),
            ..QuestionText::default()
        }
    }
}

impl Shock {
    fn text(&self) -> QuestionText {
        QuestionText {
            method: self.method.clone(),
            order: self.order.clone(),
            equation: self.equation.clone(),
            printed_velocity: self.printed_velocity,
            initial: self.initial.clone(),
            duration: self.duration.clone(),
            step: self.step.clone(),
            tolerance: self.tolerance.clone(),
            compare: self.compare,
            ..QuestionText::default()
        }
    }
}
