//! The mass-elastic sheet: inertias and stiffnesses as they are, and reduced to the speed of one node.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::{Driveline, End};
use halfshaft_results::{MassElasticSheet, SheetConnection, SheetInertia};

/// The sheet, reduced to the node of the first torque with an order, or of the first engine, or else to
/// the first node.
pub(super) fn sheet(
    line: &Driveline,
    whole: &Driveline,
    equations: &EquationsOfMotion,
) -> MassElasticSheet {
    let speeds = equations.network.rigid_speeds(equations.groups());
    let loud = line
        .torques()
        .iter()
        .filter(|torque| torque.harmonics.iter().any(|harmonic| harmonic.amplitude_nm != 0.0));
    let driven = loud.map(|torque| torque.on.as_str());
    let cranks = line.engines().iter().map(|engine| engine.node(0));
    let reference = driven.chain(cranks).find_map(|name| equations.node(name)).unwrap_or(0);
    let node_speed = |node: usize| {
        let node = &equations.nodes[node];
        node.ratio * speeds[node.group]
    };
    let unit = node_speed(reference);
    let inertias = (0..equations.nodes.len()).filter(|node| equations.nodes[*node].inertia > 0.0);
    let inertias = inertias.map(|node| {
        let (ratio, inertia) = (node_speed(node) / unit, equations.nodes[node].inertia);
        let name = equations.nodes[node].name.clone();
        SheetInertia { name, inertia, ratio, reduced: inertia * ratio * ratio }
    });
    let ends = whole.shafts().iter().map(|shaft| (&shaft.from, &shaft.to));
    let ends = ends.chain(whole.meshes().map(|gear| (&gear.input, &gear.output)));
    let speed = |end: End| end.map(|(group, ratio)| ratio * speeds[group]);
    let connections = equations.connections.iter().zip(ends).map(|(connection, (from, to))| {
        // Both ends of a connection turn alike; ground does not turn.
        let turning = speed(connection.from).or(speed(connection.to)).unwrap_or(unit);
        let (ratio, stiffness) = (turning / unit, connection.law.stiffness(0.0));
        SheetConnection {
            name: connection.name.clone(),
            from: from.clone(),
            to: to.clone(),
            stiffness,
            damping: connection.damping,
            ratio,
            reduced_stiffness: stiffness * ratio * ratio,
            reduced_damping: connection.damping * ratio * ratio,
        }
    });
    MassElasticSheet {
        reference: equations.nodes[reference].name.clone(),
        inertias: inertias.collect(),
        connections: connections.collect(),
    }
}
