//! Linear torsional vibration: `modes`, `campbell` and `forced` against published cases, closed formulas
//! and matrices solved here.

mod common;

use std::f64::consts::{PI, TAU};
use std::sync::atomic::{AtomicUsize, Ordering};

use common::{line_of, question, some, try_ask};
use halfshaft_analysis::{ask, natural_frequencies};
use halfshaft_model::Driveline;
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_numerics::Complex;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Answer, CampbellResult, ForcedResult, ModesResult, Reason};

fn modes(line: &Driveline, question: &QuestionText) -> ModesResult {
    match try_ask(line, Verb::Modes, question) {
        Ok(Answer::Modes(result)) => result,
        other => panic!("{other:?}"),
    }
}

fn forced(line: &Driveline, question: &QuestionText) -> ForcedResult {
    match try_ask(line, Verb::Forced, question) {
        Ok(Answer::Forced(result)) => result,
        other => panic!("{other:?}"),
    }
}

fn campbell(line: &Driveline, question: &QuestionText) -> CampbellResult {
    match try_ask(line, Verb::Campbell, question) {
        Ok(Answer::Campbell(result)) => result,
        other => panic!("{other:?}"),
    }
}

/// A chain of inertias with shafts between neighbours, and what else stands in the file.
fn chain(inertias: &[f64], stiffnesses: &[f64], others: &str) -> Driveline {
    let mut text = "format = 1\nname = \"chain\"\n".to_owned();
    for (index, inertia) in inertias.iter().enumerate() {
        text += &format!("[[inertia]]\nname = \"J{index}\"\ninertia = {inertia:?}\n");
    }
    for (index, stiffness) in stiffnesses.iter().enumerate() {
        text += &format!(
            "[[shaft]]\nname = \"k{index}\"\nfrom = \"J{index}\"\nto = \"J{}\"\nstiffness = {stiffness:?}\n",
            index + 1
        );
    }
    line_of(&(text + others), &[])
}

fn hertz(line: &Driveline) -> Vec<f64> {
    modes(line, &QuestionText::default()).modes.iter().map(|mode| mode.frequency / TAU).collect()
}

/// All of `expected` (ten digits), and a rigid-body frequency of exactly zero.
fn agree(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        if *expected == 0.0 {
            assert!(*found == 0.0, "{found}");
        } else {
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        }
    }
}

// Source: two independent assemblies (openTorsion 0.3.2, SciPy), ten digits, and the printed digits of
// Friswell and others (2010), example 9.7.1, and of Sopanen and others (2011).
#[test]
fn chains_have_the_published_frequencies() {
    agree(&hertz(&chain(&[211.4, 8.3], &[9_775_000.0], "")), &[0.0, 176.0767468]);
    agree(
        &hertz(&chain(
            &[0.0035, 0.0035, 0.0035, 0.15, 0.05],
            &[12_000.0, 12_000.0, 14_000.0, 10_000.0],
            "",
        )),
        &[0.0, 81.207_629_02, 141.214_071_4, 378.952_953_9, 536.363_282_9],
    );
    agree(
        &hertz(&chain(&[100.0, 10.0, 50.0, 10.0, 80.0], &[25e6; 4], "")),
        &[0.0, 58.712_328_28, 124.854_161_4, 360.977_249_3, 378.868_411],
    );
    agree(
        &hertz(&chain(&[1e7, 5770.0, 97_030.0], &[367e6, 5496e6], "")),
        &[0.0, 9.285_125_147, 164.584_469_3],
    );
}

// Source: the same; springs to ground hold the line, so nothing is rigid.
#[test]
fn grounded_springs_hold_the_line() {
    let ground = |node: usize| {
        format!(
            "[[shaft]]\nname = \"g{node}\"\nfrom = \"J{node}\"\nto = \"ground\"\nstiffness = 1e7\n"
        )
    };
    let line = chain(
        &[90.0, 140.0, 140.0, 140.0, 140.0, 90.0, 350.0, 500.0, 22_000.0],
        &[2.5e6, 2.5e6, 2.5e6, 2.5e6, 2.5e6, 40e6, 40e6, 3e6],
        &(ground(0) + &ground(5)),
    );
    agree(
        &hertz(&line),
        &[
            1.547_929_286,
            11.926_381_82,
            17.923_872_47,
            24.448_801_38,
            33.714_733_82,
            40.184_989_78,
            60.315_129_92,
            69.240_964_11,
            132.804_259_6,
        ],
    );
}

/// A hollow bar with a disc at each end, in so many pieces.
fn bar(elements: usize) -> Driveline {
    line_of(
        &format!(
            "format = 1\nname = \"bar\"\n[[inertia]]\nname = \"a\"\ninertia = 200\n\
             [[inertia]]\nname = \"b\"\ninertia = 10\n[[shaft]]\nname = \"bar\"\nfrom = \"a\"\nto = \"b\"\n\
             length = \"800 m\"\nouter_diameter = \"780 mm\"\ninner_diameter = \"650 mm\"\n\
             shear_modulus = \"75 GPa\"\ndensity = \"8000 kg/m³\"\nelements = {elements}\n"
        ),
        &[],
    )
}

// Source: the same independent assemblies for five elements.
#[test]
fn a_bar_has_consistent_inertia() {
    agree(
        &hertz(&bar(5)),
        &[0.0, 1.941_661_739, 4.071_920_906, 6.543_740_886, 9.154_726_842, 10.524_390_56],
    );
}

// Source: the continuous bar with discs at its ends, (a + b) q cos q L... = sin q L (a b q² - ...), whose
// roots are 1.910332294 Hz and so on; linear shape functions give the frequency to order h².
#[test]
fn finer_pieces_approach_the_continuous_bar_at_order_two() {
    let exact = [1.910_332_294, 3.820_664_759, 5.730_997_568, 7.641_330_893];
    for (mode, exact) in exact.iter().enumerate() {
        let error = |elements: usize| hertz(&bar(elements))[mode + 1] / exact - 1.0;
        let (coarse, fine) = (error(40), error(80));
        let order = (coarse / fine).log2();
        assert!(coarse > 0.0 && (order - 2.0).abs() < 0.02, "{mode}: {coarse:e} {fine:e} {order}");
    }
    // Far more pieces than a dense problem would take.
    let found = modes(&bar(2000), &QuestionText { count: some("4"), ..QuestionText::default() });
    for (mode, exact) in found.modes[1..].iter().zip(exact) {
        assert!((mode.frequency / TAU / exact - 1.0).abs() < 4e-6, "{}", mode.frequency);
    }
    assert_eq!(found.elastic_modes, Some(2000));
}

// Source: Friswell and others (2010), example 9.6.3: a double geared branch, and the same assemblies.
#[test]
fn branches_behind_gears_have_the_published_frequencies() {
    let mut text = "format = 1\nname = \"branches\"\n".to_owned();
    for (node, inertia) in [(0, 3200), (5, 450), (6, 450), (1, 200), (2, 200), (3, 800), (4, 800)] {
        text += &format!("[[inertia]]\nname = \"n{node}\"\ninertia = {inertia}\n");
    }
    for (from, to, length, diameter) in [(0, 1, 2500, 200), (3, 5, 3500, 250), (4, 6, 3500, 250)] {
        text += &format!(
            "[[shaft]]\nname = \"s{from}\"\nfrom = \"n{from}\"\nto = \"n{to}\"\nlength = \"{length} mm\"\n\
             outer_diameter = \"{diameter} mm\"\nshear_modulus = \"68 GPa\"\n"
        );
    }
    for (input, output, ratio) in [(1, 2, -1.0), (1, 3, -1.6), (2, 4, -1.6)] {
        text += &format!(
            "[[gear]]\nname = \"g{output}\"\ninput = \"n{input}\"\noutput = \"n{output}\"\nratio = {ratio}\n"
        );
    }
    agree(&hertz(&line_of(&text, &[])), &[0.0, 10.304_193_34, 20.479_260_65, 24.422_919_26]);
}

/// A car with its gears, and the driveshafts as one shaft at the wheels.
const CAR: &str = r#"
format = 1
name = "Car"
[[inertia]]
name = "engine"
inertia = 0.17
[[gear]]
name = "gearbox"
input = "engine"
output = "gearbox output"
ratio = 3.5
ratios = [3.5, 1.9, 1.3, 0.95, 0.75]
[[inertia]]
name = "gearbox output"
inertia = 0.014
[[gear]]
name = "final drive"
input = "gearbox output"
output = "differential"
ratio = 3.7
[[inertia]]
name = "differential"
inertia = 0.031
[[shaft]]
name = "driveshafts"
from = "differential"
to = "vehicle"
stiffness = 5000
damping = 65
[[inertia]]
name = "vehicle"
inertia = 144.36
"#;

// Source: the two-mass model of Kiencke and Nielsen in two independent assemblies, eight digits.
#[test]
fn shuffle_is_told_gear_by_gear() {
    let found = modes(&line_of(CAR, &[]), &QuestionText::default());
    assert!((found.modes[1].damping_ratio - 0.093_892_295_2).abs() < 1e-9);
    let expected = [
        (3.5, 2.298_988_1, 0.093_892_3),
        (1.9, 3.944_984_2, 0.161_116),
        (1.3, 5.599_391_8, 0.228_683),
        (0.95, 7.442_906_2, 0.303_974),
        (0.75, 9.141_150_1, 0.373_331),
    ];
    assert_eq!(found.gears.len(), expected.len());
    for (row, (ratio, frequency, damping)) in found.gears.iter().zip(expected) {
        assert_eq!(row.gear.ratio, Some(ratio));
        assert!((row.frequency[0] / TAU / frequency - 1.0).abs() < 2e-8, "{row:?}");
        assert!((row.damping_ratio[0] / damping - 1.0).abs() < 2e-6, "{row:?}");
    }
    let diagram = campbell(
        &line_of(CAR, &[]),
        &QuestionText { orders: some("1"), ..QuestionText::default() },
    );
    for (gear, row) in diagram.gears.iter().zip(&found.gears) {
        assert_eq!(gear.frequency[..1], row.frequency[..1]);
    }
}

// Source: Modelica.Mechanics.Rotational.Examples.First in two assemblies: one real eigenvalue of the
// rigid-body motion, and one oscillating pair.
#[test]
fn a_damper_to_ground_gives_the_rigid_body_motion_one_real_eigenvalue() {
    let text = r#"
format = 1
name = "First"
[[inertia]]
name = "motor"
inertia = 0.1
[[gear]]
name = "gear"
input = "motor"
output = "two"
ratio = 10
[[inertia]]
name = "two"
inertia = 2
damping = 10
[[shaft]]
name = "spring"
from = "two"
to = "load"
stiffness = 1e4
[[inertia]]
name = "load"
inertia = 2
"#;
    let found = modes(&line_of(text, &[]), &QuestionText::default());
    assert_eq!(found.modes[0].eigenvalues[0], (0.0, 0.0));
    assert!((found.modes[0].eigenvalues[1].0 + 0.714_296_126).abs() < 1e-9);
    let (re, im) = found.modes[1].eigenvalues[0];
    assert!((re + 0.059_518_603_7).abs() < 1e-10 && (im - 76.375_681_8).abs() < 1e-7);
    assert!((found.modes[1].frequency / TAU - 12.155_659_57).abs() < 1e-8);
}

// Source: c² against 4 k m of one mass on a spring, at, just below and above critical damping.
#[test]
fn critical_and_stronger_damping_gives_real_pairs() {
    for ratio in [0.999_999, 1.0, 1.000_001, 7.0] {
        let others = format!(
            "[[shaft]]\nname = \"spring\"\nfrom = \"J0\"\nto = \"ground\"\nstiffness = 100\ndamping = {}\n",
            2.0 * ratio * 20.0
        );
        let found = modes(&chain(&[4.0], &[], &others), &QuestionText::default());
        let [(re, im), (other, _)] = found.modes[0].eigenvalues;
        assert!((found.modes[0].damping_ratio - ratio).abs() < 1e-12);
        if ratio < 1.0 {
            assert!((im - 5.0 * (1.0_f64 - ratio * ratio).sqrt()).abs() < 1e-9);
        } else {
            let root = 5.0 * (ratio * ratio - 1.0).sqrt();
            assert!(im == 0.0 && (re - (root - 5.0 * ratio)).abs() < 1e-6, "{re}");
            assert!((other + 5.0 * ratio + root).abs() < 1e-6);
        }
    }
}

// Source: inertias on springs in series have one spring between them; a massless node follows statically.
#[test]
fn massless_nodes_are_eliminated_exactly() {
    let text = |middle: &str| {
        format!(
            "format = 1\nname = \"series\"\n[[inertia]]\nname = \"a\"\ninertia = 2\n[[inertia]]\n\
             name = \"b\"\ninertia = 3\n{middle}"
        )
    };
    let two = text(
        "[[shaft]]\nname = \"one\"\nfrom = \"a\"\nto = \"m\"\nstiffness = 1000\n\
         [[shaft]]\nname = \"two\"\nfrom = \"m\"\nto = \"b\"\nstiffness = 3000\n\
         [[torque]]\nname = \"t\"\non = \"a\"\namplitude = 5\n",
    );
    let one = text(
        "[[shaft]]\nname = \"one\"\nfrom = \"a\"\nto = \"b\"\nstiffness = 750\n\
         [[torque]]\nname = \"t\"\non = \"a\"\namplitude = 5\n",
    );
    let (two, one) = (line_of(&two, &[]), line_of(&one, &[]));
    agree(&hertz(&two), &hertz(&one));
    let shape = &modes(&two, &QuestionText::default()).modes[1].shape;
    let expected = 0.25 * shape["a"] + 0.75 * shape["b"];
    assert!((shape["m"] - expected).abs() < 1e-12, "{shape:?}");
    let at =
        QuestionText { frequency: some("20..21"), points: some("2"), ..QuestionText::default() };
    let torque =
        |line: &Driveline| forced(line, &at).gears[0].table.values("one.torque.amplitude")[0];
    assert!((torque(&two) / torque(&one) - 1.0).abs() < 1e-12);
    let refused =
        try_ask(&two, Verb::Simulate, &QuestionText::default()).expect_err("has no inertia");
    assert!(refused.to_string().contains("\"m\" has no inertia"), "{refused}");
}

// Source: openTorsion 0.3.2 and SciPy: undamped, amplitudes 200, 50, 5 and 2 N·m of orders 1 to 4 at
// node 0 and 3600 rpm; nine digits.
#[test]
fn torques_of_orders_are_the_published_ones() {
    let line = chain(
        &[100.0, 10.0, 50.0, 10.0, 80.0],
        &[25e6; 4],
        "[[torque]]\nname = \"t\"\non = \"J0\"\namplitude = 200\nharmonics = [ { order = 2, amplitude = 50 }, \
         { order = 3, amplitude = 5 }, { order = 4, amplitude = 2 } ]\n",
    );
    let question = QuestionText {
        frequency: some("3600rpm..3700rpm"),
        points: some("2"),
        ..QuestionText::default()
    };
    let result = forced(&line, &question);
    let expected = [
        [2_078.337_36, 65.780_275_2, 0.641_056_937, 0.063_547_212_8],
        [2_188.019_86, 52.400_152, 0.877_172_072, 0.212_100_486],
        [2_114.499_51, 74.078_306_6, 0.186_235_127, 0.009_747_855_56],
        [1_979.588_42, 82.528_911, 0.303_631_172, 0.045_251_042_7],
    ];
    for (shaft, row) in expected.iter().enumerate() {
        for (index, expected) in row.iter().enumerate() {
            let name = format!("k{shaft}.torque.order{}", index + 1);
            let found = result.gears[0].table.values(&name)[0];
            assert!((found / expected - 1.0).abs() < 5e-9, "{name}: {found} {expected}");
        }
    }
}

/// `|torque|` of the shaft between two inertias with a 2 by 2 damping matrix, for a torque on the first.
fn two_discs(inertia: f64, stiffness: f64, damping: f64, loss: f64, omega: f64) -> f64 {
    // Both equal: the twist x obeys J x'' + 2 c x' + 2 k (1 + i η) x = T.
    let impedance = Complex::new(
        2.0 * stiffness - omega * omega * inertia,
        2.0 * omega * damping + 2.0 * loss * stiffness,
    );
    stiffness.hypot(loss * stiffness) / impedance.modulus()
}

// Source: for two equal discs modal damping of 2 % is the damping matrix 58.54229240472223 [1 -1; -1 1]
// (openTorsion 0.3.2), whose vibration is a quotient; a loss factor likewise.
#[test]
fn modal_damping_and_loss_factors_act_as_their_matrices() {
    let torque = "[[torque]]\nname = \"t\"\non = \"J0\"\namplitude = 1\n";
    let at = |speed: f64| QuestionText {
        frequency: some(&format!("{speed}..{}", speed + 1.0)),
        points: some("2"),
        ..QuestionText::default()
    };
    let lines = [
        ("[line]\nmodal_damping = 0.02\n", 58.542_292_404_722_23, 0.0),
        ("[line]\nloss_factor = 0.05\n", 0.0, 0.05),
    ];
    for (damping, matrix, loss) in lines {
        let line = chain(&[10.0, 10.0], &[428_400.0], &(torque.to_owned() + damping));
        for speed in [100.0, 292.7, 293.0, 400.0] {
            let result = forced(&line, &at(speed));
            let found = result.gears[0].table.values("k0.torque.amplitude")[0];
            // Modal damping is no torque in the shaft, a loss factor is.
            let expected = two_discs(10.0, 428_400.0, matrix, loss, speed);
            assert!((found / expected - 1.0).abs() < 1e-10, "{speed}: {found} {expected}");
        }
        let ratio = modes(&line, &QuestionText::default()).modes[1].damping_ratio;
        assert!((ratio - if loss > 0.0 { loss / 2.0 } else { 0.02 }).abs() < 1e-12, "{ratio}");
    }
}

// Source: the same line with dampers as coupling of the modes, against its own sparse solution: with a
// vanishing modal damping both must agree.
#[test]
fn sums_over_modes_agree_with_the_dynamic_stiffness() {
    let dampers = "[[shaft]]\nname = \"d\"\nfrom = \"J1\"\nto = \"J3\"\nstiffness = 0\ndamping = 3e4\n\
                   [[torque]]\nname = \"t\"\non = \"J0\"\namplitude = 100\norder = 1\n";
    let line = |others: &str| {
        chain(&[100.0, 10.0, 50.0, 10.0, 80.0], &[25e6; 4], &(dampers.to_owned() + others))
    };
    let question = QuestionText {
        frequency: some("100..2500"),
        points: some("25"),
        ..QuestionText::default()
    };
    let (direct, modal) = (line(""), line("[line]\nmodal_damping = 1e-14\n"));
    let (direct, modal) = (forced(&direct, &question), forced(&modal, &question));
    for column in &direct.gears[0].table.columns {
        let other = modal.gears[0].table.values(&column.name);
        let scale = column.values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        for (a, b) in column.values.iter().zip(other) {
            let phase = column.name.ends_with(".phase");
            let apart = if phase { (a - b).sin().abs() } else { (a - b).abs() / scale };
            assert!(apart < 1e-9, "{}: {a} {b}", column.name);
        }
    }
}

// Source: energy balance: over a period the mean power of the torque is what the dampers turn into heat.
#[test]
fn heat_is_the_power_of_the_torques() {
    let line = chain(
        &[100.0, 10.0, 50.0],
        &[25e6, 25e6],
        "[[damper]]\nname = \"ring\"\non = \"J2\"\ninertia = 8\nstiffness = 1e6\ndamping = 300\nloss_factor = 0.1\n\
         [[torque]]\nname = \"t\"\non = \"J0\"\namplitude = 100\nharmonics = [ { order = 2.5, amplitude = 40 } ]\n",
    );
    let question = QuestionText {
        frequency: some("50..400"),
        points: some("8"),
        node: some("J0"),
        shaft: some("ring"),
        ..QuestionText::default()
    };
    let table = &forced(&line, &question).gears[0].table;
    let of = |name: &str| table.values(name).to_vec();
    for row in 0..8 {
        // Power of T cos ωt on a speed V cos(ωt + φ): T V cos φ / 2.
        let power = |order: &str, torque: f64| {
            0.5 * torque
                * of(&format!("J0.speed.order{order}"))[row]
                * of(&format!("J0.speed.order{order}.phase"))[row].cos()
        };
        let (given, heat) = (power("1", 100.0) + power("2.5", 40.0), of("ring.heat")[row]);
        assert!((given / heat - 1.0).abs() < 1e-7, "{given} {heat}");
    }
}

// Source: integration in time of the same line until it repeats; the half range of the torque is that of
// the orders together, not the sum of their amplitudes.
#[test]
fn orders_together_are_what_integration_shows() {
    let text = "[[shaft]]\nname = \"holder\"\nfrom = \"J1\"\nto = \"ground\"\nstiffness = 900\ndamping = 40\n\
                [[torque]]\nname = \"t\"\non = \"J0\"\namplitude = 10\nharmonics = [ { order = 1.5, amplitude = 14, \
                phase = 0.7 }, { order = 3, amplitude = 30, phase = \"-80 deg\" } ]\n";
    let line = chain(&[2.0, 5.0], &[1500.0], text);
    let question =
        QuestionText { frequency: some("9..10"), points: some("2"), ..QuestionText::default() };
    let result = forced(&line, &question);
    let table = &result.gears[0].table;
    let range = table.values("k0.torque.amplitude")[0];
    let sum: f64 = ["1", "1.5", "3"]
        .iter()
        .map(|order| table.values(&format!("k0.torque.order{order}"))[0])
        .sum();
    assert!(range < 0.97 * sum, "{range} {sum}");
    let period = 2.0 * TAU / 9.0;
    let question = QuestionText {
        frequency: some("9"),
        duration: some(&format!("{:?}", 40.0 * period)),
        record: some(&format!("{:?}..{:?}", 39.0 * period, 40.0 * period)),
        step: some(&format!("{:?}", period / 4000.0)),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    let Ok(Answer::History(history)) = try_ask(&line, Verb::Simulate, &question) else { panic!() };
    let torque = history.values("k0.torque");
    let high = torque.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = torque.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(((high - low) / 2.0 / range - 1.0).abs() < 2e-5, "{high} {low} {range}");
}

// Source: Den Hartog, Mechanical Vibrations, section 3.3: with a viscous damper (no spring) all curves of
// the motion of a mass M on k pass through one point at ω² = 2 k / M / (2 + μ), with amplitude
// (2 + μ) / μ times the static one, whatever the damping.
#[test]
fn curves_of_a_viscous_damper_pass_through_the_fixed_point() {
    let (mass, stiffness, mu) = (4.0_f64, 900.0_f64, 0.25_f64);
    let speed = (2.0 * stiffness / mass / (2.0 + mu)).sqrt();
    for damping in [0.5, 5.0, 80.0] {
        let line = chain(
            &[mass],
            &[],
            &format!(
                "[[shaft]]\nname = \"spring\"\nfrom = \"J0\"\nto = \"ground\"\nstiffness = {stiffness:?}\n\
                 [[damper]]\nname = \"d\"\non = \"J0\"\ninertia = {:?}\ndamping = {damping:?}\n\
                 [[torque]]\nname = \"t\"\non = \"J0\"\namplitude = {stiffness:?}\n",
                mu * mass
            ),
        );
        let question = QuestionText {
            frequency: some(&format!("{speed:?}..{:?}", speed + 1.0)),
            points: some("2"),
            ..QuestionText::default()
        };
        let found = forced(&line, &question).gears[0].table.values("spring.twist.amplitude")[0];
        assert!((found / ((2.0 + mu) / mu) - 1.0).abs() < 1e-10, "{damping}: {found}");
    }
}

// Source: an eigenvalue of the whole line, all modes taken, against the same from the lowest modes alone.
#[test]
fn damped_frequencies_of_a_long_line_do_not_need_all_modes() {
    let mut others = String::new();
    for node in [0, 37, 80] {
        others += &format!(
            "[[damper]]\nname = \"d{node}\"\non = \"J{node}\"\ninertia = 2\ndamping = 90\nstiffness = 200\n"
        );
    }
    let line = chain(&vec![1.0; 90], &vec![1e5; 89], &others);
    let all = modes(&line, &QuestionText::default());
    let few = modes(&line, &QuestionText { count: some("8"), ..QuestionText::default() });
    assert!(few.modes.len() == 9 && all.modes.len() == 93);
    for (few, all) in
        few.modes.iter().zip(&all.modes).skip(1).filter(|(few, _)| few.damped_frequency > 0.0)
    {
        let [(re, im), _] = few.eigenvalues;
        let near = all.eigenvalues[0];
        assert!((re - near.0).hypot(im - near.1) < 1e-8 * im, "{:?} {near:?}", (re, im));
    }
}

// Source: mode over order, and the margins by hand.
#[test]
fn critical_speeds_are_frequency_over_order() {
    let line = chain(
        &[3.0, 1.0],
        &[3000.0],
        "[line]\noperating = \"20rad/s..50rad/s\"\n[[torque]]\nname = \"t\"\non = \"J0\"\namplitude = 1\n\
         harmonics = [ { order = 2, amplitude = 3 }, { order = 0.5, amplitude = 1 } ]\n",
    );
    let frequency = (3000.0_f64 * (1.0 / 3.0 + 1.0)).sqrt();
    let found =
        campbell(&line, &QuestionText { frequency: some("0..200"), ..QuestionText::default() });
    let critical = &found.gears[0].critical;
    assert_eq!(critical.len(), 3);
    for (critical, order) in critical.iter().zip([2.0, 1.0, 0.5]) {
        assert_eq!(critical.order, order);
        let speed = frequency / order;
        assert!((critical.speed / speed - 1.0).abs() < 1e-12);
        let margin = if speed > 50.0 { speed / 50.0 - 1.0 } else { 0.0 };
        assert!((critical.margin.expect("has a range") - margin).abs() < 1e-12);
        assert!(critical.torque.is_none(), "nothing damps it");
    }
}

// Source: at resonance of a lightly damped line the mode of the order stands alone, to the order of the
// damping.
#[test]
fn torque_of_a_critical_speed_is_that_of_the_vibration() {
    let line = chain(
        &[100.0, 10.0, 50.0, 10.0, 80.0],
        &[25e6; 4],
        "[line]\nmodal_damping = 1e-4\n[[torque]]\nname = \"t\"\non = \"J1\"\namplitude = 7\norder = 4\n",
    );
    let diagram =
        campbell(&line, &QuestionText { frequency: some("50..1000"), ..QuestionText::default() });
    for critical in &diagram.gears[0].critical {
        let question = QuestionText {
            frequency: some(&format!("{:?}..{:?}", critical.speed, critical.speed + 1.0)),
            points: some("2"),
            ..QuestionText::default()
        };
        let shaft = critical.shaft.as_deref().expect("is excited");
        let found =
            forced(&line, &question).gears[0].table.values(&format!("{shaft}.torque.amplitude"))[0];
        let told = critical.torque.expect("is damped");
        assert!((found / told - 1.0).abs() < 3e-4, "{found} {told}");
    }
}

// Source: the formula of a free chain of equal masses, 2 sqrt(k/J) sin(j π / 2 n).
#[test]
fn long_lines_are_solved_for_their_lowest_modes() {
    let n = 4000;
    let line = chain(&vec![0.5; n], &vec![2e4; n - 1], "");
    let found = modes(&line, &QuestionText::default());
    assert_eq!((found.modes.len(), found.elastic_modes), (21, Some(n - 1)));
    for (index, mode) in found.modes.iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let exact = 2.0 * (2e4_f64 / 0.5).sqrt() * (index as f64 * PI / 2.0 / n as f64).sin();
        assert!(
            (mode.frequency - exact).abs() <= 1e-10 * exact,
            "{index}: {} {exact}",
            mode.frequency
        );
    }
}

// Source: an elastic mesh of stiffness k at the input is one of ratio² k at the output.
#[test]
fn a_mesh_may_refer_to_either_side() {
    let text = |stiffness: f64, damping: f64, side: &str| {
        format!(
            "format = 1\nname = \"mesh\"\n[[inertia]]\nname = \"a\"\ninertia = 2\n[[inertia]]\nname = \"b\"\n\
             inertia = 30\n[[gear]]\nname = \"g\"\ninput = \"a\"\noutput = \"b\"\nratio = -3\n\
             stiffness = {stiffness:?}\ndamping = {damping:?}\nreferred_to = \"{side}\"\n"
        )
    };
    let of = |text: &str| modes(&line_of(text, &[]), &QuestionText::default()).modes[1].clone();
    let (input, output) = (of(&text(100.0, 0.5, "input")), of(&text(900.0, 4.5, "output")));
    assert_eq!(input.eigenvalues, output.eigenvalues);
    let exact = (900.0_f64 * (1.0 / 30.0 + 1.0 / 18.0)).sqrt();
    assert!((input.frequency / exact - 1.0).abs() < 1e-12);
}

// Source: the impedance of two springs with dampers in series, (k1 + c1 λ) (k2 + c2 λ) / (k1 + k2 + (c1 + c2) λ),
// holds the mass: λ² m and it add up to zero; for c2 alone (Maxwell) the forced vibration is a quotient.
#[test]
fn dampers_at_massless_nodes_are_exact() {
    let m = 2.0;
    let line = |[k1, c1, k2, c2]: [f64; 4]| {
        chain(
            &[m],
            &[],
            &format!(
                "[[shaft]]\nname = \"one\"\nfrom = \"J0\"\nto = \"between\"\nstiffness = {k1:?}\ndamping = {c1:?}\n\
                 [[shaft]]\nname = \"two\"\nfrom = \"between\"\nto = \"ground\"\nstiffness = {k2:?}\ndamping = {c2:?}\n\
                 [[torque]]\nname = \"t\"\non = \"J0\"\namplitude = 1\n"
            ),
        )
    };
    let impedance = |[k1, c1, k2, c2]: [f64; 4], value: Complex| {
        let spring = |k: f64, c: f64| Complex::from(k) + value.scaled(c);
        spring(k1, c1) * spring(k2, c2) / spring(k1 + k2, c1 + c2)
    };
    for values in [[800.0, 5.0, 1500.0, 20.0], [800.0, 0.0, 300.0, 4.0], [900.0, 3.0, 50.0, 0.0]] {
        let found = modes(&line(values), &QuestionText::default());
        let (re, im) = found.modes[0].eigenvalues[0];
        let value = Complex::new(re, im);
        let rest = (value * value).scaled(m) + impedance(values, value);
        assert!(im > 0.0 && rest.modulus() < 1e-9 * (im * im * m), "{value:?} {rest:?}");
    }
    let maxwell = [800.0, 0.0, 0.0, 90.0];
    let at =
        QuestionText { frequency: some("15..16"), points: some("2"), ..QuestionText::default() };
    let torque = forced(&line(maxwell), &at).gears[0].table.values("one.torque.amplitude")[0];
    let series = impedance(maxwell, Complex::new(0.0, 15.0));
    let exact = (series / (series - Complex::from(15.0 * 15.0 * m))).modulus();
    assert!((torque / exact - 1.0).abs() < 1e-12, "{torque} {exact}");
}

/// An observer that asks for the end at its n-th call.
struct StopsAfter(AtomicUsize);

impl Observer for StopsAfter {
    fn cancelled(&self) -> bool {
        self.0.fetch_sub(1, Ordering::Relaxed) <= 1
    }
}

// Source: the contract of observers: what was reached is kept, with a reason, also within the only gear.
#[test]
fn a_vibration_that_is_stopped_says_so() {
    let text = QuestionText {
        frequency: some("1..100"),
        points: some("500"),
        this_gear: true,
        ..QuestionText::default()
    };
    let driven =
        chain(&[2.0, 5.0], &[1500.0], "[[torque]]\nname = \"t\"\non = \"J0\"\namplitude = 10\n");
    let asked = question(&driven, Verb::Forced, &text);
    let Ok(Answer::Forced(stopped)) = ask(&driven, &asked, &StopsAfter(AtomicUsize::new(3))) else {
        panic!("something was reached")
    };
    assert_eq!(stopped.header.termination.reason, Reason::Cancelled);
    let whole = forced(&driven, &text);
    assert!(whole.header.termination.is_complete());
    let (few, all) = (&stopped.gears[0].table, &whole.gears[0].table);
    assert!(few.rows() > 0 && few.rows() < all.rows());
    for (few, all) in few.columns.iter().zip(&all.columns) {
        assert_eq!(few.values, all.values[..few.values.len()]);
    }
}

// Source: `modes`, which takes the dense solver for the branch and Lanczos' iteration for the long row; for
// the row of four it is the same solver, held against published values above.
#[test]
fn natural_frequencies_alone_are_those_of_the_modes() {
    let held =
        "[[shaft]]\nname = \"held\"\nfrom = \"J1\"\nto = \"ground\"\nstiffness = 3e3\n".to_owned();
    let branch = "[[inertia]]\nname = \"B\"\ninertia = 2\n".to_owned()
        + "[[shaft]]\nname = \"branch\"\nfrom = \"J2\"\nto = \"B\"\nstiffness = 900\n";
    let (inertias, stiffnesses) = ([0.5, 1.0, 4.0, 0.3], [2e3, 5e3, 1e4]);
    for line in [
        chain(&inertias, &stiffnesses, &held),
        chain(&inertias, &stiffnesses, &branch),
        chain(&[1.0; 450], &[1e4; 449], ""),
    ] {
        let count = Some(line.inertias().len().to_string());
        let told = modes(&line, &QuestionText { count, ..QuestionText::default() }).modes;
        let told: Vec<f64> = told.iter().map(|mode| mode.frequency).filter(|f| *f > 0.0).collect();
        agree(&natural_frequencies(&line).expect("is at rest"), &told);
    }
}

// Source: damping in proportion to stiffness, C = β K, gives every mode the ratio β ω / 2, however rounding
// couples the modes of a long row.
#[test]
fn proportional_damping_couples_no_modes() {
    let (count, beta) = (120, 5e-5);
    let mut others = String::new();
    for index in 1..count {
        others += &format!(
            "[[shaft]]\nname = \"d{index}\"\nfrom = \"J{}\"\nto = \"J{index}\"\nstiffness = 0\n\
             damping = {}\n",
            index - 1,
            beta * 2e5
        );
    }
    let line = chain(&vec![0.5; count], &vec![2e5; count - 1], &others);
    for mode in modes(&line, &QuestionText::default()).modes.iter().skip(1) {
        let ratio = beta * mode.frequency / 2.0;
        assert!((mode.damping_ratio / ratio - 1.0).abs() < 1e-9, "{} {ratio}", mode.damping_ratio);
    }
}
