//! What the columns of tables are called in words.
//!
//! A channel is `<shaft or node>.<quantity>`, on a response curve followed by a measure, such as
//! `half-shaft.twist.harmonic1`. Other columns have names of their own, and a fold curve has one
//! under the address of its parameter, such as `half-shaft.damping`.

use super::name::plain;

/// Revolutions per minute of one radian per second.
pub(crate) const RPM: f64 = 30.0 / std::f64::consts::PI;

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Twist,
    TwistRate,
    Torque,
    Angle,
    Speed,
}

impl Quantity {
    const ALL: [(&'static str, &'static str, Self); 5] = [
        ("twist", "twist", Self::Twist),
        ("twist_rate", "twist rate", Self::TwistRate),
        ("torque", "torque", Self::Torque),
        ("angle", "angle", Self::Angle),
        ("speed", "speed", Self::Speed),
    ];

    /// The word in the names of channels.
    pub(crate) fn key(self) -> &'static str {
        Self::ALL.iter().find(|(_, _, quantity)| *quantity == self).map_or("", |row| row.0)
    }

    /// The same for a reader.
    pub(crate) fn words(self) -> &'static str {
        Self::ALL.iter().find(|(_, _, quantity)| *quantity == self).map_or("", |row| row.1)
    }

    fn of(key: &str) -> Option<Self> {
        Self::ALL.iter().find(|row| row.0 == key).map(|row| row.2)
    }
}

/// What of a periodic motion is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    /// The value itself, over time.
    Value,
    /// Half of peak to peak.
    Amplitude,
    /// The mean.
    Mean,
    /// The modulus of the first harmonic.
    Harmonic,
}

impl Measure {
    fn words(self) -> &'static str {
        match self {
            Self::Value => "",
            Self::Amplitude => ", half of peak to peak",
            Self::Mean => ", mean",
            Self::Harmonic => ", first harmonic",
        }
    }
}

/// A channel taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ColumnWords<'n> {
    /// The shaft or node.
    pub(crate) owner: &'n str,
    pub(crate) quantity: Quantity,
    pub(crate) measure: Measure,
}

/// Takes the name of a channel apart; `None` for other columns.
pub(crate) fn column_words(name: &str) -> Option<ColumnWords<'_>> {
    let (rest, last) = name.rsplit_once('.')?;
    let measure = match last {
        "amplitude" => Measure::Amplitude,
        "mean" => Measure::Mean,
        "harmonic1" => Measure::Harmonic,
        _ => {
            let quantity = Quantity::of(last)?;
            return Some(ColumnWords { owner: rest, quantity, measure: Measure::Value });
        }
    };
    let (owner, key) = rest.rsplit_once('.')?;
    // Also the address of a torque's amplitude ends so; then no quantity stands before it.
    Some(ColumnWords { owner, quantity: Quantity::of(key)?, measure })
}

/// What a column is called in words, without its unit: "half-shaft twist", "detuning σ".
pub(crate) fn column_label(name: &str) -> String {
    let own = match name {
        "time" => "time",
        "frequency" => "excitation speed Ω",
        "sigma" => "detuning σ",
        "rho" => "amplitude ρ",
        "phase" => "phase lag η",
        "stable" => "stable",
        "unstable_dimension" => "unstable directions",
        "largest_multiplier" => "largest Floquet multiplier",
        "harmonics" => "highest harmonic kept",
        "truncation" => "part of the waveform left out",
        "multiplier_angle" => "angle of the multiplier",
        "damped_frequency" => "damped frequency",
        "damping_ratio" => "damping ratio",
        "twist" => "twist",
        "torque" => "torque",
        "stiffness" => "tangent stiffness",
        "mode.alpha" => "cubic coefficient α",
        "mode.beta" => "damping coefficient β",
        "mode.f" => "excitation amplitude f",
        "mode.omega_1" => "natural frequency ω₁",
        _ => return channel_label(name),
    };
    own.to_owned()
}

fn channel_label(name: &str) -> String {
    if let Some(ColumnWords { owner, quantity, measure }) = column_words(name) {
        return format!("{} {}{}", plain(owner), quantity.words(), measure.words());
    }
    match name.rsplit_once('.') {
        Some((owner, "cubic" | "quadratic" | "quintic" | "septic")) => {
            let key = name.get(owner.len() + 1..).unwrap_or_default();
            format!("{} {key} stiffness", plain(owner))
        }
        Some((owner, key)) => format!("{} {}", plain(owner), plain(&key.replace('_', " "))),
        None => plain(name),
    }
}

#[cfg(test)]
mod tests {
    use super::{Measure, Quantity, column_label, column_words};

    /// Oracle: the contract's names of channels.
    #[test]
    fn columns_read_as_words() {
        let cases = [
            ("half-shaft.twist", "half-shaft twist"),
            ("half-shaft.twist_rate.harmonic1", "half-shaft twist rate, first harmonic"),
            ("a.b.torque.mean", "a.b torque, mean"),
            ("engine torque.amplitude", "engine torque amplitude"),
            ("half-shaft.cubic", "half-shaft cubic stiffness"),
            ("sigma", "detuning σ"),
            ("full", "full"),
        ];
        for (name, words) in cases {
            assert_eq!(column_label(name), words);
        }
        let channel = column_words("s.torque.harmonic1").expect("a channel");
        assert_eq!((channel.quantity, channel.measure), (Quantity::Torque, Measure::Harmonic));
        assert_eq!(column_words("engine torque.amplitude"), None);
    }
}
