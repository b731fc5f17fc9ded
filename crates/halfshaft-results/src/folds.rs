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
    /// channel; closed forms add `sigma`, `rho`; harmonic balance adds `opens` (1 where the two
    /// responses that meet at the fold exist at higher speeds, -1 where at lower ones),
    /// `unstable_dimension` (of the stabler of the two) and `harmonics`.
    pub curves: Vec<Table>,
    /// Cusps, where two fold curves meet; births and mergers of detached responses.
    pub special_points: Vec<SpecialPoint>,
    /// Address of the parameter.
    pub parameter: String,
    /// Unit of the parameter.
    pub parameter_unit: String,
    /// Value of the parameter in the model, where it has one.
    pub parameter_value: Option<f64>,
    /// How the line was scaled to the oscillator at the model's own value.
    pub scaling: Option<ModeScaling>,
    /// How many responses coexist, where that was counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub responses: Option<ResponseCount>,
}

/// Number of coexisting periodic responses of the excitation's period over a grid of the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResponseCount {
    /// Excitation speeds of the grid, rad/s, ascending.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: Vec<f64>,
    /// Values of the parameter of the grid, ascending.
    #[serde(deserialize_with = "crate::number::read")]
    pub parameter: Vec<f64>,
    /// `count[i][j]` responses at `parameter[i]`, `frequency[j]`.
    pub count: Vec<Vec<u32>>,
}
