//! The tables of a model file and the way from its text to a [`Driveline`].

use crate::diagnostic::{Diagnostic, Diagnostics, Source, did_you_mean};
use crate::driveline::{Driveline, Places, validate};
use crate::elements::{GEAR, Gear, INERTIA, Inertia, PULSE, Pulse, SHAFT, Shaft, TORQUE, Torque};
use crate::format::checked::CheckedTable;
use crate::format::reader::read_document;
use crate::format::spec::{KeySpec, TableSpec, ValueSpec};
use crate::parameter::{self, AddressError};
use crate::range::parse_flag_quantity;

/// The whole model file.
pub static MODEL: TableSpec = TableSpec {
    name: "",
    doc: "A driveline. A bare number is in SI; a text carries its unit.",
    keys: &[
        KeySpec::new("format", ValueSpec::Count(1, 1), "Version of this file format: 1.")
            .required(),
        KeySpec::new("name", ValueSpec::Text, "Name of the line, for titles.").required(),
        KeySpec::new("description", ValueSpec::Text, "What the line is; free text."),
        KeySpec::new("inertia", ValueSpec::Tables(&INERTIA), "Rigid bodies.").required(),
        KeySpec::new("gear", ValueSpec::Tables(&GEAR), "Ideal gears."),
        KeySpec::new("shaft", ValueSpec::Tables(&SHAFT), "Torsional connections.").required(),
        KeySpec::new("torque", ValueSpec::Tables(&TORQUE), "External torques."),
    ],
};

/// One `--set "ADDRESS=VALUE"`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SetFlag(pub String);

/// Reads a model text, applies the settings and validates the line.
///
/// Returns the line with warnings (never errors) in the diagnostics.
///
/// # Errors
/// All findings of all stages at once, with at least one error among them.
pub fn read_model(
    source: Source,
    settings: &[SetFlag],
) -> Result<(Driveline, Diagnostics), Diagnostics> {
    let mut found = Diagnostics::about(source);
    let text = found.sources[0].text.clone();
    if text.trim().is_empty() {
        found.push(
            Diagnostic::error(0..0, "the file is empty")
                .hint("`halfshaft new` writes a model to start from"),
        );
        return Err(found);
    }
    let document = read_document(&text, &MODEL, &mut found);
    let sound = !found.has_errors();
    let (mut line, places) = build(&document, &mut found);
    if sound {
        // An address can only be judged where all elements could be read.
        for setting in settings {
            apply_setting(&mut line, setting, &mut found);
        }
        validate(&line, &places, &mut found);
    }
    if found.has_errors() { Err(found) } else { Ok((line, found)) }
}

/// Elements of the document with the places of their keys.
fn build(document: &CheckedTable, found: &mut Diagnostics) -> (Driveline, Places) {
    for torque in document.tables("torque") {
        check_pulse(torque, found);
    }
    let mut places = Places::new(document);
    let line = Driveline {
        name: document.text("name").unwrap_or_default().to_owned(),
        description: document.text("description").unwrap_or_default().to_owned(),
        inertias: places.read(document, "inertia", Inertia::read),
        gears: places.read(document, "gear", Gear::read),
        shafts: places.read(document, "shaft", Shaft::read),
        torques: places.read(document, "torque", Torque::read),
    };
    (line, places)
}

/// A pulse needs other keys for each shape, which the list of keys cannot say.
fn check_pulse(torque: &CheckedTable, found: &mut Diagnostics) {
    let Some((pulse, shape)) =
        torque.table("pulse").and_then(|pulse| Some((pulse, pulse.word("shape")?)))
    else {
        return;
    };
    let (needed, useless) = Pulse::needs(shape);
    for key in needed.iter().filter(|key| !pulse.mentions(key)) {
        let unit =
            PULSE.key(key).and_then(KeySpec::quantity).map_or("", |(kind, _)| kind.si_unit());
        found.push(
            Diagnostic::error(pulse.span.clone(), format!("a {shape} pulse needs \"{key}\""))
                .hint(format!("add {key} = \"... {unit}\"")),
        );
    }
    for key in useless.iter().filter(|key| pulse.mentions(key)) {
        let message = format!("a pulse of shape {shape} has no \"{key}\"");
        found.push(
            Diagnostic::error(pulse.span_of(key), message)
                .hint(format!("give {}", needed.join(" and "))),
        );
    }
}

fn apply_setting(line: &mut Driveline, setting: &SetFlag, found: &mut Diagnostics) {
    let text = setting.0.as_str();
    let source = found.sources.len();
    found.sources.push(Source::new("--set", text));
    let Some(at) = text.find('=') else {
        found.push(
            Diagnostic::error(0..text.len(), "a setting must be ADDRESS=VALUE")
                .hint("e.g. --set \"half-shaft.cubic=-500 N·m/rad³\"")
                .in_source(source),
        );
        return;
    };
    let (address, value) = (text[..at].trim(), text[at + 1..].trim());
    let address_at = text.find(address).unwrap_or(0);
    let address_span = address_at..address_at + address.len();
    let value_at = text.len() - text[at + 1..].trim_start().len();
    let value_span = value_at..value_at + value.len();
    let parameter = match parameter::resolve(line, address) {
        Ok(parameter) => parameter,
        Err(error) => {
            found.push(address_diagnostic(&error, line).at(address_span, source));
            return;
        }
    };
    if value == crate::elements::BALANCE_WORD && parameter.takes_balance() {
        parameter.set_balance(line);
        return;
    }
    let problem = match parse_flag_quantity(value, parameter.kind) {
        Ok(si) if parameter.sign.allows(si) => {
            if !parameter.set(line, si) {
                found.push(
                    Diagnostic::error(address_span, format!("\"{address}\" has no value to set"))
                        .in_source(source),
                );
            }
            return;
        }
        Ok(_) => {
            Diagnostic::error(value_span, format!("\"{address}\" must {}", parameter.sign.rule()))
        }
        Err(error) => Diagnostic::error(value_span, error.to_string()).maybe_hint(error.hint()),
    };
    found.push(problem.in_source(source));
}

/// An address error as a diagnostic that still lacks its place.
struct Placeless(Diagnostic);

impl Placeless {
    fn at(self, span: std::ops::Range<usize>, source: usize) -> Diagnostic {
        Diagnostic { span, ..self.0 }.in_source(source)
    }
}

fn address_diagnostic(error: &AddressError, line: &Driveline) -> Placeless {
    let hint = match error {
        AddressError::NoElement { name } => did_you_mean(name, line.element_names())
            .unwrap_or_else(|| {
                let names: Vec<_> = line.element_names().collect();
                format!("elements of this line are {}", names.join(", "))
            }),
        AddressError::NoKey { key, known, .. } => did_you_mean(key, known.iter().copied())
            .unwrap_or_else(|| format!("it has {}", known.join(", "))),
        AddressError::NoDot { .. } => {
            "an address is <element name>.<key>, e.g. half-shaft.cubic".to_owned()
        }
    };
    Placeless(Diagnostic::error(0..0, error.to_string()).hint(hint))
}
