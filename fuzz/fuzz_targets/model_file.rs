//! Any text as a model file: a line or errors with places in the text, never a panic.
#![no_main]

use halfshaft_model::{SetFlag, Source, Topology, read_model};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let settings = [SetFlag("half-shaft.cubic=1 N·m/rad³".to_owned())];
    for settings in [&[][..], &settings[..]] {
        match read_model(Source::new("fuzz", text), settings) {
            Ok((line, found)) => {
                assert!(!found.has_errors());
                assert!(Topology::of(&line).is_ok());
                assert_eq!(line.digest().len(), 64);
            }
            Err(found) => {
                assert!(found.has_errors());
                for item in &found.items {
                    let source = &found.sources[item.source];
                    assert!(item.span.start <= source.text.len());
                    source.position(item.span.start);
                    source.excerpt(&item.span);
                }
                assert!(!found.plain().is_empty());
            }
        }
    }
});
