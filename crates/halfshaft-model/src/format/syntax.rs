//! What is no TOML, in words for whoever meant a model.

use std::ops::Range;

use toml::de::Error;

use crate::diagnostic::{Diagnostic, Diagnostics};

/// Tells every line that is no TOML once; returns where these lines stand, in order.
pub(super) fn report(text: &str, errors: Vec<Error>, found: &mut Diagnostics) -> Vec<Range<usize>> {
    let mut lines: Vec<Range<usize>> = Vec::new();
    let start = |error: &Error| error.span().map_or(0, |span| span.start);
    let mut errors = errors;
    errors.sort_by_key(start);
    for error in errors {
        let at = start(&error);
        // One slip makes the parser stumble several times.
        if lines.last().is_some_and(|line| line.start <= at && at <= line.end) {
            continue;
        }
        let line = line_at(text, at);
        found.push(slip(text, &line).unwrap_or_else(|| {
            let hint = if is_header(text, &line) {
                "a table begins with [[name]], as in [[shaft]]"
            } else {
                "the file is TOML: key = value, texts in quotation marks"
            };
            Diagnostic::error(error.span().unwrap_or(0..0), error.message().trim().to_owned())
                .hint(hint)
        }));
        let ends = is_header(text, &line);
        lines.push(line);
        // What follows a broken header stands in the wrong table and is read as such.
        if ends {
            break;
        }
    }
    lines
}

/// Whether a line is meant to begin a table.
pub(super) fn is_header(text: &str, line: &Range<usize>) -> bool {
    text.get(line.clone()).is_some_and(|written| written.trim_start().starts_with('['))
}

/// The line that holds the byte at `offset`, without its end.
fn line_at(text: &str, offset: usize) -> Range<usize> {
    let offset = offset.min(text.len());
    let bytes = text.as_bytes();
    let start = bytes[..offset].iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    let rest = bytes[offset..].iter().position(|byte| *byte == b'\n');
    start..rest.map_or(text.len(), |at| offset + at)
}

/// The usual slips in `key = value`: a decimal comma and missing quotation marks.
fn slip(text: &str, line: &Range<usize>) -> Option<Diagnostic> {
    let written = text.get(line.clone())?;
    let (key, value) = written.split_once('=')?;
    let value = value.split('#').next()?.trim();
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    let structured = value.starts_with(['[', '{']) || value.contains(['"', '\'', '\\']);
    if structured || value.is_empty() || !key.trim().chars().all(bare) {
        return None;
    }
    let start = line.start + key.len() + 1 + written[key.len() + 1..].find(value)?;
    let problem = |message| Diagnostic::error(start..start + value.len(), message);
    if let Some(number) = decimal_comma(value) {
        let hint = format!("decimals are written with a point: {number}");
        return Some(problem(format!("\"{value}\" is no number")).hint(hint));
    }
    let folded = value.to_ascii_lowercase();
    if folded == "true" || folded == "false" {
        return Some(problem(format!("\"{value}\" is no value")).hint(format!("write {folded}")));
    }
    if value.contains(char::is_alphabetic) || value.contains(':') {
        let message = format!("the value of \"{}\" has no quotation marks", key.trim());
        return Some(problem(message).hint(format!("write \"{value}\" in quotation marks")));
    }
    None
}

/// The number that was meant by one with a decimal comma.
fn decimal_comma(value: &str) -> Option<String> {
    let (whole, decimals) = value.split_once(',')?;
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let fits = digits(whole.trim_start_matches(['-', '+'])) && digits(decimals);
    fits.then(|| format!("{whole}.{decimals}"))
}
