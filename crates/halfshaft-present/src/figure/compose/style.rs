//! Sizes and colours of everything that is not data. Lengths are points.

use crate::figure::item::Line;
use crate::figure::scene::{Ink, Stroke};

/// Font size of the heading.
pub(crate) const TITLE_SIZE: f64 = 10.5;
/// Font size of axis texts.
pub(crate) const LABEL_SIZE: f64 = 9.5;
/// Font size of the numbers along an axis.
pub(crate) const TICK_SIZE: f64 = 8.5;
/// Font size of legends and of texts between the axes.
pub(crate) const NOTE_SIZE: f64 = 8.5;

/// Least distance of anything from the edge of the page.
pub(crate) const EDGE: f64 = 6.0;
/// Length of a mark with a label.
pub(crate) const TICK_LENGTH: f64 = 4.0;
/// Length of a mark without a label.
pub(crate) const MINOR_LENGTH: f64 = 2.25;
/// From a mark to its label.
pub(crate) const TICK_GAP: f64 = 3.0;
/// From labels to the text of the axis.
pub(crate) const AXIS_GAP: f64 = 5.0;
/// Widths are measured in the embedded font; a viewer may have a slightly wider one.
pub(crate) const SLACK: f64 = 1.05;
/// Edges of panels lie on whole pixels of a screen, 0.75 points.
pub(crate) const PIXEL: f64 = 0.75;

/// The page.
pub(crate) const PAPER: Ink = (255, 255, 255);
/// Letters.
pub(crate) const TEXT: Ink = (26, 26, 26);
/// Letters that say that there is nothing.
pub(crate) const FAINT: Ink = (130, 130, 130);
/// The border of a panel.
pub(crate) const FRAME: Ink = (60, 60, 60);
/// The lines behind the data.
pub(crate) const GRID: Ink = (228, 228, 228);

/// Width of frames and marks.
pub(crate) const FRAME_WIDTH: f64 = 0.75;
/// Width of grid lines.
pub(crate) const GRID_WIDTH: f64 = 0.5;
/// Width of reference lines.
pub(crate) const REFERENCE_WIDTH: f64 = 1.1;
/// White edge of filled markers.
pub(crate) const MARKER_EDGE: f64 = 0.8;
/// Line width of hollow markers and crosses.
pub(crate) const MARKER_LINE: f64 = 1.3;

/// A line of the data: colour, width and dashes that grow with the width.
pub(crate) fn stroke(colour: Ink, width: f64, line: Line) -> Stroke {
    let width = if width.is_finite() { width.clamp(0.2, 20.0) } else { 1.4 };
    let dash = dashes(line).iter().map(|length| length * width).collect();
    Stroke { colour, width, dash }
}

/// Dashes and gaps in units of the line width.
pub(crate) fn dashes(line: Line) -> &'static [f64] {
    match line {
        Line::Solid => &[],
        Line::Dashed => &[3.6, 1.8],
        Line::Dotted => &[1.0, 1.5],
        Line::DashDot => &[4.8, 1.6, 1.0, 1.6],
    }
}
