//! From TOML with byte spans to checked values, after a [`TableSpec`], all errors at once.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::checked::{Checked, CheckedTable, Entry};
use super::spec::{KeySpec, TableSpec, ValueSpec};
use super::syntax;
use crate::diagnostic::{Diagnostic, Diagnostics, did_you_mean, nearest, with_article};
use crate::range::parse_range;
use crate::units::{QuantityError, QuantityKind, Sign, parse_quantity};

/// The other kind of file, which is easily given in the place of the one that is wanted.
pub(crate) struct OtherFile {
    /// The lists that only it has.
    pub(crate) lists: &'static [&'static str],
    /// What is to be said.
    pub(crate) message: &'static str,
    /// What to do with it, before the name of the file.
    pub(crate) command: &'static str,
}

/// Parses `text` and checks it after `spec`; syntax errors and all others go to `found`. `None`
/// where it is the other kind of file, of which nothing more needs to be said.
pub(crate) fn read_document(
    text: &str,
    spec: &'static TableSpec,
    other: &OtherFile,
    found: &mut Diagnostics,
) -> Option<CheckedTable> {
    let (document, errors) = DeTable::parse_recoverable(text);
    let table = document.get_ref();
    let is_own = |key: &KeySpec| matches!(key.value, ValueSpec::Tables(_));
    let own = spec.keys.iter().any(|key| is_own(key) && table.contains_key(key.name));
    if !own && other.lists.iter().any(|list| table.contains_key(*list)) {
        let file = found.sources.first().map_or("", |source| source.name.as_str());
        let hint = format!("use `{} {file}`", other.command);
        found.push(Diagnostic::error(0..0, other.message).hint(hint));
        return None;
    }
    let broken = syntax::report(text, errors, found);
    let before = found.items.len();
    let mut checked = check_table(table, document.span(), spec, found);
    // What the parser made of a broken line says nothing about what was meant.
    let within_broken = |span: &Range<usize>| {
        let next = broken.partition_point(|line| line.start <= span.start);
        broken[..next].last().is_some_and(|line| span.end <= line.end)
    };
    let mut number = 0;
    found.items.retain(|item| {
        number += 1;
        number <= before || !within_broken(&item.span)
    });
    // After a broken header every key stands in the wrong table.
    if broken.iter().any(|line| syntax::is_header(text, line)) {
        found.items.truncate(before);
    }
    checked.strays |= !broken.is_empty();
    checked.sound &= broken.is_empty();
    Some(checked)
}

/// Checks one table after its specification.
fn check_table(
    table: &DeTable<'_>,
    span: Range<usize>,
    spec: &'static TableSpec,
    found: &mut Diagnostics,
) -> CheckedTable {
    let before = found.items.len();
    let mut checked = CheckedTable { span, ..CheckedTable::default() };
    // The parser keeps keys in alphabetic order; a reader expects findings in file order.
    let mut written: Vec<_> = table.iter().collect();
    written.sort_by_key(|(key, _)| key.span().start);
    for (key, value) in written {
        let Some(key_spec) = spec.key(key.get_ref()) else {
            found.push(unknown_key(key, spec));
            // The key that was meant is there, if not as it should be.
            let meant = nearest(key.get_ref(), spec.keys.iter().map(|key| key.name));
            checked.unsound.extend(meant.filter(|meant| !table.contains_key(*meant)));
            // It may be meant as one of the lists.
            checked.strays |= matches!(value.get_ref(), DeValue::Array(_) | DeValue::Table(_));
            continue;
        };
        match check_key(key_spec, value, found) {
            Some(value_checked) => {
                let entry = Entry { span: value.span(), value: value_checked };
                checked.entries.push((key_spec.name, entry));
            }
            None => checked.unsound.push(key_spec.name),
        }
    }
    for key in spec.keys.iter().filter(|key| key.required && !checked.mentions(key.name)) {
        found.push(missing_key(key, spec, &checked.span));
    }
    checked.sound = found.items.len() == before;
    checked
}

fn unknown_key(key: &Spanned<toml::de::DeString<'_>>, spec: &TableSpec) -> Diagnostic {
    let known = spec.keys.iter().map(|key| key.name);
    let hint = did_you_mean(key.get_ref(), known.clone())
        .unwrap_or_else(|| format!("known keys are {}", known.collect::<Vec<_>>().join(", ")));
    let place = if spec.name.is_empty() { "the file" } else { spec.name };
    Diagnostic::error(key.span(), format!("unknown key \"{}\" in {place}", key.get_ref()))
        .hint(hint)
}

fn missing_key(key: &KeySpec, spec: &TableSpec, span: &Range<usize>) -> Diagnostic {
    let message = if spec.name.is_empty() {
        format!("the key \"{}\" is missing", key.name)
    } else {
        format!("this {} has no \"{}\"", spec.name, key.name)
    };
    Diagnostic::error(span.clone(), message).hint(format!("add {}", example_line(key)))
}

/// An example of the key as it would stand in a file.
fn example_line(key: &KeySpec) -> String {
    match key.value {
        ValueSpec::Quantity(QuantityKind::Number, _) | ValueSpec::Count(..) => {
            format!("{} = 1", key.name)
        }
        ValueSpec::Quantity(kind, _) | ValueSpec::QuantityOr(kind, ..) => {
            format!("{} = \"... {}\"", key.name, kind.si_unit())
        }
        ValueSpec::Choice(words) => {
            format!("{} = \"{}\"", key.name, words.first().copied().unwrap_or("..."))
        }
        ValueSpec::Tables(spec) => format!("a table [[{}]]", spec.name),
        _ => format!("{} = \"...\"", key.name),
    }
}

fn check_key(
    key: &'static KeySpec,
    value: &Spanned<DeValue<'_>>,
    found: &mut Diagnostics,
) -> Option<Checked> {
    match key.value {
        ValueSpec::Text => text(key, value, found).map(Checked::Text),
        ValueSpec::Node { ground } => node(key, value, ground, found).map(Checked::Text),
        ValueSpec::Quantity(kind, sign) => {
            quantity(key.name, value, (kind, sign, &[]), found).map(Checked::Number)
        }
        ValueSpec::QuantityOr(kind, sign, words) => {
            let word = value.get_ref().as_str().and_then(|t| words.iter().find(|w| **w == t));
            match word {
                Some(word) => Some(Checked::Word(word)),
                None => quantity(key.name, value, (kind, sign, words), found).map(Checked::Number),
            }
        }
        ValueSpec::Quantities(kind, sign) => {
            let items = array(key, value, found)?;
            let read = |item| quantity(key.name, item, (kind, sign, &[]), found);
            let numbers: Vec<_> = items.iter().map(read).collect();
            numbers.into_iter().collect::<Option<_>>().map(Checked::Numbers)
        }
        ValueSpec::Range(kind) => range(key, value, kind, found),
        ValueSpec::Count(least, most) => count(key, value, least, most, found),
        ValueSpec::Flag => match value.get_ref() {
            DeValue::Boolean(flag) => Some(Checked::Flag(*flag)),
            _ => wrong_type(key.name, value, "true or false", found),
        },
        ValueSpec::Choice(words) => choice(key, value, words, found),
        ValueSpec::Texts => {
            let items = array(key, value, found)?;
            let texts: Vec<_> = items
                .iter()
                .map(|item| {
                    let value = Checked::Text(text(key, item, found)?);
                    Some(Entry { span: item.span(), value })
                })
                .collect();
            texts.into_iter().collect::<Option<_>>().map(Checked::Texts)
        }
        ValueSpec::Table(spec) => match value.get_ref() {
            DeValue::Table(table) => {
                Some(Checked::Table(check_table(table, value.span(), spec, found)))
            }
            _ => wrong_type(key.name, value, "a table { ... }", found),
        },
        ValueSpec::TableOrText(spec) => match value.get_ref() {
            DeValue::Table(table) => {
                Some(Checked::Table(check_table(table, value.span(), spec, found)))
            }
            DeValue::String(text) => Some(Checked::Text(text.clone().into_owned())),
            _ => wrong_type(key.name, value, "a table { ... } or the path of a file", found),
        },
        ValueSpec::Tables(spec) => tables(key, value, spec, found),
    }
}

fn wrong_type<T>(
    key: &str,
    value: &Spanned<DeValue<'_>>,
    wanted: &str,
    found: &mut Diagnostics,
) -> Option<T> {
    let actual = value.get_ref().type_str();
    let message = format!("\"{key}\" must be {wanted}, not {}", with_article(actual));
    found.push(Diagnostic::error(value.span(), message));
    None
}

fn text(key: &KeySpec, value: &Spanned<DeValue<'_>>, found: &mut Diagnostics) -> Option<String> {
    match value.get_ref() {
        DeValue::String(text) => Some(text.clone().into_owned()),
        _ => wrong_type(key.name, value, "a text", found),
    }
}

fn node(
    key: &KeySpec,
    value: &Spanned<DeValue<'_>>,
    ground: bool,
    found: &mut Diagnostics,
) -> Option<String> {
    let name = text(key, value, found)?;
    if name.trim().is_empty() {
        found.push(Diagnostic::error(value.span(), format!("\"{}\" names no node", key.name)));
        return None;
    }
    if name == crate::GROUND && !ground {
        let message = format!("\"{}\" cannot be ground here", key.name);
        found.push(
            Diagnostic::error(value.span(), message)
                .hint("only shafts connect to ground; a torque or gear there would do nothing"),
        );
        return None;
    }
    Some(name)
}

/// A quantity of some kind and sign; some words may have been tried in vain.
fn quantity(
    key: &str,
    value: &Spanned<DeValue<'_>>,
    (kind, sign, words): (QuantityKind, Sign, &[&str]),
    found: &mut Diagnostics,
) -> Option<f64> {
    let si = match value.get_ref() {
        DeValue::String(text) => match parse_quantity(text, kind) {
            Ok(si) => si,
            Err(error) => {
                let (message, hint) = wrong_sign_too(key, &error, sign)
                    .unwrap_or_else(|| (format!("{key}: {error}"), error.hint_or_word(words)));
                found.push(Diagnostic::error(value.span(), message).maybe_hint(hint));
                return None;
            }
        },
        DeValue::Float(number) => bare_number(number.as_str()).unwrap_or(f64::NAN),
        DeValue::Integer(number) => whole_number(number).unwrap_or(f64::NAN),
        _ => {
            let wanted = format!("{} such as {}", kind.name(), sample(kind));
            return wrong_type(key, value, &wanted, found);
        }
    };
    check_sign(key, si, sign, value.span(), found)
}

/// Message and hint where a number without its unit has the wrong sign as well: whoever adds the
/// unit only would have to try a third time.
fn wrong_sign_too(
    key: &str,
    error: &QuantityError,
    sign: Sign,
) -> Option<(String, Option<String>)> {
    let QuantityError::NoUnit { text, kind } = error else { return None };
    let value = parse_quantity(text, QuantityKind::Number).ok()?;
    sign.advice(value)?;
    let message = format!("\"{key}\" must {}, and its unit is missing", sign.rule());
    let right = text.trim().trim_start_matches(['-', '−']).trim_start();
    Some((message, Some(format!("write \"{right} {}\"", kind.si_unit()))))
}

/// A sample of how a quantity is written, for messages.
fn sample(kind: QuantityKind) -> String {
    match kind {
        QuantityKind::Number => "5.71".to_owned(),
        _ => format!("\"1 {}\"", kind.si_unit()),
    }
}

/// The value of a TOML number in decimal form.
fn bare_number(text: &str) -> Option<f64> {
    text.replace('_', "").parse().ok()
}

/// The value of a TOML integer of any radix; `None` where it does not fit 64 bits.
fn whole_number(number: &toml::de::DeInteger<'_>) -> Option<f64> {
    if number.radix() == 10 {
        return bare_number(number.as_str());
    }
    #[expect(clippy::cast_precision_loss, reason = "hexadecimal parameters are small")]
    i64::from_str_radix(number.as_str(), number.radix()).ok().map(|value| value as f64)
}

fn check_sign(
    key: &str,
    value: f64,
    sign: Sign,
    span: Range<usize>,
    found: &mut Diagnostics,
) -> Option<f64> {
    if !value.is_finite() {
        found.push(Diagnostic::error(span, format!("\"{key}\" must be a finite number")));
        return None;
    }
    if sign.allows(value) {
        return Some(value);
    }
    found.push(
        Diagnostic::error(span, format!("\"{key}\" must {}", sign.rule()))
            .maybe_hint(sign.advice(value).map(str::to_owned)),
    );
    None
}

fn array<'v, 'd>(
    key: &KeySpec,
    value: &'v Spanned<DeValue<'d>>,
    found: &mut Diagnostics,
) -> Option<&'v [Spanned<DeValue<'d>>]> {
    match value.get_ref() {
        DeValue::Array(items) => Some(items),
        _ => wrong_type(key.name, value, "a list [ ... ]", found),
    }
}

fn range(
    key: &KeySpec,
    value: &Spanned<DeValue<'_>>,
    kind: QuantityKind,
    found: &mut Diagnostics,
) -> Option<Checked> {
    let text = text(key, value, found)?;
    match parse_range(&text, kind) {
        Ok((from, to)) => Some(Checked::Range(from, to)),
        Err(error) => {
            found.push(
                Diagnostic::error(value.span(), format!("{}: {error}", key.name))
                    .maybe_hint(error.hint()),
            );
            None
        }
    }
}

fn count(
    key: &KeySpec,
    value: &Spanned<DeValue<'_>>,
    least: u32,
    most: u32,
    found: &mut Diagnostics,
) -> Option<Checked> {
    let wanted = format!("a whole number from {least} to {most}");
    let DeValue::Integer(written) = value.get_ref() else {
        return wrong_type(key.name, value, &wanted, found);
    };
    let number = whole_number(written);
    if let Some(number) = number.filter(|n| (f64::from(least)..=f64::from(most)).contains(n)) {
        return Some(Checked::Number(number));
    }
    // Only the version of a format has no choice.
    let message = if least == most {
        format!("this version reads {} = {least}", key.name)
    } else {
        format!("\"{}\" must be {wanted}, not {}", key.name, written.as_str())
    };
    found.push(Diagnostic::error(value.span(), message));
    None
}

fn choice(
    key: &KeySpec,
    value: &Spanned<DeValue<'_>>,
    words: &'static [&'static str],
    found: &mut Diagnostics,
) -> Option<Checked> {
    let text = text(key, value, found)?;
    if let Some(word) = words.iter().find(|word| **word == text) {
        return Some(Checked::Word(word));
    }
    let hint = did_you_mean(&text, words.iter().copied())
        .unwrap_or_else(|| format!("choose from {}", words.join(", ")));
    found
        .push(Diagnostic::error(value.span(), format!("\"{text}\" is no {}", key.name)).hint(hint));
    None
}

fn tables(
    key: &KeySpec,
    value: &Spanned<DeValue<'_>>,
    spec: &'static TableSpec,
    found: &mut Diagnostics,
) -> Option<Checked> {
    let hint = format!("write [[{}]] with double brackets for each one", key.name);
    let DeValue::Array(items) = value.get_ref() else {
        let message = format!("\"{}\" must be a list of tables", key.name);
        found.push(Diagnostic::error(value.span(), message).hint(hint));
        return None;
    };
    let mut checked = Vec::new();
    for item in items.iter() {
        match item.get_ref() {
            DeValue::Table(table) => {
                checked.push(check_table(table, item.span(), spec, found));
            }
            _ => {
                let message = format!("\"{}\" must be a list of tables", key.name);
                found.push(Diagnostic::error(item.span(), message).hint(hint.clone()));
                // It keeps its place in the list as a table of which nothing is known.
                checked.push(CheckedTable { span: item.span(), ..CheckedTable::default() });
            }
        }
    }
    Some(Checked::Tables(checked))
}
