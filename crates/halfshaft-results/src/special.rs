//! Points of a curve where something happens.

use serde::{Deserialize, Serialize};

use crate::Named;

/// What happens at a special point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpecialKind {
    /// Two responses meet and vanish: the response jumps (limit point, LP).
    Fold,
    /// Two folds meet and vanish (CP).
    Cusp,
    /// The curve leaves the asked range.
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
    /// Values by column name, `frequency` (rad/s) first.
    #[serde(flatten, deserialize_with = "crate::number::read")]
    pub values: Named<f64>,
}

impl SpecialPoint {
    /// The value of that name.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }
}
