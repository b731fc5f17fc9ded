//! Numbers with their units.

use super::number::number;

/// The symbol of a unit; pure numbers have none.
pub(crate) fn unit(symbol: &str) -> &str {
    if symbol == "1" { "" } else { symbol }
}

/// A number with its unit: `4853.5 N·m`. The space between them does not break.
pub(crate) fn quantity(value: f64, digits: usize, symbol: &str) -> String {
    let text = number(value, digits);
    match unit(symbol) {
        "" => text,
        symbol => format!("{text}\u{a0}{symbol}"),
    }
}

/// A twist in radians and in degrees: `0.8089 rad (46.35°)`.
pub(crate) fn angle(radians: f64) -> String {
    let degrees = number(radians.to_degrees(), 4);
    format!("{}\u{a0}rad ({degrees}°)", number(radians, 5))
}

/// An angular frequency in all the units that engineers use: `25.04 rad/s (3.985 Hz, 239.1 rpm)`.
pub(crate) fn frequency_words(rad_per_s: f64) -> String {
    format!(
        "{}\u{a0}rad/s ({}\u{a0}Hz, {}\u{a0}rpm)",
        number(rad_per_s, 5),
        number(rad_per_s / std::f64::consts::TAU, 4),
        number(rad_per_s * super::RPM, 5),
    )
}

/// A text whose numbers do not part from their units at the end of a line.
pub(crate) fn bound(text: &str) -> String {
    let mut bound = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(place) = rest.find(' ') {
        let (before, after) = (&rest[..place], &rest[place + 1..]);
        bound.push_str(before);
        let number = before.ends_with(|c: char| c.is_ascii_digit() || "⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c));
        bound.push(if number && begins_with_unit(after) { '\u{a0}' } else { ' ' });
        rest = after;
    }
    bound + rest
}

fn begins_with_unit(text: &str) -> bool {
    let word = text.split(|c: char| c.is_whitespace() || ",;:()".contains(c)).next();
    let word = word.unwrap_or_default().trim_end_matches('.');
    let known = ["%", "s", "ms", "rad", "Hz", "rpm", "J", "times", "1/s", "kg·m²"];
    known.contains(&word) || ["N·m", "rad/", "kN·m"].iter().any(|start| word.starts_with(start))
}

#[cfg(test)]
mod tests {
    use super::{angle, bound, frequency_words, quantity};

    /// Oracle: typesetting: a unit stays with its number, words stay apart.
    #[test]
    fn numbers_keep_their_units() {
        assert_eq!(
            bound("after 2 s (88 % of all), 3 springs"),
            "after 2\u{a0}s (88\u{a0}% of all), 3 springs"
        );
        assert_eq!(bound("carries 7814 N·m. From 2 to 3"), "carries 7814\u{a0}N·m. From 2 to 3");
        assert_eq!(bound("8.5×10⁻¹² rad/s² "), "8.5×10⁻¹²\u{a0}rad/s² ");
    }

    /// Oracle: by hand: 1 rad is 57.2958 degrees; 2π rad/s is 1 Hz and 60 rpm.
    #[test]
    fn units_follow_their_numbers() {
        assert_eq!(quantity(4853.5, 6, "N·m"), "4853.5\u{a0}N·m");
        assert_eq!(quantity(0.25, 3, "1"), "0.25");
        assert_eq!(angle(1.0), "1\u{a0}rad (57.3°)");
        assert_eq!(
            frequency_words(std::f64::consts::TAU),
            "6.2832\u{a0}rad/s (1\u{a0}Hz, 60\u{a0}rpm)"
        );
    }
}
