//! The model file: what is accepted, and that every mistake is told at its place.

use halfshaft_model::{Diagnostics, Driveline, SetFlag, Severity, Source, embedded, read_model};

fn read(text: &str) -> Result<(Driveline, Diagnostics), Diagnostics> {
    read_model(Source::new("line.toml", text), &[])
}

fn errors(text: &str) -> Vec<(usize, usize, String, Option<String>)> {
    let found = read(text).expect_err("the text has mistakes");
    found
        .errors()
        .map(|item| {
            let (line, column) = found.sources[item.source].position(item.span.start);
            (line, column, item.message.clone(), item.hint.clone())
        })
        .collect()
}

/// The embedded example with one line replaced.
fn example_with(from: &str, to: &str) -> String {
    let text = embedded::example().text;
    assert!(text.contains(from), "the example has {from}");
    text.replacen(from, to, 1)
}

#[track_caller]
fn assert_one_error(text: &str, excerpt: &str, message: &str, hint: &str) {
    let found = read(text).expect_err("the text has a mistake");
    let items: Vec<_> = found.errors().collect();
    assert_eq!(items.len(), 1, "{}", found.plain());
    let item = items[0];
    let source = &found.sources[item.source];
    assert_eq!(source.excerpt(&item.span), excerpt, "{}", found.plain());
    assert!(item.message.contains(message), "message: {}", item.message);
    let told = item.hint.clone().unwrap_or_default();
    assert!(told.contains(hint), "hint: {told}");
}

#[test]
fn the_embedded_models_are_sound() {
    for source in
        [embedded::example(), embedded::scaled(), Source::new("starter.toml", embedded::starter())]
    {
        let name = source.name.clone();
        let (_, found) = read_model(source, &[]).unwrap_or_else(|e| panic!("{}", e.plain()));
        assert!(found.items.is_empty(), "{name}: {}", found.plain());
    }
}

#[test]
fn the_example_is_table_1_of_the_paper() {
    let (line, _) = read(&embedded::example().text).expect("is sound");
    assert_eq!(line.inertias()[0].inertia_kg_m2, 0.328);
    assert_eq!(line.inertias()[1].inertia_kg_m2, 81.6);
    let shaft = &line.shafts()[0];
    assert_eq!(shaft.stiffness_nm_per_rad, 6420.0);
    assert_eq!(shaft.cubic_nm_per_rad3, -642.0);
    assert_eq!(shaft.damping_nm_s_per_rad, 90.0);
}

#[test]
fn all_mistakes_are_told_at_once_and_in_order() {
    let text = r#"
format = 1
nam = "x"
[[inertia]]
name = "engine"
inertia = "0.3 kg"
[[inertia]]
name = "wheel"
inertia = 0
[[shaft]]
name = "shaft"
from = "engine"
to = "wheel"
stifness = 3
stiffness = "6420 N·m"
cubic = "1 N·m/rad^3 extra"
"#;
    let told = errors(text);
    let places: Vec<_> = told.iter().map(|(line, column, ..)| (*line, *column)).collect();
    assert!(places.len() >= 6, "{told:#?}");
    assert!(told.iter().any(|(.., m, _)| m.contains("unknown key \"nam\"")));
    // Its name is not missing but misspelt.
    assert!(!told.iter().any(|(.., m, _)| m.contains("\"name\" is missing")));
    assert!(told.iter().any(|(l, c, m, _)| (*l, *c) == (6, 11) && m.contains("\"kg\" is a mass")));
    assert!(told.iter().any(|(l, c, m, _)| (*l, *c) == (9, 11) && m.contains("more than zero")));
    assert!(
        told.iter()
            .any(|(l, _, _, h)| *l == 14 && h.as_deref() == Some("did you mean \"stiffness\"?"))
    );
    assert!(told.iter().any(
        |(l, _, _, h)| *l == 15 && h.as_deref().is_some_and(|h| h.contains("N·m/rad, N·m/deg"))
    ));
}

#[test]
fn each_mistake_points_at_its_text() {
    assert_one_error(
        &example_with("\"6420 N·m/rad\"", "\"6420\""),
        "\"6420\"",
        "the unit is missing",
        "bare number 6420",
    );
    assert_one_error(
        &example_with("to = \"vehicle\"", "to = \"vehicel\""),
        "\"vehicel\"",
        "no inertia",
        "did you mean \"vehicle\"?",
    );
    assert_one_error(
        &example_with("on = \"vehicle\"", "on = \"vehikle\""),
        "\"vehikle\"",
        "no node",
        "did you mean \"vehicle\"?",
    );
    assert_one_error(
        &example_with("name = \"final drive\"", "name = \"gearbox\""),
        "\"gearbox\"",
        "two elements are named",
        "must be unique",
    );
    assert_one_error(
        &example_with("\"0.328 kg·m²\"", "\"-0.328 kg·m²\""),
        "\"-0.328 kg·m²\"",
        "more than zero",
        "",
    );
    assert_one_error(&example_with("\"0.328 kg·m²\"", "nan"), "nan", "finite", "");
    assert_one_error(
        &example_with("\"0.328 kg·m²\"", "\"nan kg·m²\""),
        "\"nan kg·m²\"",
        "finite",
        "",
    );
    assert_one_error(
        &example_with("cubic = \"-642 N·m/rad³\"", "kubic = \"-642 N·m/rad³\""),
        "kubic",
        "unknown key",
        "did you mean \"cubic\"?",
    );
    assert_one_error(
        &example_with("shape = \"half-sine\"", "shape = \"halfsine\""),
        "\"halfsine\"",
        "no shape",
        "half-sine",
    );
    assert_one_error(
        &example_with("shape = \"half-sine\", peak = \"-12 kN·m\"", "shape = \"half-sine\""),
        "{ shape = \"half-sine\", start = \"0 s\", duration = \"50 ms\" }",
        "needs \"peak\"",
        "peak",
    );
}

#[test]
fn the_angle_of_a_stiffness_counts() {
    let per_degree = example_with("\"6420 N·m/rad\"", "\"6420 N·m/deg\"");
    let (line, _) = read(&per_degree).expect("is sound");
    let ratio = line.shafts()[0].stiffness_nm_per_rad / 6420.0;
    assert!((ratio - 180.0 / std::f64::consts::PI).abs() < 1e-12);
}

#[test]
fn gear_loops_that_contradict_are_refused_and_consistent_ones_are_not() {
    let text = embedded::example().text;
    let loop_of = |ratio: &str| {
        format!(
            "{text}\n[[gear]]\nname = \"bypass\"\ninput = \"engine\"\n\
             output = \"half-shaft flange\"\nratio = {ratio}\n"
        )
    };
    assert!(read(&loop_of("5.71")).is_ok());
    assert_one_error(&loop_of("5.7"), "5.7", "contradicts", "5.71");
}

#[test]
fn floating_parts_and_locked_loops_are_refused() {
    let text = embedded::example().text;
    assert_one_error(
        &format!("{text}\n[[inertia]]\nname = \"spare wheel\"\ninertia = 1\n"),
        "\"spare wheel\"",
        "floats",
        "connect it",
    );
    let locked = format!(
        "{text}\n[[shaft]]\nname = \"bypass\"\nfrom = \"engine\"\nto = \"vehicle\"\nstiffness = 1\n"
    );
    assert_one_error(&locked, "\"bypass\"", "cannot turn", "agree");
    let idle = format!(
        "{text}\n[[shaft]]\nname = \"idle\"\nfrom = \"engine\"\nto = \"gearbox output\"\n\
         stiffness = 1\n"
    );
    assert_one_error(&idle, "\"gearbox output\"", "never twists", "");
}

#[test]
fn syntax_errors_have_places_too() {
    let told = errors("format = 1\nname = \"x\n[[inertia]\nname = = 3\n");
    assert!(told.iter().any(|(line, ..)| *line == 2), "{told:#?}");
    assert!(errors("").iter().any(|(.., m, _)| m.contains("empty")));
    assert!(errors("   \n\n").iter().any(|(.., m, _)| m.contains("empty")));
    assert!(
        errors("format = 2\nname = \"x\"").iter().any(|(.., m, _)| m.contains("reads format = 1"))
    );
}

#[test]
fn settings_reach_every_numeric_key() {
    let settings: Vec<SetFlag> = [
        "half-shaft.cubic=642 N·m/rad³",
        "half-shaft.quintic = -3",
        "engine torque.amplitude=0.05 kN·m",
        "road load.mean=-4853.5",
        "road load.pulse.peak=-1 kN·m",
        "gearbox.ratio=1.79",
        "engine.inertia=0.4 kg·m²",
    ]
    .map(|text| SetFlag(text.to_owned()))
    .to_vec();
    let (line, _) = read_model(embedded::example(), &settings).expect("is sound");
    assert_eq!(line.shafts()[0].cubic_nm_per_rad3, 642.0);
    assert_eq!(line.shafts()[0].quintic_nm_per_rad5, -3.0);
    assert_eq!(line.torques()[0].harmonics[0].amplitude_nm, 50.0);
    assert_eq!(line.gears()[0].ratio, 1.79);
    let address = line.parameter("road load.pulse.peak").expect("is there");
    assert_eq!(address.value(&line), Some(-1000.0));
}

#[test]
fn wrong_settings_are_told_with_their_text() {
    let settings: Vec<SetFlag> = [
        "half-shaft.cubik=1",
        "halfshaft.cubic=1",
        "half-shaft.cubic",
        "engine.inertia=0",
        "half-shaft.stiffness=6420 N·m",
        "half-shaft.from=1",
    ]
    .map(|text| SetFlag(text.to_owned()))
    .to_vec();
    let found = read_model(embedded::example(), &settings).expect_err("all are wrong");
    let told: Vec<_> = found
        .errors()
        .map(|item| (found.sources[item.source].excerpt(&item.span), item.hint.as_deref()))
        .collect();
    assert_eq!(told.len(), settings.len(), "{}", found.plain());
    assert_eq!(told[0], ("half-shaft.cubik", Some("did you mean \"cubic\"?")));
    assert_eq!(told[1], ("halfshaft.cubic", Some("did you mean \"half-shaft\"?")));
    assert_eq!(told[3].0, "0");
    assert_eq!(told[4].0, "6420 N·m");
}

#[test]
fn a_torque_that_does_nothing_is_a_warning() {
    let text = example_with("mean = \"850 N·m\"\namplitude = \"40 N·m\"\n", "");
    let (_, found) = read(&text).expect("is sound");
    assert_eq!(found.items.len(), 1);
    assert_eq!(found.items[0].severity, Severity::Warning);
}

#[test]
fn the_digest_is_of_the_values_not_of_the_text() {
    let digest = |text: &str| read(text).expect("is sound").0.digest();
    let plain = digest(&embedded::example().text);
    assert_eq!(plain, digest(&example_with("\"0.328 kg·m²\"", "\"3280 kg·cm²\"")));
    assert_ne!(plain, digest(&example_with("\"0.328 kg·m²\"", "\"3281 kg·cm²\"")));
}
