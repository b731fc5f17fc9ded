//! What is told of the vibration of a line.

use halfshaft_model::question::ForcedQuestion;
use halfshaft_numerics::Complex;

use crate::modal::vibration::Vibration;

/// Inertias of which a short line tells by itself.
const SHORT: usize = 16;
/// Orders of all shafts together that are told one by one where nobody asks for some.
const MOST_ORDERS: usize = 400;

/// A quantity of a shaft or node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Torque,
    Twist,
    Speed,
    Acceleration,
}

/// A channel of the answer.
#[derive(Clone, Debug)]
pub(super) struct Channel {
    pub(super) name: String,
    pub(super) quantity: Quantity,
    /// Connection or node.
    index: usize,
    /// Whether each order is told as well.
    pub(super) orders: bool,
}

impl Channel {
    pub(super) fn unit(&self) -> &'static str {
        match self.quantity {
            Quantity::Torque => "N·m",
            Quantity::Twist => "rad",
            Quantity::Speed => "rad/s",
            Quantity::Acceleration => "rad/s²",
        }
    }
}

/// The channels that a question asks for.
pub(super) fn channels(
    vibration: &Vibration,
    question: &ForcedQuestion,
    orders: usize,
) -> Vec<Channel> {
    let equations = &vibration.equations;
    let mut channels = Vec::new();
    let short = equations.connections.len() * orders <= MOST_ORDERS;
    for (index, connection) in equations.connections.iter().enumerate() {
        let asked = question.shafts.as_ref().map(|shafts| shafts.contains(&connection.name));
        if asked == Some(false) {
            continue;
        }
        let orders = asked.unwrap_or(short);
        let name = format!("{}.torque", connection.name);
        channels.push(Channel { name, quantity: Quantity::Torque, index, orders });
        if orders {
            let name = format!("{}.twist", connection.name);
            channels.push(Channel { name, quantity: Quantity::Twist, index, orders: false });
        }
    }
    let heavy = equations.nodes.iter().filter(|node| node.inertia > 0.0).count();
    for (index, node) in equations.nodes.iter().enumerate() {
        let told = match &question.nodes {
            Some(nodes) => nodes.contains(&node.name),
            None => heavy <= SHORT && node.inertia > 0.0,
        };
        if told {
            for (word, quantity) in
                [("speed", Quantity::Speed), ("acceleration", Quantity::Acceleration)]
            {
                let orders = question.nodes.is_some();
                channels.push(Channel {
                    name: format!("{}.{word}", node.name),
                    quantity,
                    index,
                    orders,
                });
            }
        }
    }
    channels
}

/// Complex amplitude of a channel for the motion of the groups at `omega` (rad/s).
pub(super) fn amplitude(
    vibration: &Vibration,
    channel: &Channel,
    omega: f64,
    motion: &[Complex],
) -> Complex {
    let equations = &vibration.equations;
    let twist = |index: usize| twist(vibration, index, motion);
    match channel.quantity {
        Quantity::Torque => {
            let connection = &equations.connections[channel.index];
            let x = vibration.state.twists[channel.index];
            let stiffness = connection.law.stiffness(x);
            let loss = connection.loss_factor * stiffness + omega * connection.damping_at(x);
            Complex::new(stiffness, loss) * twist(channel.index)
        }
        Quantity::Twist => twist(channel.index),
        Quantity::Speed => {
            let node = &equations.nodes[channel.index];
            Complex::new(0.0, omega * node.ratio) * motion[node.group]
        }
        Quantity::Acceleration => {
            let node = &equations.nodes[channel.index];
            motion[node.group].scaled(-omega * omega * node.ratio)
        }
    }
}

/// Complex amplitude of the twist of a connection.
pub(super) fn twist(vibration: &Vibration, index: usize, motion: &[Complex]) -> Complex {
    let connection = &vibration.equations.connections[index];
    let end = |end: halfshaft_model::End| {
        end.map_or(Complex::default(), |(group, ratio)| motion[group].scaled(ratio))
    };
    end(connection.from) - end(connection.to)
}
