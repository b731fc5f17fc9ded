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
    /// The smallest shock from each response to each other one; none where there is one response only.
    #[serde(default)]
    pub shocks: Vec<SmallestShock>,
    /// How these were looked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shock_search: Option<ShockSearch>,
}

/// The smallest impulse of torque on a node that throws the line from one response to another.
///
/// Where none was found up to [`ShockSearch::largest_impulse`], impulse, phase and time are missing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SmallestShock {
    /// The response that is left, by its place among the attractors.
    pub from: usize,
    /// The response that is reached; `None` for a motion that grows beyond all measure.
    pub to: Option<usize>,
    /// The impulse with its sign, N·m·s.
    pub impulse: Option<f64>,
    /// Angle of the excitation's common period at which it acts, from 0 to 2π rad.
    pub phase: Option<f64>,
    /// The same in time, s: from the first of the states that stand at `from`, so that it may be
    /// more than one period of the excitation for a response of several.
    pub time: Option<f64>,
    /// The node that it acts on.
    pub node: String,
}

/// How the smallest shocks were looked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShockSearch {
    /// The node that they act on.
    pub node: String,
    /// The largest impulse tried, N·m·s: as much energy as a change of the varied shaft's rate of
    /// twist by the whole height of the window.
    pub largest_impulse: f64,
    /// Moments of a period of the excitation that were tried before the best ones were made finer.
    pub phases: usize,
    /// Motions that were followed.
    pub motions: usize,
    /// Those among them that had reached no response when they were given up.
    #[serde(default)]
    pub undecided: usize,
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
