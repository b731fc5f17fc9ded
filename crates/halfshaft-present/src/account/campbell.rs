//! What is told of critical speeds.

use halfshaft_results::{CampbellGear, CampbellResult, CriticalSpeed, Gear};

use super::{Account, Grid, Tone};
use crate::words::{RPM, capital, counted, number, percent, plain, quantity};

/// Rows of a table at most.
const MOST_ROWS: usize = 30;
/// Distance from the operating range that is asked for in practice (classification societies ask for
/// 10 to 20 %).
const CLOSE: f64 = 0.2;

/// The whole account.
pub(crate) fn account(result: &CampbellResult) -> Account {
    let mut account = Account::default();
    account.text(opening(result));
    if result.gears.len() > 1 {
        let rows: Vec<(&Gear, &[f64], &[f64])> = result
            .gears
            .iter()
            .map(|row| (&row.gear, row.frequency.as_slice(), row.damping_ratio.as_slice()))
            .collect();
        account.grid(gear_table(&rows));
    }
    for (index, gear) in result.gears.iter().enumerate() {
        if result.gears.len() > 1 {
            account.heading(gear_name(&gear.gear));
        }
        account.figure(crate::figures::campbell::id(index));
        account.grid(modes(gear));
        account.grid(critical(result, gear));
    }
    account
}

/// A gear in words.
pub(crate) fn gear_name(gear: &Gear) -> String {
    match (&gear.gearbox, gear.ratio) {
        (Some(gearbox), Some(ratio)) => format!("{}, ratio {}", plain(gearbox), number(ratio, 5)),
        _ => "the line".to_owned(),
    }
}

/// Lowest modes gear by gear, side by side.
pub(crate) fn gear_table(rows: &[(&Gear, &[f64], &[f64])]) -> Grid {
    let shown = rows.iter().map(|(_, frequency, _)| frequency.len()).max().unwrap_or(0).min(4);
    let mut grid =
        Grid::new("Gear by gear").words("gear", rows.iter().map(|(gear, ..)| gear_name(gear)));
    for mode in 0..shown {
        let hertz = |values: &[f64]| values.get(mode).map(|value| value / std::f64::consts::TAU);
        let frequencies = rows.iter().map(|(_, frequency, _)| hertz(frequency));
        let damping = rows.iter().map(|(.., damping)| damping.get(mode).map(|d| 100.0 * d));
        grid = grid.numbers(&format!("mode {}", mode + 1), "Hz", 5, frequencies);
        grid = grid.numbers("damping", "%", 3, damping);
    }
    grid
}

fn opening(result: &CampbellResult) -> Vec<String> {
    let all: Vec<&CriticalSpeed> = result.gears.iter().flat_map(|gear| &gear.critical).collect();
    let orders: Vec<String> =
        result.orders.iter().take(12).map(|order| number(*order, 4)).collect();
    let more = if result.orders.len() > 12 { " and so on" } else { "" };
    let mut sentences = vec![format!(
        "{} between {} and {} rpm, {} {}{more}.",
        capital(&counted(all.len(), "critical speed", "critical speeds")),
        number(result.frequency.0 * RPM, 4),
        number(result.frequency.1 * RPM, 4),
        if orders.len() == 1 { "order" } else { "orders" },
        orders.join(", ")
    )];
    if let Some((from, to)) = result.operating {
        let inside = all.iter().filter(|speed| speed.margin == Some(0.0)).count();
        let near = |speed: &&&CriticalSpeed| speed.margin.is_some_and(|m| m > 0.0 && m < CLOSE);
        let close = all.iter().filter(near).count();
        sentences.push(format!(
            "The line is run from {} to {} rpm: {} in that range, {close} within {} of it.",
            number(from * RPM, 4),
            number(to * RPM, 4),
            match inside {
                0 => "none lies".to_owned(),
                1 => "one lies".to_owned(),
                more => format!("{more} lie"),
            },
            percent(CLOSE, 2),
        ));
    }
    let inside = all.iter().any(|speed| speed.margin == Some(0.0) && speed.torque.is_some());
    let most = if inside { f64::MIN_POSITIVE } else { CLOSE };
    let relevant = all.iter().filter(|speed| speed.margin.is_none_or(|margin| margin < most));
    let loudest = relevant.filter_map(|speed| Some((speed, speed.torque?)));
    if let Some((speed, torque)) = loudest.max_by(|a, b| a.1.total_cmp(&b.1)) {
        let shaft = speed.shaft.as_deref().map_or_else(String::new, plain);
        let there = match result.operating {
            Some(_) if inside => " there",
            Some(_) => " near it",
            None => "",
        };
        sentences.push(format!(
            "The strongest{there} is order {} on mode {} at {} rpm: alone it loads the {shaft} with ±{}.",
            number(speed.order, 4),
            speed.mode,
            number(speed.speed * RPM, 4),
            quantity(torque, 4, "N·m"),
        ));
    }
    sentences
}

fn modes(gear: &CampbellGear) -> Grid {
    let numbers: Vec<String> = (1..=gear.frequency.len()).map(|mode| mode.to_string()).collect();
    Grid::new("Modes")
        .words("mode", numbers)
        .numbers(
            "frequency",
            "Hz",
            6,
            gear.frequency.iter().map(|f| Some(f / std::f64::consts::TAU)),
        )
        .numbers("damping ratio", "%", 3, gear.damping_ratio.iter().map(|d| Some(100.0 * d)))
        .words("what moves", &gear.label)
}

/// Critical speeds that are told: those in or near the operating range, if there is one, and of many
/// the strongest.
fn told(gear: &CampbellGear) -> (Vec<&CriticalSpeed>, String) {
    let near = |speed: &&CriticalSpeed| speed.margin.is_none_or(|margin| margin <= CLOSE);
    let mut rows: Vec<&CriticalSpeed> = gear.critical.iter().filter(near).collect();
    let with_range = gear.critical.iter().any(|speed| speed.margin.is_some());
    let place = if with_range {
        format!(" in the operating range and within {} of it", percent(CLOSE, 2))
    } else {
        String::new()
    };
    let all = rows.len();
    if all <= MOST_ROWS {
        return (rows, format!("Critical speeds{place}"));
    }
    let strength = |speed: &CriticalSpeed| speed.torque.unwrap_or(0.0);
    rows.sort_by(|a, b| strength(b).total_cmp(&strength(a)));
    rows.truncate(MOST_ROWS);
    rows.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    (rows, format!("Critical speeds{place}, the {MOST_ROWS} strongest of {all}"))
}

fn critical(result: &CampbellResult, gear: &CampbellGear) -> Grid {
    let (rows, title) = told(gear);
    let hertz = |row: &&CriticalSpeed| Some(row.frequency / std::f64::consts::TAU);
    let mut grid = Grid::new(title)
        .numbers("speed", "rpm", 6, rows.iter().map(|row| Some(row.speed * RPM)))
        .numbers("order", "", 4, rows.iter().map(|row| Some(row.order)))
        .words("mode", rows.iter().map(|row| row.mode.to_string()))
        .numbers("frequency", "Hz", 5, rows.iter().map(hertz));
    if result.operating.is_some() {
        let margin = |row: &&CriticalSpeed| row.margin.map(|margin| 100.0 * margin);
        grid = grid.numbers("off the operating range", "%", 3, rows.iter().map(margin));
    }
    grid = grid
        .numbers("alone it makes ±", "N·m", 4, rows.iter().map(|row| row.torque))
        .words("in", rows.iter().map(|row| row.shaft.as_deref().map_or_else(String::new, plain)));
    let tone = |row: &&CriticalSpeed| match (row.margin, row.torque) {
        (Some(0.0), Some(_)) => Tone::Bad,
        _ => Tone::Usual,
    };
    let tones: Vec<Tone> = rows.iter().map(tone).collect();
    grid.with_tones(tones).without_empty_columns()
}
