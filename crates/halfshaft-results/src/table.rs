//! Named columns with units.

use std::collections::{HashMap, HashSet};

use serde::{Deserialize, Serialize, Serializer};

/// One column of numbers. A missing value is NaN in memory and `null` in JSON.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Column {
    /// Name, e.g. `half-shaft.twist`.
    pub name: String,
    /// Symbol of the unit, `1` for pure numbers.
    pub unit: String,
    /// One number a row.
    #[serde(serialize_with = "write_values", deserialize_with = "crate::number::read")]
    pub values: Vec<f64>,
}

/// Columns of equal length.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// The columns, the independent one first.
    pub columns: Vec<Column>,
}

impl Column {
    /// A column of the given name and unit.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), unit: unit.into(), values }
    }
}

impl PartialEq for Column {
    /// Equal to the last bit; a missing value equals a missing value.
    fn eq(&self, other: &Self) -> bool {
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
        self.name == other.name
            && self.unit == other.unit
            && self.values.len() == other.values.len()
            && self.values.iter().zip(&other.values).all(same)
    }
}

impl Table {
    /// A table of the given columns.
    pub fn new(columns: Vec<Column>) -> Self {
        Self { columns }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.iter().map(|column| column.values.len()).max().unwrap_or(0)
    }

    /// The column of that name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// Values of the column of that name; empty where there is none.
    pub fn values(&self, name: &str) -> &[f64] {
        self.column(name).map_or(&[], |column| &column.values)
    }

    /// Values of the columns of those names, in their order; empty where there is none. Finds many
    /// columns at once faster than one by one.
    pub fn values_of<'n>(&self, names: impl IntoIterator<Item = &'n str>) -> Vec<&[f64]> {
        let mut known: HashMap<&str, &[f64]> = HashMap::new();
        for column in &self.columns {
            known.entry(&column.name).or_insert(&column.values);
        }
        names.into_iter().map(|name| known.get(name).copied().unwrap_or_default()).collect()
    }

    /// Linear interpolation of a column over the first column, which must ascend.
    ///
    /// `None` outside the first column's range or where the column is missing. Where `x`
    /// stands in the first column (to a part in 10¹²) the stored value is returned.
    pub fn interpolate(&self, name: &str, x: f64) -> Option<f64> {
        let xs = &self.columns.first()?.values;
        let ys = &self.column(name)?.values;
        let close = |value: f64| (value - x).abs() <= 1e-12 * x.abs().max(value.abs());
        let after = xs.partition_point(|value| *value < x);
        for index in [after, after.wrapping_sub(1)] {
            if xs.get(index).is_some_and(|value| close(*value)) {
                return ys.get(index).copied();
            }
        }
        let before = after.checked_sub(1)?;
        let (x0, x1) = (*xs.get(before)?, *xs.get(after)?);
        let (y0, y1) = (*ys.get(before)?, *ys.get(after)?);
        Some(y0 + (y1 - y0) * (x - x0) / (x1 - x0))
    }
}

/// Names and units of all columns of some tables, each name once and in the order of the tables.
pub fn column_names<'t>(tables: impl IntoIterator<Item = &'t Table>) -> Vec<(String, String)> {
    let mut known = HashSet::new();
    let columns = tables.into_iter().flat_map(|table| &table.columns);
    columns
        .filter(|column| known.insert(column.name.as_str()))
        .map(|column| (column.name.clone(), column.unit.clone()))
        .collect()
}

fn write_values<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    // JSON has no NaN; a missing value becomes null.
    serializer.collect_seq(values.iter().map(|value| value.is_finite().then_some(*value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_is_exact_on_the_grid_and_linear_between() {
        let table = Table::new(vec![
            Column::new("time", "s", vec![0.0, 0.1, 0.3]),
            Column::new("x", "rad", vec![1.0, 2.0, 4.0]),
        ]);
        assert_eq!(table.interpolate("x", 0.1), Some(2.0));
        assert_eq!(table.interpolate("x", 0.1 + 1e-16), Some(2.0));
        assert!((table.interpolate("x", 0.2).expect("inside") - 3.0).abs() < 1e-15);
        assert_eq!(table.interpolate("x", 0.31), None);
        assert_eq!(table.interpolate("y", 0.1), None);
    }

    #[test]
    fn missing_values_survive_json_and_compare_equal() {
        let column = Column::new("a", "1", vec![1.0, f64::NAN, -0.0]);
        let text = serde_json::to_string(&column).expect("plain data");
        assert!(text.contains("null"));
        let back: Column = serde_json::from_str(&text).expect("own text");
        assert_eq!(column, back);
        assert_ne!(column, Column::new("a", "1", vec![1.0, f64::NAN, 0.0]));
    }
}
