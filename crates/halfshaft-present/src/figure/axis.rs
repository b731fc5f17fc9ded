//! What an axis says and how it measures.

use serde::Serialize;

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Equal differences take equal lengths.
    #[default]
    Linear,
    /// Equal ratios take equal lengths; values that are not positive are not shown.
    Log,
}

/// A second reading of the same axis in another unit, on the opposite side of the panel:
/// `secondary value = factor * value + offset`. It is left out if the factor is zero, or if the axis
/// is logarithmic and the second unit is not a positive multiple of the first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Secondary {
    /// The quantity, for instance "Engine speed".
    pub label: String,
    /// Its unit, for instance "rpm"; empty for a pure number.
    pub unit: String,
    /// Secondary units per primary unit.
    pub factor: f64,
    /// Secondary value where the primary value is zero.
    pub offset: f64,
}

/// One axis of a panel.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Axis {
    /// The quantity with its symbol, for instance "Excitation speed Ω" (light typesetting).
    pub label: String,
    /// Its unit, for instance "rad/s"; empty for a pure number.
    pub unit: String,
    /// The shown interval; `None` fits the data.
    pub range: Option<(f64, f64)>,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// A second unit on the opposite side.
    pub secondary: Option<Secondary>,
    /// Names (light typesetting) at values, in place of numbers; such as the parts of a line. Along
    /// a horizontal axis those that would overlap are left out.
    pub names: Vec<(f64, String)>,
}

impl Axis {
    /// A linear axis that fits its data.
    #[must_use]
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), ..Self::default() }
    }

    /// Shows exactly this interval.
    #[must_use]
    pub fn with_range(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from, to));
        self
    }

    /// Writes names at values in place of numbers.
    #[must_use]
    pub fn with_names(mut self, names: Vec<(f64, String)>) -> Self {
        self.names = names;
        self
    }

    /// Makes the axis logarithmic.
    #[must_use]
    pub fn logarithmic(mut self) -> Self {
        self.scale = Scale::Log;
        self
    }

    /// Adds a second unit that is a multiple of the first, such as rpm over rad/s.
    #[must_use]
    pub fn with_secondary(
        mut self,
        label: impl Into<String>,
        unit: impl Into<String>,
        factor: f64,
    ) -> Self {
        let (label, unit) = (label.into(), unit.into());
        self.secondary = Some(Secondary { label, unit, factor, offset: 0.0 });
        self
    }

    /// The secondary reading if its numbers make one: finite, not constant, and, on a logarithmic
    /// axis, again logarithmic.
    pub(crate) fn usable_secondary(&self) -> Option<&Secondary> {
        let usable = |s: &&Secondary| {
            let ratio = (1e-100..1e100).contains(&s.factor.abs());
            let proportional = s.offset == 0.0 && s.factor > 0.0;
            ratio && s.offset.is_finite() && (self.scale == Scale::Linear || proportional)
        };
        self.secondary.as_ref().filter(usable)
    }
}

impl Secondary {
    /// The secondary value at a primary value.
    #[must_use]
    pub fn value(&self, primary: f64) -> f64 {
        self.factor * primary + self.offset
    }

    /// The primary value at a secondary value.
    #[must_use]
    pub fn primary(&self, value: f64) -> f64 {
        (value - self.offset) / self.factor
    }
}
