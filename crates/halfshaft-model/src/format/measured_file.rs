//! Points in a file of their own: columns such as twist and torque of a measured law, time and torque,
//! or order, amplitude and phase.
//!
//! Cells are separated by commas, semicolons, tabs or blanks; `#` begins a comment. A first line that
//! is no number is the header: `twist [deg], torque [N·m]`, in any order; without units (or without a
//! header, in the order told) the numbers are in SI.

use std::ops::Range;
use std::path::Path;

use super::checked::{Checked, CheckedTable, Entry};
use super::limits::read_file;
use crate::diagnostic::{Diagnostic, Diagnostics, Source};
use crate::units::{QuantityKind, parse_quantity};

/// Most mistakes that are told of one file: a wrong separator is one on every line.
const MOST_TOLD: usize = 5;

/// A column of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Column {
    /// Which of the quantities it holds.
    quantity: usize,
    /// SI units in one unit of the column.
    factor: f64,
}

/// Names of the columns with what they mean.
type Names = [(&'static str, QuantityKind)];

/// A measured law.
pub(super) const OVER_TWIST: &Names =
    &[("twist", QuantityKind::Angle), ("torque", QuantityKind::Torque)];
/// A torque over time.
pub(super) const OVER_TIME: &Names =
    &[("time", QuantityKind::Time), ("torque", QuantityKind::Torque)];
/// Gas pressure over the crank angle.
pub(super) const PRESSURE: &Names =
    &[("angle", QuantityKind::Angle), ("pressure", QuantityKind::Pressure)];
/// Torque over the crank angle.
pub(super) const CRANK_TORQUE: &Names =
    &[("angle", QuantityKind::Angle), ("torque", QuantityKind::Torque)];
/// Harmonics of a torque.
pub(super) const ORDERS: &Names = &[
    ("order", QuantityKind::Number),
    ("amplitude", QuantityKind::Torque),
    ("phase", QuantityKind::Angle),
];

/// Puts the points of a file into the place of the path that stands in `key = "..."`; a file that
/// cannot be used is told, and the key is then unsound.
pub(super) fn resolve(
    element: &mut CheckedTable,
    (key, names): (&str, &'static Names),
    model: &Path,
    found: &mut Diagnostics,
) {
    let Some(Entry { span, value: Checked::Text(path) }) = element.entry(key).cloned() else {
        return;
    };
    match read_points((&path, names), model, &span, found) {
        Some(points) => element.replace(key, Checked::Table(points)),
        None => element.spoil(key),
    }
}

fn read_points(
    (path, names): (&str, &'static Names),
    model: &Path,
    span: &Range<usize>,
    found: &mut Diagnostics,
) -> Option<CheckedTable> {
    let full = model.parent().unwrap_or_else(|| Path::new("")).join(path);
    let mut refuse = |message: String| {
        let hint = "the path is relative to the folder of the model file";
        found.push(Diagnostic::error(span.clone(), message).hint(hint));
    };
    // A pipe or a device would be waited for.
    if full.metadata().is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir()) {
        refuse(format!("{} is no file", full.display()));
        return None;
    }
    let source = match read_file(&full) {
        Ok(source) => source,
        Err(error) => {
            refuse(error.to_string());
            return None;
        }
    };
    let number = found.sources.len();
    let (columns, mistakes) = parse(&source, names);
    found.sources.push(source);
    let sound = mistakes.is_empty();
    found.items.extend(mistakes.into_iter().take(MOST_TOLD).map(|item| item.in_source(number)));
    if sound { Some(CheckedTable::of_numbers(span.clone(), columns)) } else { None }
}

/// Columns by their names.
type Values = Vec<(&'static str, Vec<f64>)>;

/// The columns in SI, and what is wrong.
fn parse(source: &Source, names: &'static Names) -> (Values, Vec<Diagnostic>) {
    let mut values: Values = names.iter().map(|(name, _)| (*name, Vec::new())).collect();
    let mut mistakes = Vec::new();
    let mut columns: Option<Vec<Column>> = None;
    let mut start = 0;
    for line in source.text.split_inclusive('\n') {
        let cells = cells(line, start);
        start += line.len();
        if cells.is_empty() {
            continue;
        }
        let is_header = columns.is_none() && cells.iter().all(|(_, cell)| !begins_number(cell));
        if is_header {
            match header(&cells, names) {
                Ok(read) => columns = Some(read),
                Err(mistake) => return (values, vec![mistake]),
            }
            continue;
        }
        let plain = |quantity| Column { quantity, factor: 1.0 };
        let order = columns.get_or_insert_with(|| (0..names.len()).map(plain).collect());
        match row(&cells, order.len()) {
            Ok(numbers) => {
                for (column, number) in order.iter().zip(numbers) {
                    values[column.quantity].1.push(number * column.factor);
                }
            }
            Err(mistake) => mistakes.push(mistake),
        }
    }
    (values, mistakes)
}

/// The cells of a line with their places in the text.
fn cells(line: &str, start: usize) -> Vec<(Range<usize>, &str)> {
    let content = line.split('#').next().unwrap_or("");
    let separator = [';', '\t', ','].into_iter().find(|c| content.contains(*c));
    let separates = |c: char| match separator {
        Some(separator) => c == separator,
        None => c.is_whitespace(),
    };
    let mut cells = Vec::new();
    let mut at = start;
    for cell in content.split(separates) {
        let text = cell.trim();
        let from = at + (cell.len() - cell.trim_start().len());
        // One byte for the separator; blanks of more bytes only stand at the end of a line.
        at += cell.len() + 1;
        if separator.is_some() || !text.is_empty() {
            cells.push((from..from + text.len(), text));
        }
    }
    // An empty line has one empty cell, and a line may end in a separator.
    while cells.last().is_some_and(|(_, text)| text.is_empty()) {
        cells.pop();
    }
    cells
}

fn begins_number(cell: &str) -> bool {
    cell.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | '−'))
}

/// Names of the columns in words: "twist and torque", "order, amplitude and phase".
fn listed(names: &Names, last: &str) -> String {
    let names: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
    match names.split_last() {
        Some((end, rest)) => format!("{} {last} {end}", rest.join(", ")),
        None => String::new(),
    }
}

/// Columns from a header such as `twist [deg]`, `torque (N·m)`.
fn header(cells: &[(Range<usize>, &str)], names: &Names) -> Result<Vec<Column>, Diagnostic> {
    let wrong = |place: &Range<usize>, message: String| {
        let unit = |kind: QuantityKind| match kind {
            QuantityKind::Time => "ms",
            QuantityKind::Angle => "deg",
            QuantityKind::Pressure => "bar",
            kind => kind.si_unit(),
        };
        let example: Vec<String> =
            names.iter().map(|(name, kind)| format!("{name} [{}]", unit(*kind))).collect();
        Diagnostic::error(place.clone(), message).hint(format!("e.g. {}", example.join(", ")))
    };
    let whole = cells[0].0.start..cells[cells.len() - 1].0.end;
    if cells.len() != names.len() {
        let message = format!("{} columns, not {}", cells.len(), listed(names, "and"));
        return Err(wrong(&whole, message));
    }
    let column = |(place, text): &(Range<usize>, &str)| {
        let text = text.trim_matches('"');
        let (name, unit) = text.split_once(['[', '(']).unwrap_or((text, ""));
        let name = name.trim().to_lowercase();
        let Some(quantity) = names.iter().position(|(known, _)| *known == name) else {
            let known = listed(names, if names.len() == 2 { "nor" } else { "or" });
            let word = if names.len() == 2 { "neither" } else { "not one of" };
            return Err(wrong(place, format!("\"{text}\" is {word} {known}")));
        };
        let unit = unit.trim_end_matches([']', ')']).trim();
        let kind = names[quantity].1;
        if unit.is_empty() || kind == QuantityKind::Number {
            return Ok(Column { quantity, factor: 1.0 });
        }
        match parse_quantity(&format!("1 {unit}"), kind) {
            Ok(factor) => Ok(Column { quantity, factor }),
            Err(error) => {
                let message = format!("{name}: {error}");
                Err(Diagnostic::error(place.clone(), message).maybe_hint(error.hint()))
            }
        }
    };
    let columns: Vec<Column> = cells.iter().map(column).collect::<Result<_, _>>()?;
    let twice = (1..columns.len())
        .find(|at| columns[..*at].iter().any(|before| before.quantity == columns[*at].quantity));
    match twice {
        Some(at) => Err(wrong(&cells[at].0, "this column is there twice".to_owned())),
        None => Ok(columns),
    }
}

/// The numbers of a line, in the order of the columns.
fn row(cells: &[(Range<usize>, &str)], wanted: usize) -> Result<Vec<f64>, Diagnostic> {
    if cells.len() != wanted {
        let whole = cells[0].0.start..cells[cells.len() - 1].0.end;
        let count = if wanted == 2 { "two" } else { "three" };
        let message = format!("a point has {count} numbers, not {}", cells.len());
        let hint = format!("write {count} numbers a line; decimals have a point");
        return Err(Diagnostic::error(whole, message).hint(hint));
    }
    let number = |(place, text): &(Range<usize>, &str)| {
        let plain = text.trim_matches('"').replace('−', "-");
        let value = plain.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| {
            let diagnostic = Diagnostic::error(place.clone(), format!("\"{text}\" is no number"));
            let decimal = plain.replace(',', ".");
            match decimal.parse::<f64>() {
                Ok(_) if plain.contains(',') => {
                    diagnostic.hint(format!("decimals are written with a point: {decimal}"))
                }
                _ => diagnostic.hint("units stand in the header, e.g. torque [N·m]"),
            }
        })
    };
    cells.iter().map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str) -> Vec<Vec<f64>> {
        let (values, mistakes) = parse(&Source::new("law.csv", text), OVER_TWIST);
        assert!(mistakes.is_empty(), "{mistakes:?}");
        values.into_iter().map(|(_, numbers)| numbers).collect()
    }

    // Source: the same points written in several ways.
    #[test]
    fn files_are_read_with_any_separator_order_and_unit() {
        let expected = [vec![-0.5, 0.0, 0.5], vec![-2.0, 0.0, 3.5]];
        for text in [
            "-0.5,-2\n0,0\n0.5,3.5",
            "# measured\ntwist, torque\r\n-0.5, -2\r\n\r\n0, 0 # rest\r\n0.5, 3.5,\r\n",
            "torque (N*m);twist (rad)\n-2;−0.5\n0;0\n3.5;0.5\n",
            "Twist [rad]\tTorque [kN·m]\n-0.5\t-2e-3\n0\t0\n0.5\t3.5e-3\n",
            "-0.5 -2\n0   0\n\"0.5\" 3.5\n",
        ] {
            let found = points(text);
            for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                assert!((found - expected).abs() < 1e-15, "{text}");
            }
        }
        let twist = points("twist [deg], torque [N·m]\n180, 1\n").remove(0);
        assert!((twist[0] - std::f64::consts::PI).abs() < 1e-15);
    }

    #[test]
    fn mistakes_have_their_place() {
        let told = |text: &str| {
            let source = Source::new("law.csv", text);
            let (_, mistakes) = parse(&source, OVER_TWIST);
            let first = mistakes.first().expect("is wrong").clone();
            (source.excerpt(&first.span).to_owned(), first.message, first.hint.unwrap_or_default())
        };
        let (place, message, _) = told("twist [deg], force [N]\n1, 2\n");
        assert!(place == "force [N]" && message.contains("neither"));
        let (place, message, _) = told("twist [N·m], torque\n1, 2\n");
        assert!(place == "twist [N·m]" && message.contains("is a torque"), "{message}");
        let (place, message, _) = told("1, 2\n3, 4, 5\n");
        assert!(place == "3, 4, 5" && message.contains("not 3"));
        let (place, _, hint) = told("twist; torque\n0,5; 2\n");
        assert!(place == "0,5" && hint.contains("0.5"));
        let (place, _, hint) = told("0.5 deg, 2\n");
        assert!(place == "0.5 deg" && hint.contains("header"));
    }
}
