//! A small table for reading.

use crate::words::{MISSING, capital, common_decimals, decimals, number, plain, unit};

/// What a row says besides its numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tone {
    /// Nothing.
    #[default]
    Usual,
    /// That all is well.
    Good,
    /// That something does not hold.
    Bad,
    /// That the others are held against it.
    Main,
}

/// A column of a [`Grid`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GridColumn {
    pub(crate) name: String,
    /// Symbol of the unit; empty for texts and pure numbers.
    pub(crate) unit: String,
    /// Whether the cells are numbers, which stand flush right.
    pub(crate) numeric: bool,
    pub(crate) cells: Vec<String>,
}

/// A table with a heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Grid {
    pub(crate) title: String,
    pub(crate) columns: Vec<GridColumn>,
    /// One a row; missing ones are usual.
    pub(crate) tones: Vec<Tone>,
}

impl Grid {
    pub(crate) fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Adds a column of words.
    pub(crate) fn words<T: AsRef<str>>(
        mut self,
        name: &str,
        cells: impl IntoIterator<Item = T>,
    ) -> Self {
        let cells = cells.into_iter().map(|cell| shown(cell.as_ref())).collect();
        self.columns.push(GridColumn {
            name: capital(name),
            unit: String::new(),
            numeric: false,
            cells,
        });
        self
    }

    /// Adds a column of numbers with so many significant digits; of equal decimals where they are
    /// of similar size.
    pub(crate) fn numbers(
        mut self,
        name: &str,
        symbol: &str,
        digits: usize,
        values: impl IntoIterator<Item = Option<f64>>,
    ) -> Self {
        let values: Vec<f64> = values.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect();
        let places = common_decimals(&values, digits);
        let cell = |value: &f64| match places {
            Some(places) => decimals(*value, places),
            None => number(*value, digits),
        };
        let cells = values.iter().map(cell).collect();
        let (name, unit) = (capital(name), plain(unit(symbol)));
        self.columns.push(GridColumn { name, unit, numeric: true, cells });
        self
    }

    /// Adds a column of numbers with just so many decimals.
    pub(crate) fn fixed(
        mut self,
        name: &str,
        symbol: &str,
        places: usize,
        values: impl IntoIterator<Item = Option<f64>>,
    ) -> Self {
        let cell = |value: Option<f64>| decimals(value.unwrap_or(f64::NAN), places);
        let cells = values.into_iter().map(cell).collect();
        let (name, unit) = (capital(name), plain(unit(symbol)));
        self.columns.push(GridColumn { name, unit, numeric: true, cells });
        self
    }

    /// Adds a column of numbers that are written out already, each in its own way.
    pub(crate) fn figures(mut self, name: &str, cells: impl IntoIterator<Item = String>) -> Self {
        let cells = cells.into_iter().map(|cell| shown(&cell)).collect();
        let name = capital(name);
        self.columns.push(GridColumn { name, unit: String::new(), numeric: true, cells });
        self
    }

    /// The tones of the rows.
    pub(crate) fn with_tones(mut self, tones: impl IntoIterator<Item = Tone>) -> Self {
        self.tones = tones.into_iter().collect();
        self
    }

    pub(crate) fn rows(&self) -> usize {
        self.columns.iter().map(|column| column.cells.len()).max().unwrap_or(0)
    }

    pub(crate) fn tone(&self, row: usize) -> Tone {
        self.tones.get(row).copied().unwrap_or_default()
    }

    /// The same without the columns in which no row has anything to say.
    pub(crate) fn without_empty_columns(mut self) -> Self {
        self.columns.retain(|column| column.cells.iter().any(|cell| cell != MISSING));
        self
    }
}

fn shown(cell: &str) -> String {
    if cell.trim().is_empty() { MISSING.to_owned() } else { plain(cell) }
}

#[cfg(test)]
mod tests {
    use super::Grid;

    /// Oracle: by hand.
    #[test]
    fn columns_of_numbers_line_up() {
        let grid = Grid::new("t").words("node", ["a", ""]).numbers(
            "speed",
            "1",
            5,
            [Some(0.0), Some(115.1306), None],
        );
        assert_eq!(grid.columns[0].cells, ["a", "–"]);
        assert_eq!(grid.columns[1].cells, ["0.00", "115.13", "–"]);
        assert_eq!((grid.columns[1].unit.as_str(), grid.rows()), ("", 3));
    }

    /// Oracle: the definition.
    #[test]
    fn empty_columns_go() {
        let grid = Grid::new("t").words("a", ["x"]).numbers("b", "N", 3, [None]);
        assert_eq!(grid.without_empty_columns().columns.len(), 1);
    }
}
