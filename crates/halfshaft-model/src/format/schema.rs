//! JSON schema of the files, for completion and checking in editors.

use serde_json::{Map, Value, json};

use super::spec::{KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// JSON schema (2020-12) of the file that `spec` describes.
///
/// Editors use it through a comment at the head of a TOML file (`#:schema <path>`).
pub fn json_schema(spec: &TableSpec, title: &str) -> Value {
    let mut schema = table(spec);
    if let Value::Object(object) = &mut schema {
        let head = [
            ("$schema", json!("https://json-schema.org/draft/2020-12/schema")),
            ("title", json!(title)),
        ];
        let rest = std::mem::take(object);
        object.extend(head.into_iter().map(|(key, value)| (key.to_owned(), value)));
        object.extend(rest);
    }
    schema
}

fn table(spec: &TableSpec) -> Value {
    let offered = spec.keys.iter();
    let properties: Map<String, Value> =
        offered.map(|key| (key.name.to_owned(), property(key))).collect();
    let required: Vec<&str> =
        spec.keys.iter().filter(|key| key.required).map(|key| key.name).collect();
    json!({
        "type": "object",
        "description": spec.doc,
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn property(key: &KeySpec) -> Value {
    let mut value = value(&key.value);
    if let Value::Object(object) = &mut value {
        let nested = object.remove("description");
        let doc = match nested.as_ref().and_then(Value::as_str) {
            Some(nested) => format!("{} {nested}", key.doc),
            None => key.doc.to_owned(),
        };
        object.insert("description".to_owned(), Value::String(doc));
    }
    value
}

fn value(spec: &ValueSpec) -> Value {
    match spec {
        ValueSpec::Text | ValueSpec::Node { .. } => json!({ "type": "string" }),
        ValueSpec::Quantity(kind, sign) => quantity(*kind, *sign),
        ValueSpec::QuantityOr(kind, sign, words) => {
            json!({ "anyOf": [{ "enum": words }, quantity(*kind, *sign)] })
        }
        ValueSpec::Quantities(kind, sign) => {
            json!({ "type": "array", "items": quantity(*kind, *sign) })
        }
        ValueSpec::Range(_) => json!({ "type": "string", "pattern": "\\.\\." }),
        ValueSpec::Count(least, most) => {
            json!({ "type": "integer", "minimum": least, "maximum": most })
        }
        ValueSpec::Flag => json!({ "type": "boolean" }),
        ValueSpec::Choice(words) => json!({ "type": "string", "enum": words }),
        ValueSpec::Texts => json!({ "type": "array", "items": { "type": "string" } }),
        ValueSpec::Table(spec) => table(spec),
        ValueSpec::TableOrText(spec) => {
            json!({ "anyOf": [{ "type": "string" }, table(spec)] })
        }
        ValueSpec::Tables(spec) => json!({ "type": "array", "items": table(spec) }),
    }
}

/// A text that begins with a number; which units may follow is beyond a pattern.
const NUMBER_FIRST: &str = "^\\s*[-−+]?\\.?[0-9]";

fn quantity(kind: QuantityKind, sign: Sign) -> Value {
    let mut number = json!({ "type": "number" });
    match sign {
        Sign::Positive => number["exclusiveMinimum"] = json!(0),
        Sign::NonNegative => number["minimum"] = json!(0),
        Sign::NonZero => number["not"] = json!({ "const": 0 }),
        Sign::Any => {}
    }
    let examples: Vec<String> = match kind {
        QuantityKind::Number => vec!["1.5".to_owned(), "2 %".to_owned()],
        _ => kind.examples().iter().map(|unit| format!("1 {unit}")).collect(),
    };
    let text = json!({ "type": "string", "pattern": NUMBER_FIRST, "examples": examples });
    json!({ "anyOf": [number, text] })
}
