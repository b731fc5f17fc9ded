//! The tables of a model file and the way from its text to a [`Driveline`].

use std::path::PathBuf;

use crate::diagnostic::{Diagnostic, Diagnostics, Source, with_article};
use crate::driveline::{Driveline, Places, validate};
use crate::elements::{
    DAMPER, Damper, ENGINE, Engine, GEAR, Gear, INERTIA, Inertia, PULSE, PulseShape, SHAFT, Shaft,
    TORQUE, Torque, WHOLE_LINE, WholeLine, check_engine, check_gear, check_shaft, check_torque,
};
use crate::format::checked::CheckedTable;
use crate::format::measured_file;
use crate::format::reader::{OtherFile, read_document};
use crate::format::spec::{KeySpec, TableSpec, ValueSpec};
use crate::parameter::{self, AddressError};
use crate::range::parse_flag_quantity;

/// The whole model file.
pub static MODEL: TableSpec = TableSpec {
    name: "",
    doc: "A driveline. A bare number is in SI; a text carries its unit. Every number has an address \
          for --set and sweeps: `<element name>.<key>`.",
    keys: &[
        KeySpec::new("format", ValueSpec::Count(1, 1), "Version of this file format: 1.")
            .required(),
        KeySpec::new("name", ValueSpec::Text, "Name of the line, for titles.").required(),
        KeySpec::new("description", ValueSpec::Text, "What the line is; free text."),
        KeySpec::new("inertia", ValueSpec::Tables(&INERTIA), "Rigid bodies.").required(),
        KeySpec::new("gear", ValueSpec::Tables(&GEAR), "Gears, rigid or elastic."),
        KeySpec::new("shaft", ValueSpec::Tables(&SHAFT), "Torsional connections."),
        KeySpec::new("torque", ValueSpec::Tables(&TORQUE), "External torques."),
        KeySpec::new("damper", ValueSpec::Tables(&DAMPER), "Torsional vibration dampers."),
        KeySpec::new("engine", ValueSpec::Tables(&ENGINE), "Piston engines as sources of orders."),
        KeySpec::new("line", ValueSpec::Table(&WHOLE_LINE), "The line as a whole."),
    ],
};

/// A study in the place of a model.
static A_STUDY: OtherFile = OtherFile {
    lists: &["question", "figure"],
    message: "this is a study file, not a model file",
    command: "halfshaft run",
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
    let Some(mut document) = read_document(&text, &MODEL, &A_STUDY, &mut found) else {
        return Err(found);
    };
    let path = PathBuf::from(&found.sources[0].name);
    for (list, key, names) in [
        ("shaft", "table", measured_file::OVER_TWIST),
        ("torque", "table", measured_file::OVER_TIME),
        ("torque", "orders", measured_file::ORDERS),
        ("engine", "pressure", measured_file::PRESSURE),
        ("engine", "torque", measured_file::CRANK_TORQUE),
    ] {
        for element in document.tables_mut(list) {
            measured_file::resolve(element, (key, names), &path, &mut found);
        }
    }
    check_keys(&document, &mut found);
    let (mut line, places) = build(&document);
    for setting in settings {
        apply_setting(&mut line, setting, &places, &mut found);
    }
    validate(&line, &places, &mut found);
    // Whoever mends a file goes through it from top to bottom.
    found.items.sort_by_key(|item| (item.source, item.span.start));
    if found.has_errors() { Err(found) } else { Ok((line, found)) }
}

/// Elements of the document with the places of their keys. What is unsound keeps its place by a
/// stand-in, so that the names and nodes of all elements can be judged.
fn build(document: &CheckedTable) -> (Driveline, Places<'_>) {
    let places = Places::new(document);
    let line = Driveline {
        name: document.text_or_empty("name"),
        description: document.text_or_empty("description"),
        inertias: places.read("inertia", Inertia::read),
        gears: places.read("gear", Gear::read),
        shafts: places.read("shaft", Shaft::read),
        torques: places.read("torque", Torque::read),
        dampers: places.read("damper", Damper::read),
        engines: places.read("engine", Engine::read),
        whole: document.table("line").map(WholeLine::read).unwrap_or_default(),
    };
    (line, places)
}

/// What the lists of keys cannot say: which keys go together.
fn check_keys(document: &CheckedTable, found: &mut Diagnostics) {
    document.tables("gear").iter().for_each(|gear| check_gear(gear, found));
    document.tables("shaft").iter().for_each(|shaft| check_shaft(shaft, found));
    for torque in document.tables("torque") {
        check_torque(torque, found);
        check_pulse(torque, found);
    }
    document.tables("engine").iter().for_each(|engine| check_engine(engine, found));
}

/// A pulse needs other keys for each shape, which the list of keys cannot say.
fn check_pulse(torque: &CheckedTable, found: &mut Diagnostics) {
    let Some((pulse, shape)) = torque
        .table("pulse")
        .and_then(|pulse| Some((pulse, PulseShape::named(pulse.word("shape")?)?)))
    else {
        return;
    };
    let (needed, useless) = shape.needs();
    let what = format!("{} pulse", with_article(shape.name()));
    for key in needed.iter().filter(|key| !pulse.mentions(key)) {
        let unit =
            PULSE.key(key).and_then(KeySpec::quantity).map_or("", |(kind, _)| kind.si_unit());
        found.push(
            Diagnostic::error(pulse.span.clone(), format!("{what} needs \"{key}\""))
                .hint(format!("add {key} = \"... {unit}\"")),
        );
    }
    for key in useless.iter().filter(|key| pulse.mentions(key)) {
        let message = format!("{what} has no \"{key}\"");
        found.push(
            Diagnostic::error(pulse.span_of(key), message)
                .hint(format!("give {}", needed.join(" and "))),
        );
    }
}

fn apply_setting(
    line: &mut Driveline,
    setting: &SetFlag,
    places: &Places,
    found: &mut Diagnostics,
) {
    let text = setting.0.as_str();
    let source = found.sources.len();
    found.sources.push(Source::new("--set", text));
    // Names may hold "=", values never do.
    let Some(at) = text.rfind('=') else {
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
            if can_judge(&error, line, places) {
                let problem = Diagnostic::error(address_span, error.to_string());
                found.push(problem.hint(error.hint(line)).in_source(source));
            }
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
        Ok(si) => {
            Diagnostic::error(value_span, format!("\"{address}\" must {}", parameter.sign.rule()))
                .maybe_hint(parameter.sign.advice(si).map(str::to_owned))
        }
        Err(error) => {
            let balance = [crate::elements::BALANCE_WORD];
            let words: &[&str] = if parameter.takes_balance() { &balance } else { &[] };
            Diagnostic::error(value_span, error.to_string()).maybe_hint(error.hint_or_word(words))
        }
    };
    found.push(problem.in_source(source));
}

/// Whether an address is wrong whatever the unsound parts of the file were meant to say.
fn can_judge(error: &AddressError, line: &Driveline, places: &Places) -> bool {
    match error {
        AddressError::NoDot { .. } => true,
        AddressError::NoElement { .. } => places.names_known(),
        AddressError::NoKey { element, .. } => {
            let at = line.element_names().position(|name| name == element);
            at.is_none_or(|at| places.is_sound_at(at))
        }
    }
}
