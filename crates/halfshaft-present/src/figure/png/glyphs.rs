//! Text as outlines of the embedded font.

use tiny_skia::{PathBuilder, Transform};
use ttf_parser::OutlineBuilder;

use super::Canvas;
use crate::figure::font;
use crate::figure::scene::{Align, Stroke, Text, Weight};

/// Width of the white edge around letters on both sides together, as in the SVG.
const HALO: f64 = 2.0;

impl Canvas {
    /// Draws a line of text.
    pub(super) fn text(&mut self, text: &Text) {
        let outlines = outlines(text);
        let Some(shape) = outlines.finish() else { return };
        let turn = if text.upright { -90.0 } else { 0.0 };
        let (x, y) = (text.place.x as f32, text.place.y as f32);
        let place = Transform::from_translate(x, y).pre_rotate(turn);
        let Some(shape) = shape.transform(place) else { return };
        if text.halo {
            self.stroke(&shape, &Stroke::solid((255, 255, 255), HALO));
        }
        self.fill(&shape, text.colour, 1.0);
    }
}

/// The outlines of all letters around the place of the text.
fn outlines(text: &Text) -> PathBuilder {
    let width = text.rich.width(text.size, text.weight);
    let mut pen = Pen {
        builder: PathBuilder::new(),
        scale: 1.0,
        x: match text.align {
            Align::Start => 0.0,
            Align::Middle => -0.5 * width,
            Align::End => -width,
        },
        y: 0.0,
    };
    for run in &text.rich.runs {
        let size = run.level.size(text.size);
        pen.y = -run.level.rise(text.size);
        for c in run.text.chars() {
            pen.letter(c, text.weight, size);
        }
    }
    pen.builder
}

/// Draws letters one after the other.
struct Pen {
    builder: PathBuilder,
    /// Points per font unit.
    scale: f64,
    x: f64,
    y: f64,
}

impl Pen {
    fn letter(&mut self, c: char, weight: Weight, size: f64) {
        self.scale = size / font::units_per_size(c, weight);
        font::outline(c, weight, self);
        self.x += font::advance(c, weight) * size;
    }

    /// From font units, with y upwards, to points around the place of the text.
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        let across = self.x + self.scale * f64::from(x);
        let down = self.y - self.scale * f64::from(y);
        (across as f32, down as f32)
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.builder.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.builder.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.builder.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2)) = (self.place(x1, y1), self.place(x2, y2));
        let (x, y) = self.place(x, y);
        self.builder.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.builder.close();
    }
}
