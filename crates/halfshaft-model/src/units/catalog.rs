//! The units that a driveline engineer writes, with their SI values.
//!
//! Values are exact by definition where the SI brochure, the international yard and
//! pound agreement, or a rotation make them so.

use std::f64::consts::PI;

use super::dimension::Dimension;

/// One unit name.
pub(super) struct Unit {
    pub(super) name: &'static str,
    /// Value in SI units.
    pub(super) factor: f64,
    pub(super) dimension: Dimension,
    /// Whether decimal prefixes (k, m, ...) may stand before the name.
    pub(super) prefixes: bool,
}

const fn unit(name: &'static str, factor: f64, dimension: Dimension, prefixes: bool) -> Unit {
    Unit { name, factor, dimension, prefixes }
}

const POUND: f64 = 0.453_592_37;
const STANDARD_GRAVITY: f64 = 9.806_65;
const FOOT: f64 = 0.304_8;
const INCH: f64 = 0.025_4;

/// Every known unit name; order decides nothing.
pub(super) static UNITS: &[Unit] = &[
    unit("g", 1e-3, Dimension::MASS, true),
    unit("t", 1e3, Dimension::MASS, false),
    unit("lb", POUND, Dimension::MASS, false),
    // Workshops write lb-ft for a torque. No dimension fits both readings, so that the place where
    // it stands tells them apart.
    unit("lb", POUND * STANDARD_GRAVITY, Dimension::FORCE, false),
    unit("lbm", POUND, Dimension::MASS, false),
    unit("slug", POUND * STANDARD_GRAVITY / FOOT, Dimension::MASS, false),
    unit("m", 1.0, Dimension::LENGTH, true),
    unit("in", INCH, Dimension::LENGTH, false),
    unit("inch", INCH, Dimension::LENGTH, false),
    unit("ft", FOOT, Dimension::LENGTH, false),
    unit("s", 1.0, Dimension::TIME, true),
    unit("sec", 1.0, Dimension::TIME, false),
    unit("min", 60.0, Dimension::TIME, false),
    unit("h", 3600.0, Dimension::TIME, false),
    unit("rad", 1.0, Dimension::ANGLE, true),
    unit("deg", PI / 180.0, Dimension::ANGLE, false),
    unit("°", PI / 180.0, Dimension::ANGLE, false),
    unit("degree", PI / 180.0, Dimension::ANGLE, false),
    unit("degrees", PI / 180.0, Dimension::ANGLE, false),
    unit("arcmin", PI / 10_800.0, Dimension::ANGLE, false),
    unit("rev", 2.0 * PI, Dimension::ANGLE, false),
    unit("turn", 2.0 * PI, Dimension::ANGLE, false),
    unit("U", 2.0 * PI, Dimension::ANGLE, false),
    unit("rpm", PI / 30.0, Dimension::SPEED, false),
    unit("Hz", 2.0 * PI, Dimension::SPEED, true),
    unit("N", 1.0, Dimension::FORCE, true),
    unit("kgf", STANDARD_GRAVITY, Dimension::FORCE, false),
    unit("kp", STANDARD_GRAVITY, Dimension::FORCE, false),
    unit("lbf", POUND * STANDARD_GRAVITY, Dimension::FORCE, false),
    unit("ozf", POUND * STANDARD_GRAVITY / 16.0, Dimension::FORCE, false),
    unit("J", 1.0, Dimension::TORQUE, true),
    unit("W", 1.0, Dimension::POWER, true),
    unit("Pa", 1.0, Dimension::PRESSURE, true),
    unit("bar", 1e5, Dimension::PRESSURE, true),
    unit("psi", POUND * STANDARD_GRAVITY / (INCH * INCH), Dimension::PRESSURE, false),
    unit("%", 1e-2, Dimension::NONE, false),
];

/// Decimal prefixes with their factors.
pub(super) static PREFIXES: &[(&str, f64)] = &[
    ("n", 1e-9),
    ("µ", 1e-6),
    ("μ", 1e-6),
    ("u", 1e-6),
    ("m", 1e-3),
    ("c", 1e-2),
    ("d", 1e-1),
    ("h", 1e2),
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
];

/// All readings of `text` as one unit, plain or with a prefix.
pub(super) fn readings(text: &str) -> impl Iterator<Item = (f64, Dimension)> + '_ {
    let plain = UNITS.iter().filter(move |u| u.name == text).map(|u| (u.factor, u.dimension));
    let prefixed = PREFIXES.iter().flat_map(move |(prefix, scale)| {
        let rest = text.strip_prefix(prefix).unwrap_or("");
        UNITS
            .iter()
            .filter(move |u| u.prefixes && u.name == rest)
            .map(move |u| (u.factor * scale, u.dimension))
    });
    plain.chain(prefixed)
}

/// The known unit whose name is nearest to `text`, for "did you mean"; more than half of the
/// letters must be right, or every short unit would be near to every other.
pub(super) fn nearest(text: &str) -> Option<String> {
    let length = text.chars().count();
    let plain = UNITS.iter().map(|u| u.name.to_owned());
    let common = ["kg", "mm", "cm", "kN", "Nm", "ms", "kHz", "GPa", "MPa"].map(str::to_owned);
    plain
        .chain(common)
        .map(|name| (strsim::damerau_levenshtein(&name.to_lowercase(), &text.to_lowercase()), name))
        .filter(|(distance, name)| {
            let letters = name.chars().count();
            *distance <= 1.max(letters / 3) && 2 * distance < letters.max(length)
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: definitions (kg = 1000 g; 1 lbf·ft = 1.355 817 948 331 4 N·m, NIST SP 811).
    #[test]
    fn prefixed_and_customary_units_have_their_defined_values() {
        let kilogram = readings("kg").next().expect("kg is known");
        assert_eq!(kilogram, (1.0, Dimension::MASS));
        let (pound_force, _) = readings("lbf").next().expect("lbf is known");
        assert!((pound_force * FOOT - 1.355_817_948_331_400_4).abs() < 1e-15);
    }

    #[test]
    fn only_units_that_are_near_are_proposed() {
        assert_eq!(nearest("rmp").as_deref(), Some("rpm"));
        assert_eq!(nearest("hz").as_deref(), Some("Hz"));
        for word in ["x", "Q", "xy", "furlong"] {
            assert_eq!(nearest(word), None, "{word}");
        }
    }

    #[test]
    fn a_text_may_have_two_readings() {
        // "min" is minutes, and a milli-inch is never written "min" because the inch takes no prefix.
        assert_eq!(readings("min").count(), 1);
        // "ms" is a millisecond only as one unit; metre-second is found by splitting the word.
        assert_eq!(readings("ms").count(), 1);
    }
}
