//! Answer of `folds`.

use serde::{Deserialize, Serialize};

use crate::{Header, ModeScaling, SpecialPoint, Table};

/// Answer of `folds`: curves that bound the region where responses coexist.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoldsResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// Fold curves: `frequency`, the parameter under its address, the first harmonic of each
    /// channel, `sigma`, `rho`.
    pub curves: Vec<Table>,
    /// Cusps, where two fold curves meet.
    pub special_points: Vec<SpecialPoint>,
    /// Address of the parameter.
    pub parameter: String,
    /// Unit of the parameter.
    pub parameter_unit: String,
    /// Value of the parameter in the model, where it has one.
    pub parameter_value: Option<f64>,
    /// How the line was scaled to the oscillator at the model's own value.
    pub scaling: Option<ModeScaling>,
}
