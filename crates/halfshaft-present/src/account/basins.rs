//! What is told of initial states and the responses that they lead to.

use halfshaft_results::{Attractor, BasinsResult};

use super::{Account, Grid};
use crate::words::{counted, number, plain, quantity};

/// The whole account.
pub(crate) fn account(result: &BasinsResult) -> Account {
    let mut account = Account::default();
    account.text(told(result));
    account.figure(crate::figures::basins::ID);
    account.grid(table(result));
    account.append(super::smallest::account(result));
    if result.attractors.len() > 1 {
        account.note(
            "A slow sweep of the speed follows one response until it ends; a shock throws the line from \
             one to another as soon as the state after it lies in the other's basin.",
        );
    }
    account
}

/// What an attractor is called.
pub(crate) fn name(result: &BasinsResult, index: usize) -> String {
    let attractor = &result.attractors[index];
    let swing = swing(result, attractor)
        .map_or_else(String::new, |swing| format!(", ±{}", quantity(swing, 4, "rad")));
    let period = match attractor.periods {
        0 | 1 => String::new(),
        periods => format!(" of {periods} periods"),
    };
    format!("response {}{period}{swing}", index + 1)
}

fn swing(result: &BasinsResult, attractor: &Attractor) -> Option<f64> {
    attractor.values.get(&format!("{}.twist.amplitude", result.shaft)).copied()
}

fn told(result: &BasinsResult) -> Vec<String> {
    let grid = &result.grid;
    let states = grid.twist.len() * grid.rate.len();
    let rpm = quantity(result.frequency * 30.0 / std::f64::consts::PI, 5, "rpm");
    let at = format!("{rpm} ({})", quantity(result.frequency, 6, "rad/s"));
    let shaft = plain(&result.shaft);
    let mut sentences = vec![format!(
        "At {at} the line has {} to settle to, seen from {states} initial states of the {shaft}.",
        counted(result.attractors.len(), "response", "responses")
    )];
    for (index, attractor) in result.attractors.iter().enumerate() {
        let share = percent(attractor.share);
        let name = name(result, index);
        sentences.push(format!("{share} lead to {name}."));
    }
    if result.escaped > 0.0 {
        sentences
            .push(format!("From {} the motion grows beyond all measure.", percent(result.escaped)));
    }
    sentences
}

fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share, 4))
}

fn table(result: &BasinsResult) -> Grid {
    let all = &result.attractors;
    let name = |word: &str| format!("{}.twist.{word}", result.shaft);
    let of = |word: &str| {
        let name = name(word);
        all.iter().map(|a| a.values.get(&name).copied()).collect::<Vec<_>>()
    };
    Grid::new("Responses that the line settles to")
        .figures("response", (1..=all.len()).map(|k| k.to_string()))
        .figures("periods", all.iter().map(|a| a.periods.to_string()))
        .figures("share", all.iter().map(|a| percent(a.share)))
        .numbers("swing", "rad", 5, of("amplitude"))
        .numbers("mean", "rad", 5, of("mean"))
        .numbers("largest multiplier", "", 5, all.iter().map(|a| a.largest_multiplier))
        .words(
            "listed by resonance",
            all.iter().map(|a| if a.continued { "yes" } else { "no" }.to_owned()),
        )
}
