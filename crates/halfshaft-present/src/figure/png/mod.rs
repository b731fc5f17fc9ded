//! Figures as PNG pictures, drawn with the embedded font so that they look the same everywhere.

use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path as SkiaPath, PathBuilder, Pixmap,
    Stroke as SkiaStroke, StrokeDash, Transform,
};

use super::compose::compose;
use super::error::FigureError;
use super::panel::Figure;
use super::scene::{Disc, Fill, Ink, Path, Scene, Shape, Stroke};
use super::svg::PIXELS_PER_POINT;

mod glyphs;
mod resolution;

/// Sharp on paper and on dense screens: 192 pixels per inch.
pub const DEFAULT_SCALE: f64 = 2.0;

/// Longest side of a picture in pixels.
const LONGEST_SIDE: f64 = 20_000.0;
/// Most pixels of a picture; each takes four bytes.
const MOST_PIXELS: f64 = 1.2e8;

/// Draws a figure. A scale of 1 gives 96 pixels per inch, the size that the SVG has on a screen.
///
/// # Errors
///
/// If the scale gives no pixel, or more than fit in memory.
pub fn render(figure: &Figure, scale: f64) -> Result<Vec<u8>, FigureError> {
    draw(&compose(figure), scale)
}

/// Draws a scene, see [`render`].
pub(crate) fn draw(scene: &Scene, scale: f64) -> Result<Vec<u8>, FigureError> {
    let factor = scale * PIXELS_PER_POINT;
    let mut canvas = Canvas::new(scene, factor)?;
    for primitive in &scene.primitives {
        match &primitive.shape {
            Shape::Path(path) => canvas.path(path),
            Shape::Disc(disc) => canvas.disc(disc),
            Shape::Text(text) => canvas.text(text),
        }
    }
    let encoded = canvas.pixels.encode_png();
    let bytes = encoded.map_err(|e| FigureError::Encoding { reason: e.to_string() })?;
    Ok(resolution::stated(bytes, 96.0 * scale))
}

/// The picture while it is drawn.
struct Canvas {
    pixels: Pixmap,
    /// From points to pixels.
    to_pixels: Transform,
}

impl Canvas {
    fn new(scene: &Scene, factor: f64) -> Result<Self, FigureError> {
        let (width, height) = ((scene.width * factor).round(), (scene.height * factor).round());
        let refused = || FigureError::PictureSize { width, height };
        let sides = 1.0..=LONGEST_SIDE;
        if !sides.contains(&width) || !sides.contains(&height) || width * height > MOST_PIXELS {
            return Err(refused());
        }
        let pixels = Pixmap::new(width as u32, height as u32).ok_or_else(refused)?;
        let factor = factor as f32;
        Ok(Self { pixels, to_pixels: Transform::from_scale(factor, factor) })
    }

    fn path(&mut self, path: &Path) {
        let mut builder = PathBuilder::new();
        for run in &path.runs {
            for (index, point) in run.iter().enumerate() {
                let (x, y) = (point.x as f32, point.y as f32);
                if index == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
            }
            if path.closed {
                builder.close();
            }
        }
        if let Some(shape) = builder.finish() {
            self.paint(&shape, path.fill.as_ref(), path.stroke.as_ref());
        }
    }

    fn disc(&mut self, disc: &Disc) {
        let (x, y) = (disc.centre.x as f32, disc.centre.y as f32);
        if let Some(shape) = PathBuilder::from_circle(x, y, disc.radius as f32) {
            self.paint(&shape, disc.fill.as_ref(), disc.stroke.as_ref());
        }
    }

    fn paint(&mut self, shape: &SkiaPath, fill: Option<&Fill>, stroke: Option<&Stroke>) {
        if let Some(fill) = fill {
            self.fill(shape, fill.colour, fill.opacity);
        }
        if let Some(stroke) = stroke {
            self.stroke(shape, stroke);
        }
    }

    fn fill(&mut self, shape: &SkiaPath, colour: Ink, opacity: f64) {
        let paint = paint(colour, opacity);
        self.pixels.fill_path(shape, &paint, FillRule::Winding, self.to_pixels, None);
    }

    fn stroke(&mut self, shape: &SkiaPath, stroke: &Stroke) {
        let pen = SkiaStroke {
            width: stroke.width as f32,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            ..SkiaStroke::default()
        };
        // A line with too many dashes for the rasteriser is drawn unbroken rather than not at all.
        let dashes = stroke.dash.iter().map(|&length| length as f32).collect();
        let dashed = StrokeDash::new(dashes, 0.0).and_then(|dash| shape.dash(&dash, 1.0));
        let shape = dashed.as_ref().unwrap_or(shape);
        self.pixels.stroke_path(shape, &paint(stroke.colour, 1.0), &pen, self.to_pixels, None);
    }
}

fn paint((red, green, blue): Ink, opacity: f64) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint
}
