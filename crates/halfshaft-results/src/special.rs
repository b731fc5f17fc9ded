//! Points of a curve where something happens.

use serde::{Deserialize, Serialize};

use crate::Named;

/// What happens at a special point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpecialKind {
    /// Two responses meet and vanish: the response jumps (limit point, LP).
    Fold,
    /// A multiplier leaves the unit circle at -1: a response of twice the period branches off (PD).
    PeriodDoubling,
    /// A complex pair of multipliers leaves the unit circle: a quasi-periodic motion branches off
    /// (torus, TR).
    NeimarkSacker,
    /// Two responses cross (BP).
    BranchPoint,
    /// The response begins or ceases to touch a switching twist of a law.
    GrazingContact,
    /// Two folds meet and vanish (CP).
    Cusp,
    /// A detached response is born from nothing.
    IsolaBirth,
    /// A detached response joins another.
    IsolaMerger,
    /// The curve ends: it leaves the asked range, or could not be followed further.
    End,
}

/// How surely a special point is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Located to the tolerance by an equation of its own.
    Located,
    /// Known to lie between two samples.
    Bracketed,
}

/// A special point with its values by column name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpecialPoint {
    /// What happens there.
    pub kind: SpecialKind,
    /// How surely it is known.
    pub status: Status,
    /// Change of the unstable dimension across the point, in the direction of the branch, where it is
    /// known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unstable_dimension_change: Option<i32>,
    /// What else there is to say, as a sentence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// Values by column name, `frequency` (rad/s) first. A period doubling or Neimark-Sacker point
    /// has the critical multiplier's `multiplier_angle` (rad), and any point located by Newton's
    /// method its `precision` (relative size of the last correction).
    #[serde(flatten, deserialize_with = "crate::number::read")]
    pub values: Named<f64>,
}

impl SpecialPoint {
    /// A point of the given kind with its values by column name.
    pub fn new(kind: SpecialKind, status: Status, values: Named<f64>) -> Self {
        Self { kind, status, unstable_dimension_change: None, note: None, values }
    }

    /// The value of that name.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }
}
