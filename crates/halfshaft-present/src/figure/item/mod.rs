//! What a panel can show.

use serde::Serialize;

use super::colour::Colour;

mod build;
mod stability;

/// Anything drawn between the axes.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Item {
    /// A line through points.
    Curve(Curve),
    /// Separate points.
    Points(Points),
    /// A filled area.
    Region(Region),
    /// A straight line across the panel at one value.
    Reference(Reference),
    /// A text at a place.
    Label(Label),
}

/// How a line is broken up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Line {
    /// Unbroken: stable, or the only line.
    #[default]
    Solid,
    /// Dashes: unstable.
    Dashed,
    /// Dots.
    Dotted,
    /// Dashes and dots in turn.
    DashDot,
}

/// A line through points; a value that is not finite breaks it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// Its name in the legend (light typesetting). Items of one name share one legend entry.
    pub name: String,
    /// Horizontal values.
    pub x: Vec<f64>,
    /// Vertical values; the longer of the two lists is cut to the shorter.
    pub y: Vec<f64>,
    /// How the line is broken up.
    pub line: Line,
    /// Its colour.
    pub colour: Colour,
    /// Its width in points.
    pub width: f64,
    /// Whether the legend names it.
    pub in_legend: bool,
}

/// The shape of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Marker {
    /// A disc: folds.
    #[default]
    Circle,
    /// A square: branch points.
    Square,
    /// A triangle that points up.
    Triangle,
    /// A triangle that points down.
    TriangleDown,
    /// A square on its corner: period doublings.
    Diamond,
    /// A cross of two diagonals; drawn with lines, never filled.
    Cross,
    /// A cross of two upright lines; drawn with lines, never filled.
    Plus,
    /// A star with five points: cusps.
    Star,
}

/// Separate points; one whose values are not both finite is left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Points {
    /// Their name in the legend (light typesetting).
    pub name: String,
    /// Horizontal values.
    pub x: Vec<f64>,
    /// Vertical values; the longer of the two lists is cut to the shorter.
    pub y: Vec<f64>,
    /// Their shape.
    pub marker: Marker,
    /// Filled with the colour, or white with a coloured edge.
    pub filled: bool,
    /// Their colour.
    pub colour: Colour,
    /// Diameter in points.
    pub size: f64,
    /// Texts set beside the points in turn; may be shorter than the points, or empty.
    pub labels: Vec<String>,
    /// Whether the legend names them.
    pub in_legend: bool,
}

/// A filled area inside a closed line; a value that is not finite starts a further area.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Region {
    /// Its name in the legend (light typesetting).
    pub name: String,
    /// Horizontal values of the corners.
    pub x: Vec<f64>,
    /// Vertical values of the corners; the last corner is joined to the first.
    pub y: Vec<f64>,
    /// Its colour.
    pub colour: Colour,
    /// 0 (not seen) to 1 (hides the grid).
    pub opacity: f64,
    /// Whether the legend names it.
    pub in_legend: bool,
}

/// The direction of a straight line across the panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// At one value of the vertical axis.
    Horizontal,
    /// At one value of the horizontal axis.
    Vertical,
}

/// A straight line across the panel at one value, with an optional text along it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reference {
    /// The direction of the line.
    pub axis: Direction,
    /// The value that it stands for. The shown range is stretched to include it.
    pub value: f64,
    /// Text along the line (light typesetting); may be empty.
    pub label: String,
    /// How the line is broken up.
    pub line: Line,
    /// Its colour.
    pub colour: Colour,
}

/// On which side of its place a text lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Anchor {
    /// The text is centred on the place.
    #[default]
    Centre,
    /// The text ends at the place.
    Left,
    /// The text starts at the place.
    Right,
    /// The text is centred above the place.
    Above,
    /// The text is centred below the place.
    Below,
}

/// A text at a place of the panel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Label {
    /// Horizontal value.
    pub x: f64,
    /// Vertical value.
    pub y: f64,
    /// What it says (light typesetting).
    pub text: String,
    /// On which side of the place the text lies.
    pub anchor: Anchor,
    /// Its colour.
    pub colour: Colour,
}
