//! Colours that stay apart for colour-blind readers and on grey print.

use serde::Serialize;

/// A colour by name. The named ones are the palette of M. Okabe and K. Ito ("Color universal
/// design", 2008) without its yellow, which is too pale for lines on white.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Colour {
    /// The first choice for the result itself.
    #[default]
    Blue,
    /// The first choice for danger: limits, folds, unstable zones.
    Vermillion,
    /// The first choice for what is safe.
    Green,
    /// A further curve.
    Purple,
    /// A further curve.
    Orange,
    /// A further curve.
    Sky,
    /// Measured data, or the text colour.
    Black,
    /// Helping lines such as a backbone curve.
    Grey,
    /// Any other colour as red, green, blue.
    Rgb(u8, u8, u8),
}

impl Colour {
    /// The result that the figure is about.
    pub const PRIMARY: Self = Self::Blue;
    /// A limit, a jump, an unsafe zone.
    pub const DANGER: Self = Self::Vermillion;
    /// A safe zone.
    pub const SAFE: Self = Self::Green;
    /// Something that helps to read the figure.
    pub const AUXILIARY: Self = Self::Grey;

    /// The colours in the order in which curves should take them; starts again after the last.
    #[must_use]
    pub fn index(index: usize) -> Self {
        const ORDER: [Colour; 7] = [
            Colour::Blue,
            Colour::Vermillion,
            Colour::Green,
            Colour::Orange,
            Colour::Purple,
            Colour::Sky,
            Colour::Black,
        ];
        ORDER[index % ORDER.len()]
    }

    /// Red, green and blue, 0 to 255.
    #[must_use]
    pub fn rgb(self) -> (u8, u8, u8) {
        match self {
            Self::Blue => (0, 114, 178),
            Self::Vermillion => (213, 94, 0),
            Self::Green => (0, 158, 115),
            Self::Purple => (204, 121, 167),
            Self::Orange => (230, 159, 0),
            Self::Sky => (86, 180, 233),
            Self::Black => (26, 26, 26),
            Self::Grey => (115, 115, 115),
            Self::Rgb(red, green, blue) => (red, green, blue),
        }
    }

    /// The colour as `#rrggbb`.
    #[must_use]
    pub fn hex(self) -> String {
        let (red, green, blue) = self.rgb();
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}
