//! What every result says about itself.

use serde::{Deserialize, Serialize};

/// Which line an answer is about.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ModelIdentity {
    /// Name of the line.
    pub name: String,
    /// SHA-256 over all its values in SI.
    pub digest: String,
}

/// Why an analysis ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reason {
    /// All that was asked has been answered.
    Completed,
    /// The user stopped it; what was reached is kept.
    Cancelled,
    /// The integrator used up its steps.
    StepLimit,
    /// The integrator's step became too small to go on.
    StepTooSmall,
    /// A value left the numbers: the motion runs away.
    NonFinite,
    /// Questions of a study were left without a full answer.
    Unanswered,
    /// A shaft was twisted so far past the limit of its law that nothing holds it back.
    RunsAway,
    /// A connection changes its mode again and again without time passing.
    Chattering,
}

/// How an analysis ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Termination {
    /// Why.
    pub reason: Reason,
    /// Where it got to and what to try, where there is more to say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<String>,
}

impl Termination {
    /// All that was asked has been answered.
    pub fn completed() -> Self {
        Self { reason: Reason::Completed, detail: None }
    }

    /// An early end, with what was reached and what to try.
    pub fn early(reason: Reason, detail: impl Into<String>) -> Self {
        Self { reason, detail: Some(detail.into()) }
    }

    /// Whether all that was asked has been answered.
    pub fn is_complete(&self) -> bool {
        self.reason == Reason::Completed
    }
}

/// The head of every result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Name of the analysis, as the command is called.
    pub analysis: String,
    /// Which line.
    pub model: ModelIdentity,
    /// The settings with which it was asked, in SI.
    pub settings: serde_json::Value,
    /// How it ended.
    pub termination: Termination,
    /// Version of the program.
    pub version: String,
    /// What the reader must know before using the numbers, as sentences.
    pub warnings: Vec<String>,
    /// What was assumed, as sentences.
    pub assumptions: Vec<String>,
}
