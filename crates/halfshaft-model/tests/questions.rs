//! Addresses and options: what is accepted, and what is refused with which hint.

use halfshaft_model::format::{MODEL, json_schema};
use halfshaft_model::question::{OptionError, Question, QuestionText, Verb, read};
use halfshaft_model::{Driveline, SetFlag, Source, embedded, read_model};

fn example_with(from: &str, to: &str) -> Driveline {
    let text = embedded::example().text;
    assert!(text.contains(from), "the example has {from}");
    let source = Source::new("line.toml", text.replacen(from, to, 1));
    read_model(source, &[]).unwrap_or_else(|found| panic!("{}", found.plain())).0
}

fn example() -> Driveline {
    read_model(embedded::example(), &[]).expect("is sound").0
}

fn folds(line: &Driveline, parameter: &str) -> Result<(f64, f64), Vec<OptionError>> {
    let (parameter, method) = (Some(parameter.to_owned()), Some("averaged".to_owned()));
    let text = QuestionText { parameter, method, ..QuestionText::default() };
    match read(Verb::Folds, &text, line)? {
        Question::Folds(folds) => Ok((folds.parameter.from, folds.parameter.to)),
        other => panic!("{other:?}"),
    }
}

// Source: the contract: "Every numeric key has one" address.
#[test]
fn every_number_of_a_model_has_an_address() {
    let harmonics = "amplitude = \"40 N·m\"\n\
                     harmonics = [ { order = 2, amplitude = 60 }, { order = 0.5, amplitude = 7 } ]";
    let line = example_with("amplitude = \"40 N·m\"", harmonics);
    for (address, value) in [
        ("engine torque.amplitude", 40.0),
        ("engine torque.harmonics.1.amplitude", 60.0),
        ("engine torque.harmonics.1.order", 2.0),
        ("engine torque.harmonics.2.amplitude", 7.0),
        ("engine torque.harmonics.2.phase", 0.0),
        ("road load.pulse.peak", -12_000.0),
        ("road load.pulse.duration", 0.05),
        ("gearbox.ratios.1", 5.82),
        ("gearbox.ratios.5", 0.64),
    ] {
        let parameter = line.parameter(address).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(parameter.value(&line), Some(value), "{address}");
        let changed = line.with(&parameter, 3.5).expect("is allowed");
        assert_eq!(parameter.value(&changed), Some(3.5), "{address}");
    }
    for (address, hint) in [
        ("engine torque.harmonics.0.amplitude", "harmonics.1.amplitude"),
        ("engine torque.harmonics.3.order", "harmonics.1.order"),
        ("road load.peak", "\"road load.pulse.peak\""),
        ("gearbox.ratios.6", "ratios.1"),
        ("road load.pulse.impulse", "pulse.peak"),
    ] {
        let error = line.parameter(address).expect_err("leads nowhere");
        assert!(error.hint(&line).contains(hint), "{address}: {}", error.hint(&line));
    }
}

#[test]
fn a_range_must_hold_legal_values_only() {
    let line = example();
    for (parameter, words) in [
        ("vehicle.inertia=-5..100", "\"vehicle.inertia\" must be more than zero"),
        ("vehicle.inertia=0..100", "must be more than zero"),
        ("half-shaft.damping=-1..1", "must not be negative"),
        ("gearbox.ratio=-1..1", "must not be zero"),
        ("mode.beta=-1..1", "must not be negative"),
        ("mode.omega_1=0..1", "must be more than zero"),
    ] {
        let errors = folds(&line, parameter).expect_err("is not legal");
        assert!(errors[0].message.contains(words), "{parameter}: {errors:?}");
    }
    assert_eq!(folds(&line, "half-shaft.cubic=-700..0"), Ok((-700.0, 0.0)));
    assert_eq!(folds(&line, "gearbox.ratio=-2..-1"), Ok((-2.0, -1.0)));
    assert_eq!(folds(&line, "mode.f=0..20"), Ok((0.0, 20.0)));
}

// Source: the theory: fold curves are of one order of the torques that follow the excitation speed.
#[test]
fn a_parameter_without_effect_on_folds_is_refused() {
    let harmonics = "amplitude = \"40 N·m\"\nharmonics = [ { order = 2, amplitude = 60 } ]";
    let line = example_with("amplitude = \"40 N·m\"", harmonics);
    for (parameter, words, hint) in [
        ("gearbox.ratios.1=1..3", "a list of ratios", "\"gearbox.ratio\""),
        ("road load.pulse.peak=1..3", "acts once", "shock"),
        ("road load.pulse.start=1..3", "acts once", "shock"),
        ("engine torque.frequency=1..3", "speed of its own", "other axis"),
        ("engine torque.order=1..3", "one order", "--order"),
        ("engine torque.harmonics.1.order=1..3", "one order", "--order"),
        ("engine torque.phase=1..3", "no other torque of order", "time"),
    ] {
        let errors = folds(&line, parameter).expect_err("has no effect");
        assert!(errors[0].message.contains("has no effect on fold curves"), "{errors:?}");
        assert!(errors[0].message.contains(words), "{parameter}: {errors:?}");
        assert!(errors[0].hint.contains(hint), "{parameter}: {errors:?}");
    }
    assert_eq!(folds(&line, "engine torque.harmonics.1.amplitude=1..3"), Ok((1.0, 3.0)));
    assert_eq!(folds(&line, "engine torque.mean=1..3"), Ok((1.0, 3.0)));
    let parameter = Some("engine torque.harmonics.1.amplitude=1..3".to_owned());
    let (order, method) = (Some("1".to_owned()), Some("averaged".to_owned()));
    let other = QuestionText { parameter, order, method, ..QuestionText::default() };
    let errors = read(Verb::Folds, &other, &line).expect_err("is of another order");
    assert!(errors[0].hint.contains("--order 2"), "{errors:?}");
    let fixed = "amplitude = \"40 N·m\"\nfrequency = \"20 Hz\"";
    let line = example_with("amplitude = \"40 N·m\"", fixed);
    let errors = folds(&line, "engine torque.amplitude=1..3").expect_err("does not follow");
    assert!(errors[0].message.contains("has a speed of its own"), "{errors:?}");
}

/// Two shafts side by side behind a gear each: the loop turns while both gears have one ratio.
const LOOP: &str = "format = 1\nname = \"loop\"\n\
    [[inertia]]\nname = \"a\"\ninertia = 1\n[[inertia]]\nname = \"b\"\ninertia = 1\n\
    [[gear]]\nname = \"g1\"\ninput = \"a\"\noutput = \"p\"\nratio = 2\nratios = [2, 3]\n\
    [[gear]]\nname = \"g2\"\ninput = \"a\"\noutput = \"q\"\nratio = 2\n\
    [[shaft]]\nname = \"s1\"\nfrom = \"p\"\nto = \"b\"\nstiffness = 100\n\
    [[shaft]]\nname = \"s2\"\nfrom = \"q\"\nto = \"b\"\nstiffness = 100\n";

// Source: two paths to one thing: a value that --set refuses is refused along a sweep as well.
#[test]
fn a_value_that_locks_a_loop_of_shafts_is_refused_however_it_is_set() {
    let source = || Source::new("line.toml", LOOP);
    let (line, _) = read_model(source(), &[]).unwrap_or_else(|found| panic!("{}", found.plain()));
    let setting = SetFlag("g1.ratio=3".to_owned());
    let found = read_model(source(), &[setting]).expect_err("cannot turn").plain();
    let ratio = line.parameter("g1.ratio").expect("is a number");
    let error = line.with(&ratio, 3.0).expect_err("cannot turn").to_string();
    for words in ["the loop that shaft \"s2\" closes cannot turn", "times the speed of \"b\""] {
        assert!(error.contains(words), "{error}");
        assert!(found.contains(words), "{found}");
    }
    assert!(error.starts_with("with g1.ratio = 3: "), "{error}");
    assert!(line.with(&ratio, 2.0).is_ok());
    assert!(folds(&line, "g1.ratio=2..3").is_err());
    // Held at ground, the line need not turn.
    let held = LOOP.to_owned()
        + "[[shaft]]\nname = \"mount\"\nfrom = \"b\"\nto = \"ground\"\nstiffness = 1\n";
    let (held, _) = read_model(Source::new("line.toml", held), &[]).expect("is sound");
    assert!(held.with(&ratio, 3.0).is_ok());
}

#[test]
fn a_wrong_coefficient_of_the_mode_is_told_the_right_ones() {
    for parameter in ["mode.g=1..2", "mode.=1..2"] {
        let errors = folds(&example(), parameter).expect_err("is none");
        assert!(errors[0].message.contains("the mode has no coefficient"), "{errors:?}");
        assert!(errors[0].hint.contains("mode.alpha, mode.beta, mode.f, mode.omega_1"));
    }
}

#[test]
fn a_name_may_hold_an_equals_sign() {
    let line = example_with("name = \"half-shaft\"", "name = \"k = 0\"");
    assert_eq!(folds(&line, "k = 0.damping=1..2"), Ok((1.0, 2.0)));
    let text = embedded::example().text.replacen("\"half-shaft\"", "\"k = 0\"", 1);
    let setting = SetFlag("k = 0.cubic = -5 N·m/rad³".to_owned());
    let (line, _) = read_model(Source::new("line.toml", text), &[setting]).expect("is sound");
    assert_eq!(line.shafts()[0].cubic_nm_per_rad3, -5.0);
    let initial = vec!["k = 0.twist=1 rad".to_owned()];
    let text = QuestionText { initial, ..QuestionText::default() };
    assert!(read(Verb::Simulate, &text, &line).is_ok());
}

#[test]
fn a_question_knows_its_verb() {
    let parameter = Some("half-shaft.cubic=-700..0".to_owned());
    for (name, verb) in Verb::ALL {
        let needed = parameter.clone().filter(|_| verb == Verb::Folds);
        let frequency = (verb == Verb::Basins).then(|| "4Hz".to_owned());
        let text = QuestionText { parameter: needed, frequency, ..QuestionText::default() };
        let question = read(verb, &text, &example()).expect("has no options");
        assert_eq!((question.verb(), question.verb().name()), (verb, name));
    }
}

#[test]
fn options_without_effect_are_refused() {
    let some = |text: &str| Some(text.to_owned());
    let plain = QuestionText::default;
    let scales = || QuestionText { method: some("multiple-scales"), ..plain() };
    let refused = [
        QuestionText { order: some("1"), ..plain() },
        QuestionText { equation: some("twist"), method: some("clamped"), ..plain() },
        QuestionText { order: some("1"), printed_velocity: true, ..plain() },
        QuestionText { step: some("6s"), ..plain() },
        QuestionText { step: some("2s"), duration: some("1s"), ..plain() },
    ];
    for text in refused {
        let errors = read(Verb::Shock, &text, &example()).expect_err("has no effect");
        assert!(errors.iter().all(|error| !error.hint.is_empty()), "{errors:?}");
    }
    for text in [
        QuestionText { order: some("1"), equation: some("twist"), ..scales() },
        QuestionText { tolerance: some("1e-9"), ..scales() },
        QuestionText { step: some("5s"), ..plain() },
    ] {
        assert!(read(Verb::Shock, &text, &example()).is_ok(), "{text:?}");
    }
    let long = QuestionText { step: some("2s"), record: some("3s..4s"), ..plain() };
    let errors = read(Verb::Simulate, &long, &example()).expect_err("no sample would be kept");
    assert!(errors[0].message.contains("longer than the 1 s"), "{errors:?}");
    // What follows from a wrong duration is not told.
    let wrong = QuestionText { duration: some("9kg"), step: some("7s"), ..plain() };
    assert_eq!(read(Verb::Simulate, &wrong, &example()).expect_err("is wrong").len(), 1);
}

// Source: by hand: 2e8 numbers over the columns of each line.
#[test]
fn a_history_holds_so_many_numbers_however_many_channels_the_line_has() {
    let asked = |line: &Driveline, step: Option<&str>| {
        let step = step.map(str::to_owned);
        let record = Some("1s..2s".to_owned());
        let text = QuestionText { step, record, ..QuestionText::default() };
        read(Verb::Simulate, &text, line)
    };
    // The example has one shaft and four nodes: 12 columns, and 2e8/12 samples of each.
    assert!(asked(&example(), Some("6.1e-8s")).is_ok());
    let errors = asked(&example(), Some("5.9e-8s")).expect_err("too many");
    assert!(errors[0].message.contains("too many samples"), "{errors:?}");
    assert!(errors[0].hint.contains("12 columns, so at most 16666666 samples"), "{errors:?}");
    let mut text =
        String::from("format = 1\nname = \"long\"\n[[inertia]]\nname = \"0\"\ninertia = 1\n");
    for number in 1..=21_000 {
        let before = number - 1;
        text += &format!("[[inertia]]\nname = \"{number}\"\ninertia = 1\n");
        text += &format!("[[shaft]]\nname = \"s{number}\"\nstiffness = 1\n");
        text += &format!("from = \"{before}\"\nto = \"{number}\"\n");
    }
    let (long, _) = read_model(Source::new("long.toml", text), &[]).expect("is sound");
    let errors = asked(&long, None).expect_err("the step of its own is too small");
    assert!(errors[0].message.contains("where no step is given"), "{errors:?}");
    assert!(asked(&long, Some("1ms")).is_ok());
}

// Source: what the program reads: a ratio is a number or a text with a number.
#[test]
fn the_schema_takes_what_the_program_takes() {
    let line = example_with("ratio = 5.71", "ratio = \"5.71\"");
    assert_eq!(line.gears()[1].ratio, 5.71);
    let schema = json_schema(&MODEL, "model");
    let ratio = &schema["properties"]["gear"]["items"]["properties"]["ratio"]["anyOf"];
    assert_eq!(ratio[0]["type"], "number");
    assert_eq!(ratio[1]["type"], "string");
    assert_eq!(ratio[1]["pattern"], "^\\s*[-−+]?\\.?[0-9]");
}

// Source: by hand.
#[test]
fn basins_have_one_speed_a_window_and_a_grid() {
    let some = |text: &str| Some(text.to_owned());
    let asked = |text: &QuestionText| read(Verb::Basins, text, &example());
    let text = QuestionText {
        frequency: some("120rpm"),
        grid: some("30x20"),
        window: some("-90deg..90deg, -2rad/s..3rad/s"),
        shaft: some("half-shaft"),
        periods: some("500"),
        shock: some("half-shaft flange"),
        ..QuestionText::default()
    };
    let Ok(Question::Basins(question)) = asked(&text) else { panic!("is sound") };
    let turn = std::f64::consts::PI;
    assert!((question.frequency - 4.0 * turn).abs() < 1e-12);
    assert_eq!((question.grid, question.periods), ((30, 20), 500));
    assert_eq!(question.shock.as_deref(), Some("half-shaft flange"));
    let [twist, rate] = question.window.expect("is given");
    assert!((twist.0 + 0.5 * turn).abs() < 1e-12 && (twist.1 - 0.5 * turn).abs() < 1e-12);
    assert_eq!(rate, (-2.0, 3.0));
    // All mistakes at once, each with a hint.
    let wrong = QuestionText {
        frequency: some("3Hz..4Hz"),
        grid: some("30x"),
        window: some("1rad..2rad"),
        shaft: some("halfshaft"),
        shock: some("half-shaft"),
        ..QuestionText::default()
    };
    let errors = asked(&wrong).expect_err("is wrong");
    let options: Vec<&str> = errors.iter().map(|error| error.option).collect();
    assert_eq!(options, ["frequency", "shaft", "window", "grid", "shock"]);
    assert!(errors.iter().all(|error| !error.hint.is_empty()), "{errors:?}");
    assert_eq!(asked(&QuestionText::default()).expect_err("has no speed").len(), 1);
}

// Source: by hand.
#[test]
fn a_bifurcation_sweeps_speeds_or_a_number_of_the_model() {
    let some = |text: &str| Some(text.to_owned());
    let asked = |text: &QuestionText| read(Verb::Bifurcation, text, &example());
    let text = QuestionText {
        frequency: some("60rpm..120rpm"),
        steps: some("11"),
        transient: some("0"),
        points: some("7"),
        direction: some("down"),
        no_branches: true,
        ..QuestionText::default()
    };
    let Ok(Question::Bifurcation(question)) = asked(&text) else { panic!("is sound") };
    let turn = std::f64::consts::TAU;
    let (from, to) = question.frequency.expect("is given");
    assert!((from - turn).abs() < 1e-12 && (to - 2.0 * turn).abs() < 1e-12);
    assert_eq!((question.steps, question.transient, question.points), (11, Some(0), 7));
    assert!(!question.branches);
    let over = QuestionText {
        frequency: some("4Hz"),
        parameter: some("half-shaft.damping=1..100"),
        ..QuestionText::default()
    };
    let Ok(Question::Bifurcation(question)) = asked(&over) else { panic!("is sound") };
    assert_eq!(question.parameter.map(|range| (range.from, range.to)), Some((1.0, 100.0)));
    // All mistakes at once, each of them told.
    let wrong = QuestionText {
        frequency: some("0Hz..4Hz"),
        steps: some("1"),
        points: some("0"),
        shaft: some("halfshaft"),
        direction: some("sideways"),
        ..QuestionText::default()
    };
    let errors = asked(&wrong).expect_err("is wrong");
    let options: Vec<&str> = errors.iter().map(|error| error.option).collect();
    assert_eq!(options, ["frequency", "steps", "points", "shaft", "direction"]);
    let single = QuestionText { frequency: some("4Hz"), ..QuestionText::default() };
    let errors = asked(&single).expect_err("sweeps nothing");
    assert!(errors[0].hint.contains("--parameter"), "{errors:?}");
    let many =
        QuestionText { steps: some("1000000"), points: some("1000"), ..QuestionText::default() };
    assert_eq!(asked(&many).expect_err("is too much").len(), 1);
}
