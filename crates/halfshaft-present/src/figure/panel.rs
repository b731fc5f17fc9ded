//! A figure and its panels.

use serde::Serialize;

use super::axis::Axis;
use super::item::Item;

/// One figure: one or more panels, stacked from top to bottom.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Figure {
    /// A short name, unique in a document; becomes part of element ids and file names.
    pub id: String,
    /// The heading drawn above the panels (light typesetting); may be empty.
    pub title: String,
    /// What the reader should see in it. Not drawn: it is the description for screen readers, and
    /// the text that a report sets below the figure.
    pub caption: String,
    /// The panels from top to bottom. Neighbours with equal horizontal axes share that axis.
    pub panels: Vec<Panel>,
    /// The size of the page.
    pub size: Size,
}

/// The size of a figure. A page that a long heading or a long legend would fill becomes higher.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Size {
    /// The width of a text page, 6.4 in; 4.2 in high, and 2 in more for every further panel.
    #[default]
    Single,
    /// As high as [`Size::Single`], but 9 in wide.
    Wide,
    /// The width of one column of a journal, 3.5 in.
    Column,
    /// As wide as high, 5 in.
    Square,
    /// Any other size, in points.
    Points {
        /// Width in points.
        width: f64,
        /// Height in points.
        height: f64,
    },
}

/// One pair of axes with what is drawn between them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn; later items lie on top of earlier ones of the same kind.
    pub items: Vec<Item>,
    /// Where the legend goes.
    pub legend: LegendPlace,
    /// Share of the height compared with the other panels.
    pub height_share: f64,
}

/// Where the legend of a panel goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LegendPlace {
    /// In the emptiest part of the panel, or below it if every part is needed.
    #[default]
    Auto,
    /// In this corner, whatever lies below.
    Inside(Corner),
    /// Below the panel.
    Below,
    /// Nowhere.
    Hidden,
}

/// A corner of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Corner {
    /// Upper left.
    TopLeft,
    /// Upper right.
    TopRight,
    /// Lower left.
    BottomLeft,
    /// Lower right.
    BottomRight,
}

impl Figure {
    /// A figure without panels.
    #[must_use]
    pub fn new(id: impl Into<String>, title: impl Into<String>) -> Self {
        Self { id: id.into(), title: title.into(), ..Self::default() }
    }

    /// Says what the reader should see.
    #[must_use]
    pub fn with_caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
    }

    /// Sets the size.
    #[must_use]
    pub fn with_size(mut self, size: Size) -> Self {
        self.size = size;
        self
    }

    /// Adds a panel below the others.
    #[must_use]
    pub fn with(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Width and height in points, always positive and of a size that can be drawn.
    #[must_use]
    pub fn dimensions(&self) -> (f64, f64) {
        const SMALLEST: f64 = 72.0;
        const LARGEST: f64 = 7200.0;
        let further_panels = self.panels.len().saturating_sub(1) as f64;
        let height = 302.4 + 144.0 * further_panels;
        let (width, height) = match self.size {
            Size::Single => (460.8, height),
            Size::Wide => (648.0, height),
            Size::Column => (252.0, 0.625 * height),
            Size::Square => (360.0, 360.0),
            Size::Points { width, height } => (width, height),
        };
        let sane = |length: f64, usual: f64| {
            if length.is_finite() { length.clamp(SMALLEST, LARGEST) } else { usual }
        };
        (sane(width, 460.8), sane(height, 302.4))
    }
}

impl Panel {
    /// An empty panel.
    #[must_use]
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, items: Vec::new(), legend: LegendPlace::Auto, height_share: 1.0 }
    }

    /// Adds one item.
    #[must_use]
    pub fn with(mut self, item: impl Into<Item>) -> Self {
        self.items.push(item.into());
        self
    }

    /// Adds several items.
    #[must_use]
    pub fn with_all<T: Into<Item>>(mut self, items: impl IntoIterator<Item = T>) -> Self {
        self.items.extend(items.into_iter().map(Into::into));
        self
    }

    /// Places the legend.
    #[must_use]
    pub fn with_legend(mut self, legend: LegendPlace) -> Self {
        self.legend = legend;
        self
    }
}
