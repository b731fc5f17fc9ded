//! The settings of `campbell` and `forced` and their options.

use serde::Serialize;

use super::text::OptionError;
use super::values::Reader;
use crate::diagnostic::did_you_mean;
use crate::driveline::Topology;
use crate::range::parse_range;
use crate::units::QuantityKind;

/// Settings of `campbell`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CampbellQuestion {
    /// Range of the excitation speed Ω, rad/s; `None` for one that reaches beyond the operating range
    /// or the lowest critical speeds.
    pub frequency: Option<(f64, f64)>,
    /// Orders; `None` for those of the model's torques.
    pub orders: Option<Vec<f64>>,
    /// Operating range of Ω, rad/s; `None` for that of the model, if it has one.
    pub operating: Option<(f64, f64)>,
    /// How many of the lowest elastic modes, at most.
    pub count: usize,
    /// Whether only the gear that the model is in is wanted, not every one that a gearbox lists.
    pub this_gear: bool,
}

impl Default for CampbellQuestion {
    fn default() -> Self {
        Self { frequency: None, orders: None, operating: None, count: 12, this_gear: false }
    }
}

/// Settings of `forced`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ForcedQuestion {
    /// Range of the excitation speed Ω, rad/s; `None` for one that takes in the lowest resonances.
    pub frequency: Option<(f64, f64)>,
    /// Number of speeds, equally spaced; `None` for as many as the resonances ask.
    pub points: Option<usize>,
    /// Orders that act; `None` for all of the model's torques.
    pub orders: Option<Vec<f64>>,
    /// Shafts that are told order by order; `None` for all of a short line.
    pub shafts: Option<Vec<String>>,
    /// Nodes that are told; `None` for all of a short line.
    pub nodes: Option<Vec<String>>,
    /// Whether only the gear that the model is in is wanted, not every one that a gearbox lists.
    pub this_gear: bool,
}

/// Most speeds.
const MOST_POINTS: usize = 1_000_000;
/// Most orders.
const MOST_ORDERS: usize = 200;

impl Reader<'_> {
    pub(super) fn campbell(&mut self) -> CampbellQuestion {
        let text = self.text;
        let default = CampbellQuestion::default();
        CampbellQuestion {
            frequency: self.speeds_from_zero("frequency", text.frequency.as_deref()),
            orders: self.listed_orders(),
            operating: self.speeds_from_zero("operating", text.operating.as_deref()),
            count: self.count("count", text.count.as_deref(), 1, 1000).unwrap_or(default.count),
            this_gear: text.this_gear,
        }
    }

    pub(super) fn forced(&mut self) -> ForcedQuestion {
        let text = self.text;
        let line = self.line.expanded();
        let shafts: Vec<&str> = line.connection_names().collect();
        let topology = Topology::of(&line).ok();
        let nodes = topology.iter().flat_map(|topology| &topology.nodes);
        let nodes: Vec<&str> = nodes.map(|node| node.name.as_str()).collect();
        ForcedQuestion {
            frequency: self.speeds_from_zero("frequency", text.frequency.as_deref()),
            points: self.count("points", text.points.as_deref(), 1, MOST_POINTS),
            orders: self.listed_orders(),
            shafts: self.names("shaft", text.shaft.as_deref(), &shafts),
            nodes: self.names("node", text.node.as_deref(), &nodes),
            this_gear: text.this_gear,
        }
    }

    /// A range of speeds that are not negative.
    fn speeds_from_zero(
        &mut self,
        option: &'static str,
        written: Option<&str>,
    ) -> Option<(f64, f64)> {
        let written = written?;
        let problem = match parse_range(written, QuantityKind::Speed) {
            Ok((from, to)) if from >= 0.0 => return Some((from, to)),
            Ok(_) => OptionError::new(option, written, "excitation speeds begin at zero", ""),
            Err(error) => {
                let hint = error.hint().unwrap_or_default();
                OptionError::new(option, written, error.to_string(), hint)
            }
        };
        self.errors.push(problem);
        None
    }

    /// `--orders 0.5,1,2`.
    fn listed_orders(&mut self) -> Option<Vec<f64>> {
        let written = self.text.orders.as_deref()?;
        let mut orders = Vec::new();
        for part in written.split(',').map(str::trim) {
            match part.parse::<f64>() {
                Ok(order) if order.is_finite() && order > 0.0 => orders.push(order),
                _ => {
                    let message = format!("\"{part}\" is no order");
                    let hint = "write numbers above zero, e.g. --orders 0.5,1,2";
                    self.errors.push(OptionError::new("orders", written, message, hint));
                    return None;
                }
            }
        }
        orders.sort_by(f64::total_cmp);
        orders.dedup();
        if orders.len() > MOST_ORDERS {
            let message = format!("{} orders are too many", orders.len());
            let hint = format!("at most {MOST_ORDERS}");
            self.errors.push(OptionError::new("orders", written, message, hint));
        }
        Some(orders)
    }

    /// Names of the line, separated by commas; one name may hold commas itself.
    fn names(
        &mut self,
        option: &'static str,
        written: Option<&str>,
        known: &[&str],
    ) -> Option<Vec<String>> {
        let written = written?;
        if known.contains(&written) {
            return Some(vec![written.to_owned()]);
        }
        // The name of a bar stands for all of its pieces.
        let pieces = |name: &'_ str| -> Vec<String> {
            let beginning = format!("{name}.");
            let numbered = |known: &&&str| {
                let piece = known.strip_prefix(beginning.as_str()).unwrap_or("");
                !piece.is_empty() && piece.chars().all(|c| c.is_ascii_digit())
            };
            known.iter().filter(numbered).map(|piece| (*piece).to_owned()).collect()
        };
        let bars = self.line.shafts.iter().filter(|shaft| shaft.dimensions.is_some());
        let bars: Vec<&str> = bars.map(|shaft| shaft.name.as_str()).collect();
        let whole: Vec<&str> = if bars.contains(&written) {
            vec![written]
        } else {
            written.split(',').map(str::trim).collect()
        };
        let (bars, asked): (Vec<&str>, Vec<&str>) =
            whole.into_iter().partition(|name| bars.contains(name) && !known.contains(name));
        for name in asked.iter().filter(|name| !known.contains(name)) {
            let hint = did_you_mean(name, known.iter().copied())
                .unwrap_or_else(|| format!("choose from {}", known.join(", ")));
            let message = format!("no {option} is named \"{name}\"");
            self.errors.push(OptionError::new(option, written, message, hint));
        }
        let single = asked.into_iter().map(str::to_owned);
        Some(single.chain(bars.into_iter().flat_map(pieces)).collect())
    }
}
