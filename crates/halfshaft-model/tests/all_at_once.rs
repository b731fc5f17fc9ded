//! All mistakes of a file are told together, and none that only follows from another.
//!
//! Source: the model-file contract ("an error that shows file, line, column, the offending text and
//! a hint, all such errors at once").

use halfshaft_model::{SetFlag, Source, embedded, read_model};

/// Messages and hints about the embedded example with some texts replaced.
fn told(changes: &[(&str, &str)], settings: &[&str]) -> Vec<(String, String)> {
    let mut text = embedded::example().text;
    for (from, to) in changes {
        assert!(text.contains(from), "the example has {from}");
        text = text.replacen(from, to, 1);
    }
    let settings: Vec<SetFlag> = settings.iter().map(|text| SetFlag((*text).to_owned())).collect();
    let found = read_model(Source::new("line.toml", text), &settings).expect_err("has mistakes");
    let errors = found.errors();
    errors.map(|item| (item.message.clone(), item.hint.clone().unwrap_or_default())).collect()
}

/// The file must be told exactly these mistakes, each by words of its message and hint.
#[track_caller]
fn assert_told(changes: &[(&str, &str)], settings: &[&str], expected: &[(&str, &str)]) {
    let told = told(changes, settings);
    assert_eq!(told.len(), expected.len(), "{told:#?}");
    for ((message, hint), (words, hint_words)) in told.iter().zip(expected) {
        assert!(message.contains(words) && hint.contains(hint_words), "{words}: {told:#?}");
    }
}

const ZERO_INERTIA: (&str, &str) = ("\"81.6 kg·m²\"", "0");
const MISSPELT: (&str, &str) = ("to = \"vehicle\"", "to = \"vehcile\"");
const TWICE: (&str, &str) = ("name = \"final drive\"", "name = \"gearbox\"");

#[test]
fn values_names_nodes_and_addresses_are_told_together() {
    assert_told(
        &[ZERO_INERTIA, MISSPELT, TWICE, ("on = \"engine\"", "on = \"engin\"")],
        &["half-shaft.cubik=1", "vehicle.inertia=2", "road laod.mean=3"],
        &[
            ("two elements are named \"gearbox\": a gear and a gear", "unique"),
            ("more than zero", ""),
            // The vehicle's value is unsound, but its name is known.
            ("\"vehcile\" has no inertia", "did you mean \"vehicle\""),
            ("no node is named \"engin\"", "did you mean \"engine\""),
            ("no number \"cubik\"", "did you mean \"cubic\""),
            ("no element is named \"road laod\"", "did you mean \"road load\""),
        ],
    );
}

#[test]
fn a_floating_part_and_a_gear_loop_are_told_beside_other_mistakes() {
    let spare = "\n[[inertia]]\nname = \"spare wheel\"\ninertia = \"1 kg\"\n\n[[torque]]\n";
    assert_told(
        &[MISSPELT, ("\n[[torque]]\n", spare)],
        &[],
        &[("\"vehcile\" has no inertia", "vehicle"), ("floats", ""), ("\"kg\" is a mass", "")],
    );
    let bypass = "\n[[gear]]\nname = \"bypass\"\ninput = \"engine\"\n\
                  output = \"half-shaft flange\"\nratio = 6\n\n[[inertia]]\nname = \"vehicle\"";
    assert_told(
        &[ZERO_INERTIA, MISSPELT, ("\n[[inertia]]\nname = \"vehicle\"", bypass)],
        &[],
        &[("contradicts", "5.71"), ("more than zero", ""), ("\"vehcile\" has no inertia", "")],
    );
}

#[test]
fn the_misspelt_end_of_a_gear_is_named_itself() {
    assert_told(
        &[("input = \"engine\"", "input = \"engin\"")],
        &[],
        &[("the node \"engin\" has no inertia", "did you mean \"engine\"")],
    );
}

// Each of these leaves names, nodes or ratios unknown; what depends on them must not be told.
#[test]
fn what_only_follows_from_another_mistake_is_not_told() {
    let cases: &[(&[(&str, &str)], &str)] = &[
        // An inertia without its name: the shaft's end is then unknown.
        (&[("name = \"vehicle\"", "nam = \"vehicle\"")], "\"nam\""),
        (&[("[[inertia]]\nname = \"vehicle\"", "[[inertai]]\nname = \"vehicle\"")], "\"inertai\""),
        // A shaft without one end, which could hold the line at ground.
        (&[("to = \"vehicle\"", "too = \"vehicle\"")], "\"too\""),
        (&[("output = \"half-shaft flange\"", "output = 3")], "must be a text"),
        (&[("ratio = 5.71", "ratio = \"5.71 rad\"")], "leave"),
        (&[("mean = \"850 N·m\"\namplitude = \"40 N·m\"", "mean = \"850 N\"")], "a force"),
        (&[("shape = \"half-sine\"", "shape = \"halfsine\"")], "halfsine"),
        (&[("stiffness = \"6420 N·m/rad\"", "stiffness = \"6420 N·m\"")], "stiffness"),
    ];
    for (changes, words) in cases {
        let told =
            told(changes, &["road load.pulse.impulse=1"][..usize::from(*words == "halfsine")]);
        assert!(told.iter().any(|(message, hint)| (message.clone() + hint).contains(words)));
        // A key that is misspelt is missing under its right name too.
        let missing = |message: &str| message.starts_with("this ");
        let rest = told.iter().filter(|(message, _)| !missing(message)).count();
        assert_eq!(rest, 1, "{words}: {told:#?}");
    }
}

// Source: the example is sound, so one change to one key is one mistake at most.
#[test]
fn one_wrong_or_missing_value_is_one_mistake_at_its_place() {
    let text = embedded::example().text;
    let keys = text.lines().enumerate().filter(|(_, line)| !line.starts_with(['#', '[']));
    for (number, line) in keys {
        let Some((key, _)) = line.split_once(" = ") else { continue };
        let wrong = |replacement: &str| {
            let lines = text.lines().enumerate();
            let lines = lines.map(|(at, line)| if at == number { replacement } else { line });
            let text = lines.collect::<Vec<_>>().join("\n");
            match read_model(Source::new("line.toml", text), &[]) {
                Ok(_) => Vec::new(),
                Err(found) => found
                    .errors()
                    .map(|item| {
                        (found.sources[0].position(item.span.start).0, item.message.clone())
                    })
                    .collect(),
            }
        };
        let told = wrong(&format!("{key} = true"));
        assert!(told.len() == 1 && told[0].0 == number + 1, "{line}: {told:#?}");
        let told = wrong("");
        assert!(told.len() <= 1, "{line}: {told:#?}");
    }
}

#[test]
fn only_ratios_that_are_known_contradict_each_other() {
    let bypass = |ratio: &str| {
        format!(
            "\n[[gear]]\nname = \"bypass\"\ninput = \"engine\"\noutput = \"half-shaft flange\"\n\
             ratio = {ratio}\n\n[[shaft]]\n"
        )
    };
    assert_told(&[("\n[[shaft]]\n", &bypass("0"))], &[], &[("not be zero", "")]);
    assert_told(&[("\n[[shaft]]\n", &bypass("6"))], &[], &[("contradicts", "5.71")]);
}

#[test]
fn mistakes_are_told_in_the_order_of_the_file() {
    let text = embedded::example().text.replace("\"0.328 kg·m²\"", "0").replace(TWICE.0, TWICE.1);
    let found = read_model(Source::new("line.toml", text), &[]).expect_err("has mistakes");
    let starts: Vec<usize> = found.errors().map(|item| item.span.start).collect();
    assert!(starts.len() == 2 && starts[0] < starts[1], "{}", found.plain());
}

#[test]
fn nouns_have_their_articles() {
    let twin = "\n[[inertia]]\nname = \"engine\"\ninertia = 1\n\n[[gear]]\n";
    let told_twin = told(&[("\n[[gear]]\n", twin)], &[]);
    assert!(told_twin[0].0.contains("an inertia and an inertia"), "{told_twin:?}");
    let ground = told(&[("name = \"vehicle\"", "name = \"ground\"")], &[]);
    assert!(ground.iter().any(|(m, _)| m.contains("an inertia cannot be named")), "{ground:?}");
}

/// A line of `count` shafts from one hub, each to a node of its own that no inertia names.
fn misspelt(count: usize) -> String {
    let mut text =
        "format = 1\nname = \"x\"\n[[inertia]]\nname = \"hub\"\ninertia = 1\n".to_owned();
    for number in 0..count {
        text += &format!("[[inertia]]\nname = \"wheel number {number}\"\ninertia = 1\n");
        text += &format!("[[gear]]\nname = \"gear {number}\"\nratio = 2\n");
        text += &format!("input = \"hub\"\noutput = \"wheel number {number}\"\n");
        text += &format!("[[shaft]]\nname = \"shaft {number}\"\nstiffness = 1\n");
        text += &format!("from = \"hub\"\nto = \"weel number {number}\"\n");
        text +=
            &format!("[[torque]]\nname = \"torque {number}\"\nmean = 1\non = \"weel {number}\"\n");
    }
    text
}

// Source: the clock: twice the mistakes take about twice the time. Eight times would be sixty-four
// times for a reader that holds every name against every other.
#[test]
fn many_mistakes_take_time_in_proportion() {
    let time = |count: usize| {
        let text = misspelt(count);
        let start = std::time::Instant::now();
        let found = read_model(Source::new("x", text), &[]).expect_err("has mistakes");
        assert!(found.items.len() >= count);
        assert!(found.plain().contains("did you mean \"wheel number 0\"?"));
        start.elapsed()
    };
    time(100);
    let (few, many) = (time(500), time(4000));
    assert!(many < 25 * few, "{few:?}, then {many:?}");
}
