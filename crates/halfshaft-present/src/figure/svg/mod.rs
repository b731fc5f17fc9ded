//! Figures as SVG text.
//!
//! Texts are real `<text>` elements, so they can be searched, read aloud and restyled. The page
//! names DejaVu Sans, for which the layout is made, and leaves slack for a viewer that lacks it.
//! Every group has a class (`hs-curve`, `hs-axis-text`, ...). Coordinates are rounded to 0.01 points,
//! and equal figures give equal bytes.

use std::fmt::Write;

use super::compose::compose;
use super::panel::Figure;
use super::scene::{Disc, Fill, Path, Primitive, Role, Scene, Shape, Stroke};
use super::typeset::{Rich, xml_escape};
use number::{Hundredths, path_data};

mod number;
mod text;

/// The fonts that a viewer may use, the best first.
pub(super) const FONTS: &str = "'DejaVu Sans', Verdana, sans-serif";

/// Pixels of a screen per point.
pub(super) const PIXELS_PER_POINT: f64 = 96.0 / 72.0;

/// How the text is to be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SvgOptions {
    /// For pasting into an HTML page: without XML header, shrinking with a narrow page.
    pub embed_in_html: bool,
}

/// Writes a figure.
#[must_use]
pub fn render(figure: &Figure, options: &SvgOptions) -> String {
    let title = Rich::parse(&figure.title).text();
    let head = Head {
        id: &figure.id,
        title: if title.is_empty() { &figure.id } else { &title },
        description: &Rich::parse(&figure.caption).text(),
    };
    document(&compose(figure), &head, options)
}

/// What stands at the beginning of a document, without marks.
pub(crate) struct Head<'t> {
    pub(crate) id: &'t str,
    pub(crate) title: &'t str,
    pub(crate) description: &'t str,
}

/// Writes a composed scene.
pub(crate) fn document(scene: &Scene, head: &Head<'_>, options: &SvgOptions) -> String {
    let mut out = String::with_capacity(4096 + 8 * scene.corners());
    open(&mut out, head, scene, options);
    for group in scene.primitives.chunk_by(|a, b| a.role == b.role) {
        write_group(&mut out, group);
    }
    out.push_str("</svg>\n");
    out
}

// Writing to a string cannot fail, so the results of `write!` below carry no news.

/// The id of a figure's element: ASCII letters, digits, `-` and `_` only. What is none of these
/// stands as its code point, so that different ids stay different.
fn element_id(id: &str) -> String {
    let mut element = String::from("hs-");
    for c in id.chars() {
        if c.is_ascii_alphanumeric() || c == '-' {
            element.push(c);
        } else {
            let _ = write!(element, "_{:x}_", u32::from(c));
        }
    }
    element
}

fn open(out: &mut String, head: &Head<'_>, scene: &Scene, options: &SvgOptions) {
    let id = element_id(head.id);
    let title = xml_escape(head.title);
    let (width, height) = (Hundredths::of(scene.width), Hundredths::of(scene.height));
    let pixels = |length: f64| Hundredths::of(length * PIXELS_PER_POINT);
    if !options.embed_in_html {
        out.push_str("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    }
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" id=\"{id}\" class=\"hs-figure\" \
         viewBox=\"0 0 {width} {height}\" width=\"{}\" height=\"{}\" role=\"img\" \
         aria-label=\"{title}\" aria-describedby=\"{id}-desc\" font-family=\"{FONTS}\"",
        pixels(scene.width),
        pixels(scene.height),
    );
    if options.embed_in_html {
        out.push_str(" style=\"max-width:100%;height:auto\"");
    }
    let caption = xml_escape(head.description);
    let _ = writeln!(out, ">\n<title>{title}</title>\n<desc id=\"{id}-desc\">{caption}</desc>");
}

fn write_group(out: &mut String, group: &[Primitive]) {
    let Some(first) = group.first() else { return };
    let _ = writeln!(out, "<g class=\"hs-{}\">", class(first.role));
    for primitive in group {
        match &primitive.shape {
            Shape::Path(path) => write_path(out, path),
            Shape::Disc(disc) => write_disc(out, disc),
            Shape::Text(text) => text::write_text(out, text),
        }
    }
    out.push_str("</g>\n");
}

fn class(role: Role) -> &'static str {
    match role {
        Role::Background => "background",
        Role::Title => "title",
        Role::Grid => "grid",
        Role::Frame => "frame",
        Role::TickLabel => "tick-label",
        Role::AxisText => "axis-text",
        Role::Region => "region",
        Role::Reference => "reference",
        Role::Curve => "curve",
        Role::Marker => "marker",
        Role::Annotation => "annotation",
        Role::Legend => "legend",
    }
}

fn write_path(out: &mut String, path: &Path) {
    out.push_str("<path d=\"");
    for run in &path.runs {
        path_data(out, run, path.closed);
    }
    out.push('"');
    write_paint(out, path.fill.as_ref(), path.stroke.as_ref());
    out.push_str("/>\n");
}

fn write_disc(out: &mut String, disc: &Disc) {
    let (x, y) = (Hundredths::of(disc.centre.x), Hundredths::of(disc.centre.y));
    let radius = Hundredths::of(disc.radius);
    let _ = write!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"");
    write_paint(out, disc.fill.as_ref(), disc.stroke.as_ref());
    out.push_str("/>\n");
}

fn write_paint(out: &mut String, fill: Option<&Fill>, stroke: Option<&Stroke>) {
    match fill {
        None => out.push_str(" fill=\"none\""),
        Some(fill) => {
            let _ = write!(out, " fill=\"{}\"", hex(fill.colour));
            if fill.opacity < 1.0 {
                let _ = write!(out, " fill-opacity=\"{}\"", Hundredths::of(fill.opacity));
            }
        }
    }
    if let Some(stroke) = stroke {
        let width = Hundredths::of(stroke.width);
        let colour = hex(stroke.colour);
        let _ =
            write!(out, " stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"");
        if !stroke.dash.is_empty() {
            let lengths: Vec<String> =
                stroke.dash.iter().map(|&length| Hundredths::of(length).to_string()).collect();
            let _ = write!(out, " stroke-dasharray=\"{}\"", lengths.join(" "));
        }
    }
}

fn hex((red, green, blue): (u8, u8, u8)) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}
