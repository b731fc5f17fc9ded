//! From a line to the answer of `forced`.

use halfshaft_model::Driveline;
use halfshaft_model::question::{ForcedQuestion, Question};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{ForcedGear, ForcedResult, Gear, Header, Reason, Termination};

use super::channels::channels;
use super::engines;
use super::speeds::{self, speeds};
use super::sweep::Sweep;
use super::synthesis::multiples;
use crate::campbell::default_range;
use crate::error::AnalysisError;
use crate::header::header;
use crate::modal::vibration::{InGear, Vibration, at_rest_in_gears};

/// Most numbers of one gear: they are half a gigabyte.
const MOST_VALUES: usize = 60_000_000;

/// Answers `forced`.
pub(crate) fn solve(
    line: &Driveline,
    question: &ForcedQuestion,
    observer: &dyn Observer,
) -> Result<ForcedResult, AnalysisError> {
    let mut header = header(line, &Question::Forced(question.clone()));
    let here = Vibration::of(line, None)?;
    here.told(&mut header);
    let orders = orders(&here, question)?;
    if multiples(&orders).is_none() {
        header.assumptions.push(
            "the orders have no common period: at some time all of them meet, so amplitudes add up"
                .to_owned(),
        );
    }
    let mut told = Vec::new();
    for InGear { gear, line, vibration } in at_rest_in_gears(line, question.this_gear, &mut header)?
    {
        let (gear, complete) = in_gear(gear, &line, &vibration, question, &orders, observer)?;
        told.push(gear);
        undamped(&vibration, &mut header);
        if let Some(warning) = speeds::too_wide(&vibration, question, &orders)?
            && !header.warnings.contains(&warning)
        {
            header.warnings.push(warning);
        }
        if !complete {
            stopped(&mut header, told.len());
            break;
        }
    }
    Ok(ForcedResult { header, orders, engines: engines::tables(line), gears: told })
}

/// The vibration in one gear, and whether all speeds are told.
fn in_gear(
    gear: Gear,
    line: &Driveline,
    vibration: &Vibration,
    question: &ForcedQuestion,
    orders: &[f64],
    observer: &dyn Observer,
) -> Result<(ForcedGear, bool), AnalysisError> {
    let range = match question.frequency {
        Some(range) => range,
        None => default_range(line, vibration, orders)?,
    };
    let speeds = speeds(vibration, question, orders, range)?;
    let channels = channels(vibration, question, orders.len());
    let columns: usize =
        channels.iter().map(|c| if c.orders { 1 + 2 * orders.len() } else { 1 }).sum();
    let values = columns.saturating_mul(speeds.len());
    if values > MOST_VALUES {
        let advice = "take fewer --points, or name the shafts and nodes with --shaft and --node";
        return Err(AnalysisError::TooLarge { values, most: MOST_VALUES, advice });
    }
    let mut sweep = Sweep::new(vibration, orders, channels, question.shafts.as_deref());
    let complete = sweep.run(&speeds, observer)?;
    Ok((sweep.into_result(gear), complete))
}

/// Orders that act and are asked for.
fn orders(vibration: &Vibration, question: &ForcedQuestion) -> Result<Vec<f64>, AnalysisError> {
    let acting = vibration.equations.excitation.orders();
    if acting.is_empty() {
        let reason = "no torque of the model has an order".to_owned();
        return Err(AnalysisError::NoExcitation { reason });
    }
    let Some(asked) = &question.orders else { return Ok(acting) };
    let known = acting.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    let orders: Vec<f64> = acting.into_iter().filter(|order| asked.contains(order)).collect();
    if orders.is_empty() {
        let reason = format!("none of the orders asked for acts; the model's are {known}");
        return Err(AnalysisError::NoExcitation { reason });
    }
    Ok(orders)
}

/// Says where nothing but the step of the speeds bounds a resonance.
fn undamped(vibration: &Vibration, header: &mut Header) {
    let equations = &vibration.equations;
    let damped = equations.modal_damping > 0.0
        || equations.connections.iter().any(|c| c.damping > 0.0 || c.loss_factor > 0.0)
        || equations.ground_damping.iter().any(|damping| *damping > 0.0);
    let warning = "nothing damps the line: peaks are as high as speeds come near the resonances";
    if !damped && header.warnings.iter().all(|known| known != warning) {
        header.warnings.push(warning.to_owned());
    }
}

fn stopped(header: &mut Header, gear: usize) {
    header.termination = Termination::early(
        Reason::Cancelled,
        format!("stopped in gear number {gear}, of which the lower speeds are told"),
    );
}
