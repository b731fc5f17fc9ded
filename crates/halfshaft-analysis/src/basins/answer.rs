//! From the question to the map of initial states.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{BasinsQuestion, Question};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Attractor, BasinGrid, BasinsResult, Reason, Termination};

use super::search::{ESCAPED, Search, UNDECIDED};
use super::shocks::{self, Shocks};
use super::window::Window;
use crate::error::AnalysisError;
use crate::harmonic_balance::{AtSpeed, Response};
use crate::header::header;

/// Attractors not known before are looked for from so many by so many states.
const COARSE: usize = 24;
/// Times that states which reached nothing known are asked what they settle to.
const MOST_ROUNDS: usize = 3;
/// Loose ends that are followed on.
const MOST_LOOSE: usize = 512;

pub(crate) fn solve(
    line: &Driveline,
    question: &BasinsQuestion,
    observer: &dyn Observer,
) -> Result<BasinsResult, AnalysisError> {
    let equations = Rc::new(EquationsOfMotion::new(line)?);
    let at = AtSpeed::new(equations, question.frequency)?;
    let responses = at.responses(observer);
    let limits = (question.tolerance, question.periods);
    let mut search = Search::new(&at, question.frequency, responses.clone(), limits)?;
    let window = Window::new(&at, question, &responses, &search.frame)?;
    let coarse = search.lead(COARSE * COARSE, |k| window.coarse(k, COARSE), true, observer)?;
    search.learn(&coarse)?;
    let mut led = search.lead(window.count(), |k| window.state(k), false, observer)?;
    for _ in 0..MOST_ROUNDS {
        let ends = led.ends();
        if ends.is_empty() || led.cancelled {
            break;
        }
        let every = ends.len().div_ceil(MOST_LOOSE);
        let some: Vec<&Vec<f64>> = ends.iter().step_by(every).collect();
        let on = search.lead(some.len(), |k| some[k].clone(), true, observer)?;
        if !search.learn(&on)? {
            break;
        }
        led = search.lead(window.count(), |k| window.state(k), false, observer)?;
    }
    let (mut result, order) = assemble(line, question, &window, &search, &led.outcomes);
    // A single response can be left too where motions run away.
    let elsewhere = search.attractors.len() > 1 || led.outcomes.contains(&ESCAPED);
    if elsewhere && !led.cancelled {
        let node = question.shock.as_deref().unwrap_or_else(|| shocks::usual_node(line));
        if let Some(shocks) = Shocks::new(&search, node, &window, observer) {
            (result.shocks, result.shock_search) = shocks.all(&order)?;
        }
    }
    tell(&mut result, question, &responses, led.cancelled);
    Ok(result)
}

/// The result, the attractor of the largest share first, and their order by that.
fn assemble(
    line: &Driveline,
    question: &BasinsQuestion,
    window: &Window,
    search: &Search<'_>,
    outcomes: &[i32],
) -> (BasinsResult, Vec<usize>) {
    let all = outcomes.len().max(1) as f64;
    let share = |of: i32| outcomes.iter().filter(|outcome| **outcome == of).count() as f64 / all;
    let shares: Vec<f64> = (0..).take(search.attractors.len()).map(share).collect();
    let mut order: Vec<usize> = (0..shares.len()).collect();
    order.sort_by(|a, b| shares[*b].total_cmp(&shares[*a]));
    let attractors = order
        .iter()
        .map(|at| attractor(window, search, &search.attractors[*at], shares[*at]))
        .collect();
    let place = |outcome: &i32| match usize::try_from(*outcome) {
        Ok(number) => order
            .iter()
            .position(|at| *at == number)
            .map_or(UNDECIDED, |at| i32::try_from(at).unwrap_or(i32::MAX)),
        Err(_) => *outcome,
    };
    let rows = outcomes.chunks(window.twists.len());
    let result = BasinsResult {
        header: header(line, &Question::Basins(question.clone())),
        frequency: question.frequency,
        shaft: window.shaft.clone(),
        attractors,
        grid: BasinGrid {
            twist: window.twists.clone(),
            rate: window.rates.clone(),
            attractor: rows.map(|row| row.iter().map(place).collect()).collect(),
        },
        escaped: share(ESCAPED),
        undecided: share(UNDECIDED),
        shocks: Vec::new(),
        shock_search: None,
    };
    (result, order)
}

fn attractor(window: &Window, search: &Search<'_>, response: &Response, share: f64) -> Attractor {
    let states: Vec<Vec<f64>> = response.states.iter().map(|own| search.frame.lanes(own)).collect();
    let half = states[0].len() / 2;
    Attractor {
        periods: response.periods,
        share,
        values: response.values.clone(),
        twist: states.iter().map(|state| state[window.place]).collect(),
        rate: states.iter().map(|state| state[half + window.place]).collect(),
        multipliers: response.stability.multipliers.iter().map(|m| [m.re, m.im]).collect(),
        largest_multiplier: Some(response.stability.largest()),
        continued: !response.origin.is_empty(),
        origin: response.origin.clone(),
    }
}

/// What the reader must know of the answer.
fn tell(
    result: &mut BasinsResult,
    question: &BasinsQuestion,
    responses: &[Response],
    cancelled: bool,
) {
    let shaft = &result.shaft;
    result.header.assumptions.push(format!(
        "at time 0 only {shaft} is twisted and turning, everything else is at rest in the equilibrium"
    ));
    let warnings = &mut result.header.warnings;
    if result.undecided > 0.0 && !cancelled {
        warnings.push(format!(
            "{:.3} % of the initial states had reached no response after {} periods: their motion is \
             chaotic, goes round a torus or decays very slowly; try more --periods",
            100.0 * result.undecided,
            question.periods
        ));
    }
    let unseen = result.attractors.iter().filter(|attractor| attractor.share == 0.0).count();
    if unseen > 0 {
        warnings.push(format!(
            "{unseen} stable responses are reached from no initial state of the window; widen it by --window"
        ));
    }
    let found = result.attractors.iter().filter(|attractor| !attractor.continued).count();
    if found > 0 && !responses.is_empty() {
        warnings.push(format!(
            "{found} of the responses were found by letting the line run alone: `resonance` does not list \
             them at this speed"
        ));
    }
    if let Some(search) = result.shock_search.as_ref().filter(|search| search.undecided > 0) {
        warnings.push(format!(
            "{} of {} motions after a shock had reached no response after {} periods; a smaller shock may be \
             among them: try more --periods",
            search.undecided, search.motions, question.periods
        ));
    }
    if cancelled {
        let detail = "not all initial states were followed".to_owned();
        result.header.termination = Termination::early(Reason::Cancelled, detail);
    }
}
