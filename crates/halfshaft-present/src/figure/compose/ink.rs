//! Where a panel is already inked, so that texts can keep clear.

use crate::figure::geometry::{Point, Rect};

/// A coarse count of what is drawn, cell by cell.
pub(super) struct InkMap {
    area: Rect,
    /// Side of a cell in points.
    cell: f64,
    columns: usize,
    rows: usize,
    cells: Vec<f32>,
}

impl InkMap {
    /// Side of a cell of a usual panel in points: about half of a letter.
    const SMALLEST: f64 = 2.0;
    /// Cells along the longer side at most.
    const MOST: f64 = 1000.0;

    pub(super) fn new(area: Rect) -> Self {
        let cell = Self::SMALLEST.max(area.width().max(area.height()) / Self::MOST);
        let count = |length: f64| (length / cell).ceil().clamp(1.0, Self::MOST) as usize;
        let (columns, rows) = (count(area.width()), count(area.height()));
        Self { area, cell, columns, rows, cells: vec![0.0; columns * rows] }
    }

    /// Counts a line through the points.
    pub(super) fn add_line(&mut self, points: &[Point]) {
        for ends in points.windows(2) {
            let (from, to) = (ends[0], ends[1]);
            let length = (to.x - from.x).hypot(to.y - from.y);
            let steps = (length / self.cell).ceil().clamp(1.0, 10_000.0);
            for step in 0..=steps as usize {
                let share = step as f64 / steps;
                let (dx, dy) = (share * (to.x - from.x), share * (to.y - from.y));
                self.add_point(from.moved(dx, dy));
            }
        }
    }

    /// Counts everything inside a box.
    pub(super) fn add_box(&mut self, area: &Rect) {
        let (columns, rows) = self.range(area);
        for row in rows {
            for column in columns.clone() {
                self.cells[row * self.columns + column] = 1.0;
            }
        }
    }

    fn add_point(&mut self, point: Point) {
        if self.area.contains(point) {
            let column = self.column(point.x);
            let row = self.row(point.y);
            self.cells[row * self.columns + column] = 1.0;
        }
    }

    /// Number of inked cells in a box.
    pub(super) fn count(&self, area: &Rect) -> f64 {
        let (columns, rows) = self.range(area);
        let row_sum = |row: usize| -> f32 {
            let start = row * self.columns;
            self.cells[start + columns.start..start + columns.end].iter().sum()
        };
        f64::from(rows.map(row_sum).sum::<f32>())
    }

    fn column(&self, x: f64) -> usize {
        (((x - self.area.left) / self.cell) as usize).min(self.columns - 1)
    }

    fn row(&self, y: f64) -> usize {
        (((y - self.area.top) / self.cell) as usize).min(self.rows - 1)
    }

    fn range(&self, area: &Rect) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
        if area.overlap(&self.area) <= 0.0 {
            return (0..0, 0..0);
        }
        let columns = self.column(area.left)..self.column(area.right) + 1;
        let rows = self.row(area.top)..self.row(area.bottom) + 1;
        (columns, rows)
    }
}
