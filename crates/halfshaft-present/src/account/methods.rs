//! What is told of the methods that answer a shock, side by side.

use halfshaft_results::{MethodRow, ShockDetails};

use super::{Account, Grid, Tone};
use crate::words::{list, number, percent, plain, times};

/// The comparison; nothing where none was asked for.
pub(crate) fn account(shock: &ShockDetails) -> Account {
    let mut account = Account::default();
    let rows = &shock.comparison;
    if rows.is_empty() {
        return account;
    }
    account.heading("The methods side by side");
    account.text(statements(rows));
    if rows.len() < 2 {
        return account;
    }
    account.figure("methods");
    account.grid(peaks(rows));
    account.grid(errors(rows));
    account.note(
        "Multiple scales are closed forms: the first order sees the cubic term, the second also \
         that the quadratic term lowers the frequency. Clamped holds the drive end; published is \
         the equation of the manuscript, which adds both ends and so doubles stiffness and damping. \
         Only the full line stands for the vehicle. Peaks are those of θ, the advance of the load \
         end: the twist beyond rest with the opposite sign.",
    );
    account.list(equations(rows));
    account
}

/// What follows from the comparison.
pub(crate) fn statements(rows: &[MethodRow]) -> Vec<String> {
    let mut sentences = Vec::new();
    for (first, second) in orders(rows) {
        sentences.extend(second_against_first(first, second));
    }
    sentences.extend(single_equations(rows));
    if rows.len() == 1 {
        sentences.push(
            "No single equation fits this line, so only the whole line is integrated.".to_owned(),
        );
    }
    sentences
}

/// Both orders of multiple scales of every equation.
pub(crate) fn orders(rows: &[MethodRow]) -> Vec<(&MethodRow, &MethodRow)> {
    let of_order = |order: &'static str| {
        rows.iter().filter_map(move |row| {
            Some((row, row.method.strip_prefix("multiple scales")?.trim().strip_prefix(order)?))
        })
    };
    of_order("1")
        .filter_map(|(first, equation)| {
            let second = of_order("2").find(|(_, other)| *other == equation)?.0;
            Some((first, second))
        })
        .collect()
}

/// How much nearer the second order is than the first, on the first peak and the phase.
pub(crate) fn second_against_first(first: &MethodRow, second: &MethodRow) -> Option<String> {
    let mut parts = Vec::new();
    if let (Some(one), Some(two)) = (first.first_peak_error, second.first_peak_error) {
        let shares = (percent(two.abs(), 2), percent(one.abs(), 2));
        parts.push(format!(
            "{} on the first peak ({} against {})",
            nearer(one, two),
            shares.0,
            shares.1
        ));
    }
    if let (Some(one), Some(two)) = (first.phase_error, second.phase_error) {
        let angles = (number(two.abs(), 2), number(one.abs(), 2));
        let text = nearer(one, two);
        parts.push(format!("{text} on the phase at 2 s ({} against {} rad)", angles.0, angles.1));
    }
    let equation = second.method.split_once(',').map_or("", |(_, equation)| equation.trim());
    let of = if equation.is_empty() {
        String::new()
    } else {
        format!(" of the {} equation", plain(equation))
    };
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    (!parts.is_empty())
        .then(|| format!("For the closed form{of}, second order is {}.", list(&parts)))
}

/// "188 times nearer than first", or the other way round.
fn nearer(first: f64, second: f64) -> String {
    let factor = first.abs() / second.abs();
    match factor {
        f if f.is_nan() => "as near as first".to_owned(),
        f if f.is_infinite() => "exact".to_owned(),
        f if f >= 1.0 => format!("{} nearer than first", times(f)),
        f => format!("{} farther than first", times(1.0 / f)),
    }
}

/// What holding one end does to the first peak.
fn single_equations(rows: &[MethodRow]) -> Option<String> {
    let told: Vec<String> = rows
        .iter()
        .filter(|row| !row.method.starts_with("multiple scales"))
        .filter(|row| row.reference.as_deref() == Some("full"))
        .filter_map(|row| {
            let factor = row.first_peak_error? + 1.0;
            Some(format!("\"{}\" gives {} the first peak", plain(&row.method), times(factor)))
        })
        .collect();
    (!told.is_empty()).then(|| {
        format!("Held against the full line, {}: they answer another question.", list(&told))
    })
}

fn tones(rows: &[MethodRow]) -> impl Iterator<Item = Tone> + '_ {
    rows.iter().map(|row| if row.reference.is_none() { Tone::Main } else { Tone::Usual })
}

fn peaks(rows: &[MethodRow]) -> Grid {
    Grid::new("What each method answers")
        .words("method", rows.iter().map(|row| &row.method))
        .numbers("first peak", "rad", 5, rows.iter().map(|row| row.first_peak))
        .numbers("at", "s", 4, rows.iter().map(|row| row.first_peak_time))
        .numbers("first rate peak", "rad/s", 5, rows.iter().map(|row| row.first_rate_peak))
        .numbers("frequency", "rad/s", 5, rows.iter().map(|row| row.oscillation_frequency))
        .numbers("decay", "1/s", 4, rows.iter().map(|row| row.decay_rate))
        .with_tones(tones(rows))
}

fn errors(rows: &[MethodRow]) -> Grid {
    let compared: Vec<&MethodRow> = rows.iter().filter(|row| row.reference.is_some()).collect();
    // A millionth of a per cent is the tolerance of the integration, not a difference.
    let share = |value: Option<f64>| {
        value.map(|value| if value.abs() < 1e-8 { 0.0 } else { 100.0 * value })
    };
    Grid::new("How far each is from its reference")
        .words("method", compared.iter().map(|row| &row.method))
        .words("against", compared.iter().map(|row| row.reference.clone().unwrap_or_default()))
        .numbers("first peak", "%", 3, compared.iter().map(|row| share(row.first_peak_error)))
        .numbers("first rate peak", "%", 3, compared.iter().map(|r| share(r.first_rate_peak_error)))
        .numbers(
            "largest difference over the first peak",
            "%",
            3,
            compared.iter().map(|row| share(row.largest_difference)),
        )
        .numbers("phase at 2 s", "rad", 3, compared.iter().map(|row| row.phase_error))
}

/// The single equations solved, each once.
fn equations(rows: &[MethodRow]) -> Vec<String> {
    let mut told: Vec<(&str, String)> = Vec::new();
    for row in rows.iter().filter(|row| row.method != "full") {
        let name = row.method.split_once(',').map_or(row.method.as_str(), |(_, name)| name.trim());
        if !told.iter().any(|(equation, _)| *equation == row.equation) {
            told.push((&row.equation, format!("{}: {}", plain(name), formula(&row.equation))));
        }
    }
    told.into_iter().map(|(_, line)| line).collect()
}

fn formula(equation: &str) -> String {
    plain(equation).replace(" - ", " − ")
}
