//! What turns vibration into heat.

use halfshaft_numerics::Complex;

use super::channels::Spring;
use crate::modal::vibration::Vibration;

/// A damper with its name.
pub(super) struct Damper {
    pub(super) name: String,
    kind: Kind,
}

enum Kind {
    Connection(Spring),
    Ground { group: usize, damping: f64 },
}

/// The dampers and lossy shafts of a line, only some of the shafts where these are told, and all that stand
/// between a node and ground.
pub(super) fn dampers(vibration: &Vibration, shafts: Option<&[String]>) -> Vec<Damper> {
    let equations = &vibration.equations;
    let connections = equations.connections.iter().enumerate();
    let lossy = connections.filter(|(_, connection)| {
        let told = shafts.is_none_or(|shafts| shafts.contains(&connection.name));
        told && (connection.damping > 0.0 || connection.loss_factor > 0.0)
    });
    let lossy = lossy.map(|(index, connection)| Damper {
        name: connection.name.clone(),
        kind: Kind::Connection(Spring::of(vibration, index)),
    });
    let grounds = equations.ground_damping.iter().enumerate().filter(|(_, c)| **c > 0.0);
    let grounds = grounds.map(|(group, damping)| Damper {
        name: equations.nodes[equations.reference[group]].name.clone(),
        kind: Kind::Ground { group, damping: *damping },
    });
    lossy.chain(grounds).collect()
}

impl Damper {
    /// Mean power of one order at `omega` (rad/s) for the motion of the groups, W.
    pub(super) fn heat(&self, omega: f64, motion: &[Complex]) -> f64 {
        match &self.kind {
            Kind::Connection(spring) => spring.heat(omega, motion),
            Kind::Ground { group, damping } => {
                let Complex { re, im } = motion[*group];
                0.5 * omega * omega * damping * (re * re + im * im)
            }
        }
    }
}
