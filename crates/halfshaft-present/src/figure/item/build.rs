//! Short ways to make items.

use super::{Anchor, Curve, Direction, Item, Label, Line, Marker, Points, Reference, Region};
use crate::figure::colour::Colour;

impl Curve {
    /// A solid line that the legend names.
    #[must_use]
    pub fn new(name: impl Into<String>, x: Vec<f64>, y: Vec<f64>, colour: Colour) -> Self {
        let name = name.into();
        Self { name, x, y, line: Line::Solid, colour, width: 1.4, in_legend: true }
    }

    /// Changes how the line is broken up.
    #[must_use]
    pub fn with_line(mut self, line: Line) -> Self {
        self.line = line;
        self
    }

    /// Changes the width, in points.
    #[must_use]
    pub fn with_width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Leaves the curve out of the legend.
    #[must_use]
    pub fn unlisted(mut self) -> Self {
        self.in_legend = false;
        self
    }
}

impl Points {
    /// Filled points without texts, named in the legend.
    #[must_use]
    pub fn new(name: impl Into<String>, x: Vec<f64>, y: Vec<f64>, colour: Colour) -> Self {
        let (name, marker, labels) = (name.into(), Marker::Circle, Vec::new());
        Self { name, x, y, marker, filled: true, colour, size: 6.0, labels, in_legend: true }
    }

    /// Changes the shape.
    #[must_use]
    pub fn with_marker(mut self, marker: Marker) -> Self {
        self.marker = marker;
        self
    }

    /// Makes the points white with a coloured edge.
    #[must_use]
    pub fn hollow(mut self) -> Self {
        self.filled = false;
        self
    }

    /// Sets texts beside the points.
    #[must_use]
    pub fn with_labels(mut self, labels: Vec<String>) -> Self {
        self.labels = labels;
        self
    }

    /// Leaves the points out of the legend.
    #[must_use]
    pub fn unlisted(mut self) -> Self {
        self.in_legend = false;
        self
    }
}

impl Region {
    /// A light area that the legend names.
    #[must_use]
    pub fn new(name: impl Into<String>, x: Vec<f64>, y: Vec<f64>, colour: Colour) -> Self {
        Self { name: name.into(), x, y, colour, opacity: 0.18, in_legend: true }
    }

    /// Leaves the area out of the legend.
    #[must_use]
    pub fn unlisted(mut self) -> Self {
        self.in_legend = false;
        self
    }
}

impl Reference {
    /// A dashed line at a value of the vertical axis.
    #[must_use]
    pub fn horizontal(value: f64, label: impl Into<String>, colour: Colour) -> Self {
        let axis = Direction::Horizontal;
        Self { axis, value, label: label.into(), line: Line::Dashed, colour }
    }

    /// A dashed line at a value of the horizontal axis.
    #[must_use]
    pub fn vertical(value: f64, label: impl Into<String>, colour: Colour) -> Self {
        Self { axis: Direction::Vertical, ..Self::horizontal(value, label, colour) }
    }
}

impl Label {
    /// A text centred on a place.
    #[must_use]
    pub fn new(x: f64, y: f64, text: impl Into<String>) -> Self {
        Self { x, y, text: text.into(), anchor: Anchor::Centre, colour: Colour::Black }
    }
}

impl From<Curve> for Item {
    fn from(curve: Curve) -> Self {
        Self::Curve(curve)
    }
}

impl From<Points> for Item {
    fn from(points: Points) -> Self {
        Self::Points(points)
    }
}

impl From<Region> for Item {
    fn from(region: Region) -> Self {
        Self::Region(region)
    }
}

impl From<Reference> for Item {
    fn from(reference: Reference) -> Self {
        Self::Reference(reference)
    }
}

impl From<Label> for Item {
    fn from(label: Label) -> Self {
        Self::Label(label)
    }
}
