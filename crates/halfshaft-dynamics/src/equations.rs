//! Inertias and connections of a line with the gears taken out.

use halfshaft_model::elements::{Engagement, MeanTorque};
use halfshaft_model::{Driveline, End, Network, Topology};

use crate::error::DynamicsError;
use crate::excitation::Excitation;
use crate::laws::{Friction, TorqueLaw, law_of_mesh, law_of_shaft};
use crate::rigid::RigidBody;

/// A shaft between two groups (or a group and ground), or the elastic mesh of a gear: twist
/// `x = ratio_from q_from - ratio_to q_to`.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Name of the shaft or gear.
    pub name: String,
    /// Group and ratio of the node at the `from` end; `None` is ground.
    pub from: End,
    /// Group and ratio of the node at the `to` end; `None` is ground.
    pub to: End,
    /// Torque over twist.
    pub law: TorqueLaw,
    /// Viscous damping in parallel, N·m·s/rad.
    pub damping: f64,
    /// Whether the damping acts at every twist; else only where [`TorqueLaw::in_contact`].
    pub damps_in_gap: bool,
    /// Dry friction in parallel.
    pub friction: Option<Friction>,
    /// When the friction comes to bear, for motions in time; `None` from the beginning.
    pub engagement: Option<Engagement>,
    /// Loss factor of hysteretic damping, for linear vibrations.
    pub loss_factor: f64,
    /// Torque over the relative acceleration of the ends, kg·m²: of pieces of bars with consistent
    /// inertia ([`EquationsOfMotion::consistent`]), else zero.
    pub inertance: f64,
}

impl Connection {
    /// Viscous damping that acts at twist `x` (rad), N·m·s/rad.
    #[inline]
    pub fn damping_at(&self, x: f64) -> f64 {
        if self.damps_in_gap || self.law.in_contact(x) { self.damping } else { 0.0 }
    }

    /// Torque that depends on the rate of twist `v` (rad/s): viscous damping and dry friction, N·m.
    #[inline]
    pub fn resistance(&self, x: f64, v: f64) -> f64 {
        self.damping_at(x) * v + self.friction.map_or(0.0, |friction| friction.torque(v))
    }

    /// Derivative of [`Connection::resistance`] by the rate, N·m·s/rad.
    #[inline]
    pub fn resistance_slope(&self, x: f64, v: f64) -> f64 {
        self.damping_at(x) + self.friction.map_or(0.0, |friction| friction.slope(v))
    }
}

/// A node of the line: it turns at `ratio` times its group.
#[derive(Clone, Debug, PartialEq)]
pub struct NodePlace {
    /// Name of the node.
    pub name: String,
    /// Its group.
    pub group: usize,
    /// Its speed over the group's.
    pub ratio: f64,
    /// Its own inertia, kg·m².
    pub inertia: f64,
}

/// `M q'' + D q' + Σ w (c x' + r(x') + p(x)) = Q`, one coordinate `q` a group.
#[derive(Clone, Debug)]
pub struct EquationsOfMotion {
    /// Inertia of each group, kg·m², at its reference node.
    pub inertia: Vec<f64>,
    /// Damping to ground of each group, N·m·s/rad, at its reference node.
    pub ground_damping: Vec<f64>,
    /// Reference node of each group, by index into `nodes`.
    pub reference: Vec<usize>,
    /// Shafts and then elastic meshes of gears, each in file order.
    pub connections: Vec<Connection>,
    /// Nodes of the line.
    pub nodes: Vec<NodePlace>,
    /// Spanning tree and loops.
    pub network: Network,
    /// The motion without twist; `None` for a line held at ground.
    pub rigid: Option<RigidBody>,
    /// External torques.
    pub excitation: Excitation,
    /// Number of elastic meshes of gears, the last of the connections.
    pub meshes: usize,
    /// Damping ratio of every elastic mode beside what dampers do, for linear vibrations.
    pub modal_damping: f64,
}

impl EquationsOfMotion {
    /// Group angles (or speeds) from the twists of the spanning tree (or their rates), in the tree's
    /// order; those of a free line with its first group at zero.
    pub fn group_angles(&self, tree_twists: &[f64], angles: &mut [f64]) {
        if self.rigid.is_some() {
            angles[0] = 0.0;
        }
        for (twist, edge) in tree_twists.iter().zip(&self.network.tree) {
            let parent = edge.parent.map_or(0.0, |(group, ratio)| ratio * angles[group]);
            let (child, ratio) = edge.child;
            angles[child] = if edge.from_parent { parent - twist } else { parent + twist } / ratio;
        }
    }

    /// The equations of motion of `line`, bars with half of the inertia of each piece at either end.
    ///
    /// # Errors
    /// [`DynamicsError`] for a line that validation would not have passed.
    pub fn new(line: &Driveline) -> Result<Self, DynamicsError> {
        let mut equations = Self::consistent(line)?;
        equations.connections.iter_mut().for_each(|connection| connection.inertance = 0.0);
        Ok(equations)
    }

    /// The same with consistent inertia of bars: what it differs by from halves at the ends is the
    /// inertance of the connections. For linear vibrations.
    ///
    /// # Errors
    /// [`DynamicsError`] for a line that validation would not have passed.
    pub fn consistent(line: &Driveline) -> Result<Self, DynamicsError> {
        let line = &*line.expanded();
        let topology = Topology::of(line)?;
        let network = Network::of(line, &topology);
        let nodes = node_places(line, &topology);
        let count = topology.groups.len();
        let mut inertia = vec![0.0; count];
        let mut ground_damping = vec![0.0; count];
        for (node, element) in nodes.iter().zip(line.inertias()) {
            // The first nodes are those of the inertias, in the same order.
            inertia[node.group] += node.ratio * node.ratio * element.inertia_kg_m2;
            ground_damping[node.group] += node.ratio * node.ratio * element.damping_nm_s_per_rad;
        }
        if inertia.iter().all(|value| *value <= 0.0) || !network.unreached.is_empty() {
            return Err(DynamicsError::Degenerate);
        }
        let rigid = (!network.grounded)
            .then(|| RigidBody::new(network.rigid_speeds(count), &inertia, &ground_damping));
        let mut excitation = Excitation::new(line, &topology);
        balance(line, &mut excitation, rigid.as_ref());
        Ok(Self {
            reference: topology.groups.iter().map(|group| group.reference).collect(),
            connections: connections(line, &network),
            inertia,
            ground_damping,
            nodes,
            network,
            rigid,
            excitation,
            meshes: line.meshes().count(),
            modal_damping: line.whole().modal_damping,
        })
    }

    /// The first node that turns without any inertia, which only linear vibrations and statics can do
    /// without.
    pub fn massless(&self) -> Option<&str> {
        let group = self.inertia.iter().position(|inertia| *inertia <= 0.0)?;
        self.reference.get(group).map(|node| self.nodes[*node].name.as_str())
    }

    /// What damps linear vibrations only, in words: a loss factor or modal damping.
    pub fn linear_damping(&self) -> Option<String> {
        if self.modal_damping > 0.0 {
            return Some("modal damping of the whole line".to_owned());
        }
        let lossy = self.connections.iter().find(|connection| connection.loss_factor > 0.0)?;
        Some(format!("the loss factor of \"{}\"", lossy.name))
    }

    /// Number of groups, the degrees of freedom.
    pub fn groups(&self) -> usize {
        self.inertia.len()
    }

    /// Index of the connection of that name.
    pub fn connection(&self, name: &str) -> Option<usize> {
        self.connections.iter().position(|connection| connection.name == name)
    }

    /// Index of the node of that name.
    pub fn node(&self, name: &str) -> Option<usize> {
        self.nodes.iter().position(|node| node.name == name)
    }

    /// Twist of connection `index` for group angles `angles`.
    pub fn twist(&self, index: usize, angles: &[f64]) -> f64 {
        let connection = &self.connections[index];
        let end = |end: End| end.map_or(0.0, |(group, ratio)| ratio * angles[group]);
        end(connection.from) - end(connection.to)
    }

    /// Adds `scale · w_e` for connection `index` to `out`, one entry a group.
    pub fn add_direction(&self, index: usize, scale: f64, out: &mut [f64]) {
        let connection = &self.connections[index];
        if let Some((group, ratio)) = connection.from {
            out[group] += scale * ratio;
        }
        if let Some((group, ratio)) = connection.to {
            out[group] -= scale * ratio;
        }
    }

    /// Times at which torques or frictions change their law, ascending, each once.
    pub fn breaks(&self) -> Vec<f64> {
        let mut times = self.excitation.breaks();
        let engagements = self.connections.iter().filter_map(|connection| connection.engagement);
        times.extend(engagements.flat_map(|engagement| [engagement.start_s, engagement.end_s()]));
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// `wᵀ M⁻¹ w` of connection `index`: acceleration of its twist by a torque across it, 1/(kg·m²).
    pub fn compliance_of(&self, index: usize) -> f64 {
        let mut direction = vec![0.0; self.groups()];
        self.add_direction(index, 1.0, &mut direction);
        direction.iter_mut().zip(&self.inertia).for_each(|(w, m)| *w /= m);
        self.twist(index, &direction)
    }

    /// The same of a connection by the inertias at its ends that have some, 1/(kg·m²).
    pub fn compliance_of_heavy(&self, connection: &Connection) -> f64 {
        let ends = [connection.from, connection.to].into_iter().flatten();
        let heavy = ends.filter(|(group, _)| self.inertia[*group] > 0.0);
        heavy.map(|(group, ratio)| ratio * ratio / self.inertia[group]).sum()
    }

    /// Jumps of the rates of a [`Motion`](crate::Motion)'s coordinates by impulses on the groups, N·m·s.
    pub fn rate_jumps(&self, impulses: &[f64]) -> Vec<f64> {
        let speeds: Vec<f64> = impulses.iter().zip(&self.inertia).map(|(p, m)| p / m).collect();
        let tree = self.network.tree.iter();
        let mean = self.rigid.as_ref().map(|rigid| rigid.mean(&speeds));
        tree.map(|edge| self.twist(edge.shaft, &speeds)).chain(mean).collect()
    }

    /// Kinetic energy for group speeds `speeds`, J.
    pub fn kinetic_energy(&self, speeds: &[f64]) -> f64 {
        self.inertia.iter().zip(speeds).map(|(m, v)| 0.5 * m * v * v).sum()
    }

    /// Potential energy for twists of all connections, J.
    pub fn potential_energy(&self, twists: &[f64]) -> f64 {
        self.connections.iter().zip(twists).map(|(c, x)| c.law.energy(*x)).sum()
    }
}

fn node_places(line: &Driveline, topology: &Topology) -> Vec<NodePlace> {
    let place = |node: &halfshaft_model::Node| NodePlace {
        name: node.name.clone(),
        group: node.group,
        ratio: node.ratio,
        inertia: node.inertia.map_or(0.0, |index| line.inertias()[index].inertia_kg_m2),
    };
    topology.nodes.iter().map(place).collect()
}

/// Shafts and then elastic meshes of gears, as in the network.
fn connections(line: &Driveline, network: &Network) -> Vec<Connection> {
    let loss = |own: Option<f64>| own.unwrap_or(line.whole().loss_factor);
    let shafts = line.shafts().iter().map(|shaft| Connection {
        name: shaft.name.clone(),
        from: None,
        to: None,
        law: law_of_shaft(shaft),
        damping: shaft.damping_nm_s_per_rad,
        damps_in_gap: shaft.damps_in_gap,
        friction: (shaft.friction_nm > 0.0).then_some(Friction {
            torque_nm: shaft.friction_nm,
            speed_rad_s: shaft.friction_speed_rad_s,
        }),
        engagement: shaft.engagement,
        loss_factor: loss(shaft.loss_factor),
        inertance: shaft.inertance_kg_m2,
    });
    let meshes = line.meshes().map(|gear| Connection {
        name: gear.name.clone(),
        from: None,
        to: None,
        law: law_of_mesh(gear),
        damping: gear.mesh_at_output().map_or(0.0, |[_, damping, _]| damping),
        damps_in_gap: gear.damps_in_gap,
        friction: None,
        engagement: None,
        loss_factor: loss(None),
        inertance: 0.0,
    });
    let placed = |(connection, [from, to]): (Connection, &[End; 2])| Connection {
        from: *from,
        to: *to,
        ..connection
    };
    shafts.chain(meshes).zip(&network.ends).map(placed).collect()
}

/// Gives the balancing torque, if there is one, the mean that stops the rigid-body motion
/// from accelerating.
fn balance(line: &Driveline, excitation: &mut Excitation, rigid: Option<&RigidBody>) {
    let Some(rigid) = rigid else { return };
    let balancing = line.torques().iter().position(|torque| torque.mean == MeanTorque::Balance);
    let Some(balancing) = balancing else { return };
    let lever = |source: &crate::Source| rigid.speeds[source.group] * source.ratio;
    let others: f64 = excitation
        .sources
        .iter()
        .enumerate()
        .filter(|(index, _)| *index != balancing)
        .map(|(_, source)| lever(source) * source.mean)
        .sum();
    let own = &excitation.sources[balancing];
    let mean = -others / lever(own);
    excitation.sources[balancing].mean = mean;
}
