//! Tables in plain text.
//!
//! Words stand flush left and break into lines where they must; numbers stand flush right with
//! their points in line. A table that is still too wide is cut into parts, each of which repeats
//! the first column.

use super::wrap::{columns as width_of, wrapped};
use crate::account::{Grid, GridColumn};

/// Between columns.
const GAP: usize = 2;
/// Set in by this much.
const INDENT: usize = 2;
/// Words are not squeezed below this.
const NARROWEST: usize = 14;

/// A column with its cells laid out.
struct Laid {
    /// Lines of the head.
    head: Vec<String>,
    /// Lines of each cell.
    cells: Vec<Vec<String>>,
    width: usize,
    numeric: bool,
}

/// The lines of a table.
pub(super) fn render(grid: &Grid, most: usize) -> Vec<String> {
    let mut lines = wrapped(&grid.title, most);
    let room = most - INDENT;
    let laid = laid_out(&grid.columns, room);
    for part in parts(&laid, room) {
        if lines.len() > 1 {
            lines.push(String::new());
        }
        lines.extend(part_lines(&part, grid.rows()));
    }
    lines
}

/// Columns as wide as they need to be, words squeezed until all fit, if they can.
fn laid_out(columns: &[GridColumn], room: usize) -> Vec<Laid> {
    let natural: Vec<usize> = columns.iter().map(natural_width).collect();
    let gaps = GAP * columns.len().saturating_sub(1);
    let mut widths = natural.clone();
    loop {
        let over = (widths.iter().sum::<usize>() + gaps).saturating_sub(room);
        if over == 0 {
            break;
        }
        let least = |index: usize| NARROWEST.max(longest(&columns[index].name));
        let squeezable = |index: &usize| !columns[*index].numeric && widths[*index] > least(*index);
        let Some(widest) = (0..columns.len()).filter(squeezable).max_by_key(|i| widths[*i]) else {
            break;
        };
        // Down to the next widest, so that all give way together.
        let next = (0..columns.len())
            .filter(|i| *i != widest && !columns[*i].numeric && widths[*i] < widths[widest])
            .map(|i| widths[i])
            .max()
            .unwrap_or(0)
            .max(least(widest));
        widths[widest] -= over.min(widths[widest] - next).max(1);
    }
    let widths = widths.iter().map(|width| (*width).min(room));
    columns.iter().zip(widths).map(|(column, width)| laid_column(column, width)).collect()
}

/// Width without any break in a cell; heads break at spaces.
fn natural_width(column: &GridColumn) -> usize {
    let cells = aligned(column);
    let cells = cells.iter().map(|cell| width_of(cell)).max().unwrap_or(0);
    let head = if column.numeric { longest(&column.name) } else { head_width(&column.name) };
    cells.max(head).max(width_of(&column.unit))
}

/// Width of the longest word.
fn longest(text: &str) -> usize {
    text.split(' ').map(width_of).max().unwrap_or(0)
}

/// Heads of words take two lines at most.
fn head_width(name: &str) -> usize {
    let whole = width_of(name);
    let fits = |width: &usize| wrapped(name, *width).len() <= 2;
    (longest(name).max(2)..=whole).find(fits).unwrap_or(whole)
}

fn laid_column(column: &GridColumn, width: usize) -> Laid {
    let mut head = wrapped(&column.name, width.max(2));
    head.extend(wrapped(&column.unit, width.max(2)));
    let cells = aligned(column).iter().map(|cell| cell_lines(cell, width)).collect();
    Laid { head, cells, width, numeric: column.numeric }
}

fn cell_lines(cell: &str, width: usize) -> Vec<String> {
    // A number is padded for its point and must not lose that.
    if width_of(cell) <= width {
        return vec![cell.replace('\u{a0}', " ")];
    }
    wrapped(cell, width)
}

/// Cells of numbers padded at their ends, so that their points stand in line.
fn aligned(column: &GridColumn) -> Vec<String> {
    if !column.numeric {
        return column.cells.clone();
    }
    let after = |cell: &str| cell.find('.').map_or(0, |point| width_of(&cell[point..]));
    let most = column.cells.iter().map(|cell| after(cell)).max().unwrap_or(0);
    let padded = |cell: &String| {
        let pad = if cell.contains('×') { 0 } else { most - after(cell) };
        format!("{cell}{}", " ".repeat(pad))
    };
    column.cells.iter().map(padded).collect()
}

/// The columns in parts that fit, each beginning with the first column.
fn parts(columns: &[Laid], room: usize) -> Vec<Vec<&Laid>> {
    let mut parts: Vec<Vec<&Laid>> = Vec::new();
    let mut used = 0;
    for column in columns {
        let fits = used + GAP + column.width <= room;
        match parts.last_mut() {
            Some(part) if fits => {
                part.push(column);
                used += GAP + column.width;
            }
            _ => {
                let first = columns.first().filter(|_| !parts.is_empty());
                let first = first.filter(|first| first.width + GAP + column.width <= room);
                used = first.map_or(0, |first| first.width + GAP) + column.width;
                parts.push(first.into_iter().chain([column]).collect());
            }
        }
    }
    parts
}

fn part_lines(part: &[&Laid], rows: usize) -> Vec<String> {
    let head_height = part.iter().map(|column| column.head.len()).max().unwrap_or(0);
    let mut lines = Vec::new();
    for line in 0..head_height {
        // Heads of fewer lines stand at the bottom, next to their cells.
        let of = |column: &Laid| {
            let above = head_height - column.head.len();
            line.checked_sub(above).and_then(|line| column.head.get(line)).cloned()
        };
        lines.push(row(part, of));
    }
    lines.push(row(part, |column| Some("-".repeat(column.width))));
    for index in 0..rows {
        let cell = |column: &Laid| column.cells.get(index).cloned().unwrap_or_default();
        let height = part.iter().map(|column| cell(column).len()).max().unwrap_or(1);
        for line in 0..height.max(1) {
            lines.push(row(part, |column| cell(column).get(line).cloned()));
        }
    }
    lines
}

fn row(part: &[&Laid], of: impl Fn(&Laid) -> Option<String>) -> String {
    let mut line = " ".repeat(INDENT);
    for (index, column) in part.iter().enumerate() {
        let text = of(column).unwrap_or_default();
        let pad = " ".repeat(column.width.saturating_sub(width_of(&text)));
        let gap = if index == 0 { "" } else { "  " };
        let (before, after) =
            if column.numeric { (pad, String::new()) } else { (String::new(), pad) };
        line.push_str(&format!("{gap}{before}{text}{after}"));
    }
    line.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::render;
    use crate::account::Grid;

    /// Oracle: by hand.
    #[test]
    fn numbers_stand_with_their_points_in_line() {
        let grid = Grid::new("Title").words("node", ["engine", "car"]).numbers(
            "error",
            "%",
            2,
            [Some(281.0), Some(0.0044)],
        );
        let lines = render(&grid, 40);
        assert_eq!(
            lines,
            [
                "Title",
                "             Error",
                "  Node           %",
                "  ------  --------",
                "  engine  281",
                "  car       0.0044",
            ]
            .map(str::to_owned)
        );
    }

    /// Oracle: the contract: nothing is wider than asked, nothing is left out.
    #[test]
    fn wide_tables_break_and_split() {
        let long = "a sentence that is much too long for its column and must break".to_owned();
        let mut grid = Grid::new("").words("what", [long.clone(), "b".to_owned()]);
        for index in 0..12 {
            grid = grid.numbers(&format!("mode {index}"), "rad", 6, [Some(1.23456), Some(2.0)]);
        }
        let lines = render(&grid, 60);
        assert!(lines.iter().all(|line| line.chars().count() <= 60));
        let text = lines.join(" ");
        assert!(long.split(' ').all(|word| text.contains(word)));
        assert_eq!(text.matches("1.23456").count(), 12);
    }
}
