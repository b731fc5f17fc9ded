//! CSV text of an answer's tables.

use crate::{Answer, Column, FoldsResult, Table, column_names};

/// The tables of an answer as one CSV text: a header of `name (unit)`, then the rows. Where
/// there are several tables, a first column names each. `None` where there is no table.
pub fn csv(answer: &Answer) -> Option<String> {
    let tables = tables_of(answer);
    if tables.is_empty() {
        return None;
    }
    let several = tables.len() > 1;
    let names = column_names(tables.iter().map(|(_, table)| table));
    let mut writer = csv::Writer::from_writer(Vec::new());
    let head = names.iter().map(|(name, unit)| match unit.as_str() {
        "1" | "" => name.clone(),
        _ => format!("{name} ({unit})"),
    });
    let table_head = several.then(|| "table".to_owned());
    // Writing to memory cannot fail.
    let _ = writer.write_record(table_head.into_iter().chain(head));
    for (title, table) in &tables {
        write_rows(&mut writer, table, &names, several.then_some(title.as_str()));
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok())
}

/// The tables of an answer for flat files: those of [`Answer::tables`], and where an answer that is
/// tables happens to have none, one without rows, for the head says that there was nothing.
pub fn tables_of(answer: &Answer) -> Vec<(String, Table)> {
    let tables = answer.tables();
    match answer {
        _ if !tables.is_empty() => tables,
        Answer::Folds(folds) => vec![("no curve".to_owned(), empty_curve(folds))],
        Answer::Resonance(_) => {
            let frequency = Column::new("frequency", "rad/s", Vec::new());
            vec![("no branch".to_owned(), Table::new(vec![frequency]))]
        }
        _ => tables,
    }
}

fn empty_curve(folds: &FoldsResult) -> Table {
    let column = |name: &str, unit: &str| Column::new(name, unit, Vec::new());
    Table::new(vec![
        column("frequency", "rad/s"),
        column(&folds.parameter, &folds.parameter_unit),
        column("sigma", "rad/s"),
        column("rho", "rad"),
    ])
}

fn write_rows(
    writer: &mut csv::Writer<Vec<u8>>,
    table: &Table,
    names: &[(String, String)],
    title: Option<&str>,
) {
    let columns = table.values_of(names.iter().map(|(name, _)| name.as_str()));
    for row in 0..table.rows() {
        let cells = columns.iter().map(|values| match values.get(row) {
            Some(value) if value.is_finite() => value.to_string(),
            _ => String::new(),
        });
        let title = title.map(str::to_owned);
        // Writing to memory cannot fail.
        let _ = writer.write_record(title.into_iter().chain(cells));
    }
}
