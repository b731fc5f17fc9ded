//! Any text as quantities, ranges, settings and options: a value or an error, never a panic.
#![no_main]

use halfshaft_model::question::{QuestionText, Verb, read};
use halfshaft_model::units::QuantityKind;
use halfshaft_model::{SetFlag, embedded, parse_flag_quantity, parse_range, read_model};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let kinds = [
        QuantityKind::Speed,
        QuantityKind::Stiffness(3),
        QuantityKind::Number,
        QuantityKind::Time,
        QuantityKind::Torque,
    ];
    for kind in kinds {
        if let Ok(value) = parse_flag_quantity(text, kind) {
            assert!(value.is_finite());
        }
        if let Ok((from, to)) = parse_range(text, kind) {
            assert!(from < to);
        }
    }
    let _ = read_model(embedded::example(), &[SetFlag(text.to_owned())]);
    let (line, _) = read_model(embedded::example(), &[]).expect("the example is sound");
    let same = || Some(text.to_owned());
    let options = QuestionText {
        duration: same(),
        initial: vec![text.to_owned()],
        start: same(),
        frequency: same(),
        step: same(),
        tolerance: same(),
        record: same(),
        method: same(),
        order: same(),
        equation: same(),
        mode: same(),
        points: same(),
        parameter: same(),
        equilibrium: same(),
        grid: same(),
        window: same(),
        shaft: same(),
        periods: same(),
        shock: same(),
        rate: same(),
        friction: same(),
        orders: same(),
        integrator: same(),
        steps: same(),
        transient: same(),
        direction: same(),
        ..QuestionText::default()
    };
    for (_, verb) in Verb::ALL {
        let _ = read(verb, &options, &line);
    }
});
