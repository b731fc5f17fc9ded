//! What is told of the vibration of a line.

use halfshaft_model::End;
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
    source: Source,
    /// Whether each order is told as well.
    pub(super) orders: bool,
}

/// What a channel is taken from.
#[derive(Clone, Copy, Debug)]
enum Source {
    Spring(Spring),
    Node { group: usize, ratio: f64 },
}

/// A connection in small vibration about the equilibrium.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spring {
    from: End,
    to: End,
    stiffness: f64,
    /// Loss factor times stiffness.
    lost: f64,
    damping: f64,
}

impl Spring {
    /// The connection of that number.
    pub(super) fn of(vibration: &Vibration, index: usize) -> Self {
        let connection = &vibration.equations.connections[index];
        let x = vibration.state.twists[index];
        let stiffness = connection.law.stiffness(x);
        Self {
            from: connection.from,
            to: connection.to,
            stiffness,
            lost: connection.loss_factor * stiffness,
            damping: connection.damping_at(x),
        }
    }

    /// Complex amplitude of its twist for the motion of the groups.
    fn twist(&self, motion: &[Complex]) -> Complex {
        let end =
            |end: End| end.map_or(Complex::default(), |(group, ratio)| motion[group].scaled(ratio));
        end(self.from) - end(self.to)
    }

    /// Mean power that its damping turns into heat at `omega` (rad/s), W.
    pub(super) fn heat(&self, omega: f64, motion: &[Complex]) -> f64 {
        let twist = self.twist(motion);
        let square = twist.re * twist.re + twist.im * twist.im;
        0.5 * (omega * omega * self.damping + omega * self.lost) * square
    }
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
        let source = Source::Spring(Spring::of(vibration, index));
        let name = format!("{}.torque", connection.name);
        channels.push(Channel { name, quantity: Quantity::Torque, source, orders });
        if orders {
            let name = format!("{}.twist", connection.name);
            channels.push(Channel { name, quantity: Quantity::Twist, source, orders: false });
        }
    }
    let heavy = equations.nodes.iter().filter(|node| node.inertia > 0.0).count();
    for node in &equations.nodes {
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
                    source: Source::Node { group: node.group, ratio: node.ratio },
                    orders,
                });
            }
        }
    }
    channels
}

/// Complex amplitude of a channel for the motion of the groups at `omega` (rad/s).
pub(super) fn amplitude(channel: &Channel, omega: f64, motion: &[Complex]) -> Complex {
    match (channel.source, channel.quantity) {
        (Source::Spring(spring), Quantity::Torque) => {
            let complex = Complex::new(spring.stiffness, spring.lost + omega * spring.damping);
            complex * spring.twist(motion)
        }
        (Source::Spring(spring), _) => spring.twist(motion),
        (Source::Node { group, ratio }, Quantity::Speed) => {
            Complex::new(0.0, omega * ratio) * motion[group]
        }
        (Source::Node { group, ratio }, _) => motion[group].scaled(-omega * omega * ratio),
    }
}
