//! Natural frequencies over the orders of the excitation: the Campbell diagram and critical speeds.
//!
//! A torsional line without gyroscopic effects has natural frequencies that do not depend on the speed,
//! so mode `r` is critical for order `n` at `Ω = ω_r / n`. How much that matters is told by the torque
//! that this order and mode alone make at resonance, `|φᵀ T_n| / (2 ζ ω²)` times the twist of the shaft
//! and its dynamic stiffness.

mod critical;

use halfshaft_model::Driveline;
use halfshaft_model::question::{CampbellQuestion, Question};
use halfshaft_results::{CampbellGear, CampbellResult};

use crate::error::AnalysisError;
use crate::header::header;
use crate::modal::vibration::{InGear, Vibration, at_rest_in_gears};
use crate::modal::{ElasticMode, damping_ratio, words};

/// Orders that are told where nothing excites the line.
const SOME_ORDERS: [f64; 6] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
/// Elastic modes whose critical speeds a diagram takes in by itself.
const SHOWN_MODES: usize = 3;
/// How far a diagram reaches beyond what it must show.
const BEYOND: f64 = 1.25;

/// Answers `campbell`.
pub(crate) fn solve(
    line: &Driveline,
    question: &CampbellQuestion,
) -> Result<CampbellResult, AnalysisError> {
    let mut header = header(line, &Question::Campbell(question.clone()));
    let here = Vibration::of(line, None)?;
    here.told(&mut header);
    let orders = orders(&here, question, &mut header.assumptions);
    let operating = question.operating.or(line.whole().operating_rad_s);
    let mut solved = Vec::new();
    for in_gear in at_rest_in_gears(line, question.this_gear, &mut header)? {
        let modes = in_gear.vibration.modes(question.count)?;
        let pairs = in_gear.vibration.damped(&modes)?.elastic;
        solved.push((in_gear, modes, pairs));
    }
    let lowest = solved.iter().flat_map(|(_, modes, _)| modes.iter().take(SHOWN_MODES));
    let highest = lowest.map(ElasticMode::frequency).fold(0.0, f64::max);
    let frequency = question.frequency.unwrap_or_else(|| range(operating, &orders, highest));
    let gears = solved
        .iter()
        .map(|(InGear { gear, vibration, .. }, modes, pairs)| CampbellGear {
            gear: gear.clone(),
            frequency: modes.iter().map(ElasticMode::frequency).collect(),
            damping_ratio: pairs.iter().map(|pair| damping_ratio(*pair)).collect(),
            label: words(&vibration.equations, &vibration.state, modes),
            critical: critical::speeds(vibration, modes, pairs, &orders, frequency, operating),
        })
        .collect();
    Ok(CampbellResult { header, frequency, orders, operating, gears })
}

/// Orders that are asked for, those of the torques, or some.
fn orders(
    vibration: &Vibration,
    question: &CampbellQuestion,
    assumptions: &mut Vec<String>,
) -> Vec<f64> {
    if let Some(orders) = &question.orders {
        return orders.clone();
    }
    let orders = vibration.equations.excitation.orders();
    if !orders.is_empty() {
        return orders;
    }
    assumptions.push(
        "no torque of the model has an order: the diagram shows orders 0.5 to 4, --orders chooses others"
            .to_owned(),
    );
    SOME_ORDERS.to_vec()
}

/// The range of speeds that a line is told over where nobody says it, rad/s.
pub(crate) fn default_range(
    line: &Driveline,
    vibration: &Vibration,
    orders: &[f64],
) -> Result<(f64, f64), AnalysisError> {
    if let Some((from, to)) = line.whole().operating_rad_s {
        return Ok((from / BEYOND, to * BEYOND));
    }
    let modes = vibration.modes(SHOWN_MODES)?;
    let highest = modes.last().map_or(0.0, ElasticMode::frequency);
    Ok(range(None, orders, highest))
}

/// The speeds that a diagram shows by itself: the operating range, or where the lowest order has met the
/// lowest modes.
fn range(operating: Option<(f64, f64)>, orders: &[f64], highest: f64) -> (f64, f64) {
    let lowest = orders.first().copied().unwrap_or(1.0);
    let reach = operating.map_or(highest / lowest.max(0.5), |(_, to)| to);
    (0.0, if reach > 0.0 { BEYOND * reach } else { 1.0 })
}
