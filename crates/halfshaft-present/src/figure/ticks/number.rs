//! Numbers as text, and exact powers of ten.

use crate::figure::typeset::{Level, Rich};

/// The floating-point number nearest to a power of ten; infinite or zero beyond the range.
pub(crate) fn pow10(exponent: i32) -> f64 {
    // `powi` multiplies and so rounds several times; the parser rounds once.
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// `digits * 10^exponent` rounded as few times as possible.
pub(crate) fn scaled(digits: f64, exponent: i32) -> f64 {
    if (-300..0).contains(&exponent) { digits / pow10(-exponent) } else { digits * pow10(exponent) }
}

/// `digits * 10^exponent` with just the decimals that it needs and a true minus sign.
pub(crate) fn decimal(digits: f64, exponent: i32) -> String {
    let decimals = usize::try_from(-exponent).unwrap_or(0);
    let text = format!("{:.*}", decimals, scaled(digits.abs(), exponent));
    if digits < 0.0 { format!("−{text}") } else { text }
}

/// A whole number with a true minus sign.
pub(crate) fn signed(number: i32) -> String {
    decimal(f64::from(number), 0)
}

/// A whole number times a power of ten without its sign: as a decimal if that is short.
pub(crate) fn magnitude(mut digits: f64, mut exponent: i32) -> Rich {
    while exponent < 0 && digits % 10.0 == 0.0 {
        (digits, exponent) = (digits / 10.0, exponent + 1);
    }
    if (-12..=6).contains(&exponent) {
        return Rich::plain(&decimal(digits.abs(), exponent));
    }
    let mut text = Rich::plain(&decimal(digits.abs(), 0));
    text.push_str("×10", Level::Base);
    text.push_str(&signed(exponent), Level::Super);
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oracle: by hand.
    #[test]
    fn numbers_read_as_in_print() {
        assert_eq!(decimal(-25.0, -1), "−2.5");
        assert_eq!(decimal(0.0, -2), "0.00");
        assert_eq!(decimal(12.0, 1), "120");
        assert_eq!(magnitude(-7.0, 12).text(), "7×1012");
        assert_eq!(signed(-3), "−3");
    }

    /// Oracle: the literals of the compiler.
    #[test]
    fn powers_of_ten_are_exact() {
        assert_eq!([pow10(300), pow10(-300), pow10(0), pow10(23)], [1e300, 1e-300, 1.0, 1e23]);
    }
}
