//! Points in a file of their own: two columns, twist and torque of a measured law or time and torque.
//!
//! Cells are separated by commas, semicolons, tabs or blanks; `#` begins a comment. A first line that
//! is no number is the header: `twist [deg], torque [N·m]`, in either order; without units (or
//! without a header, twist first) the numbers are in SI.

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
    /// 0 for twist or time, 1 for torque.
    quantity: usize,
    /// SI units in one unit of the column.
    factor: f64,
}

/// Names of the two columns with what they mean.
type Names = [(&'static str, QuantityKind); 2];

/// A measured law.
pub(super) const OVER_TWIST: Names =
    [("twist", QuantityKind::Angle), ("torque", QuantityKind::Torque)];
/// A torque over time.
pub(super) const OVER_TIME: Names =
    [("time", QuantityKind::Time), ("torque", QuantityKind::Torque)];

/// Puts the points of a file into the place of the path that stands in `table = "..."`; a file that
/// cannot be used is told, and the key is then unsound.
pub(super) fn resolve(
    element: &mut CheckedTable,
    names: &Names,
    model: &Path,
    found: &mut Diagnostics,
) {
    let Some(Entry { span, value: Checked::Text(path) }) = element.entry("table").cloned() else {
        return;
    };
    match read_points((&path, names), model, &span, found) {
        Some(points) => element.replace("table", Checked::Table(points)),
        None => element.spoil("table"),
    }
}

fn read_points(
    (path, names): (&str, &Names),
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

/// The two columns in SI, and what is wrong.
fn parse(source: &Source, names: &Names) -> ([(&'static str, Vec<f64>); 2], Vec<Diagnostic>) {
    let mut values = names.map(|(name, _)| (name, Vec::new()));
    let mut mistakes = Vec::new();
    let mut columns: Option<[Column; 2]> = None;
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
        let order = columns.get_or_insert([0, 1].map(|quantity| Column { quantity, factor: 1.0 }));
        match row(&cells) {
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

/// Columns from a header such as `twist [deg]`, `torque (N·m)`.
fn header(cells: &[(Range<usize>, &str)], names: &Names) -> Result<[Column; 2], Diagnostic> {
    let wrong = |place: &Range<usize>, message: String| {
        let [(first, kind), (second, _)] = names;
        let unit = if *kind == QuantityKind::Time { "ms" } else { "deg" };
        Diagnostic::error(place.clone(), message)
            .hint(format!("e.g. {first} [{unit}], {second} [N·m]"))
    };
    let whole = cells[0].0.start..cells[cells.len() - 1].0.end;
    let [first, second] = cells else {
        return Err(wrong(
            &whole,
            format!("{} columns, not {} and {}", cells.len(), names[0].0, names[1].0),
        ));
    };
    let column = |(place, text): &(Range<usize>, &str)| {
        let text = text.trim_matches('"');
        let (name, unit) = text.split_once(['[', '(']).unwrap_or((text, ""));
        let name = name.trim().to_lowercase();
        let Some(quantity) = names.iter().position(|(known, _)| *known == name) else {
            return Err(wrong(
                place,
                format!("\"{text}\" is neither {} nor {}", names[0].0, names[1].0),
            ));
        };
        let unit = unit.trim_end_matches([']', ')']).trim();
        let kind = names[quantity].1;
        let unit = if unit.is_empty() { kind.si_unit() } else { unit };
        match parse_quantity(&format!("1 {unit}"), kind) {
            Ok(factor) => Ok(Column { quantity, factor }),
            Err(error) => {
                let message = format!("{name}: {error}");
                Err(Diagnostic::error(place.clone(), message).maybe_hint(error.hint()))
            }
        }
    };
    let columns = [column(first)?, column(second)?];
    if columns[0].quantity == columns[1].quantity {
        return Err(wrong(&second.0, "this column is there twice".to_owned()));
    }
    Ok(columns)
}

/// The two numbers of a line, in the order of the columns.
fn row(cells: &[(Range<usize>, &str)]) -> Result<[f64; 2], Diagnostic> {
    let [first, second] = cells else {
        let whole = cells[0].0.start..cells[cells.len() - 1].0.end;
        let message = format!("a point has two numbers, not {}", cells.len());
        let hint = "write two numbers a line; decimals have a point";
        return Err(Diagnostic::error(whole, message).hint(hint));
    };
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
    Ok([number(first)?, number(second)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str) -> [Vec<f64>; 2] {
        let (values, mistakes) = parse(&Source::new("law.csv", text), &OVER_TWIST);
        assert!(mistakes.is_empty(), "{mistakes:?}");
        values.map(|(_, numbers)| numbers)
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
        let [twist, _] = points("twist [deg], torque [N·m]\n180, 1\n");
        assert!((twist[0] - std::f64::consts::PI).abs() < 1e-15);
    }

    #[test]
    fn mistakes_have_their_place() {
        let told = |text: &str| {
            let source = Source::new("law.csv", text);
            let (_, mistakes) = parse(&source, &OVER_TWIST);
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
