//! PNG pictures.

use halfshaft_present::figure::png::{DEFAULT_SCALE, render};
use halfshaft_present::figure::{FigureError, Size};
use tiny_skia::Pixmap;

use super::samples::{diagonal, one_of_each};

fn colour_at(picture: &Pixmap, x: f64, y: f64) -> (u8, u8, u8) {
    let pixel = picture.pixel(x as u32, y as u32).expect("inside the picture").demultiply();
    (pixel.red(), pixel.green(), pixel.blue())
}

/// Oracle: a decoder; 6.4 x 4.2 inches at 192 pixels per inch; white paper in the corner.
#[test]
fn the_picture_has_the_stated_size() {
    let bytes = render(&diagonal(), DEFAULT_SCALE).unwrap();
    let picture = Pixmap::decode_png(&bytes).unwrap();
    assert_eq!((picture.width(), picture.height()), (1229, 806));
    assert_eq!(colour_at(&picture, 0.0, 0.0), (255, 255, 255));
    let inked = picture.pixels().iter().filter(|pixel| pixel.red() < 200).count();
    let share = inked as f64 / f64::from(picture.width() * picture.height());
    assert!((0.005..0.2).contains(&share), "{share} of the paper is inked");
}

/// Oracle: symmetry. The middle of the frame, found by its dark sides, lies on the diagonal.
#[test]
fn the_curve_has_its_colour_in_the_middle_of_the_frame() {
    let picture = Pixmap::decode_png(&render(&diagonal(), 2.0).unwrap()).unwrap();
    let (width, height) = (f64::from(picture.width()), f64::from(picture.height()));
    let dark = |x: f64, y: f64| colour_at(&picture, x, y).0 < 100;
    let along = |count: f64, dark: &dyn Fn(f64) -> bool| {
        let found: Vec<f64> = (0..count as u32).map(f64::from).filter(|&at| dark(at)).collect();
        0.5 * (found[0] + found[found.len() - 1])
    };
    // A row and a column that meet the frame but no number and no mark.
    let across = along(width, &|x| (0.4..0.6).any_row(height, |y| dark(x, y)));
    let down = along(height, &|y| (0.4..0.6).any_row(width, |x| dark(x, y)));
    let near = |dx: i32, dy: i32| {
        let (r, g, b) = colour_at(&picture, across + f64::from(dx), down + f64::from(dy));
        r < 60 && (90..140).contains(&g) && b > 150
    };
    let blue = (-6..=6).any(|dx| (-6..=6).any(|dy| near(dx, dy)));
    assert!(blue, "no blue at {across}, {down}");
}

/// Whether all points of a share of a length have a property.
trait Stretch {
    fn any_row(&self, length: f64, property: impl Fn(f64) -> bool) -> bool;
}

impl Stretch for std::ops::Range<f64> {
    fn any_row(&self, length: f64, property: impl Fn(f64) -> bool) -> bool {
        let (from, to) = ((self.start * length) as u32, (self.end * length) as u32);
        (from..to).map(f64::from).all(property)
    }
}

/// Oracle: the PNG specification: the chunk after the header says 7559 pixels per metre, which is
/// 192 per inch.
#[test]
fn the_resolution_is_stated() {
    let bytes = render(&diagonal(), 2.0).unwrap();
    assert_eq!(&bytes[37..41], b"pHYs");
    assert_eq!(u32::from_be_bytes(bytes[41..45].try_into().unwrap()), 7559);
}

/// Oracle: the contract of `render`: sizes that cannot be are refused with their numbers.
#[test]
fn impossible_sizes_are_refused() {
    for scale in [0.0, -1.0, 1e-9, 1e9, f64::NAN, f64::INFINITY] {
        let refused = render(&diagonal(), scale);
        assert!(matches!(refused, Err(FigureError::PictureSize { .. })), "{scale}");
    }
    let odd = Size::Points { width: f64::NAN, height: -5.0 };
    assert!(render(&diagonal().with_size(odd), 1.0).is_ok());
}

/// Oracle: equal input gives equal bytes, and letters that no font has do not stop the picture.
#[test]
fn any_letters_can_be_drawn() {
    let figure = one_of_each("漢字 🚗 \u{202e}abc\u{301} \u{0} ﷽");
    assert_eq!(render(&figure, 1.0).unwrap(), render(&figure, 1.0).unwrap());
}
