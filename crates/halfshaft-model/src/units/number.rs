//! The number at the head of a quantity text.

/// Splits `text` into the number it begins with and the rest, or `None` where it begins
/// with no number. The sign may be a true minus; `inf` and `nan` are read so that they can
/// be refused by name.
pub(super) fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim_start();
    let (sign, body) = match text.strip_prefix(['-', '−']) {
        Some(body) => (-1.0, body),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    for word in ["inf", "nan"] {
        if body.get(..3).is_some_and(|head| head.eq_ignore_ascii_case(word)) {
            let value = if word == "inf" { sign * f64::INFINITY } else { f64::NAN };
            return Some((value, &body[3..]));
        }
    }
    let end = number_length(body);
    let value: f64 = body.get(..end)?.parse().ok()?;
    Some((sign * value, &body[end..]))
}

/// Length in bytes of the longest decimal number at the head of `text`.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if end > 0 && matches!(bytes.get(end), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits((end + 1 + signed).min(bytes.len()));
        if exponent > 0 {
            end += 1 + signed + exponent;
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::split;

    #[test]
    fn the_longest_number_is_taken() {
        assert_eq!(split("6420 N·m"), Some((6420.0, " N·m")));
        assert_eq!(split("-.5e-3rad"), Some((-0.5e-3, "rad")));
        assert_eq!(split("−2 deg"), Some((-2.0, " deg")));
        assert_eq!(split("3e5"), Some((3e5, "")));
        assert_eq!(split("3 e"), Some((3.0, " e")));
        assert_eq!(split("3eV"), Some((3.0, "eV")));
        assert_eq!(split("N·m"), None);
        assert_eq!(split("."), None);
        assert_eq!(split(""), None);
    }
}
