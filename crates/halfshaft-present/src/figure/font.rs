//! The embedded font: widths for the layout, outlines for pictures.
//!
//! Two subsets of DejaVu Sans (`assets/fonts`). A bold character that only the regular subset has
//! is taken from there; one that neither has is a box.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

static REGULAR: LazyLock<Face<'static>> =
    LazyLock::new(|| parsed(include_bytes!("../../assets/fonts/DejaVuSans-subset.ttf")));
static BOLD: LazyLock<Face<'static>> =
    LazyLock::new(|| parsed(include_bytes!("../../assets/fonts/DejaVuSans-Bold-subset.ttf")));

/// Height of a capital letter, in units of the font size.
pub(crate) const CAP_HEIGHT: f64 = 0.73;
/// How far letters reach below the base line, in units of the font size.
pub(crate) const DESCENT: f64 = 0.21;
/// Distance of base lines of one paragraph, in units of the font size.
pub(crate) const LINE_HEIGHT: f64 = 1.25;

/// Thickness of the letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// Text.
    Regular,
    /// Headings.
    Bold,
}

fn parsed(data: &'static [u8]) -> Face<'static> {
    Face::parse(data, 0).expect("the embedded font is a file of this crate, parsed by its tests")
}

/// The face and glyph that show a character.
fn glyph(c: char, weight: Weight) -> (&'static Face<'static>, GlyphId) {
    let bold = (weight == Weight::Bold).then(|| BOLD.glyph_index(c)).flatten();
    match bold {
        Some(id) => (&BOLD, id),
        None => (&REGULAR, REGULAR.glyph_index(c).unwrap_or(GlyphId(0))),
    }
}

/// Width of a character in units of the font size.
pub(crate) fn advance(c: char, weight: Weight) -> f64 {
    let (face, id) = glyph(c, weight);
    let units = f64::from(face.glyph_hor_advance(id).unwrap_or(0));
    units / f64::from(face.units_per_em())
}

/// Sends the outline of a character to `sink` in font units; a blank sends nothing.
pub(crate) fn outline(c: char, weight: Weight, sink: &mut dyn OutlineBuilder) {
    let (face, id) = glyph(c, weight);
    // The answer is the bounding box; none is the right answer for a blank.
    let _ = face.outline_glyph(id, sink);
}

/// Number of font units in the font size, for the face that shows a character.
pub(crate) fn units_per_size(c: char, weight: Weight) -> f64 {
    f64::from(glyph(c, weight).0.units_per_em())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oracle: the list of signs that texts of this project use (units, Greek, scripts, arrows).
    #[test]
    fn the_signs_of_the_project_are_there() {
        let signs = "AZaz09·×²³⁻±–—°′″≤≥≈∞√−ΩσρθφωδεζλμπτξΔΣΦΨ…₁₂ₙᵢ⌀→←↔∂∫∑äöüßéñçøłŠé€½θ\u{308}";
        for c in signs.chars() {
            assert_ne!(glyph(c, Weight::Regular).1, GlyphId(0), "{c} is missing");
        }
    }

    /// Oracle: DejaVu Sans 2.37 as published: the digits are 1303 of 2048 units wide, and a box
    /// stands for what is missing.
    #[test]
    fn widths_are_those_of_the_published_font() {
        for c in '0'..='9' {
            assert!((advance(c, Weight::Regular) - 1303.0 / 2048.0).abs() < 1e-12);
        }
        assert!(advance('\u{10ffff}', Weight::Bold) > 0.0);
    }
}
