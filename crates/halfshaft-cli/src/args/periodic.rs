//! The options of the questions about periodic responses, as text.

use clap::Args;
use halfshaft::QuestionText;
use halfshaft::model::question::{ResonanceMethod, StabilityMethod};

use super::questions::Model;
use super::words::OneOf;

#[derive(Args, Debug)]
pub struct Resonance {
    #[command(flatten)]
    pub model: Model,
    /// Range of the excitation speed Ω, e.g. 3.9Hz..4.4Hz or 3.9..4.4Hz; one speed where
    /// --parameter is given [default: about the resonance]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    pub frequency: Option<String>,
    /// Go through a number of the model at one speed, e.g. "engine torque.amplitude=0..900"
    /// (harmonic-balance)
    #[arg(long, value_name = "ADDRESS=A..B")]
    pub parameter: Option<String>,
    /// How, see above [default: harmonic-balance]
    #[arg(long, value_name = "METHOD", value_parser = OneOf(&ResonanceMethod::WORDS))]
    pub method: Option<String>,
    /// Harmonics of the response (harmonic-balance) [default: as many as the tolerance needs]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub harmonics: Option<String>,
    /// Error of the waveform by the harmonics left out, relative to its amplitude
    /// (harmonic-balance) [default: 1e-6]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Where stability comes from (harmonic-balance): the equations integrated over one period, or
    /// Hill's matrix of the same harmonics [default: monodromy]
    #[arg(long, value_name = "METHOD", value_parser = OneOf(&StabilityMethod::WORDS))]
    pub stability: Option<String>,
    /// Add backbone curves, on which the peaks lie as the excitation grows (averaged always does)
    #[arg(long)]
    pub backbone: bool,
    /// Which elastic mode the default range is about; with averaged, which mode answers
    /// [default: 1]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub mode: Option<String>,
    /// Which order of the torques excites (averaged, first-harmonic) [default: every one that meets
    /// the mode in the range]
    #[arg(long, value_name = "ORDER", allow_hyphen_values = true)]
    pub order: Option<String>,
    /// At how many speeds all responses are listed; with harmonic-balance about how many samples a
    /// branch has [default: 1000; harmonic-balance: as many as its shape asks]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub points: Option<String>,
    /// Check chosen responses against periodic orbits of the full equations; by the averaged method
    /// what differs is mostly the harmonics that it leaves out (first-harmonic is not checked so)
    #[arg(long)]
    pub verify: bool,
}

#[derive(Args, Debug)]
pub struct Folds {
    #[command(flatten)]
    pub model: Model,
    /// The other axis (needed): "half-shaft.cubic=-700..0"
    #[arg(long, value_name = "ADDRESS=A..B")]
    pub parameter: Option<String>,
    /// Range of the excitation speed Ω, e.g. 3.9Hz..4.4Hz or 3.9..4.4Hz [default: about the
    /// resonance; averaged: all]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    pub frequency: Option<String>,
    /// How, as `halfshaft resonance --help` says [default: harmonic-balance]
    #[arg(long, value_name = "METHOD", value_parser = OneOf(&ResonanceMethod::WORDS))]
    pub method: Option<String>,
    /// Harmonics of the response (harmonic-balance) [default: as many as the tolerance needs]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub harmonics: Option<String>,
    /// Error of the waveform by the harmonics left out, relative to its amplitude
    /// (harmonic-balance) [default: 1e-6]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Which elastic mode the default range is about; with averaged, which mode answers
    /// [default: 1]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub mode: Option<String>,
    /// Which order of the torques excites (averaged, first-harmonic) [default: the one that drives
    /// the mode most]
    #[arg(long, value_name = "ORDER", allow_hyphen_values = true)]
    pub order: Option<String>,
    /// About how many points describe a curve [default: 200]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub points: Option<String>,
}

impl Resonance {
    pub fn text(&self) -> QuestionText {
        QuestionText {
            frequency: self.frequency.clone(),
            parameter: self.parameter.clone(),
            method: self.method.clone(),
            harmonics: self.harmonics.clone(),
            tolerance: self.tolerance.clone(),
            stability: self.stability.clone(),
            backbone: self.backbone,
            mode: self.mode.clone(),
            order: self.order.clone(),
            points: self.points.clone(),
            verify: self.verify,
            ..QuestionText::default()
        }
    }
}

impl Folds {
    pub fn text(&self) -> QuestionText {
        QuestionText {
            parameter: self.parameter.clone(),
            frequency: self.frequency.clone(),
            method: self.method.clone(),
            harmonics: self.harmonics.clone(),
            tolerance: self.tolerance.clone(),
            mode: self.mode.clone(),
            order: self.order.clone(),
            points: self.points.clone(),
            ..QuestionText::default()
        }
    }
}
