//! Bars, dampers, engines, order tables and the line as a whole in the model file.

use std::fs;

use halfshaft_model::elements::MeanTorque;
use halfshaft_model::{Driveline, SetFlag, Source, Topology, read_file, read_model};

const LINE: &str = r#"
format = 1
name = "line"
[line]
modal_damping = 0.01
operating = "800 rpm..6000 rpm"
[[inertia]]
name = "crank"
inertia = 0.2
[[inertia]]
name = "load"
inertia = 2
[[shaft]]
name = "bar"
from = "crank"
to = "load"
length = "1.5 m"
outer_diameter = "60 mm"
inner_diameter = "40 mm"
shear_modulus = "80 GPa"
density = "7850 kg/m³"
elements = 3
damping = 2
[[damper]]
name = "ring"
on = "crank"
inertia = 0.01
damping = 3
"#;

fn read(text: &str, settings: &[&str]) -> Result<Driveline, String> {
    let settings: Vec<SetFlag> = settings.iter().map(|s| SetFlag((*s).to_owned())).collect();
    match read_model(Source::new("line.toml", text), &settings) {
        Ok((line, _)) => Ok(line),
        Err(found) => Err(found.plain()),
    }
}

// Source: the formulas of a hollow bar with numbers put in by hand: I = π (60⁴ - 40⁴) / 32 mm⁴.
#[test]
fn a_bar_is_cut_into_pieces_with_its_stiffness_and_inertia() {
    let line = read(LINE, &[]).expect("is sound");
    let moment = std::f64::consts::PI * (0.06_f64.powi(4) - 0.04_f64.powi(4)) / 32.0;
    let plain = line.expanded();
    let pieces: Vec<_> = plain.shafts().iter().filter(|s| s.name.starts_with("bar.")).collect();
    assert_eq!(pieces.len(), 3);
    for piece in &pieces {
        assert!((piece.stiffness_nm_per_rad / (80e9 * moment / 0.5) - 1.0).abs() < 1e-13);
        assert!((piece.damping_nm_s_per_rad - 6.0).abs() < 1e-13);
        assert!((piece.inertance_kg_m2 / (-7850.0 * moment * 0.5 / 6.0) - 1.0).abs() < 1e-13);
    }
    let total: f64 = plain.inertias().iter().map(|inertia| inertia.inertia_kg_m2).sum();
    assert!((total - (2.2 + 0.01 + 7850.0 * moment * 1.5)).abs() < 1e-12);
    // Inertias: two of the file, the ring, two nodes between the pieces.
    assert_eq!(plain.inertias().len(), 5);
    let topology = Topology::of(&plain).expect("is sound");
    assert!(topology.node("ring.ring").is_some() && topology.node("bar.node 2").is_some());
    // A whole bar for drawings.
    assert_eq!(line.with_whole_bars().shafts().len(), 2);
}

#[test]
fn every_number_has_an_address() {
    let line = read(
        LINE,
        &["bar.length=3 m", "ring.damping=5", "line.modal_damping=0.03", "line.loss_factor=0.2"],
    )
    .expect("is sound");
    assert!((line.whole().modal_damping - 0.03).abs() < 1e-15);
    assert!((line.whole().loss_factor - 0.2).abs() < 1e-15);
    assert!((line.dampers()[0].damping_nm_s_per_rad - 5.0).abs() < 1e-15);
    let bar = line.shafts()[0].dimensions.as_ref().expect("is a bar");
    assert!((bar.length_m - 3.0).abs() < 1e-15);
    let told = read(LINE, &["bar.stiffness=3"]).expect_err("a bar has no stiffness of its own");
    assert!(told.contains("no number \"stiffness\""), "{told}");
    let told = read(LINE, &["bar.inner_diameter=70 mm"]).expect_err("no wall");
    assert!(told.contains("not less than the outer"), "{told}");
}

#[test]
fn all_mistakes_of_bars_and_engines_are_told_at_once() {
    let text = format!(
        "{LINE}\n[[shaft]]\nname = \"half\"\nfrom = \"crank\"\nto = \"load\"\nlength = 1\ncubic = 3\n\
         [[damper]]\nname = \"loose\"\non = \"crank\"\ninertia = 1\n\
         [[engine]]\nname = \"four\"\non = [\"krank\"]\nfiring_order = [1, 3, 3, 2]\nbore = \"80 mm\"\n\
         stroke = \"90 mm\"\nrod_length = \"40 mm\"\nstrokes = 3\nhighest_order = 1e9\n\
         pressure = {{ angle = [0, 1, 2, 3], pressure = [1, 2, 3, 4] }}\n\
         torque = {{ angle = [0, 1], torque = [1, 2] }}\n"
    );
    let told = read(&text, &[]).expect_err("much is wrong");
    for part in [
        "a shaft with \"length\" has no \"cubic\"",
        "a shaft with \"length\" needs \"outer_diameter\"",
        "a shaft with \"length\" needs \"shear_modulus\"",
        "nothing holds the ring of damper \"loose\"",
        "the rod is not longer than the crank radius",
        "2 or 4 strokes",
        "name each cylinder from 1 to 4 once",
        "a pressure or a torque, not both",
        "orders are taken up to 500",
    ] {
        assert!(told.contains(part), "{part} in\n{told}");
    }
    let text = format!(
        "{LINE}\n[[engine]]\nname = \"one\"\non = [\"krank\"]\n\
         torque = {{ angle = [0, 1, 2, 3], torque = [1, 2, 3, 4] }}\n"
    );
    let told = read(&text, &[]).expect_err("no such node, no cycle");
    assert!(told.contains("no node is named \"krank\"") && told.contains("crank"), "{told}");
    assert!(told.contains("not the 720 degrees of a working cycle"), "{told}");
}

// Source: the same numbers in the model and in files.
#[test]
fn tables_of_engines_and_orders_come_from_files() {
    let folder = std::env::temp_dir().join(format!("halfshaft-engine-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let path = |name: &str| folder.join(name);
    let mut pressure = "angle [deg]; pressure [bar]\n".to_owned();
    for step in 0..=72 {
        pressure += &format!("{}; {}\n", 10 * step, 1 + step % 5);
    }
    fs::write(path("pressure.csv"), pressure).expect("is written");
    fs::write(
        path("orders.csv"),
        "order, phase [deg], amplitude [kN·m]\n0.5, 90, 0.02\n2, -180, 1\n",
    )
    .expect("is written");
    let text = format!(
        "{LINE}\n[[engine]]\nname = \"one\"\non = [\"crank\"]\nbore = 0.08\nstroke = 0.09\n\
         rod_length = 0.15\npressure = \"pressure.csv\"\n[[torque]]\nname = \"measured\"\non = \"load\"\n\
         mean = \"balance\"\norders = \"orders.csv\"\n"
    );
    fs::write(path("line.toml"), text).expect("is written");
    let source = read_file(&path("line.toml")).expect("is there");
    let (line, _) = match read_model(source, &[]) {
        Ok(read) => read,
        Err(found) => panic!("{}", found.plain()),
    };
    let table = line.engines()[0].pressure.as_ref().expect("has points");
    let (first, values) = table.cycle(2.0).expect("is a cycle");
    // The end of the cycle is the beginning of the next.
    assert_eq!((first, values.len(), values[3]), (0.0, 72, 4e5));
    let torque = &line.torques()[0];
    assert_eq!(torque.mean, MeanTorque::Balance);
    let told: Vec<_> =
        torque.harmonics[1..].iter().map(|h| (h.order, h.amplitude_nm, h.phase_rad)).collect();
    let pi = std::f64::consts::PI;
    assert_eq!(told, [(0.5, 20.0, pi / 2.0), (2.0, 1000.0, -pi)]);
    fs::write(path("orders.csv"), "order, phase [deg]\n0.5, 90\n").expect("is written");
    let source = read_file(&path("line.toml")).expect("is there");
    let told = read_model(source, &[]).expect_err("a column is missing").plain();
    assert!(told.contains("2 columns, not order, amplitude and phase"), "{told}");
    fs::remove_dir_all(&folder).expect("is left");
}
