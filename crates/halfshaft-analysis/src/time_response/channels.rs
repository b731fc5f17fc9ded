//! The channels of a time history and how they follow from a state.

use std::sync::Arc;

use halfshaft_dynamics::{EquationsOfMotion, Motion};
use halfshaft_model::question::ChannelQuantity;
use halfshaft_numerics::ode::System;

/// What one channel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Owner {
    Connection(usize),
    Node(usize),
}

/// One channel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ChannelInfo {
    /// Name, e.g. `half-shaft.twist`.
    pub(crate) name: String,
    /// Symbol of its unit.
    pub(crate) unit: &'static str,
    owner: Owner,
    quantity: ChannelQuantity,
}

/// All channels of a line: three a shaft, two a node.
#[derive(Clone, Debug)]
pub(crate) struct Channels<'l> {
    motion: Motion<'l>,
    pub(crate) list: Vec<ChannelInfo>,
    scratch: Vec<f64>,
}

/// Values of all channels at one time, with their rates of change.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Sample {
    pub(crate) time: f64,
    pub(crate) values: Vec<f64>,
    pub(crate) slopes: Vec<f64>,
}

impl<'l> Channels<'l> {
    /// The channels of the line that moves in `motion`.
    pub(crate) fn new(motion: Motion<'l>) -> Self {
        let equations = motion.equations();
        let mut list = Vec::new();
        let of_shaft =
            [ChannelQuantity::Twist, ChannelQuantity::TwistRate, ChannelQuantity::Torque];
        for (index, connection) in equations.connections.iter().enumerate() {
            for quantity in of_shaft {
                list.push(info(&connection.name, Owner::Connection(index), quantity));
            }
        }
        for (index, node) in equations.nodes.iter().enumerate() {
            for quantity in [ChannelQuantity::Angle, ChannelQuantity::Speed] {
                list.push(info(&node.name, Owner::Node(index), quantity));
            }
        }
        Self { motion, list, scratch: Vec::new() }
    }

    /// Takes over the modes and pulses of a motion as they are from time `t` on.
    pub(crate) fn follow(&mut self, motion: &Motion<'l>, t: f64) {
        if let Some(modes) = motion.modes() {
            self.motion.set_modes(Arc::clone(modes));
        }
        self.motion.switch_pulses(t);
    }

    /// Length of the states that are sampled.
    pub(crate) fn dimension(&self) -> usize {
        self.motion.dimension()
    }

    /// Position of a quantity of a connection in the list.
    pub(crate) fn of_connection(&self, connection: usize, quantity: ChannelQuantity) -> usize {
        let owner = Owner::Connection(connection);
        let fits = |info: &ChannelInfo| info.owner == owner && info.quantity == quantity;
        self.list.iter().position(fits).unwrap_or(0)
    }

    /// Values and slopes of all channels for a state and its rate of change.
    pub(crate) fn sample(&mut self, time: f64, state: &[f64], rate: &[f64], sample: &mut Sample) {
        sample.time = time;
        sample.values.clear();
        sample.slopes.clear();
        let equations = self.motion.equations();
        // The state's rate of change is a state whose twists are the rates and whose rates
        // are the accelerations.
        let change = self.motion.kinematics(rate).clone();
        // With modes the torque of a connection is known to the motion alone.
        let torques = self.motion.modes().is_some().then(|| {
            self.scratch.resize(state.len(), 0.0);
            self.motion.derivative(time, state, &mut self.scratch);
            self.motion.torques().to_vec()
        });
        let kinematics = self.motion.kinematics(state);
        for channel in &self.list {
            let (value, slope) = match channel.owner {
                Owner::Connection(index) => {
                    let (x, v) = (kinematics.twists[index], kinematics.rates[index]);
                    let (value, slope) = of_connection(
                        equations,
                        index,
                        channel.quantity,
                        x,
                        v,
                        change.rates[index],
                    );
                    match &torques {
                        Some(torques) if channel.quantity == ChannelQuantity::Torque => {
                            (torques[index], slope)
                        }
                        _ => (value, slope),
                    }
                }
                Owner::Node(index) => {
                    let node = &equations.nodes[index];
                    let (values, slopes) = match channel.quantity {
                        ChannelQuantity::Angle => (&kinematics.angles, &change.angles),
                        _ => (&kinematics.speeds, &change.speeds),
                    };
                    (node.ratio * values[node.group], node.ratio * slopes[node.group])
                }
            };
            sample.values.push(value);
            sample.slopes.push(slope);
        }
    }
}

fn info(owner_name: &str, owner: Owner, quantity: ChannelQuantity) -> ChannelInfo {
    ChannelInfo {
        name: format!("{owner_name}.{}", quantity.word()),
        unit: quantity.kind().si_unit(),
        owner,
        quantity,
    }
}

/// Value and slope of a shaft's channel; its torque is spring and damper together.
fn of_connection(
    equations: &EquationsOfMotion,
    index: usize,
    quantity: ChannelQuantity,
    x: f64,
    v: f64,
    acceleration: f64,
) -> (f64, f64) {
    let connection = &equations.connections[index];
    match quantity {
        ChannelQuantity::Twist => (x, v),
        ChannelQuantity::TwistRate => (v, acceleration),
        _ => (
            connection.law.torque(x) + connection.resistance(x, v),
            connection.law.stiffness(x) * v + connection.resistance_slope(x, v) * acceleration,
        ),
    }
}
