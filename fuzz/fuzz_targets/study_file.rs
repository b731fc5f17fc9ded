//! Any text as a study file: questions or errors with places in the text, never a panic.
#![no_main]

use halfshaft_model::Source;
use halfshaft_model::study::read_study_text;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    // A study names files; those that never end are not what is tested.
    if text.contains("/dev") || text.contains("/proc") {
        return;
    }
    match read_study_text(Source::new("fuzz", text), "no such folder") {
        Ok(study) => {
            let figures = study.figures.len();
            assert!(study.questions.iter().all(|q| q.figure.is_none_or(|index| index < figures)));
        }
        Err(found) => {
            assert!(found.has_errors());
            for item in &found.items {
                let source = &found.sources[item.source];
                assert!(item.span.start <= source.text.len());
                source.excerpt(&item.span);
            }
            assert!(!found.plain().is_empty());
        }
    }
});
