//! What is told of the states of rest.

use halfshaft_results::{
    Equilibrium, GearState, Limit, Named, Running, RunningKind, ShaftCapacity, SharedLoad,
    StaticResult,
};

use super::{Account, Grid, Tone};
use crate::words::{MISSING, angle, counted, list, number, plain, quantity, times};

/// The whole account.
pub(crate) fn account(result: &StaticResult) -> Account {
    let mut account = Account::default();
    account.text(opening(result));
    account.text([running(&result.running)]);
    for id in crate::figures::statics::ids(result) {
        account.figure(id);
    }
    if margins(result).len() > 1 {
        account.grid(shaft_table(result));
    }
    account.grid(equilibria(result));
    account.text([other_states(result)]);
    account.grid(gears(result));
    account
}

/// What a shaft must carry, and what it can.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Margin {
    pub(crate) shaft: String,
    /// N·m, positive.
    pub(crate) asked: f64,
    /// N·m, positive; `None` where the law has no limit in that direction.
    pub(crate) carries: Option<Limit>,
}

impl Margin {
    /// Capacity over what is asked; infinite without a limit or a load.
    pub(crate) fn factor(&self) -> f64 {
        match self.carries {
            Some(limit) if self.asked > 0.0 => limit.torque / self.asked,
            _ => f64::INFINITY,
        }
    }
}

/// Every shaft, and all that share a torque together, with what it must carry in the model's own
/// gear.
pub(crate) fn margins(result: &StaticResult) -> Vec<Margin> {
    margins_of(result, &result.required_torque, &result.shared)
}

fn margins_of(result: &StaticResult, alone: &Named<f64>, shared: &[SharedLoad]) -> Vec<Margin> {
    let of = |(shaft, asked): (&String, &f64)| Margin {
        shaft: plain(shaft),
        asked: asked.abs(),
        carries: result.capacity.get(shaft).and_then(|capacity| limit(capacity, *asked)),
    };
    let of_group = |shared: &SharedLoad| {
        let asked = shared.required_torque?;
        Some(Margin {
            shaft: together(shared),
            asked: asked.abs(),
            carries: shared.capacity.as_ref().and_then(|capacity| limit(capacity, asked)),
        })
    };
    alone.iter().map(of).chain(shared.iter().filter_map(of_group)).collect()
}

/// Names of shafts that share a torque.
fn together(shared: &SharedLoad) -> String {
    let names: Vec<String> = shared.shafts.iter().map(|name| plain(name)).collect();
    format!("{} together", list(&names))
}

/// The limit in the direction of a load, as sizes.
fn limit(capacity: &ShaftCapacity, load: f64) -> Option<Limit> {
    let limit = if load < 0.0 { capacity.negative } else { capacity.positive }?;
    Some(Limit { torque: limit.torque.abs(), twist: limit.twist.abs() })
}

/// The first stable state, in which the line runs.
pub(crate) fn primary(result: &StaticResult) -> Option<&Equilibrium> {
    result.equilibria.iter().find(|state| state.stable)
}

/// The shaft with the least room to its limit.
pub(crate) fn tightest(margins: &[Margin]) -> Option<&Margin> {
    margins.iter().min_by(|a, b| a.factor().total_cmp(&b.factor()))
}

fn opening(result: &StaticResult) -> Vec<String> {
    let margins = margins(result);
    let Some(state) = primary(result) else {
        let mut sentences = vec!["There is no stable state under the mean torques.".to_owned()];
        sentences.extend(margins.iter().filter(|m| m.factor() < 1.0).map(overload));
        return sentences;
    };
    let Some(tight) = tightest(&margins) else {
        return vec!["There is a stable state.".to_owned()];
    };
    let twist = state.twist.iter().find(|(name, _)| plain(name) == tight.shaft);
    let twist = twist.map_or_else(String::new, |(_, twist)| {
        format!(
            "The twist of the {} is {} under {}.",
            tight.shaft,
            angle(*twist),
            torque(tight.asked)
        )
    });
    vec!["There is a stable state.".to_owned(), twist, room(tight, margins.len())]
}

fn torque(value: f64) -> String {
    quantity(value, 6, "N·m")
}

/// How far a shaft is from its limit.
fn room(margin: &Margin, shafts: usize) -> String {
    match margin.carries {
        Some(limit) => {
            let over = if margin.asked > 0.0 {
                format!(": {} what is asked", times(margin.factor()))
            } else {
                String::new()
            };
            let (torque, twist) = (torque(limit.torque), angle(limit.twist));
            format!("The law can carry {torque} at most, at {twist}{over}.")
        }
        None if shafts > 1 => "The law of no loaded shaft has a limit.".to_owned(),
        None => "The law has no limit in this direction.".to_owned(),
    }
}

/// Why a shaft cannot hold.
pub(crate) fn overload(margin: &Margin) -> String {
    let carries = margin.carries.map_or_else(
        || "it has no stable state there".to_owned(),
        |limit| format!("the law can carry {}", torque(limit.torque)),
    );
    format!("The {} would have to carry {}; {carries}.", margin.shaft, torque(margin.asked))
}

/// How the line runs under its mean torques, as a sentence.
pub(crate) fn running(running: &Running) -> String {
    let node = plain(&running.node);
    let taken: Vec<String> = running
        .balancing
        .iter()
        .map(|(name, value)| format!("{} takes {}", plain(name), torque(*value)))
        .collect();
    match running.kind {
        RunningKind::Held => "The line stands still, held by a shaft to ground.".to_owned(),
        RunningKind::Balanced if taken.is_empty() => {
            "The mean torques balance: the line runs at any constant speed.".to_owned()
        }
        RunningKind::Balanced => format!(
            "Steady running: {}, so that the mean torques balance; the line runs at any constant \
             speed.",
            list(&taken)
        ),
        RunningKind::Accelerating => format!(
            "The mean torques do not balance: the line speeds up uniformly, the {node} at {}. The \
             twists are those in the accelerating line.",
            quantity(running.acceleration, 6, "rad/s²")
        ),
        RunningKind::SteadySpeed => format!(
            "Damping to ground balances the mean torques when the {node} turns at {}; the twists \
             are those at that speed.",
            crate::words::frequency_words(running.speed)
        ),
    }
}

fn shaft_table(result: &StaticResult) -> Grid {
    let margins = margins(result);
    let state = primary(result);
    let twist = |margin: &Margin| {
        let twists = &state?.twist;
        twists.iter().find(|(name, _)| plain(name) == margin.shaft).map(|(_, twist)| *twist)
    };
    Grid::new("What each shaft carries")
        .words("shaft", margins.iter().map(|margin| &margin.shaft))
        .numbers("torque asked", "N·m", 6, margins.iter().map(|margin| Some(margin.asked)))
        .numbers("twist", "rad", 5, margins.iter().map(twist))
        .numbers("twist", "°", 4, margins.iter().map(|m| twist(m).map(f64::to_degrees)))
        .words("can carry", margins.iter().map(|margin| most(margin.carries)))
}

fn most(limit: Option<Limit>) -> String {
    limit.map_or_else(|| "no limit".to_owned(), |limit| torque(limit.torque))
}

/// One row for each shaft in each state.
fn equilibria(result: &StaticResult) -> Grid {
    let rows: Vec<(usize, &Equilibrium, &String, f64)> = result
        .equilibria
        .iter()
        .enumerate()
        .flat_map(|(number, state)| {
            state.twist.iter().map(move |(shaft, twist)| (number + 1, state, shaft, *twist))
        })
        .collect();
    let verdict = |state: &Equilibrium| if state.stable { "stable" } else { "not stable" };
    let own = |(_, state, shaft, _): &(usize, &Equilibrium, &String, f64)| {
        state.torque.get(shaft.as_str()).copied()
    };
    Grid::new("States of rest, nearest to zero twist first")
        .words("no.", rows.iter().map(|row| row.0.to_string()))
        .words("shaft", rows.iter().map(|row| row.2))
        .numbers("twist", "rad", 6, rows.iter().map(|row| Some(row.3)))
        .numbers("twist", "°", 5, rows.iter().map(|row| Some(row.3.to_degrees())))
        .numbers("torque", "N·m", 6, rows.iter().map(own))
        .words("", rows.iter().map(|row| verdict(row.1)))
        .with_tones(rows.iter().map(|row| if row.1.stable { Tone::Good } else { Tone::Bad }))
}

/// What the states that are not stable mean, and whether the list is complete.
fn other_states(result: &StaticResult) -> String {
    let unstable = result.equilibria.iter().filter(|state| !state.stable).count();
    let mut sentences = Vec::new();
    if unstable > 0 {
        sentences.push(
            "A state that is not stable exists on paper only: the smallest push drives the line \
             away from it. It bounds how far the line may be pushed from the stable one."
                .to_owned(),
        );
    }
    sentences.push(if result.complete {
        format!(
            "The list is proven complete: {}.",
            counted(result.equilibria.len(), "state", "states")
        )
    } else {
        "Further states are not excluded by proof.".to_owned()
    });
    sentences.join(" ")
}

/// What each gear asks of its most loaded shaft.
fn gears(result: &StaticResult) -> Grid {
    let rows: Vec<(&GearState, Margin)> =
        result.gears.iter().filter_map(|gear| Some((gear, gear_margin(result, gear)?))).collect();
    let several_boxes = rows.windows(2).any(|pair| pair[0].0.gear != pair[1].0.gear);
    let several_shafts = result.capacity.len() > 1;
    let mut grid = Grid::new("In every gear");
    if several_boxes {
        grid = grid.words("gearbox", rows.iter().map(|row| &row.0.gear));
    }
    grid = grid.words("ratio", rows.iter().map(|row| number(row.0.ratio, 5)));
    if several_shafts {
        grid = grid.words("tightest shaft", rows.iter().map(|row| &row.1.shaft));
    }
    let twist = |row: &(&GearState, Margin)| {
        let own = row.0.twist.iter().find(|(name, _)| plain(name) == row.1.shaft);
        own.map(|(_, twist)| *twist)
    };
    grid.numbers("must carry", "N·m", 5, rows.iter().map(|row| Some(row.1.asked)))
        .words("can carry", rows.iter().map(|row| most(row.1.carries)))
        .numbers("twist", "rad", 5, rows.iter().map(twist))
        .words("", rows.iter().map(|row| gear_verdict(row.0)))
        .with_tones(rows.iter().map(|row| if row.0.exists { Tone::Good } else { Tone::Bad }))
}

fn gear_verdict(gear: &GearState) -> &'static str {
    if gear.exists { "holds" } else { "does not hold" }
}

/// The shaft that gives way in a gear, or the one with the least room.
pub(crate) fn gear_margin(result: &StaticResult, gear: &GearState) -> Option<Margin> {
    let all = margins_of(result, &gear.required_torque, &gear.shared);
    if let Some(first) = &gear.overloaded {
        let shared = gear.shared.iter().find(|shared| shared.shafts.first() == Some(first));
        let name = shared.map_or_else(|| plain(first), together);
        if let Some(margin) = all.iter().find(|margin| margin.shaft == name) {
            return Some(margin.clone());
        }
    }
    let unlimited = all.iter().all(|margin| margin.carries.is_none());
    if unlimited {
        return all.into_iter().max_by(|a, b| a.asked.total_cmp(&b.asked));
    }
    tightest(&all).cloned()
}

/// A gear by its ratio.
pub(crate) fn gear_name(gear: &GearState) -> String {
    let ratio = number(gear.ratio, 5);
    if ratio == MISSING { plain(&gear.gear) } else { ratio }
}
