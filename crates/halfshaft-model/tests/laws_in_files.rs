//! Torque laws in model files: what is read, what goes together, what is told where.
//!
//! Source: the model-file contract.

use std::path::{Path, PathBuf};

use halfshaft_model::elements::Stage;
use halfshaft_model::{ChangeError, Driveline, SetFlag, Severity, Source, read_file, read_model};

/// A line whose only shaft has the given keys, then further tables.
fn text(law: &str, more: &str) -> String {
    format!(
        "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 1\n[[inertia]]\n\
         name = \"b\"\ninertia = 1\n[[shaft]]\nname = \"s\"\nfrom = \"a\"\nto = \"b\"\n{law}\n{more}"
    )
}

fn sound(text: &str, settings: &[&str]) -> Driveline {
    let settings: Vec<SetFlag> = settings.iter().map(|text| SetFlag((*text).to_owned())).collect();
    let (line, found) = read_model(Source::new("line.toml", text), &settings)
        .unwrap_or_else(|found| panic!("{}", found.plain()));
    assert!(found.items.is_empty(), "{}", found.plain());
    line
}

/// Offending texts, messages and hints of a text with mistakes.
fn told(text: &str, settings: &[&str]) -> Vec<(String, String, String)> {
    let settings: Vec<SetFlag> = settings.iter().map(|text| SetFlag((*text).to_owned())).collect();
    let found = read_model(Source::new("line.toml", text), &settings).expect_err("has mistakes");
    let item = |item: &halfshaft_model::Diagnostic| {
        let place = found.sources[item.source].excerpt(&item.span).to_owned();
        (place, item.message.clone(), item.hint.clone().unwrap_or_default())
    };
    found.errors().map(item).collect()
}

#[track_caller]
fn assert_told(text: &str, expected: &[(&str, &str, &str)]) {
    let told = told(text, &[]);
    assert_eq!(told.len(), expected.len(), "{told:#?}");
    for ((place, message, hint), (excerpt, words, hint_words)) in told.iter().zip(expected) {
        assert!(place == excerpt && message.contains(words), "{excerpt}: {told:#?}");
        assert!(hint.contains(hint_words), "{hint_words}: {told:#?}");
    }
}

const STAGES: &str = "stages = [{ until = \"4 deg\", stiffness = \"200 N·m/rad\" }, { until = \
     \"12 deg\", stiffness = 1200 }, { stiffness = \"9 kN·m/rad\" }]";

#[test]
fn every_law_is_read() {
    let line = sound(&text(&format!("{STAGES}\nfriction = \"15 N·m\""), ""), &[]);
    let shaft = &line.shafts()[0];
    let degree = std::f64::consts::PI / 180.0;
    let first = Stage { until_rad: Some(4.0 * degree), stiffness_nm_per_rad: 200.0 };
    assert_eq!((shaft.stages.len(), shaft.stages[0]), (3, first));
    assert_eq!(shaft.stages[2], Stage { until_rad: None, stiffness_nm_per_rad: 9000.0 });
    assert_eq!((shaft.friction_nm, shaft.friction_speed_rad_s), (15.0, 0.01));
    assert_eq!(shaft.stiffness_nm_per_rad, 0.0);

    let law = "stiffness = 5000\ncubic = 2e4\nclearance = \"2 deg\"\npreload = \"-3 N·m\"\n\
               damping = 65\ndamping_acts = \"in contact\"";
    let line = sound(&text(law, ""), &[]);
    let shaft = &line.shafts()[0];
    assert_eq!((shaft.clearance_rad, shaft.preload_nm), (Some(2.0 * degree), -3.0));
    assert!(!shaft.damps_in_gap);

    let line = sound(&text("stiffness = 5000\ncontact = \"-1 rad\"", ""), &[]);
    assert_eq!(line.shafts()[0].contact_rad, Some(-1.0));

    let law = "table = { twist = [\"-6 deg\", 0, \"6 deg\"], torque = [\"-0.9 kN·m\", 0, 800] }";
    let line = sound(&text(law, ""), &[]);
    let table = line.shafts()[0].table.as_ref().expect("is there");
    assert_eq!(table.torque_nm, [-900.0, 0.0, 800.0]);
    assert!((table.twist_rad[2] - 6.0 * degree).abs() < 1e-16);
}

#[test]
fn laws_that_do_not_go_together_are_told_all_at_once() {
    let law = format!("{STAGES}\ncubic = 3\nclearance = 0.1\nstiffness = 2");
    assert_told(
        &text(&law, ""),
        &[
            ("3", "a shaft with \"stages\" has no \"cubic\"", "leave out"),
            ("0.1", "has no \"clearance\"", "leave out"),
            ("2", "has no \"stiffness\"", "leave out"),
        ],
    );
    let table = "{ twist = [0, 1], torque = [0, 1] }";
    assert_told(
        &text(&format!("table = {table}\nquintic = 4"), ""),
        &[("4", "a shaft with \"table\" has no \"quintic\"", "table")],
    );
    let both = text("stiffness = 1\nclearance = 0.1\ncontact = 0.2", "");
    assert_told(&both, &[("0.2", "a clearance or a contact", "second shaft")]);
    let gap = text("clearance = 0.1\ncubic = 1", "");
    assert_told(&gap, &[("0.1", "has a clearance and no \"stiffness\"", "add stiffness")]);
    let coast = text("stiffness = 1\ncoast_stages = [{ stiffness = 1 }]", "");
    let coast = told(&coast, &[]);
    assert!(coast.iter().any(|(_, message, _)| message.contains("coast_stages need stages")));
    let none = text("damping = 3", "");
    assert!(told(&none, &[])[0].1.contains("has no \"stiffness\""));
}

#[test]
fn stages_and_points_out_of_order_are_told_at_their_place() {
    let law = "stages = [{ until = 0.2, stiffness = 1 }, { until = 0.1, stiffness = 2 }, \
               { stiffness = 3 }, { stiffness = 4, until = 0.7 }]";
    assert_told(
        &text(law, ""),
        &[
            ("0.1", "stage 2 ends where the one before it does", "order"),
            ("3", "stage 3 has no \"until\"", "last"),
            ("0.7", "the last stage has an \"until\"", "add a stage"),
        ],
    );
    let table = |twist: &str, torque: &str| {
        text(&format!("table = {{ twist = [{twist}], torque = [{torque}] }}"), "")
    };
    let message = |text: &str| told(text, &[])[0].1.clone();
    assert!(message(&table("0, 1, 1", "0, 1, 2")).contains("from point 2 to 3"));
    assert!(message(&table("0, 1", "0, 1, 2")).contains("2 twists and 3 torques"));
    assert!(message(&table("0", "1")).contains("fewer than two points"));
    // What is unsound is told, and nothing that follows from it.
    let told = told(&table("0, \"1 deg\", \"1 N\"", "0, 1"), &[]);
    assert_eq!(told.len(), 1, "{told:#?}");
}

#[test]
fn every_number_of_a_law_has_its_address() {
    let settings = [
        "s.stages.1.until = 5 deg",
        "s.stages.3.stiffness = 8 kN·m/rad",
        "s.friction = 3",
        "s.friction_speed = 1 rpm",
        "s.preload = 2 N·m",
    ];
    let line = sound(&text(STAGES, ""), &settings);
    let shaft = &line.shafts()[0];
    assert_eq!(shaft.stages[2].stiffness_nm_per_rad, 8000.0);
    assert_eq!((shaft.friction_nm, shaft.preload_nm), (3.0, 2.0));
    assert!((shaft.stages[0].until_rad.expect("set") - 5.0_f64.to_radians()).abs() < 1e-16);
    // A number of another law, and the limit that the last stage has not.
    for address in ["s.cubic", "s.clearance", "s.stages.3.until", "s.stages.4.stiffness"] {
        assert!(line.parameter(address).is_err(), "{address}");
    }
    let table = "table = { twist = [-1, 0, 1], torque = [-5, 0, 5] }";
    let line = sound(&text(table, ""), &["s.table.torque.3 = 6"]);
    let parameter = line.parameter("s.table.twist.2").expect("is there");
    assert_eq!(parameter.value(&line), Some(0.0));
    assert!(matches!(line.with(&parameter, 1.5), Err(ChangeError::Law { .. })));
    let line = line.with(&parameter, 0.5).expect("still ascends");
    assert_eq!(line.shafts()[0].table.as_ref().map(|t| t.torque_nm[2]), Some(6.0));
    // A polynomial has a clearance that is zero until it is set.
    let line = sound(&text("stiffness = 1", ""), &[]);
    let parameter = line.parameter("s.clearance").expect("is there");
    assert_eq!(parameter.value(&line), Some(0.0));
    let line = line.with(&parameter, 0.1).expect("is allowed");
    assert_eq!(line.shafts()[0].clearance_rad, Some(0.1));
}

#[test]
fn a_setting_that_breaks_the_order_is_told() {
    let told = told(&text(STAGES, ""), &["s.stages.1.until=13 deg"]);
    assert!(told.len() == 1 && told[0].1.contains("stage 2 ends"), "{told:?}");
}

#[test]
fn keys_that_do_nothing_are_warnings() {
    let warned = |law: &str| {
        let (_, found) = read_model(Source::new("line.toml", text(law, "")), &[])
            .unwrap_or_else(|found| panic!("{}", found.plain()));
        assert_eq!(found.items.len(), 1);
        assert_eq!(found.items[0].severity, Severity::Warning);
        found.items[0].message.clone()
    };
    assert!(warned("stiffness = 1\nfriction_speed = 1").contains("without friction"));
    assert!(warned("stiffness = 1\ndamping_acts = \"always\"").contains("without a clearance"));
}

const GEAR: &str = "[[inertia]]\nname = \"c\"\ninertia = 1\n[[gear]]\nname = \"g\"\ninput = \"b\"\n\
     output = \"c\"\nratio = 3\n";

#[test]
fn an_elastic_mesh_is_a_connection() {
    let mesh = format!("{GEAR}stiffness = \"1 MN·m/rad\"\nclearance = \"0.1 deg\"\ndamping = 2\n");
    let line = sound(&text("stiffness = 1", &mesh), &["g.damping=3"]);
    assert!(line.connection_names().eq(["s", "g"]));
    assert_eq!(line.gears()[0].damping_nm_s_per_rad, Some(3.0));
    // A rigid gear has no numbers of a mesh but the stiffness, which makes it elastic.
    let rigid = sound(&text("stiffness = 1", GEAR), &[]);
    assert!(rigid.connection_names().eq(["s"]));
    assert!(rigid.parameter("g.clearance").is_err());
    let parameter = rigid.parameter("g.stiffness").expect("is there");
    assert_eq!(parameter.value(&rigid), None);
    assert!(rigid.with(&parameter, 1e6).expect("is allowed").gears()[0].is_elastic());
    let elastic = sound(&text("stiffness = 1", GEAR), &["g.stiffness=1e6", "g.clearance=0.1"]);
    assert_eq!(elastic.gears()[0].clearance_rad, Some(0.1));
    assert_ne!(rigid.digest(), elastic.digest());
    let meshes_only =
        text("", &mesh).replace("[[shaft]]\nname = \"s\"\nfrom = \"a\"\nto = \"b\"\n", "");
    let told = told(&meshes_only, &[]);
    assert!(told.len() == 1 && told[0].1.contains("float"), "{told:?}");
}

#[test]
fn meshes_that_cannot_be_are_told() {
    let loose = format!("{GEAR}clearance = 0.1\ndamping = 1\n");
    assert_told(
        &text("stiffness = 1", &loose),
        &[
            ("0.1", "\"clearance\" needs the stiffness", "add stiffness"),
            ("1", "\"damping\" needs the stiffness", "add stiffness"),
        ],
    );
    let beside = format!(
        "{GEAR}[[gear]]\nname = \"e\"\ninput = \"b\"\noutput = \"c\"\nratio = 3\nstiffness = 5\n"
    );
    let told = told(&text("stiffness = 1", &beside), &[]);
    assert!(told.len() == 1 && told[0].1.contains("rigid gears hold together"), "{told:?}");
}

#[test]
fn a_growing_torque_needs_its_reference() {
    let torque = "[[torque]]\nname = \"t\"\non = \"a\"\namplitude = 3\n";
    let growing = format!("{torque}speed_power = 2\nreference_speed = \"600 rpm\"\n");
    let line = sound(&text("stiffness = 1", &growing), &["t.speed_power=1.5"]);
    let torque_read = &line.torques()[0];
    assert_eq!(torque_read.speed_power, Some(1.5));
    let speed = torque_read.reference_speed_rad_s.expect("is there");
    assert!((speed - 20.0 * std::f64::consts::PI).abs() < 1e-12);
    let alone = format!("{torque}speed_power = 2\n");
    assert_told(
        &text("stiffness = 1", &alone),
        &[("2", "speed_power needs a reference_speed", "rpm")],
    );
}

/// A folder of its own that goes with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("halfshaft-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("can be made");
        Self(folder)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, text).expect("can be written");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Left behind at worst.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn read_path(path: &Path) -> Result<Driveline, halfshaft_model::Diagnostics> {
    read_model(read_file(path).expect("is there"), &[]).map(|(line, _)| line)
}

#[test]
fn a_table_in_a_file_is_found_beside_the_model() {
    let folder = Folder::new("table");
    let model = folder.write("line.toml", &text("table = \"law.csv\"", ""));
    folder.write("law.csv", "torque [N·m]; twist [deg]\n-50; -1\n0; 0\n40; 1\n");
    let line = read_path(&model).unwrap_or_else(|found| panic!("{}", found.plain()));
    let inline = "table = { twist = [\"-1 deg\", 0, \"1 deg\"], torque = [-50, 0, 40] }";
    assert_eq!(line.shafts(), sound(&text(inline, ""), &[]).shafts());

    folder.write("law.csv", "twist, torque\n0, 0\n0.5 deg, 3\n1, x\n");
    let found = read_path(&model).expect_err("has mistakes");
    let places: Vec<_> = found
        .errors()
        .map(|item| {
            let source = &found.sources[item.source];
            (source.name.ends_with("law.csv"), source.position(item.span.start))
        })
        .collect();
    assert_eq!(places, [(true, (3, 1)), (true, (4, 4))], "{}", found.plain());

    folder.write("law.csv", "twist, torque\n1, 0\n0, 1\n");
    let found = read_path(&model).expect_err("does not ascend");
    assert!(found.plain().contains("do not ascend"), "{}", found.plain());
}

#[test]
fn a_table_file_that_is_missing_is_told_at_the_key() {
    let told = told(&text("table = \"no such file.csv\"", ""), &[]);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].0 == "\"no such file.csv\"" && told[0].2.contains("relative"), "{told:?}");
}
