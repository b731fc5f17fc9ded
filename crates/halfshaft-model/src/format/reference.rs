//! The reference page of a file format, in Markdown.

use std::fmt::Write as _;

use super::spec::{KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Markdown page of the file that `spec` describes, one table of keys for each table.
pub fn reference_page(spec: &TableSpec, title: &str) -> String {
    let mut page = format!("# {title}\n\n{}\n", one_line(spec.doc));
    section(&mut page, spec, "The file");
    page
}

fn section(page: &mut String, spec: &TableSpec, heading: &str) {
    // Writing to a String cannot fail.
    let _ = write!(page, "\n## {heading}\n\n");
    if !spec.name.is_empty() {
        let _ = write!(page, "{}\n\n", one_line(spec.doc));
    }
    page.push_str("| key | value | meaning |\n|---|---|---|\n");
    for key in spec.keys {
        let required = if key.required { " **(required)**" } else { "" };
        let _ = writeln!(
            page,
            "| `{}`{required} | {} | {} |",
            key.name,
            value(&key.value),
            one_line(key.doc)
        );
    }
    for (index, key) in spec.keys.iter().enumerate() {
        // Keys that hold the same kind of table share its section.
        let own = table_of(key);
        let told = spec.keys[..index].iter().filter_map(table_of);
        if own.is_none_or(|own| told.into_iter().all(|other| !std::ptr::eq(own, other))) {
            nested(page, key);
        }
    }
}

fn table_of(key: &KeySpec) -> Option<&'static TableSpec> {
    match key.value {
        ValueSpec::Tables(spec) | ValueSpec::Table(spec) | ValueSpec::TableOrText(spec) => {
            Some(spec)
        }
        _ => None,
    }
}

fn nested(page: &mut String, key: &KeySpec) {
    match key.value {
        ValueSpec::Tables(spec) => section(page, spec, &format!("`[[{}]]`", key.name)),
        ValueSpec::Table(spec) | ValueSpec::TableOrText(spec) => {
            section(page, spec, &format!("`{} = {{ ... }}`", key.name));
        }
        _ => {}
    }
}

fn value(spec: &ValueSpec) -> String {
    match spec {
        ValueSpec::Text => "text".to_owned(),
        ValueSpec::Node { ground: true } => "node, or `ground`".to_owned(),
        ValueSpec::Node { ground: false } => "node".to_owned(),
        ValueSpec::Quantity(kind, sign) => quantity(*kind, *sign),
        ValueSpec::QuantityOr(kind, sign, words) => {
            format!("{}, or `\"{}\"`", quantity(*kind, *sign), words.join("\"`, `\""))
        }
        ValueSpec::Quantities(kind, sign) => format!("list of {}", quantity(*kind, *sign)),
        ValueSpec::Range(_) => "text `A..B`".to_owned(),
        ValueSpec::Count(least, most) if least == most => format!("{least}"),
        ValueSpec::Count(least, most) => format!("whole number {least} to {most}"),
        ValueSpec::Flag => "`true` or `false`".to_owned(),
        ValueSpec::Choice(words) => format!("`\"{}\"`", words.join("\"`, `\"")),
        ValueSpec::Texts => "list of texts".to_owned(),
        ValueSpec::Table(spec) => format!("table, see {}", spec.name),
        ValueSpec::TableOrText(spec) => format!("table, see {}, or text", spec.name),
        ValueSpec::Tables(spec) => format!("list of tables, see {}", spec.name),
    }
}

fn quantity(kind: QuantityKind, sign: Sign) -> String {
    let unit = if kind == QuantityKind::Number { "number" } else { kind.si_unit() };
    let rule = match sign {
        Sign::Any => "",
        Sign::NonZero => " ≠ 0",
        Sign::NonNegative => " ≥ 0",
        Sign::Positive => " > 0",
    };
    format!("{unit}{rule}")
}

/// Source lines are wrapped; a Markdown table row is not.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
