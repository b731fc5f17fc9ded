//! What is told of the methods side by side: one value by closed form, by the first harmonic, by
//! harmonic balance and by integration, with the differences in numbers.

use halfshaft_results::{LevelRow, ReportResult};

use super::{Account, Grid};
use crate::reading::Method;
use crate::words::{capital, list, number, percent, plain, unit};

/// A method with the value that it has in a row.
type Level = (&'static str, fn(&LevelRow) -> Option<f64>);

/// The methods, the roughest first; those above are judged by those below.
const LEVELS: [Level; 3] = [
    ("closed form", |row| row.closed_form),
    ("first harmonic", |row| row.first_harmonic),
    ("harmonic balance", |row| row.harmonic_balance),
];

/// The account; nothing where fewer than two methods answered.
pub(crate) fn account(report: &ReportResult) -> Account {
    let mut account = Account::default();
    if report.levels.is_empty() {
        return account;
    }
    account.text([agreement(&report.levels)]);
    account.figure(crate::figures::levels::ID);
    account.grid(grid(&report.levels));
    account.note(
        "Twists are first harmonics. Each difference is taken against integration of the full equations where there is a value of \
         it, else against harmonic balance.",
    );
    account
}

/// What the others are held against.
fn reference(row: &LevelRow) -> Option<f64> {
    row.integration.or(row.harmonic_balance)
}

/// Speeds and differences, as parts, of a level from integration.
pub(crate) fn from_integration(rows: &[LevelRow], method: Method) -> Vec<(f64, f64)> {
    let Some((_, of)) = LEVELS.iter().find(|(name, _)| *name == method.words()) else {
        return Vec::new();
    };
    let integrated = rows.iter().filter(|row| row.integration.is_some());
    integrated.filter_map(|row| Some((row.at?, difference(row, *of)?.abs()))).collect()
}

/// Difference of a level from the reference of its row, as a part of the latter; `None` of the
/// reference itself.
fn difference(row: &LevelRow, of: fn(&LevelRow) -> Option<f64>) -> Option<f64> {
    let (value, reference) = (of(row)?, reference(row)?);
    let itself = row.integration.is_none() && row.harmonic_balance == Some(value);
    (!itself && reference != 0.0).then(|| value / reference - 1.0)
}

/// The largest difference of a level in some rows.
pub(crate) fn largest(
    rows: &[LevelRow],
    wanted: impl Fn(&LevelRow) -> bool,
    method: Method,
) -> Option<f64> {
    let of = LEVELS.iter().find(|(name, _)| *name == method.words())?.1;
    let of_rows = rows.iter().filter(|row| wanted(row));
    of_rows.filter_map(|row| difference(row, of)).map(f64::abs).reduce(f64::max)
}

/// How far the methods differ, as sentences.
fn agreement(rows: &[LevelRow]) -> String {
    let told = |wanted: &dyn Fn(&LevelRow) -> bool| {
        let methods = [Method::Averaged, Method::FirstHarmonic, Method::HarmonicBalance];
        let parts: Vec<String> = methods
            .into_iter()
            .filter_map(|method| {
                let largest = largest(rows, wanted, method)?;
                Some(format!("{} by at most {}", method.with_article(), percent(largest, 2)))
            })
            .collect();
        list(&parts)
    };
    let mut sentences = Vec::new();
    let integrated = told(&|row| row.integration.is_some());
    if !integrated.is_empty() {
        sentences.push(format!(
            "At the responses that were integrated, the first harmonic of the twist differs from \
             integration: {integrated}."
        ));
    }
    let folds = told(&|row| row.what.starts_with("fold") && row.unit == "rad/s");
    if !folds.is_empty() {
        sentences.push(format!("The speeds of the folds differ from harmonic balance: {folds}."));
    }
    sentences.join(" ")
}

fn grid(rows: &[LevelRow]) -> Grid {
    let what = |row: &LevelRow| {
        let at = row.at.map_or_else(String::new, |speed| {
            format!(" at {}", crate::words::quantity(speed, 6, "rad/s"))
        });
        let unit = plain(unit(&row.unit));
        let unit = if unit.is_empty() { unit } else { format!(", {unit}") };
        capital(&format!("{}{at}{unit}", plain(&row.what)))
    };
    // Rows of different units: each value keeps its own digits.
    let cell = |value: Option<f64>| value.map_or_else(String::new, |value| number(value, 7));
    let mut grid =
        Grid::new("Values by every method, and differences").words("value", rows.iter().map(what));
    for (name, of) in LEVELS {
        grid = grid.figures(name, rows.iter().map(|row| cell(of(row))));
    }
    grid = grid.figures("integration", rows.iter().map(|row| cell(row.integration)));
    for (name, of) in LEVELS {
        let title = format!("off: {name}, %");
        let parts = rows.iter().map(|row| difference(row, of).map(|part| 100.0 * part));
        let told = parts.map(|part| part.map_or_else(String::new, |part| number(part, 2)));
        grid = grid.figures(&title, told);
    }
    grid.without_empty_columns()
}
