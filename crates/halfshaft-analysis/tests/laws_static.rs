//! `static` and `modes` for every kind of law, against the laws solved by hand.

mod common;

use common::{assert_close, line_of, modes, statics, try_ask};
use halfshaft_analysis::AnalysisError;
use halfshaft_model::question::{QuestionText, Verb};

/// A free line of two inertias whose shaft has the given keys and carries `torque`.
fn loaded(law: &str, torque: f64) -> String {
    format!(
        "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 2\n[[inertia]]\n\
         name = \"b\"\ninertia = 3\n[[shaft]]\nname = \"s\"\nfrom = \"a\"\nto = \"b\"\n{law}\n\
         [[torque]]\nname = \"t\"\non = \"a\"\nmean = {torque:?}\namplitude = 1\n[[torque]]\n\
         name = \"u\"\non = \"b\"\nmean = \"balance\"\n"
    )
}

/// Twists of the shaft in equilibrium, each with whether it is stable.
fn twists(law: &str, torque: f64) -> Vec<(f64, bool)> {
    let result = statics(&line_of(&loaded(law, torque), &[]));
    assert!(result.complete);
    result.equilibria.iter().map(|state| (state.twist["s"], state.stable)).collect()
}

#[track_caller]
fn assert_twists(law: &str, torque: f64, expected: &[(f64, bool)]) {
    let mut found = twists(law, torque);
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found.0 - expected.0).abs() < 1e-12 && found.1 == expected.1, "{found:?}");
    }
}

const GAP: &str = "stiffness = 500\nclearance = 0.2";
const STAGES: &str = "stages = [{ until = 0.1, stiffness = 100 }, { until = 0.3, stiffness = 400 }, \
     { stiffness = 2000 }]\ncoast_stages = [{ until = 0.2, stiffness = 50 }, { stiffness = 1000 }]";
/// Rises to 60 at 0.2, falls to 20 at 0.5, rises again.
const TABLE: &str = "table = { twist = [-0.2, 0, 0.2, 0.5, 0.9], torque = [-60, 0, 60, 20, 100] }";

// Source: the laws by hand: torque / stiffness beyond the edge of the gap or stage.
#[test]
fn each_law_finds_its_twist() {
    assert_twists(GAP, 50.0, &[(0.2, true)]);
    assert_twists(GAP, -50.0, &[(-0.2, true)]);
    assert_twists(STAGES, 5.0, &[(0.05, true)]);
    assert_twists(STAGES, 50.0, &[(0.2, true)]);
    assert_twists(STAGES, 290.0, &[(0.4, true)]);
    assert_twists(STAGES, -5.0, &[(-0.1, true)]);
    assert_twists(STAGES, -110.0, &[(-0.3, true)]);
    assert_twists("stiffness = 500\ncontact = 0.3", 100.0, &[(0.5, true)]);
    assert_twists("stiffness = 500\ncontact = 0.3", -100.0, &[]);
    assert_twists("stiffness = 500\npreload = 25", 100.0, &[(0.15, true)]);
    // A cubic flank: 5000 d + 20000 d³ = 100 has d = 0.0199686 by Newton's method by hand.
    let found = twists("stiffness = 5000\ncubic = 20000\nclearance = 0.02", 100.0);
    let d = found[0].0 - 0.01;
    assert!(found.len() == 1 && (5000.0 * d + 20000.0 * d.powi(3) - 100.0).abs() < 1e-10);
}

// Source: a curve that rises, falls and rises again meets a torque between its extremes three
// times, and the middle one does not hold; below and above once.
#[test]
fn a_table_that_falls_has_three_equilibria() {
    let found = twists(TABLE, 40.0);
    let mut by_twist = found.clone();
    by_twist.sort_by(|a, b| a.0.total_cmp(&b.0));
    let stable: Vec<bool> = by_twist.iter().map(|(_, stable)| *stable).collect();
    assert_eq!(stable, [true, false, true]);
    assert!(by_twist[0].0 < 0.2 && by_twist[1].0 < 0.5 && by_twist[2].0 > 0.5);
    assert_eq!(twists(TABLE, 10.0).len(), 1);
    assert_eq!(twists(TABLE, 80.0).len(), 1);
    // Beyond its points it is straight, and that is told.
    let result = statics(&line_of(&loaded(TABLE, 500.0), &[]));
    assert!(result.header.warnings.iter().any(|w| w.contains("beyond its table")));
}

// Source: the definitions of the laws: a last stage with stiffness carries anything, one without
// what it has reached; a table carries its highest point.
#[test]
fn capacities_follow_the_last_part_of_the_law() {
    let limit = |law: &str| {
        let result = statics(&line_of(&loaded(law, 1.0), &[]));
        let capacity = result.capacity["s"];
        (capacity.positive.map(|l| (l.torque, l.twist)), capacity.negative.map(|l| l.torque))
    };
    assert_eq!(limit(GAP), (None, None));
    assert_eq!(limit(STAGES), (None, None));
    let slipping = "stages = [{ until = 0.1, stiffness = 100 }, { stiffness = 0 }]";
    assert_eq!(limit(slipping), (Some((10.0, 0.1)), Some(-10.0)));
    let (positive, negative) = limit(TABLE);
    let (torque, twist) = positive.expect("it falls");
    assert!((torque - 60.0).abs() < 1e-12 && (twist - 0.2).abs() < 1e-12 && negative.is_none());
    let stop = limit("stiffness = 500\ncontact = 0.3");
    assert_eq!(stop, (None, Some(0.0)));
}

// Source: the slipping shaft carries 10 N·m and no more.
#[test]
fn a_shaft_that_slips_has_no_state_beyond_its_torque() {
    let law = "stages = [{ until = 0.1, stiffness = 100 }, { stiffness = 0 }]";
    let result = statics(&line_of(&loaded(law, 12.0), &[]));
    assert!(result.equilibria.is_empty());
    assert!(result.header.warnings[0].contains("carries 10"), "{:?}", result.header.warnings);
}

// Source: inside a gap all twists are in balance; the line stays there and has no stiffness.
#[test]
fn a_line_rests_inside_its_clearance() {
    let line = line_of(&loaded(GAP, 0.0), &[]);
    let result = statics(&line);
    assert!(result.equilibria.len() == 1 && result.equilibria[0].stable);
    assert_eq!(result.equilibria[0].twist["s"], 0.0);
    let told = |warnings: &[String]| warnings.iter().any(|w| w.contains("-0.100000 to 0.100000"));
    assert!(told(&result.header.warnings), "{:?}", result.header.warnings);
    let result = modes(&line);
    assert!(told(&result.header.warnings));
    assert_eq!(result.modes[1].frequency, 0.0);
    assert!(result.modes[1].label.contains("free play"), "{}", result.modes[1].label);
}

// Source: the tangent of the flank: sqrt(k (1/2 + 1/3)).
#[test]
fn on_a_flank_the_modes_are_those_of_its_tangent() {
    let result = modes(&line_of(&loaded(GAP, 50.0), &[]));
    assert_close(result.modes[1].frequency, (500.0_f64 * (0.5 + 1.0 / 3.0)).sqrt(), 1e-12);
    let law = "stages = [{ until = 0.1, stiffness = 100 }, { stiffness = 2000 }]\nfriction = 3";
    let result = modes(&line_of(&loaded(law, 50.0), &[]));
    assert_close(result.modes[1].frequency, (2000.0_f64 * (0.5 + 1.0 / 3.0)).sqrt(), 1e-12);
    assert!(result.header.assumptions.iter().any(|a| a.contains("left out")));
}

// Source: parallel shafts: torques add at the same twist. 300 x and, from 0.1 on, 500 (x - 0.1).
#[test]
fn laws_side_by_side_add_their_torques() {
    let second = "[[shaft]]\nname = \"stop\"\nfrom = \"b\"\nto = \"a\"\nstiffness = 500\n\
                  clearance = 0.2\n";
    for (torque, twist) in [(15.0, 0.05), (-15.0, -0.05), (110.0, 0.2), (-110.0, -0.2)] {
        let text = loaded("stiffness = 300", torque) + second;
        let result = statics(&line_of(&text, &[]));
        assert!(result.complete && result.equilibria.len() == 1);
        assert!((result.equilibria[0].twist["s"] - twist).abs() < 1e-13);
        assert!((result.equilibria[0].twist["stop"] + twist).abs() < 1e-13);
    }
}

// Source: reference "One-sided contact": K = [[1, -1], [-1, 2]] and a stop on the first; a static
// force F on the second moves q1 = q2 = F below the stop, above it by the two equations by hand.
#[test]
fn a_stop_inside_a_loop_is_found_by_search() {
    let text = |force: f64| {
        format!(
            "format = 1\nname = \"x\"\n[[inertia]]\nname = \"q1\"\ninertia = 1\n[[inertia]]\n\
             name = \"q2\"\ninertia = 1\n[[shaft]]\nname = \"k\"\nfrom = \"q2\"\nto = \"ground\"\n\
             stiffness = 1\n[[shaft]]\nname = \"c\"\nfrom = \"q1\"\nto = \"q2\"\nstiffness = 1\n\
             [[shaft]]\nname = \"stop\"\nfrom = \"q1\"\nto = \"ground\"\nstiffness = 100\n\
             contact = 1\n[[torque]]\nname = \"t\"\non = \"q2\"\nmean = {force:?}\n"
        )
    };
    for force in [0.5, -3.0, 1.5, 40.0] {
        let result = statics(&line_of(&text(force), &[]));
        // (1 + 100) q1 - q2 = 100 and -q1 + 2 q2 = F once the stop touches.
        let (q1, q2) = if force <= 1.0 {
            (force, force)
        } else {
            ((force + 200.0) / 201.0, (101.0 * force + 100.0) / 201.0)
        };
        let stable: Vec<_> = result.equilibria.iter().filter(|state| state.stable).collect();
        assert_eq!(stable.len(), 1, "{force}: {:?}", result.equilibria);
        assert!((stable[0].twist["stop"] - q1).abs() < 1e-9, "{force}: {:?} {q1}", stable[0]);
        assert!((stable[0].twist["k"] - q2).abs() < 1e-9);
    }
}

// Source: the same line with a rigid gear and a shaft behind it.
#[test]
fn an_elastic_mesh_is_a_shaft_behind_the_gear() {
    let inertias = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 0.3\n[[inertia]]\n\
                    name = \"b\"\ninertia = 4\n[[inertia]]\nname = \"c\"\ninertia = 9\n[[shaft]]\n\
                    name = \"s\"\nfrom = \"b\"\nto = \"c\"\nstiffness = 800\ndamping = 2\n[[torque]]\n\
                    name = \"t\"\non = \"a\"\nmean = 20\n[[torque]]\nname = \"u\"\non = \"c\"\n\
                    mean = \"balance\"\n";
    let elastic = format!(
        "{inertias}[[gear]]\nname = \"g\"\ninput = \"a\"\noutput = \"b\"\nratio = -3.5\n\
         stiffness = 6000\ndamping = 4\nclearance = 0.02\n"
    );
    let behind = format!(
        "{inertias}[[gear]]\nname = \"rigid\"\ninput = \"a\"\noutput = \"o\"\nratio = -3.5\n\
         [[shaft]]\nname = \"g\"\nfrom = \"o\"\nto = \"b\"\nstiffness = 6000\ndamping = 4\n\
         clearance = 0.02\n"
    );
    let (elastic, behind) = (line_of(&elastic, &[]), line_of(&behind, &[]));
    let (a, b) = (statics(&elastic), statics(&behind));
    for shaft in ["s", "g"] {
        assert_close(a.equilibria[0].twist[shaft], b.equilibria[0].twist[shaft], 1e-12);
        assert_close(a.equilibria[0].torque[shaft], b.equilibria[0].torque[shaft], 1e-12);
    }
    // The mesh carries the torque at the output: 20 N·m times -3.5.
    assert_close(a.equilibria[0].torque["g"], -70.0, 1e-12);
    let (a, b) = (modes(&elastic), modes(&behind));
    for (a, b) in a.modes.iter().zip(&b.modes).skip(1) {
        assert_close(a.frequency, b.frequency, 1e-12);
        assert_close(a.damping_ratio, b.damping_ratio, 1e-10);
    }
}

#[test]
fn averaging_refuses_what_it_cannot_represent_by_name() {
    let refused = |law: &str| {
        let line = line_of(&loaded(law, 50.0), &[]);
        let method = Some("averaged".to_owned());
        let text = QuestionText { method, ..QuestionText::default() };
        match try_ask(&line, Verb::Resonance, &text) {
            Err(AnalysisError::MethodDoesNotFit { reason, .. }) => reason,
            other => panic!("{other:?}"),
        }
    };
    assert!(refused(GAP).contains("s has a clearance law"), "{}", refused(GAP));
    assert!(refused(STAGES).contains("multi-stage"));
    assert!(refused(TABLE).contains("table"));
    assert!(refused("stiffness = 500\ncontact = 0.01").contains("one-sided contact"));
    assert!(refused("stiffness = 500\nfriction = 1").contains("dry friction"));
}
