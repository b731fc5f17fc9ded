//! Figures: described as data, composed once, written by small back ends.
//!
//! | step | type or function | knows |
//! |---|---|---|
//! | 1. describe | [`Figure`], [`Panel`], [`Axis`], [`Item`] | quantities, units, names |
//! | 2. compose | [`compose()`] gives a [`scene::Scene`] | points on a page; margins, ticks, legends |
//! | 3. write | [`svg::render`], [`png::render`] | one file format |
//!
//! [`plotly::figure_json`] skips the second step: the browser lays out the figure itself.
//!
//! Every description gives a figure. Values that are not finite break a curve, an empty panel says
//! that it is empty, and a text may hold any Unicode. Lengths are points (1/72 inch).
//!
//! ```
//! use halfshaft_present::figure::{Axis, Colour, Curve, Figure, Panel, svg};
//!
//! let time: Vec<f64> = (0..200).map(|i| f64::from(i) * 0.005).collect();
//! let twist = time.iter().map(|t| (-2.0 * t).exp() * (40.0 * t).cos()).collect();
//! let panel = Panel::new(Axis::new("Time", "s"), Axis::new("Shaft twist θ", "mrad"))
//!     .with(Curve::new("free decay", time, twist, Colour::PRIMARY));
//! let figure = Figure::new("decay", "Free decay of the shaft").with(panel);
//! let text = svg::render(&figure, &svg::SvgOptions::default());
//! assert!(text.contains("Shaft twist"));
//! ```

pub use axis::{Axis, Scale, Secondary};
pub use colour::Colour;
pub use compose::compose;
pub use error::FigureError;
pub use item::{Anchor, Curve, Direction, Item, Label, Line, Marker, Points, Reference, Region};
pub use panel::{Corner, Figure, LegendPlace, Panel, Size};
pub use svg::SvgOptions;
pub use typeset::escape;

pub mod plotly;
pub mod png;
pub mod scene;
pub mod svg;

mod axis;
mod colour;
mod compose;
mod error;
mod font;
mod geometry;
mod item;
mod panel;
mod ticks;
mod typeset;
mod view;
