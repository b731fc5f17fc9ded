//! Initial states by the response that they lead to.

use halfshaft_results::{BasinGrid, BasinsResult};

use crate::account::basins::name;
use crate::figure::{Axis, Colour, Figure, Marker, Panel, Points, Region, Size};
use crate::words::plain;

/// The id of the figure.
pub(crate) const ID: &str = "basins";
/// Cells of a side at most: finer ones would not be seen, but make the picture heavy.
const MOST_CELLS: usize = 400;
/// Colours of the attractors, in their order; more share the last.
const COLOURS: [Colour; 7] = [
    Colour::Sky,
    Colour::Orange,
    Colour::SAFE,
    Colour::Purple,
    Colour::Rgb(240, 228, 66),
    Colour::PRIMARY,
    Colour::Grey,
];

/// The map, with the states of every attractor at the beginning of a period.
pub(crate) fn figure(result: &BasinsResult) -> Figure {
    let shaft = plain(&result.shaft);
    let mut panel = Panel::new(
        Axis::new(format!("Twist of the {shaft} at time 0"), "rad"),
        Axis::new("Its rate at time 0", "rad/s"),
    );
    let cells = Cells::of(&result.grid);
    let caught = (0..).zip(0..result.attractors.len());
    let caught = caught.map(|(key, index)| (key, name(result, index), colour(index)));
    let others = [
        (-1, "grows beyond all measure".to_owned(), Colour::DANGER),
        (-2, "reached no response in time".to_owned(), Colour::Black),
    ];
    for (key, name, colour) in caught.chain(others) {
        let (x, y) = cells.area(key);
        if !x.is_empty() {
            panel = panel.with(Region { opacity: 0.55, ..Region::new(name, x, y, colour) });
        }
    }
    for (index, attractor) in result.attractors.iter().enumerate() {
        let label = format!("{} at the start of each period", name(result, index));
        let (x, y) = (attractor.twist.clone(), attractor.rate.clone());
        let points = Points::new(label, x, y, colour(index));
        panel = panel.with(Points { marker: Marker::Diamond, size: 7.0, ..points });
    }
    let caption = "Which response the line settles to from each twist and rate of twist at time 0, \
                   everything else at rest; diamonds are the responses themselves whenever a period of \
                   the excitation begins.";
    Figure::new(ID, "Which initial state leads where")
        .with_caption(caption)
        .with_size(Size::Square)
        .with(panel)
}

fn colour(index: usize) -> Colour {
    COLOURS[index.min(COLOURS.len() - 1)]
}

/// The grid, thinned where it is finer than can be seen.
struct Cells {
    /// Edges of the cells.
    x: Vec<f64>,
    y: Vec<f64>,
    rows: Vec<Vec<i32>>,
}

impl Cells {
    fn of(grid: &BasinGrid) -> Self {
        let some = |count: usize| -> Vec<usize> {
            let step = count.div_ceil(MOST_CELLS).max(1);
            (0..count).step_by(step).collect()
        };
        let (columns, rows) = (some(grid.twist.len()), some(grid.rate.len()));
        let pick = |row: &usize| {
            let list = grid.attractor.get(*row);
            columns.iter().filter_map(|column| list?.get(*column).copied()).collect()
        };
        Self {
            x: edges(&columns.iter().map(|k| grid.twist[*k]).collect::<Vec<f64>>()),
            y: edges(&rows.iter().map(|k| grid.rate[*k]).collect::<Vec<f64>>()),
            rows: rows.iter().map(pick).collect(),
        }
    }

    /// Corners of all stretches of rows with one outcome.
    fn area(&self, key: i32) -> (Vec<f64>, Vec<f64>) {
        let (mut x, mut y) = (Vec::new(), Vec::new());
        for (row, list) in self.rows.iter().enumerate() {
            let mut column = 0;
            while column < list.len() {
                let from = column;
                while column < list.len() && list[column] == list[from] {
                    column += 1;
                }
                let ends = [self.x.get(from), self.x.get(column)];
                let heights = [self.y.get(row), self.y.get(row + 1)];
                if let ([Some(left), Some(right)], [Some(low), Some(high)]) = (ends, heights)
                    && list[from] == key
                {
                    x.extend([*left, *right, *right, *left, f64::NAN]);
                    y.extend([*low, *low, *high, *high, f64::NAN]);
                }
            }
        }
        (x, y)
    }
}

/// Edges half-way between centres.
fn edges(centres: &[f64]) -> Vec<f64> {
    let (Some(first), Some(last)) = (centres.first(), centres.last()) else { return Vec::new() };
    let half = if centres.len() > 1 { 0.5 * (centres[1] - centres[0]) } else { 0.5 };
    let mut edges = vec![first - half];
    edges.extend(centres.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])));
    edges.push(last + half);
    edges
}

#[cfg(test)]
mod tests {
    use super::Cells;
    use halfshaft_results::BasinGrid;

    /// Oracle: by hand: cells reach half-way to their neighbours, stretches are joined.
    #[test]
    fn stretches_of_one_outcome_are_one_rectangle() {
        let grid = BasinGrid {
            twist: vec![0.0, 1.0, 2.0],
            rate: vec![0.0, 2.0],
            attractor: vec![vec![0, 0, 1], vec![1, -1, 1]],
        };
        let cells = Cells::of(&grid);
        let (x, y) = cells.area(0);
        assert_eq!(x[..4], [-0.5, 1.5, 1.5, -0.5]);
        assert_eq!(y[..4], [-1.0, -1.0, 1.0, 1.0]);
        assert_eq!(cells.area(1).0.len(), 15);
        assert_eq!(cells.area(-1).0[..2], [0.5, 1.5]);
        assert!(cells.area(-2).0.is_empty());
    }
}
