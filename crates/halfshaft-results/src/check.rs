//! Answer of `check`: the line as the program understands it.

use serde::{Deserialize, Serialize};

use crate::Header;

/// A node of a group that turns rigidly together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Member {
    /// Name of the node.
    pub node: String,
    /// Its own inertia, kg·m²; 0 where it has none.
    #[serde(deserialize_with = "crate::number::read")]
    pub inertia: f64,
    /// Its speed over the speed of the reference node.
    #[serde(deserialize_with = "crate::number::read")]
    pub ratio: f64,
    /// Its damping to ground, N·m·s/rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub damping: f64,
}

/// Nodes that gears hold together, as one inertia.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReducedInertia {
    /// Node to which the inertia is reduced.
    pub reference: String,
    /// Sum of `ratio² · inertia`, kg·m².
    #[serde(deserialize_with = "crate::number::read")]
    pub inertia: f64,
    /// The nodes.
    pub members: Vec<Member>,
}

/// A gear.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedGear {
    /// Name.
    pub name: String,
    /// Input node.
    pub input: String,
    /// Output node.
    pub output: String,
    /// Input speed over output speed.
    #[serde(deserialize_with = "crate::number::read")]
    pub ratio: f64,
    /// Other ratios that it offers.
    #[serde(deserialize_with = "crate::number::read")]
    pub ratios: Vec<f64>,
    /// Its mesh, where that is elastic.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<CheckedMesh>,
}

/// The elastic mesh of a gear, at the output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedMesh {
    /// N·m/rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub stiffness: f64,
    /// N·m·s/rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub damping: f64,
    /// Total backlash, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub clearance: f64,
}

/// A term of a shaft's law beyond the linear one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NonlinearTerm {
    /// Key of the term, e.g. `cubic`.
    pub key: String,
    /// Its coefficient.
    #[serde(deserialize_with = "crate::number::read")]
    pub coefficient: f64,
    /// Unit of the coefficient.
    pub unit: String,
    /// What it does, in words.
    pub effect: String,
}

/// A shaft.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedShaft {
    /// Name.
    pub name: String,
    /// Node at the `from` end.
    pub from: String,
    /// Node at the `to` end.
    pub to: String,
    /// Linear stiffness, N·m/rad: on the flanks of a clearance, at zero twist of stages and tables.
    #[serde(deserialize_with = "crate::number::read")]
    pub stiffness: f64,
    /// Damping, N·m·s/rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub damping: f64,
    /// Terms beyond the linear one that are not zero, and what else makes the law nonlinear.
    pub nonlinear_terms: Vec<NonlinearTerm>,
    /// Loss factor of hysteretic damping; 0 for none.
    #[serde(default, skip_serializing_if = "is_zero", deserialize_with = "crate::number::read")]
    pub loss_factor: f64,
    /// The bar that it is, where it is given by its dimensions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bar: Option<CheckedBar>,
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// A round bar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedBar {
    /// Length, m.
    #[serde(deserialize_with = "crate::number::read")]
    pub length: f64,
    /// Outer diameter, m.
    #[serde(deserialize_with = "crate::number::read")]
    pub outer_diameter: f64,
    /// Inner diameter, m.
    #[serde(deserialize_with = "crate::number::read")]
    pub inner_diameter: f64,
    /// Shear modulus, Pa.
    #[serde(deserialize_with = "crate::number::read")]
    pub shear_modulus: f64,
    /// Density, kg/m³.
    #[serde(deserialize_with = "crate::number::read")]
    pub density: f64,
    /// Pieces into which it is cut.
    pub elements: usize,
    /// Inertia of the whole bar, kg·m²: half of it stands with each of its ends.
    #[serde(deserialize_with = "crate::number::read")]
    pub inertia: f64,
}

/// An inertia of the mass-elastic sheet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SheetInertia {
    /// Its node.
    pub name: String,
    /// kg·m².
    #[serde(deserialize_with = "crate::number::read")]
    pub inertia: f64,
    /// Its speed over that of the reference node.
    #[serde(deserialize_with = "crate::number::read")]
    pub ratio: f64,
    /// Inertia times the square of the ratio, kg·m².
    #[serde(deserialize_with = "crate::number::read")]
    pub reduced: f64,
}

/// A connection of the mass-elastic sheet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SheetConnection {
    /// Shaft, mesh or damper.
    pub name: String,
    /// Node at one end.
    pub from: String,
    /// Node at the other.
    pub to: String,
    /// Stiffness at zero twist, N·m/rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub stiffness: f64,
    /// Damping, N·m·s/rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub damping: f64,
    /// Its speed over that of the reference node.
    #[serde(deserialize_with = "crate::number::read")]
    pub ratio: f64,
    /// Stiffness times the square of the ratio, N·m/rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub reduced_stiffness: f64,
    /// Damping times the square of the ratio, N·m·s/rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub reduced_damping: f64,
}

/// Inertias and stiffnesses of the line as they are and reduced to the speed of one node.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassElasticSheet {
    /// The node to whose speed everything is reduced.
    pub reference: String,
    /// Inertias.
    pub inertias: Vec<SheetInertia>,
    /// Shafts, meshes and dampers.
    pub connections: Vec<SheetConnection>,
}

/// A torque.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedTorque {
    /// Name.
    pub name: String,
    /// Node it acts on.
    pub on: String,
    /// Mean, N·m; `None` where it balances the others.
    pub mean: Option<f64>,
    /// Its harmonics, those with an amplitude.
    pub harmonics: Vec<CheckedHarmonic>,
    /// The pulse, if any.
    pub pulse: Option<CheckedPulse>,
    /// How the harmonics grow with the speed, if they do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub growth: Option<CheckedGrowth>,
}

/// Amplitudes that grow with a power of the excitation speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedGrowth {
    /// The power.
    #[serde(deserialize_with = "crate::number::read")]
    pub power: f64,
    /// Speed at which the amplitudes are those stated, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub reference_speed: f64,
}

/// A harmonic of a torque.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedHarmonic {
    /// Times per turn of the excitation.
    #[serde(deserialize_with = "crate::number::read")]
    pub order: f64,
    /// N·m.
    #[serde(deserialize_with = "crate::number::read")]
    pub amplitude: f64,
    /// rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub phase: f64,
}

/// A pulse of a torque.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedPulse {
    /// `half-sine`, `rectangle`, `ramp` or `impulse`.
    pub shape: String,
    /// Largest torque, N·m; `None` for an impulse.
    pub peak: Option<f64>,
    /// When it begins, s.
    #[serde(deserialize_with = "crate::number::read")]
    pub start: f64,
    /// How long it lasts (a ramp: how long it rises), s.
    #[serde(deserialize_with = "crate::number::read")]
    pub duration: f64,
    /// Torque over time, N·m·s.
    #[serde(deserialize_with = "crate::number::read")]
    pub angular_impulse: f64,
}

/// Answer of `check`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// Free text about the line.
    pub description: String,
    /// Whether a shaft holds the line at ground.
    pub grounded: bool,
    /// Degrees of freedom.
    pub degrees_of_freedom: usize,
    /// The line's inertias with the gears taken out.
    pub reduced_inertias: Vec<ReducedInertia>,
    /// Gears.
    pub gears: Vec<CheckedGear>,
    /// Shafts.
    pub shafts: Vec<CheckedShaft>,
    /// Torques, those of engines last.
    pub torques: Vec<CheckedTorque>,
    /// Inertias and stiffnesses reduced to one speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_elastic: Option<MassElasticSheet>,
    /// What the model says of the line as a whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<CheckedLine>,
}

/// Damping of the line as a whole, for linear vibrations, and the speeds at which it is run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckedLine {
    /// Damping ratio of every elastic mode.
    #[serde(deserialize_with = "crate::number::read")]
    pub modal_damping: f64,
    /// Loss factor of every connection that has none of its own.
    #[serde(deserialize_with = "crate::number::read")]
    pub loss_factor: f64,
    /// Operating range of the excitation speed, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub operating: Option<(f64, f64)>,
}
