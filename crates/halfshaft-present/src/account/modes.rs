//! What is told of the modes.

use halfshaft_results::{Gear, Mode, ModesResult};

use super::campbell::gear_table;
use super::{Account, Grid};
use crate::words::{angle, counted, frequency_words, list, percent, plain};

/// Modes whose shapes are listed.
const SHAPES: usize = 6;

/// The whole account.
pub(crate) fn account(result: &ModesResult) -> Account {
    let mut account = Account::default();
    account.text(opening(result));
    account.grid(table(result));
    if !result.gears.is_empty() {
        let rows: Vec<(&Gear, &[f64], &[f64])> = result
            .gears
            .iter()
            .map(|row| (&row.gear, row.frequency.as_slice(), row.damping_ratio.as_slice()))
            .collect();
        account.grid(gear_table(&rows));
    }
    let elastic: Vec<&Mode> = elastic(result).take(SHAPES).collect();
    for number in 1..=elastic.len() {
        account.figure(crate::figures::modes::id(number));
    }
    if !elastic.is_empty() {
        account.grid(shapes(&elastic));
        account.grid(energies(&elastic));
    }
    account
}

/// Whether a mode is the turning of the whole line.
pub(crate) fn is_rigid(mode: &Mode) -> bool {
    mode.frequency == 0.0 && mode.strain_energy.values().all(|share| *share == 0.0)
}

/// The modes that twist shafts, lowest first.
pub(crate) fn elastic(result: &ModesResult) -> impl Iterator<Item = &Mode> {
    result.modes.iter().filter(|mode| !is_rigid(mode))
}

fn opening(result: &ModesResult) -> Vec<String> {
    let elastic: Vec<&Mode> = elastic(result).collect();
    let rigid = result.modes.len() > elastic.len();
    let oscillating = elastic.iter().find(|mode| mode.damped_frequency > 0.0);
    let Some(lowest) = oscillating.or(elastic.first()) else {
        return vec!["Nothing twists: the line has no mode of vibration.".to_owned()];
    };
    let also = if rigid { ", besides turning as a whole" } else { "" };
    let count = counted(elastic.len(), "mode", "modes");
    let mut sentences = vec![match result.elastic_modes {
        Some(all) => format!("The lowest {count} of {all}{also}."),
        None => format!("The line vibrates in {count}{also}."),
    }];
    if lowest.damped_frequency > 0.0 {
        sentences.push(format!(
            "The lowest{} stands at {} with {} of critical damping: {}.",
            if elastic.first().is_some_and(|mode| mode.damped_frequency > 0.0) {
                ""
            } else {
                " that oscillates"
            },
            frequency_words(lowest.frequency),
            percent(lowest.damping_ratio, 3),
            plain(&lowest.label)
        ));
    } else {
        sentences.push(format!(
            "The lowest does not oscillate when left alone: {}.",
            plain(&lowest.label)
        ));
    }
    let twists: Vec<String> = result
        .equilibrium
        .twist
        .iter()
        .take(SHAPES)
        .map(|(shaft, twist)| format!("{} of the {}", angle(*twist), plain(shaft)))
        .collect();
    let about = if (1..=3).contains(&result.equilibrium.twist.len()) {
        format!(" with a twist of {}", list(&twists))
    } else {
        String::new()
    };
    let kind = if result.equilibrium.stable { "stable state" } else { "unstable state" };
    sentences.push(format!("All this is about the {kind} of rest{about}."));
    sentences
}

fn table(result: &ModesResult) -> Grid {
    let modes = &result.modes;
    let mut number = 0;
    let numbers: Vec<String> = modes
        .iter()
        .map(|mode| {
            if is_rigid(mode) {
                return "rigid".to_owned();
            }
            number += 1;
            number.to_string()
        })
        .collect();
    let damped = |mode: &Mode| (!is_rigid(mode)).then_some(mode.damped_frequency);
    Grid::new("Modes")
        .words("mode", numbers)
        .numbers("frequency", "rad/s", 6, modes.iter().map(|mode| Some(mode.frequency)))
        .numbers("frequency", "Hz", 5, modes.iter().map(|m| Some(m.frequency / TAU)))
        .numbers("frequency", "rpm", 5, modes.iter().map(|m| Some(60.0 * m.frequency / TAU)))
        .numbers("damped", "rad/s", 6, modes.iter().map(damped))
        .numbers(
            "damping ratio",
            "",
            4,
            modes.iter().map(|mode| (!is_rigid(mode)).then_some(mode.damping_ratio)),
        )
        .words("what moves", modes.iter().map(|mode| &mode.label))
}

const TAU: f64 = std::f64::consts::TAU;

fn shapes(modes: &[&Mode]) -> Grid {
    let nodes: Vec<&String> =
        modes.first().map(|mode| mode.shape.keys().collect()).unwrap_or_default();
    let mut grid = Grid::new("Shapes: motion of each node over the largest").words("node", &nodes);
    for (index, mode) in modes.iter().enumerate() {
        let values = nodes.iter().map(|node| mode.shape.get(node.as_str()).copied());
        grid = grid.fixed(&format!("mode {}", index + 1), "", 3, values);
    }
    grid
}

/// Shares of the strain energy by shaft and of the kinetic energy by inertia.
fn energies(modes: &[&Mode]) -> Grid {
    let Some(first) = modes.first() else { return Grid::new("") };
    let shafts = first.strain_energy.keys().map(|name| (name, "strain"));
    let bodies = first.kinetic_energy.keys().map(|name| (name, "kinetic"));
    let rows: Vec<(&String, &str)> = shafts.chain(bodies).collect();
    let mut grid = Grid::new("Where the energy of each mode is")
        .words("energy", rows.iter().map(|row| row.1))
        .words("of", rows.iter().map(|row| row.0));
    for (index, mode) in modes.iter().enumerate() {
        let share = |row: &(&String, &str)| {
            let shares = if row.1 == "strain" { &mode.strain_energy } else { &mode.kinetic_energy };
            shares.get(row.0.as_str()).map(|share| 100.0 * share)
        };
        let values = rows.iter().map(share);
        grid = grid.fixed(&format!("mode {}", index + 1), "%", 1, values);
    }
    grid
}
