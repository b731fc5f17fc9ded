//! Answer of `modes`.

use serde::{Deserialize, Serialize};

use crate::{Equilibrium, Header, Named};

/// One mode of vibration about an equilibrium.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mode {
    /// Undamped natural frequency, rad/s; exactly 0 for the rigid-body mode.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: f64,
    /// Frequency of the damped oscillation, rad/s; 0 where it does not oscillate.
    #[serde(deserialize_with = "crate::number::read")]
    pub damped_frequency: f64,
    /// Damping over critical damping.
    #[serde(deserialize_with = "crate::number::read")]
    pub damping_ratio: f64,
    /// Motion of each node, the largest 1.
    #[serde(deserialize_with = "crate::number::read")]
    pub shape: Named<f64>,
    /// Twist of each shaft in the same scale, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist: Named<f64>,
    /// Share of the strain energy in each shaft; sums to 1, all 0 for the rigid-body mode.
    #[serde(deserialize_with = "crate::number::read")]
    pub strain_energy: Named<f64>,
    /// Share of the kinetic energy in each inertia; sums to 1.
    #[serde(deserialize_with = "crate::number::read")]
    pub kinetic_energy: Named<f64>,
    /// The two eigenvalues as (real, imaginary), 1/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub eigenvalues: [(f64, f64); 2],
    /// What the mode is, in words.
    pub label: String,
}

/// Answer of `modes`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModesResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// The equilibrium about which the line vibrates.
    pub equilibrium: Equilibrium,
    /// Modes by ascending frequency, the rigid-body mode included.
    pub modes: Vec<Mode>,
    /// How many elastic modes the line has, where not all are listed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elastic_modes: Option<usize>,
    /// The same gear by gear, where a gearbox lists its ratios.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gears: Vec<ModesInGear>,
}

/// A gear that a gearbox can be switched to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gear {
    /// Name of the gearbox; `None` for the line as it is.
    #[serde(default)]
    pub gearbox: Option<String>,
    /// Its ratio.
    #[serde(default)]
    pub ratio: Option<f64>,
}

/// The lowest elastic modes in one gear.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModesInGear {
    /// The gear.
    #[serde(flatten)]
    pub gear: Gear,
    /// Undamped natural frequencies, ascending, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: Vec<f64>,
    /// Frequencies of the damped oscillations, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub damped_frequency: Vec<f64>,
    /// Damping over critical damping.
    #[serde(deserialize_with = "crate::number::read")]
    pub damping_ratio: Vec<f64>,
}
