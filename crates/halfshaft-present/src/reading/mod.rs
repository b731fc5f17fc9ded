//! How a resonance is read: by which method it was found, over which column it runs, and by which
//! channel it is measured.
//!
//! Text, figures and findings all read it in this one way, so that they speak of the same shaft.

use halfshaft_results::{Branch, Header, ResonanceResult};

use crate::words::{RPM, column_label, column_words, plain, quantity};

mod course;

pub(crate) use course::{Stop, holds};

/// How periodic responses were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Method {
    HarmonicBalance,
    FirstHarmonic,
    Averaged,
}

impl Method {
    /// The method that the settings of a result name.
    pub(crate) fn of(header: &Header) -> Option<Self> {
        match header.settings.get("method")?.as_str()? {
            "harmonic-balance" => Some(Self::HarmonicBalance),
            "first-harmonic" => Some(Self::FirstHarmonic),
            "averaged" => Some(Self::Averaged),
            _ => None,
        }
    }

    /// What it is called in a sentence.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::HarmonicBalance => "harmonic balance",
            Self::FirstHarmonic => "first harmonic",
            Self::Averaged => "closed form",
        }
    }

    /// The same with its article.
    pub(crate) fn with_article(self) -> String {
        match self {
            Self::HarmonicBalance => self.words().to_owned(),
            Self::FirstHarmonic | Self::Averaged => format!("the {}", self.words()),
        }
    }
}

/// What a response curve runs over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Abscissa {
    /// Column of the branches.
    pub(crate) column: String,
    /// Symbol of its unit.
    pub(crate) unit: String,
}

impl Abscissa {
    /// Whether it is the excitation speed.
    pub(crate) fn is_speed(&self) -> bool {
        self.column == "frequency"
    }

    /// What it is called: "excitation speed", "engine torque amplitude".
    pub(crate) fn name(&self) -> String {
        if self.is_speed() { "excitation speed".to_owned() } else { column_label(&self.column) }
    }

    /// A value for a sentence: `247.71 rpm (25.9398 rad/s)`, `512.3 N·m`.
    pub(crate) fn told(&self, value: f64) -> String {
        if self.is_speed() {
            let rpm = quantity(value * RPM, 5, "rpm");
            format!("{rpm} ({})", quantity(value, 6, "rad/s"))
        } else {
            quantity(value, 6, &plain(&self.unit))
        }
    }

    /// Two values for a sentence: `between 200 and 220 rpm (20.944 and 23.038 rad/s)`.
    pub(crate) fn between(&self, from: f64, to: f64) -> String {
        let pair = |scale: f64, digits: usize, unit: &str| {
            let from = crate::words::number(from * scale, digits);
            format!("{from} and {}", quantity(to * scale, digits, unit))
        };
        if self.is_speed() {
            format!("between {} ({})", pair(RPM, 5, "rpm"), pair(1.0, 5, "rad/s"))
        } else {
            format!("between {}", pair(1.0, 5, &plain(&self.unit)))
        }
    }
}

/// One response of a branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// Branch, by index.
    pub(crate) branch: usize,
    /// Value that the curve runs over.
    pub(crate) x: f64,
    /// Half of peak to peak of the channel, or its first harmonic where that is all there is.
    pub(crate) swing: f64,
    /// Whether it is stable; so it is taken to be where nothing is known.
    pub(crate) stable: bool,
    /// Largest modulus of its Floquet multipliers.
    pub(crate) multiplier: Option<f64>,
}

/// A resonance with what it runs over and is measured by.
#[derive(Clone, Debug)]
pub(crate) struct Reading<'r> {
    pub(crate) result: &'r ResonanceResult,
    pub(crate) method: Method,
    pub(crate) x: Abscissa,
    /// The twist that is told and drawn, e.g. `half-shaft.twist`.
    pub(crate) channel: Option<String>,
}

/// Part of the swing below which the first harmonic does not stand for it.
const LEADING: f64 = 0.6;

impl<'r> Reading<'r> {
    pub(crate) fn of(result: &'r ResonanceResult) -> Self {
        let usual =
            if result.scaling.is_empty() { Method::HarmonicBalance } else { Method::Averaged };
        Self {
            result,
            method: Method::of(&result.header).unwrap_or(usual),
            x: abscissa(result),
            channel: result.leading_channel(),
        }
    }

    /// The column of the first harmonic of the channel, or of what else the branches have of it. Where
    /// higher orders move the channel more than the first does, its swing tells more.
    pub(crate) fn column(&self) -> String {
        let Some(channel) = &self.channel else { return "rho".to_owned() };
        let named = |measure: &str| format!("{channel}.{measure}");
        let largest = |measure: &str| {
            let of = |branch: &'r Branch| branch.values(&named(measure)).iter().copied();
            bounds(self.result.branches.iter().flat_map(of)).map(|(_, high)| high)
        };
        match (largest("harmonic1"), largest("amplitude")) {
            (Some(first), Some(swing)) if first < LEADING * swing => named("amplitude"),
            (None, Some(_)) => named("amplitude"),
            _ => named("harmonic1"),
        }
    }

    /// The column of the swing of the channel: half of peak to peak, or else its first harmonic.
    pub(crate) fn swing_column(&self) -> String {
        match &self.channel {
            Some(channel) if self.result.has_column(&format!("{channel}.amplitude")) => {
                format!("{channel}.amplitude")
            }
            _ => self.column(),
        }
    }

    /// The shaft whose twist is told, as a reader may see it.
    pub(crate) fn shaft(&self) -> Option<String> {
        let channel = self.channel.as_ref()?;
        Some(plain(column_words(channel)?.owner))
    }

    /// All responses, branch by branch, that have finite values.
    pub(crate) fn samples(&self) -> Vec<Sample> {
        let column = self.swing_column();
        let branches = self.result.branches.iter().enumerate();
        branches.flat_map(|(index, branch)| self.samples_of(index, branch, &column)).collect()
    }

    fn samples_of(&self, index: usize, branch: &Branch, column: &str) -> Vec<Sample> {
        let (xs, swings) = (branch.values(&self.x.column), branch.values(column));
        let (stable, multipliers) = (branch.values("stable"), branch.values("largest_multiplier"));
        let sample = |(row, (x, swing)): (usize, (&f64, &f64))| Sample {
            branch: index,
            x: *x,
            swing: *swing,
            stable: stable.get(row).is_none_or(|value| *value != 0.0),
            multiplier: multipliers.get(row).copied().filter(|value| value.is_finite()),
        };
        let rows = xs.iter().zip(swings).enumerate().map(sample);
        rows.filter(|sample| sample.x.is_finite() && sample.swing.is_finite()).collect()
    }

    /// Least and largest value that the curves run over.
    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        let values = self.result.branches.iter().flat_map(|b| b.values(&self.x.column)).copied();
        bounds(values)
    }
}

/// Least and largest of some values, those that are no numbers left out.
pub(crate) fn bounds(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let finite = values.into_iter().filter(|value| value.is_finite());
    finite.fold(None, |known, value| match known {
        None => Some((value, value)),
        Some((low, high)) => Some((f64::min(low, value), f64::max(high, value))),
    })
}

/// The parameter that was gone through, or the excitation speed.
fn abscissa(result: &ResonanceResult) -> Abscissa {
    let speed = || Abscissa { column: "frequency".to_owned(), unit: "rad/s".to_owned() };
    let address = result.header.settings.pointer("/parameter/address");
    let Some(address) = address.and_then(serde_json::Value::as_str) else { return speed() };
    let columns = result.branches.iter().flat_map(|branch| &branch.columns);
    let column = columns.into_iter().find(|column| column.name == address);
    column.map_or_else(speed, |column| Abscissa {
        column: address.to_owned(),
        unit: column.unit.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::Abscissa;

    /// Oracle: by hand: 10 rad/s are 95.493 rpm.
    #[test]
    fn values_are_told_in_the_units_of_the_axis() {
        let speed = Abscissa { column: "frequency".to_owned(), unit: "rad/s".to_owned() };
        assert_eq!(speed.told(10.0), "95.493\u{a0}rpm (10\u{a0}rad/s)");
        assert_eq!(
            speed.between(10.0, 20.0),
            "between 95.493 and 190.99\u{a0}rpm (10 and 20\u{a0}rad/s)"
        );
        let torque =
            Abscissa { column: "engine torque.amplitude".to_owned(), unit: "N·m".to_owned() };
        assert_eq!(torque.told(512.5), "512.5\u{a0}N·m");
        assert_eq!(torque.name(), "engine torque amplitude");
    }
}
