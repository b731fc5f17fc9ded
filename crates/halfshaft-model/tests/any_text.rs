//! Any text at all: an answer or an error with its place, never a panic. Random models survive.

use halfshaft_model::{SetFlag, Source, embedded, read_model};
use proptest::prelude::{any, prop_assert, proptest};

/// The example with one piece cut out or put in.
fn mutated(at: usize, length: usize, insert: &str) -> String {
    let text = embedded::example().text;
    let chars: Vec<char> = text.chars().collect();
    let at = at % chars.len();
    let end = (at + length).min(chars.len());
    chars[..at]
        .iter()
        .chain(insert.chars().collect::<Vec<_>>().iter())
        .chain(&chars[end..])
        .collect()
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in "\\PC{0,200}") {
        let found = read_model(Source::new("x", text), &[]);
        prop_assert!(found.is_err());
    }

    #[test]
    fn mutated_models_are_read_or_refused_with_places(
        at in any::<usize>(),
        length in 0..30_usize,
        insert in "[\\PC\n\"=\\[\\]{}]{0,8}",
    ) {
        let text = mutated(at, length, &insert);
        match read_model(Source::new("x", text), &[]) {
            Ok((line, found)) => {
                prop_assert!(!found.has_errors());
                prop_assert!(line.digest().len() == 64);
            }
            Err(found) => {
                prop_assert!(found.has_errors());
                for item in found.errors() {
                    let source = &found.sources[item.source];
                    prop_assert!(item.span.start <= source.text.len());
                    prop_assert!(source.position(item.span.start).0 >= 1);
                }
                prop_assert!(found.plain().contains("error"));
            }
        }
    }

    #[test]
    fn any_setting_is_taken_or_refused(text in "\\PC{0,60}") {
        let _ = read_model(embedded::example(), &[SetFlag(text)]);
    }

    // Source: units: the same number in another unit is the same line, digest and all, where the
    // conversion is exact.
    #[test]
    fn the_same_numbers_in_other_units_are_the_same_line(thousandths in 1..10_000_000_u32) {
        let kilo = f64::from(thousandths) / 1024.0;
        let with = |text: String| {
            read_model(embedded::example(), &[SetFlag(text)]).expect("is sound").0.digest()
        };
        let plain = with(format!("engine torque.mean={:?}", kilo * 1000.0));
        let unit = with(format!("engine torque.mean={:?} N·m", kilo * 1000.0));
        prop_assert!(plain == unit);
    }
}
