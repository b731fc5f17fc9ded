//! Numbers as people read them: few digits, a true minus, powers of ten only where needed.

/// What stands for a number that is missing.
pub(crate) const MISSING: &str = "–";

/// A number to so many significant digits, without needless zeros: `7814.18`, `−0.0123`,
/// `8.53×10⁻¹²`. A whole part is never rounded away: `28247` to four digits stays `28247`.
pub(crate) fn number(value: f64, digits: usize) -> String {
    if value.is_nan() {
        return MISSING.to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞".to_owned() } else { "−∞".to_owned() };
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = digits.clamp(1, 17);
    let (mantissa, exponent) = scientific(value.abs(), digits);
    let text = if (-4..7).contains(&exponent) {
        let places = digits as i64 - 1 - i64::from(exponent);
        trimmed(&format!("{:.*}", usize::try_from(places).unwrap_or(0), value.abs()))
    } else {
        format!("{}×10{}", trimmed(&mantissa), superscript(exponent))
    };
    signed(value, &text)
}

/// A number with just so many decimals.
pub(crate) fn decimals(value: f64, places: usize) -> String {
    if !value.is_finite() {
        return number(value, 1);
    }
    let text = format!("{:.*}", places, value.abs());
    let zero = text.chars().all(|c| matches!(c, '0' | '.'));
    if zero { text } else { signed(value, &text) }
}

/// Decimals that give a value so many digits; at most 12, and none where it is zero or no number.
pub(crate) fn places(value: f64, digits: usize) -> usize {
    if value == 0.0 || !value.is_finite() {
        return 0;
    }
    let places = digits as i64 - 1 - i64::from(scientific(value.abs(), digits.max(1)).1);
    usize::try_from(places).unwrap_or(0).min(12)
}

/// Decimals that give the largest of some values so many digits, if the others still show; `None`
/// where each value needs its own.
pub(crate) fn common_decimals(values: &[f64], digits: usize) -> Option<usize> {
    let sizes = || values.iter().map(|v| v.abs()).filter(|v| v.is_finite() && *v > 0.0);
    let (low, high) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    if high == 0.0 {
        return Some(0);
    }
    let places = places(high, digits);
    let smallest_shown = 0.1_f64.powi(i32::try_from(places).unwrap_or(12));
    let calm = (1e-3..1e7).contains(&high) && low >= 10.0 * smallest_shown;
    let needed = |value: f64| {
        let text = format!("{value:.places$}");
        trimmed(&text).split_once('.').map_or(0, |(_, fraction)| fraction.len())
    };
    calm.then(|| sizes().map(needed).max().unwrap_or(0))
}

/// A share as a percentage: `1.25 %`.
pub(crate) fn percent(share: f64, digits: usize) -> String {
    format!("{}\u{a0}%", number(100.0 * share, digits))
}

/// A factor: `1.61 times`.
pub(crate) fn times(factor: f64) -> String {
    format!("{}\u{a0}times", number(factor, 3))
}

/// Mantissa with so many digits, and exponent, of a positive number.
fn scientific(size: f64, digits: usize) -> (String, i32) {
    let text = format!("{:.*e}", digits - 1, size);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    (mantissa.to_owned(), exponent.parse().unwrap_or(0))
}

fn signed(value: f64, text: &str) -> String {
    if value < 0.0 { format!("−{text}") } else { text.to_owned() }
}

/// Without zeros at the end of a fraction.
fn trimmed(text: &str) -> String {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
    }
}

fn superscript(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' | '4'..='9' => char::from_u32(0x2070 + c as u32 - '0' as u32).unwrap_or(c),
        other => other,
    };
    exponent.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::{common_decimals, decimals, number, percent};
    use proptest::prelude::{any, prop_assert, proptest};

    /// Oracle: by hand.
    #[test]
    fn numbers_read_as_in_print() {
        let shown: Vec<String> =
            [7814.175153740371, -0.012345678, 28247.37, 0.0, 850.0, 1e7, 8.526e-12, f64::NAN]
                .iter()
                .map(|value| number(*value, 4))
                .collect();
        assert_eq!(shown, ["7814", "−0.01235", "28247", "0", "850", "1×10⁷", "8.526×10⁻¹²", "–"]);
        assert_eq!(number(9.99996, 5), "10");
        assert_eq!(number(f64::NEG_INFINITY, 5), "−∞");
        assert_eq!(decimals(-0.001, 2), "0.00");
        assert_eq!(decimals(-4853.5, 2), "−4853.50");
        assert_eq!(percent(0.0123, 3), "1.23\u{a0}%");
    }

    /// Oracle: the definition, by hand: 115.13 to five digits has two decimals.
    #[test]
    fn a_column_shares_its_decimals_where_all_values_show() {
        assert_eq!(common_decimals(&[0.0, 25.04, 115.1306], 5), Some(2));
        assert_eq!(common_decimals(&[6420.0, 21000.0], 6), Some(0));
        assert_eq!(common_decimals(&[2.8, 4.4e-5], 4), None);
        assert_eq!(common_decimals(&[0.0, f64::NAN], 4), Some(0));
    }

    /// The number that a reader gets from the text.
    fn read(text: &str) -> f64 {
        let plain = |c: char| match c {
            '−' | '⁻' => '-',
            '¹' => '1',
            '²' => '2',
            '³' => '3',
            '\u{2070}'..='\u{2079}' => char::from_digit(c as u32 - 0x2070, 10).unwrap_or('?'),
            other => other,
        };
        let text: String = text.replace("×10", "e").chars().map(plain).collect();
        text.parse().expect("a number")
    }

    proptest! {
        /// Oracle: reading the text back gives the value to the digits asked for.
        #[test]
        fn numbers_read_back(value in any::<f64>(), digits in 1_usize..10) {
            if value.is_finite() {
                let found = read(&number(value, digits));
                // Denormal numbers have fewer digits themselves.
                let slack = 0.5001 * 10_f64.powi(1 - digits as i32) * value.abs() + 1e-320;
                prop_assert!((found - value).abs() <= slack, "{value} {found}");
            }
        }
    }
}
