//! Options of `resonance` and `folds`: what each method takes, and what is refused with which hint.

use halfshaft_model::question::{
    OptionError, Question, QuestionText, ResonanceMethod, ResonanceQuestion, StabilityMethod, Verb,
    read,
};
use halfshaft_model::{Driveline, Source, embedded, read_model};

fn example_with(from: &str, to: &str) -> Driveline {
    let text = embedded::example().text;
    assert!(text.contains(from), "the example has {from}");
    let source = Source::new("line.toml", text.replacen(from, to, 1));
    read_model(source, &[]).unwrap_or_else(|found| panic!("{}", found.plain())).0
}

fn example() -> Driveline {
    read_model(embedded::example(), &[]).expect("is sound").0
}

/// What is refused of a question, as "option: message (hint)".
fn refused(verb: Verb, text: &QuestionText, line: &Driveline) -> Vec<String> {
    let told = |error: OptionError| {
        let OptionError { option, message, hint, .. } = error;
        format!("{option}: {message} ({hint})")
    };
    match read(verb, text, line) {
        Ok(question) => panic!("{text:?} is accepted: {question:?}"),
        Err(errors) => errors.into_iter().map(told).collect(),
    }
}

fn resonance(text: &QuestionText) -> ResonanceQuestion {
    match read(Verb::Resonance, text, &example()) {
        Ok(Question::Resonance(question)) => question,
        other => panic!("{text:?}: {other:?}"),
    }
}

// Source: the contract: the flags of `resonance`; two paths: text in one unit, the question in SI.
#[test]
fn harmonic_balance_takes_its_options() {
    let some = |text: &str| Some(text.to_owned());
    let plain = QuestionText::default;
    assert_eq!(resonance(&plain()), ResonanceQuestion::default());
    assert_eq!(ResonanceQuestion::default().method, ResonanceMethod::HarmonicBalance);
    let asked = resonance(&QuestionText {
        frequency: some("180rpm..240rpm"),
        harmonics: some("7"),
        tolerance: some("1e-8"),
        stability: some("hill"),
        points: some("50"),
        backbone: true,
        verify: true,
        ..plain()
    });
    let turn = 2.0 * std::f64::consts::PI;
    let (from, to) = asked.frequency.expect("was given");
    assert!((from - 3.0 * turn).abs() < 1e-12 && (to - 4.0 * turn).abs() < 1e-12);
    assert_eq!((asked.harmonics, asked.tolerance), (Some(7), 1e-8));
    assert_eq!((asked.stability, asked.points), (StabilityMethod::Hill, Some(50)));
    assert!(asked.backbone && asked.verify);
    assert_eq!(resonance(&QuestionText { mode: some("2"), ..plain() }).mode, 2);
    // At one speed a parameter runs.
    let parameter = some("engine torque.amplitude=0..0.9 kN·m");
    let swept = resonance(&QuestionText { frequency: some("1Hz"), parameter, ..plain() });
    assert_eq!(swept.frequency, Some((turn, turn)));
    let parameter = swept.parameter.expect("was given");
    assert_eq!((parameter.address.as_str(), parameter.to), ("engine torque.amplitude", 900.0));
}

#[test]
fn what_a_method_cannot_use_is_refused() {
    let some = |text: &str| Some(text.to_owned());
    let plain = QuestionText::default;
    let averaged = || QuestionText { method: some("averaged"), ..plain() };
    let first = || QuestionText { method: some("first-harmonic"), ..plain() };
    let amplitude = || some("engine torque.amplitude=1..9");
    let cases = [
        (QuestionText { order: some("1"), ..plain() }, "order: harmonic balance takes all orders"),
        (
            QuestionText { mode: some("1"), frequency: some("20..30"), ..plain() },
            "mode: the speeds are given",
        ),
        (QuestionText { harmonics: some("3"), ..averaged() }, "harmonics: only the method"),
        (QuestionText { harmonics: some("3"), ..first() }, "harmonics: only the method"),
        (QuestionText { verify: true, ..first() }, "verify: one harmonic is not held"),
        (QuestionText { stability: some("hill"), ..averaged() }, "stability: only the method"),
        (
            QuestionText { parameter: amplitude(), frequency: some("26"), ..averaged() },
            "parameter: only the method harmonic-balance goes through",
        ),
        (QuestionText { parameter: amplitude(), ..plain() }, "frequency: at which excitation"),
        (
            QuestionText { parameter: amplitude(), frequency: some("20..26"), ..plain() },
            "frequency: with --parameter the excitation speed stays",
        ),
        (QuestionText { frequency: some("26"), ..plain() }, "or add --parameter"),
        (QuestionText { harmonics: some("0"), ..plain() }, "harmonics: a whole number from 1"),
        (QuestionText { stability: some("hil"), ..plain() }, "did you mean \"hill\"?"),
        (QuestionText { tolerance: some("2"), ..plain() }, "the default is 1e-6"),
    ];
    for (text, words) in cases {
        let found = refused(Verb::Resonance, &text, &example());
        assert!(found.len() == 1 && found[0].contains(words), "{words}: {found:?}");
    }
    let folds = QuestionText { parameter: amplitude(), order: some("1"), ..plain() };
    assert!(refused(Verb::Folds, &folds, &example())[0].contains("all orders"));
    // A method that is none says nothing of the others.
    let none = QuestionText { method: some("averagd"), order: some("1"), ..plain() };
    assert_eq!(refused(Verb::Resonance, &none, &example()).len(), 1);
    for text in [
        QuestionText { order: some("1"), mode: some("1"), ..averaged() },
        QuestionText { mode: some("1"), frequency: some("20..30"), ..averaged() },
        QuestionText { backbone: true, tolerance: some("1e-8"), ..averaged() },
        QuestionText { order: some("1"), points: some("500"), ..first() },
        QuestionText { mode: some("1"), frequency: some("20..30"), ..first() },
    ] {
        assert!(read(Verb::Resonance, &text, &example()).is_ok(), "{text:?}");
    }
}

// Source: the theory: with all orders together their phases matter, and coefficients of one mode are
// none of the line's numbers.
#[test]
fn parameters_of_harmonic_balance_are_numbers_of_the_line() {
    let harmonics = "amplitude = \"40 N·m\"\nharmonics = [ { order = 2, amplitude = 60 } ]";
    let several = example_with("amplitude = \"40 N·m\"", harmonics);
    let asked = |verb: Verb, parameter: &str| QuestionText {
        parameter: Some(parameter.to_owned()),
        frequency: (verb == Verb::Resonance).then(|| "26".to_owned()),
        ..QuestionText::default()
    };
    for (verb, what) in [(Verb::Resonance, "periodic responses"), (Verb::Folds, "fold curves")] {
        let phase = asked(verb, "engine torque.phase=1..3");
        assert!(read(verb, &phase, &several).is_ok(), "{verb:?}");
        for (parameter, words) in [
            ("engine torque.phase=1..3", "no other oscillating torque"),
            ("engine torque.order=1..3", "no common period"),
            ("road load.pulse.peak=1..3", "acts once"),
        ] {
            let found = refused(verb, &asked(verb, parameter), &example());
            let effect = format!("has no effect on {what}");
            assert!(found[0].contains(words) && found[0].contains(&effect), "{found:?}");
        }
        let found = refused(verb, &asked(verb, "mode.f=1..3"), &example());
        assert!(found[0].contains("only the closed form of one mode"), "{found:?}");
        let found = refused(verb, &asked(verb, "nobody.f=1..3"), &example());
        assert!(!found[0].contains("mode.alpha"), "{found:?}");
    }
}
