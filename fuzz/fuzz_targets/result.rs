//! Any text as the JSON of a result: an answer that can be written and read back, or an error,
//! never a panic.
#![no_main]

use halfshaft_results::io::{csv, from_json, tables_of, to_json};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(answer) = from_json(text) else { return };
    let written = to_json(&answer, false).expect("an answer can be written");
    let back = from_json(&written).expect("an answer can be read back");
    // Texts, since a number that is missing does not equal itself.
    assert_eq!(to_json(&back, false).expect("an answer can be written"), written);
    assert_eq!(csv(&answer).is_some(), !tables_of(&answer).is_empty());
});
