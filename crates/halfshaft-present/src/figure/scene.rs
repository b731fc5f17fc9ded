//! A composed figure: a flat list of shapes on a page, from back to front.
//!
//! A back end only has to draw paths, discs and lines of text. All lines are already cut at the
//! border of their panel, so it needs no clipping.

pub use super::font::Weight;
pub use super::geometry::Point;
pub use super::typeset::{Level, Rich, Run};

/// Everything on the page.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Width in points.
    pub width: f64,
    /// Height in points.
    pub height: f64,
    /// The shapes from back to front.
    pub primitives: Vec<Primitive>,
}

/// One shape and what it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Primitive {
    /// What it stands for.
    pub role: Role,
    /// What is drawn.
    pub shape: Shape,
}

/// What a shape stands for; back ends may use it to group shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The page.
    Background,
    /// The heading.
    Title,
    /// The lines behind the data.
    Grid,
    /// The border of a panel and its marks.
    Frame,
    /// Numbers along an axis.
    TickLabel,
    /// Quantity and unit of an axis.
    AxisText,
    /// Filled areas.
    Region,
    /// Straight lines across the panel.
    Reference,
    /// Curves.
    Curve,
    /// Points.
    Marker,
    /// Texts between the axes.
    Annotation,
    /// The legend.
    Legend,
}

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Lines or areas with straight sides.
    Path(Path),
    /// A disc or circle.
    Disc(Disc),
    /// A line of text.
    Text(Text),
}

/// Lines or areas with straight sides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// The corners of each part.
    pub runs: Vec<Vec<Point>>,
    /// Whether the last corner of each part is joined to the first.
    pub closed: bool,
    /// How it is filled.
    pub fill: Option<Fill>,
    /// How it is outlined.
    pub stroke: Option<Stroke>,
}

/// A disc or circle.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// Its middle.
    pub centre: Point,
    /// Its radius in points.
    pub radius: f64,
    /// How it is filled.
    pub fill: Option<Fill>,
    /// How it is outlined.
    pub stroke: Option<Stroke>,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The text with its levels.
    pub rich: Rich,
    /// The place on the base line that `align` speaks of.
    pub place: Point,
    /// Which part of the text lies at the place.
    pub align: Align,
    /// Whether the text reads upwards.
    pub upright: bool,
    /// Font size in points.
    pub size: f64,
    /// Thickness of the letters.
    pub weight: Weight,
    /// Colour of the letters.
    pub colour: Ink,
    /// Whether a white edge keeps the letters readable on top of lines.
    pub halo: bool,
}

/// Which part of a text lies at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// The beginning.
    Start,
    /// The middle.
    Middle,
    /// The end.
    End,
}

/// Red, green and blue, 0 to 255.
pub type Ink = (u8, u8, u8);

/// How an area is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fill {
    /// Its colour.
    pub colour: Ink,
    /// 0 (not seen) to 1 (hides what is behind).
    pub opacity: f64,
}

/// How a line is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Ink,
    /// Its width in points.
    pub width: f64,
    /// Lengths of dashes and gaps in turn, in points; empty for an unbroken line.
    pub dash: Vec<f64>,
}

impl Fill {
    /// A fill that hides what is behind.
    #[must_use]
    pub fn solid(colour: Ink) -> Self {
        Self { colour, opacity: 1.0 }
    }
}

impl Stroke {
    /// An unbroken line.
    #[must_use]
    pub fn solid(colour: Ink, width: f64) -> Self {
        Self { colour, width, dash: Vec::new() }
    }
}

impl Scene {
    /// Number of corners of all paths: what the size of a file depends on.
    #[must_use]
    pub fn corners(&self) -> usize {
        let of = |primitive: &Primitive| match &primitive.shape {
            Shape::Path(path) => path.runs.iter().map(Vec::len).sum(),
            Shape::Disc(_) | Shape::Text(_) => 0,
        };
        self.primitives.iter().map(of).sum()
    }
}
