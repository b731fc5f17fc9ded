//! Channels of a time history and initial values given by channel.

use serde::Serialize;

use super::text::OptionError;
use crate::diagnostic::did_you_mean;
use crate::driveline::{Driveline, Topology};
use crate::range::parse_flag_quantity;
use crate::units::QuantityKind;

/// What of a shaft or node a channel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ChannelQuantity {
    /// Twist of a shaft, rad.
    Twist,
    /// Rate of twist of a shaft, rad/s.
    TwistRate,
    /// Torque of a shaft, N·m.
    Torque,
    /// Angle of a node, rad.
    Angle,
    /// Speed of a node, rad/s.
    Speed,
}

impl ChannelQuantity {
    /// All quantities.
    pub const ALL: [Self; 5] =
        [Self::Twist, Self::TwistRate, Self::Torque, Self::Angle, Self::Speed];

    /// The word after the dot of a channel name.
    pub fn word(self) -> &'static str {
        match self {
            Self::Twist => "twist",
            Self::TwistRate => "twist_rate",
            Self::Torque => "torque",
            Self::Angle => "angle",
            Self::Speed => "speed",
        }
    }

    /// What its numbers mean.
    pub fn kind(self) -> QuantityKind {
        match self {
            Self::Twist | Self::Angle => QuantityKind::Angle,
            Self::TwistRate | Self::Speed => QuantityKind::Speed,
            Self::Torque => QuantityKind::Torque,
        }
    }
}

/// A channel: `<shaft>.twist`, `<shaft>.twist_rate`, `<shaft>.torque`, `<node>.angle`,
/// `<node>.speed`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Channel {
    /// Name of the shaft or node.
    pub owner: String,
    /// What of it.
    pub quantity: ChannelQuantity,
}

impl Channel {
    /// The channel's name.
    pub fn name(&self) -> String {
        format!("{}.{}", self.owner, self.quantity.word())
    }
}

/// A channel's value at time 0, in SI.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InitialValue {
    /// Which channel; never a torque.
    pub channel: Channel,
    /// Its value, rad or rad/s.
    pub value: f64,
}

/// Reads `CHANNEL=VALUE`, e.g. `half-shaft.twist=1 rad`.
///
/// # Errors
/// What is wrong, with a hint.
pub fn parse_initial(text: &str, line: &Driveline) -> Result<InitialValue, OptionError> {
    let fail = |message: String, hint: String| OptionError::new("initial", text, message, hint);
    let example = "e.g. --initial \"half-shaft.twist=1 rad\"";
    // Names may hold "=", values never do.
    let Some((channel, value)) = text.rsplit_once('=') else {
        return Err(fail("an initial value is CHANNEL=VALUE".to_owned(), example.to_owned()));
    };
    let channel =
        parse_channel(channel.trim(), line).map_err(|(message, hint)| fail(message, hint))?;
    if channel.quantity == ChannelQuantity::Torque {
        let hint = "give a twist or a twist_rate".to_owned();
        return Err(fail("a torque follows from the state".to_owned(), hint));
    }
    let value = parse_flag_quantity(value.trim(), channel.quantity.kind())
        .map_err(|error| fail(error.to_string(), error.hint().unwrap_or_default()))?;
    Ok(InitialValue { channel, value })
}

/// The channel of that name, or what is wrong with it and a hint.
pub(super) fn parse_channel(name: &str, line: &Driveline) -> Result<Channel, (String, String)> {
    let (owner, word) = name.rsplit_once('.').ok_or_else(|| {
        let message = format!("\"{name}\" is no channel");
        (message, "channels are <shaft>.twist, <shaft>.twist_rate, <node>.speed ...".to_owned())
    })?;
    let quantity =
        ChannelQuantity::ALL.into_iter().find(|q| q.word() == word).ok_or_else(|| {
            let words = ChannelQuantity::ALL.map(ChannelQuantity::word);
            let hint = did_you_mean(word, words)
                .unwrap_or_else(|| format!("channels end in {}", words.join(", ")));
            (format!("\"{word}\" is no channel of \"{owner}\""), hint)
        })?;
    let of_node = matches!(quantity, ChannelQuantity::Angle | ChannelQuantity::Speed);
    let line = &*line.expanded();
    let topology = Topology::of(line).map_err(|error| (error.to_string(), String::new()))?;
    let known: Vec<&str> = if of_node {
        topology.nodes.iter().map(|node| node.name.as_str()).collect()
    } else {
        line.connection_names().collect()
    };
    if known.contains(&owner) {
        return Ok(Channel { owner: owner.to_owned(), quantity });
    }
    let what = if of_node { "node" } else { "shaft" };
    let hint = did_you_mean(owner, known.iter().copied())
        .unwrap_or_else(|| format!("the {what}s of this line are {}", known.join(", ")));
    Err((format!("no {what} is named \"{owner}\""), hint))
}
