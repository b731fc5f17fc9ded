//! Answer of `basins`.

use serde::{Deserialize, Serialize};

use crate::{Column, Header, Named, Table};

/// Answer of `basins`: which response each of many initial states leads to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BasinsResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// Excitation speed, rad/s.
    pub frequency: f64,
    /// The shaft whose state at time 0 is varied.
    pub shaft: String,
    /// What the line can settle to, the largest share first.
    pub attractors: Vec<Attractor>,
    /// Where each initial state leads to.
    pub grid: BasinGrid,
    /// Share of the window whose motion grew beyond all measure.
    #[serde(default)]
    pub escaped: f64,
    /// Share of the window whose motion had reached no response when it was given up.
    #[serde(default)]
    pub undecided: f64,
}

impl BasinsResult {
    /// One row an initial state: its twist and rate, and the attractor that it leads to.
    pub fn table(&self) -> Table {
        let grid = &self.grid;
        let states =
            || grid.rate.iter().flat_map(|rate| grid.twist.iter().map(move |x| (*x, *rate)));
        let led = grid.attractor.iter().flatten().map(|index| f64::from(*index));
        Table::new(vec![
            Column::new(format!("{}.twist", self.shaft), "rad", states().map(|(x, _)| x).collect()),
            Column::new(
                format!("{}.twist_rate", self.shaft),
                "rad/s",
                states().map(|(_, rate)| rate).collect(),
            ),
            Column::new("attractor", "1", led.collect()),
        ])
    }
}

/// Something that the line settles to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attractor {
    /// Periods of the excitation after which it repeats.
    pub periods: u32,
    /// Share of the window that leads to it.
    pub share: f64,
    /// Amplitude (half of peak to peak), mean and first harmonic of every channel.
    pub values: Named<f64>,
    /// Twist of the varied shaft at the beginning of each period of the excitation, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist: Vec<f64>,
    /// Its rate then, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub rate: Vec<f64>,
    /// Multipliers over its period, real and imaginary part, largest modulus first.
    #[serde(default)]
    pub multipliers: Vec<[f64; 2]>,
    /// Modulus of the largest of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub largest_multiplier: Option<f64>,
    /// Whether `resonance` at this speed lists it too, and where from.
    pub origin: String,
    /// Whether `resonance` at this speed lists it too.
    pub continued: bool,
}

/// Where each initial state of a grid leads to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BasinGrid {
    /// Twists of the shaft at time 0, rad, ascending.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist: Vec<f64>,
    /// Rates of twist at time 0, rad/s, ascending.
    #[serde(deserialize_with = "crate::number::read")]
    pub rate: Vec<f64>,
    /// `attractor[i][j]`: index into the attractors for `rate[i]`, `twist[j]`; -1 where the motion grew
    /// beyond all measure, -2 where it had reached none of them when it was given up.
    pub attractor: Vec<Vec<i32>>,
}
