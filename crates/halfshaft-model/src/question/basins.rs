//! The options of `basins`.

use super::kinds::BasinsQuestion;
use super::text::OptionError;
use super::values::Reader;
use crate::diagnostic::did_you_mean;
use crate::driveline::Topology;
use crate::units::{QuantityKind, Sign};

/// Most twists, and most rates, of a grid.
const MOST_SIDE: usize = 4000;

impl Reader<'_> {
    pub(super) fn basins(&mut self) -> BasinsQuestion {
        let default = BasinsQuestion::default();
        let text = self.text;
        BasinsQuestion {
            frequency: self.speed_of_basins().unwrap_or(default.frequency),
            shaft: self.shaft(),
            window: self.window(),
            grid: self.grid().unwrap_or(default.grid),
            tolerance: self.tolerance(default.tolerance),
            periods: self
                .count("periods", text.periods.as_deref(), 10, 10_000_000)
                .unwrap_or(default.periods),
            shock: self.shocked_node(),
        }
    }

    fn speed_of_basins(&mut self) -> Option<f64> {
        let text = self.text.frequency.as_deref();
        let Some(written) = text else {
            let message = "at which excitation speed?";
            let hint = "add one, e.g. --frequency 4Hz";
            self.errors.push(OptionError::new("frequency", "", message, hint));
            return None;
        };
        if written.contains("..") {
            let message = "the initial states are many, the excitation speed is one";
            let hint = "give one speed, e.g. --frequency 4Hz";
            self.errors.push(OptionError::new("frequency", written, message, hint));
            return None;
        }
        self.quantity("frequency", text, QuantityKind::Speed, Sign::Positive)
    }

    /// The shaft whose state is varied or recorded, which must be one of the line's.
    pub(super) fn shaft(&mut self) -> Option<String> {
        let written = self.text.shaft.as_deref()?;
        let line = self.line.expanded();
        let names: Vec<&str> = line.connection_names().collect();
        if names.contains(&written) {
            return Some(written.to_owned());
        }
        let hint = did_you_mean(written, names.iter().copied())
            .unwrap_or_else(|| format!("choose from {}", names.join(", ")));
        self.errors.push(OptionError::new("shaft", written, "no such shaft", hint));
        None
    }

    /// The node that shocks act on, which must be one of the line's.
    fn shocked_node(&mut self) -> Option<String> {
        let written = self.text.shock.as_deref()?;
        let nodes =
            Topology::of(&self.line.expanded()).map(|topology| topology.nodes).unwrap_or_default();
        let names: Vec<&str> = nodes.iter().map(|node| node.name.as_str()).collect();
        if names.contains(&written) {
            return Some(written.to_owned());
        }
        let hint = did_you_mean(written, names.iter().copied())
            .unwrap_or_else(|| format!("a shock acts on a node: choose from {}", names.join(", ")));
        self.errors.push(OptionError::new("shock", written, "the line has no such node", hint));
        None
    }

    /// `A..B,C..D`: the twists and the rates of twist.
    fn window(&mut self) -> Option<[(f64, f64); 2]> {
        let written = self.text.window.as_deref()?;
        let parts: Vec<&str> = written.split(',').collect();
        let [twist, rate] = parts[..] else {
            let message = "two ranges are wanted, of twist and of rate of twist";
            let hint = "write e.g. \"-2rad..2rad,-50rad/s..50rad/s\"";
            self.errors.push(OptionError::new("window", written, message, hint));
            return None;
        };
        let twist = self.range("window", Some(twist.trim()), QuantityKind::Angle);
        let rate = self.range("window", Some(rate.trim()), QuantityKind::Speed);
        Some([twist?, rate?])
    }

    /// `N` or `NxM`.
    fn grid(&mut self) -> Option<(usize, usize)> {
        let written = self.text.grid.as_deref()?;
        let mut sides = written.split(['x', '×']).map(|side| side.trim().parse::<usize>().ok());
        let (first, second, more) = (sides.next().flatten(), sides.next(), sides.next());
        let grid = first.zip(second.unwrap_or(first));
        let fits = |side: usize| (2..=MOST_SIDE).contains(&side);
        match grid.filter(|(twists, rates)| more.is_none() && fits(*twists) && fits(*rates)) {
            Some(grid) => Some(grid),
            None => {
                let message = format!("one or two whole numbers from 2 to {MOST_SIDE} are wanted");
                let hint = "write e.g. 200, or 300x200 for 300 twists and 200 rates";
                self.errors.push(OptionError::new("grid", written, message, hint));
                None
            }
        }
    }
}
