//! Answer of `static`.

use serde::{Deserialize, Serialize};

use crate::{Header, Named, Table};

/// One state of rest or of uniform running.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equilibrium {
    /// Twist of each shaft, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist: Named<f64>,
    /// Torque of each shaft, N·m.
    #[serde(deserialize_with = "crate::number::read")]
    pub torque: Named<f64>,
    /// Whether the line stays there when nudged.
    pub stable: bool,
    /// Smallest eigenvalue of the tangent stiffness over the inertia with the rigid-body
    /// motion taken out, s⁻²: the square of the lowest natural frequency where positive; `None` for
    /// lines so large, or states so many, that it would take longer than everything else.
    pub lowest_eigenvalue: Option<f64>,
}

/// Where a shaft's law stops carrying more torque.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limit {
    /// Largest torque on the way from zero twist, N·m.
    #[serde(deserialize_with = "crate::number::read")]
    pub torque: f64,
    /// Twist at that torque, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist: f64,
}

/// Limits of a shaft in both directions; `None` where the torque grows without bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShaftCapacity {
    /// For positive twist.
    pub positive: Option<Limit>,
    /// For negative twist.
    pub negative: Option<Limit>,
}

/// Shafts that share a torque, because they connect the same parts or lie in a loop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SharedLoad {
    /// Their names; torque and twist below are in the sense of the first.
    pub shafts: Vec<String>,
    /// Torque that they must carry together, N·m; `None` where a loop leaves it undecided.
    pub required_torque: Option<f64>,
    /// What they can carry together; `None` where a loop leaves it undecided.
    pub capacity: Option<ShaftCapacity>,
}

/// How the line runs under its mean torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RunningKind {
    /// Held by a shaft to ground: it stands still.
    Held,
    /// Free, and the mean torques balance: any constant speed.
    Balanced,
    /// Free, the mean torques do not balance: uniform acceleration.
    Accelerating,
    /// Free with damping to ground: the speed at which damping balances the mean torques.
    SteadySpeed,
}

/// How the line runs under its mean torques.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Running {
    /// Which case.
    pub kind: RunningKind,
    /// Node whose motion is meant below.
    pub node: String,
    /// Angular acceleration of that node, rad/s².
    #[serde(deserialize_with = "crate::number::read")]
    pub acceleration: f64,
    /// Angular speed of that node, rad/s, for [`RunningKind::SteadySpeed`].
    #[serde(deserialize_with = "crate::number::read")]
    pub speed: f64,
    /// Mean torques that follow from the balance, N·m, by torque name.
    #[serde(deserialize_with = "crate::number::read")]
    pub balancing: Named<f64>,
}

/// What one gear asks of the shafts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GearState {
    /// Name of the gearbox.
    pub gear: String,
    /// Its ratio.
    #[serde(deserialize_with = "crate::number::read")]
    pub ratio: f64,
    /// Torque that each shaft must carry, N·m, where it carries it alone.
    #[serde(deserialize_with = "crate::number::read")]
    pub required_torque: Named<f64>,
    /// Shafts that share a torque.
    pub shared: Vec<SharedLoad>,
    /// Twist of each shaft in the stable state of rest; empty where there is none.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist: Named<f64>,
    /// Whether a stable state of rest exists.
    pub exists: bool,
    /// The shaft that cannot carry its torque, if any; the first of those that share it.
    pub overloaded: Option<String>,
}

/// Answer of `static`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StaticResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// All equilibria, those nearer to zero twist first.
    pub equilibria: Vec<Equilibrium>,
    /// Whether the list of equilibria is proven to be complete.
    pub complete: bool,
    /// Largest torque of each shaft in the direction in which it is loaded (the smaller one
    /// where it is not), N·m; `null` where it is unbounded.
    pub torque_capacity: Named<Option<f64>>,
    /// Limits of each shaft in both directions.
    pub capacity: Named<ShaftCapacity>,
    /// Torque that each shaft must carry, N·m, where it carries it alone.
    #[serde(deserialize_with = "crate::number::read")]
    pub required_torque: Named<f64>,
    /// Shafts that share a torque.
    pub shared: Vec<SharedLoad>,
    /// How the line runs.
    pub running: Running,
    /// What other gears ask, where the model lists ratios.
    pub gears: Vec<GearState>,
    /// Torque over twist of each shaft: `twist`, `torque`, `stiffness`.
    pub curves: Named<Table>,
}
