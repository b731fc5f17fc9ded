//! A drawing of the line: what turns, what twists, what gears, what drives.
//!
//! | step | file |
//! |---|---|
//! | what is written at each part | `caption` |
//! | where every part lies | `layout` |
//! | how the parts look | `symbols` |
//!
//! The longest way through the line runs from left to right and goes on in a further row where a
//! page is too narrow; branches hang below the node that they leave, and connections that close a
//! loop are arcs.

use halfshaft_results::CheckResult;

use crate::figure::svg::{self, Head};
use crate::figure::{FigureError, SvgOptions, png};
use crate::words::plain;
use drawing::Drawing;

mod caption;
mod drawing;
mod layout;
mod symbols;

/// How to read the drawing.
pub(crate) const LEGEND: &str = "Plates are inertias, taller for larger ones (by the logarithm); \
    zigzags are shafts, with an arrow through them where the law is nonlinear; pairs of circles are \
    gears, with input over output speed; hatching is ground; small dots have no inertia of their \
    own; curved arrows are torques.";

/// The drawing of a line as an SVG file.
///
/// ```
/// use halfshaft_present::sketch::sketch;
/// use halfshaft_results::{
///     CheckResult, CheckedShaft, Header, Member, ModelIdentity, ReducedInertia, Termination,
/// };
///
/// let header = Header {
///     analysis: "check".to_owned(),
///     model: ModelIdentity { name: "Pendulum".to_owned(), digest: "00".to_owned() },
///     settings: serde_json::json!({}),
///     termination: Termination::completed(),
///     version: "0.1.0".to_owned(),
///     warnings: Vec::new(),
///     assumptions: Vec::new(),
/// };
/// let disc = Member { node: "disc".to_owned(), inertia: 2.5, ratio: 1.0, damping: 0.0 };
/// let line = CheckResult {
///     header,
///     description: String::new(),
///     grounded: true,
///     degrees_of_freedom: 1,
///     reduced_inertias: vec![ReducedInertia {
///         reference: "disc".to_owned(),
///         inertia: 2.5,
///         members: vec![disc],
///     }],
///     gears: Vec::new(),
///     shafts: vec![CheckedShaft {
///         name: "rod".to_owned(),
///         from: "disc".to_owned(),
///         to: "ground".to_owned(),
///         stiffness: 40.0,
///         damping: 0.0,
///         nonlinear_terms: Vec::new(),
///         loss_factor: 0.0,
///         bar: None,
///     }],
///     torques: Vec::new(),
///     mass_elastic: None,
///     line: None,
/// };
/// // The space before a unit does not break.
/// let drawing = sketch(&line).replace('\u{a0}', " ");
/// assert!(drawing.contains("2.5 kg·m²") && drawing.contains("40 N·m/rad"));
/// ```
#[must_use]
pub fn sketch(check: &CheckResult) -> String {
    write(check, &SvgOptions::default())
}

/// The drawing as a PNG picture; a scale of 1 gives 96 pixels per inch.
///
/// # Errors
/// [`FigureError`] where the picture has no pixel or more than fit in memory.
pub fn picture(check: &CheckResult, scale: f64) -> Result<Vec<u8>, FigureError> {
    png::draw(&Drawing::new(check).finish(), scale)
}

/// The drawing for a page.
pub(crate) fn embedded(check: &CheckResult) -> String {
    write(check, &SvgOptions { embed_in_html: true })
}

fn write(check: &CheckResult, options: &SvgOptions) -> String {
    let scene = Drawing::new(check).finish();
    let title = format!("Sketch of {}", plain(&check.header.model.name));
    svg::document(&scene, &Head { id: "sketch", title: &title, description: LEGEND }, options)
}
