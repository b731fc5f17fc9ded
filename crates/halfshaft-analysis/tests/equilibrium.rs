//! `static`: all states of rest, their stability, the torque capacity.

mod common;

use common::{assert_close, chain, driveline, line_of, statics};
use halfshaft_results::RunningKind;
use proptest::prelude::{prop_assert, proptest};

const K1: f64 = 6420.0;

/// A free line whose shaft carries exactly `torque` (a balanced pair of torques).
fn loaded(k1: f64, k3: f64, torque: f64) -> String {
    format!(
        "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 2\n[[inertia]]\n\
         name = \"b\"\ninertia = 3\n[[shaft]]\nname = \"s\"\nfrom = \"a\"\nto = \"b\"\n\
         stiffness = {k1:?}\ncubic = {k3:?}\n[[torque]]\nname = \"t\"\non = \"a\"\nmean = {torque:?}\n\
         [[torque]]\nname = \"u\"\non = \"b\"\nmean = \"balance\"\n"
    )
}

// Source: theory 2: T_max = (2/3) k1 sqrt(k1/(3 |k3|)) at sqrt(k1/(3 |k3|)).
#[test]
fn the_capacity_of_the_softening_half_shaft_is_7814_newton_metres() {
    let result = statics(&driveline(&[]));
    let limit = result.capacity["half-shaft"].positive.expect("softens");
    assert_close(limit.torque, 2.0 / 3.0 * K1 * (K1 / (3.0 * 642.0)).sqrt(), 1e-15);
    assert!((limit.torque - 7814.175).abs() < 5e-4 && (limit.twist - 1.825742).abs() < 5e-7);
    assert_eq!(result.torque_capacity["half-shaft"], Some(limit.torque));
    let hardening = statics(&driveline(&["half-shaft.cubic=642"]));
    assert_eq!(hardening.torque_capacity["half-shaft"], None);
}

// Source: the law itself, k1 x + k3 x³ = T, and the sign of its discriminant for the number of
// roots: three where 4 k1³/k3 + 27 T² < 0 for k3 < 0, else one.
#[test]
fn static_roots_satisfy_the_law_in_all_regimes() {
    let torques = [0.0, 1e-12, 1.0, 4853.5, 7814.0, 1e6, -4853.5];
    let cubics = [642.0, -642.0, 1e-30, -1e-30, 1e12, -1e12, 0.0, -3.0];
    for k3 in cubics {
        for torque in torques {
            let result = statics(&line_of(&loaded(K1, k3, torque), &[]));
            assert!(result.complete);
            for state in &result.equilibria {
                let x = state.twist["s"];
                let law = K1 * x + k3 * x.powi(3);
                let size = (K1 * x).abs() + (k3 * x.powi(3)).abs() + torque.abs();
                assert!((law - torque).abs() <= 1e-12 * size, "k3 {k3} T {torque} x {x}: {law}");
                assert_eq!(state.stable, K1 + 3.0 * k3 * x * x > 0.0, "k3 {k3} T {torque} x {x}");
            }
            let three = k3 < 0.0 && 4.0 * K1.powi(3) / k3 + 27.0 * torque * torque < 0.0;
            let expected = if three { 3 } else { 1 };
            assert_eq!(result.equilibria.len(), expected, "k3 {k3}, T {torque}");
        }
    }
}

// Source: theory 2: at T_max the two roots nearest to zero merge at sqrt(k1/(3 |k3|)).
#[test]
fn a_load_exactly_at_the_capacity_is_found_and_not_called_stable() {
    let limit = statics(&driveline(&[])).capacity["half-shaft"].positive.expect("softens");
    let result = statics(&line_of(&loaded(K1, -642.0, limit.torque), &[]));
    let at_limit = &result.equilibria[0];
    assert_close(at_limit.twist["s"], limit.twist, 1e-7);
    assert_close(at_limit.torque["s"], limit.torque, 1e-12);
    assert!(!at_limit.stable);
    assert!(result.header.warnings.iter().any(|warning| warning.contains("7814")));
    let beyond = statics(&line_of(&loaded(K1, -642.0, limit.torque * 1.001), &[]));
    assert!(beyond.equilibria.iter().all(|state| !state.stable));
    let below = statics(&line_of(&loaded(K1, -642.0, limit.torque * 0.999), &[]));
    assert_eq!(below.equilibria.iter().filter(|state| state.stable).count(), 1);
}

// Source: theory 2: 5.71 · 1.79 · 850 N·m = 8688 N·m against 7814 N·m.
#[test]
fn a_gear_that_asks_too_much_is_warned_of_in_plain_words() {
    let message = "gear 1.79 at 850 N·m needs 8688 N·m on the half-shaft; its law carries 7814 N·m";
    let listed = statics(&driveline(&[]));
    assert!(listed.header.warnings.iter().any(|warning| warning == message));
    let gears: Vec<(f64, bool)> = listed.gears.iter().map(|g| (g.ratio, g.exists)).collect();
    let expected = [(5.82, false), (3.23, false), (1.79, false), (1.0, true), (0.64, true)];
    assert_eq!(gears, expected);
    let in_gear = statics(&driveline(&["gearbox.ratio=1.79"]));
    assert_eq!(in_gear.header.warnings[0], message);
    assert!(in_gear.equilibria.iter().all(|state| !state.stable));
}

// Source: Newton's law for the line as a whole, T = (J_m + J_L) a at the wheel, and for its end:
// the shaft carries J_L a.
#[test]
fn unbalanced_torques_accelerate_the_line_and_twist_the_shaft_by_inertia() {
    let result = statics(&driveline(&["road load.mean=0", "half-shaft.cubic=0"]));
    assert_eq!(result.running.kind, RunningKind::Accelerating);
    let (jm, jl) = (0.328 * 5.71 * 5.71, 81.6);
    let acceleration = 850.0 * 5.71 / (jm + jl);
    assert_close(result.equilibria[0].torque["half-shaft"], jl * acceleration, 1e-13);
    assert_eq!(result.running.node, "half-shaft flange");
    assert_close(result.running.acceleration, acceleration, 1e-13);
    assert!(result.header.assumptions[0].contains("accelerates uniformly"));
}

// Source: at constant speed the drag balances the engine: ω = T/d, and the shaft carries T.
#[test]
fn damping_to_ground_ends_the_acceleration_at_a_steady_speed() {
    let settings = ["road load.mean=0", "half-shaft.cubic=0", "vehicle.damping=4"];
    let result = statics(&driveline(&settings));
    assert_eq!(result.running.kind, RunningKind::SteadySpeed);
    assert_close(result.running.speed, 850.0 * 5.71 / 4.0, 1e-13);
    assert_close(result.equilibria[0].torque["half-shaft"], 850.0 * 5.71, 1e-13);
}

// Source: springs in parallel add; springs in series share the torque (linear statics).
#[test]
fn shafts_in_loops_share_their_torque() {
    let text = chain(&[1.0, 2.0, 3.0], &[100.0, 300.0], Some(50.0), 0.0)
        + "[[shaft]]\nname = \"bypass\"\nfrom = \"n0\"\nto = \"n2\"\nstiffness = 40\n\
           [[torque]]\nname = \"t\"\non = \"n2\"\nmean = 10\n";
    let result = statics(&line_of(&text, &[]));
    assert!(result.complete && result.equilibria.len() == 1);
    let state = &result.equilibria[0];
    // From n0 to n2: 100 and 300 in series (75), beside 40.
    let twist = -10.0 / 115.0;
    assert_close(state.twist["bypass"], twist, 1e-12);
    assert_close(state.torque["s0"], 75.0 * twist, 1e-12);
    assert_close(state.torque["s1"], 75.0 * twist, 1e-12);
    assert_close(state.torque["held"], 10.0, 1e-12);
}

// Source: two softening cubics side by side between two nodes are one with summed coefficients.
#[test]
fn parallel_nonlinear_shafts_are_one_polynomial() {
    let text = loaded(4000.0, -400.0, 3000.0)
        + "[[shaft]]\nname = \"s2\"\nfrom = \"b\"\nto = \"a\"\nstiffness = 2420\ncubic = -242\n";
    let both = statics(&line_of(&text, &[]));
    let one = statics(&line_of(&loaded(6420.0, -642.0, 3000.0), &[]));
    assert!(both.complete);
    assert_eq!(both.equilibria.len(), 3);
    for (a, b) in both.equilibria.iter().zip(&one.equilibria) {
        assert_close(a.twist["s"], b.twist["s"], 1e-12);
        assert_close(a.twist["s2"], -b.twist["s"], 1e-12);
        assert_eq!(a.stable, b.stable);
    }
}

// Source: in a chain each shaft carries the torque beyond it, so its states are independent: the
// states of the line are all combinations.
#[test]
fn states_of_a_chain_are_the_combinations_of_its_shafts() {
    let text = chain(&[1.0, 2.0, 3.0], &[100.0, 120.0], None, 0.0)
        + "[[torque]]\nname = \"t\"\non = \"n0\"\nmean = 20\n\
           [[torque]]\nname = \"u\"\non = \"n2\"\nmean = \"balance\"\n";
    let line = line_of(&text, &["s0.cubic=-10", "s1.cubic=-10"]);
    let result = statics(&line);
    assert_eq!(result.equilibria.len(), 9);
    assert_eq!(result.equilibria.iter().filter(|state| state.stable).count(), 1);
    assert!(result.equilibria[0].stable);
    assert!(result.equilibria.iter().all(|s| s.lowest_eigenvalue > Some(0.0) || !s.stable));
}

// Source: the same, where the combinations are too many to list (3¹⁰): the stable state, which is
// the one nearest to zero twist in every shaft, is still found, and the list says that it is short.
#[test]
fn the_stable_state_is_found_among_too_many_to_list() {
    let inertias = [1.0; 11];
    let text = chain(&inertias, &[1000.0; 10], None, 0.0)
        + "[[torque]]\nname = \"t\"\non = \"n0\"\nmean = 10\n\
           [[torque]]\nname = \"u\"\non = \"n10\"\nmean = \"balance\"\n";
    let settings: Vec<String> = (0..10).map(|i| format!("s{i}.cubic=-300")).collect();
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    let result = statics(&line_of(&text, &settings));
    assert_eq!(result.equilibria.iter().filter(|state| state.stable).count(), 1);
    assert!(result.equilibria[0].stable && !result.complete);
    for twist in result.equilibria[0].twist.values() {
        assert_close(1000.0 * twist - 300.0 * twist.powi(3), 10.0, 1e-12);
        assert!(twist.abs() < 0.011);
    }
    assert!(result.header.assumptions.iter().any(|text| text.contains("of the 59049")));
    assert!(result.header.warnings.is_empty(), "{:?}", result.header.warnings);
}

// Source: the sum of two laws, 100 x - 10 x³ and -(50 y + 3 y² - 8 y³) at y = -x: its largest torque
// lies where its slope 150 - 6 x - 54 x² vanishes, and neither law alone decides.
#[test]
fn shafts_side_by_side_are_judged_by_what_they_carry_together() {
    let text = |torque: f64| {
        loaded(100.0, -10.0, torque)
            + "[[shaft]]\nname = \"q\"\nfrom = \"b\"\nto = \"a\"\nstiffness = 50\n\
               quadratic = 3\ncubic = -8\n"
    };
    let twist = (-6.0 + (36.0_f64 + 4.0 * 54.0 * 150.0).sqrt()) / 108.0;
    let most = 150.0 * twist - 3.0 * twist * twist - 18.0 * twist.powi(3);
    let holds = statics(&line_of(&text(most - 1e-3), &[]));
    assert_eq!(holds.shared.len(), 1);
    assert_eq!(holds.shared[0].shafts, ["s", "q"]);
    let limit = holds.shared[0].capacity.and_then(|c| c.positive).expect("a limit");
    assert_close(limit.torque, most, 1e-13);
    assert_close(limit.twist, twist, 1e-13);
    assert!(holds.equilibria.iter().any(|state| state.stable));
    assert!(holds.required_torque.is_empty() && holds.header.warnings.is_empty());
    let fails = statics(&line_of(&text(250.0), &[]));
    let warning = &fails.header.warnings[0];
    assert!(warning.contains("250 N·m on s and q together; their laws carry 159 N·m"), "{warning}");
}

// Source: the potential x⁴/4 of a purely cubic spring has its minimum at zero.
#[test]
fn a_cubic_well_without_linear_stiffness_holds() {
    let result = statics(&line_of(&loaded(0.0, 1.0, 0.0), &[]));
    assert!(result.equilibria.len() == 1 && result.equilibria[0].stable);
    let falls = statics(&line_of(&loaded(0.0, -1.0, 0.0), &[]));
    assert!(falls.equilibria.iter().all(|state| !state.stable));
}

// Source: a nonlinear loop solved by the search must be stationary points of the potential.
#[test]
fn nonlinear_loops_are_searched_and_said_so() {
    let text = chain(&[1.0, 2.0, 3.0], &[100.0, 120.0], None, 0.0)
        + "[[shaft]]\nname = \"loop\"\nfrom = \"n0\"\nto = \"n2\"\nstiffness = 30\ncubic = 5\n\
           [[torque]]\nname = \"t\"\non = \"n0\"\nmean = 12\n\
           [[torque]]\nname = \"u\"\non = \"n2\"\nmean = \"balance\"\n";
    let line = line_of(&text, &["s0.cubic=-10", "s1.cubic=-8"]);
    let result = statics(&line);
    assert!(!result.complete);
    assert!(result.header.assumptions.iter().any(|a| a.contains("searched")));
    assert!(!result.equilibria.is_empty());
    for state in &result.equilibria {
        let (x0, x1) = (state.twist["s0"], state.twist["s1"]);
        let around = x0 + x1;
        assert_close(state.twist["loop"], around, 1e-9);
        let torque_loop = 30.0 * around + 5.0 * around.powi(3);
        assert_close(100.0 * x0 - 10.0 * x0.powi(3) + torque_loop, 12.0, 1e-8);
        assert_close(120.0 * x1 - 8.0 * x1.powi(3) + torque_loop, 12.0, 1e-8);
        let (k0, k1) = (100.0 - 30.0 * x0 * x0, 120.0 - 24.0 * x1 * x1);
        let kl = 30.0 + 15.0 * around * around;
        let stable = k0 + kl > 0.0 && (k0 + kl) * (k1 + kl) - kl * kl > 0.0;
        assert_eq!(state.stable, stable);
    }
}

proptest! {
    // Source: invariance. Exchanging the ends of the shaft and of the torques mirrors the states.
    #[test]
    fn reversing_the_shaft_mirrors_the_states(k3 in -2000.0..2000.0_f64, torque in -9e3..9e3_f64) {
        let text = loaded(K1, k3, torque);
        let mirrored = text.replace("from = \"a\"\nto = \"b\"", "from = \"b\"\nto = \"a\"");
        let (one, other) = (statics(&line_of(&text, &[])), statics(&line_of(&mirrored, &[])));
        prop_assert!(one.equilibria.len() == other.equilibria.len());
        for (a, b) in one.equilibria.iter().zip(&other.equilibria) {
            prop_assert!((a.twist["s"] + b.twist["s"]).abs() <= 1e-12 * a.twist["s"].abs());
        }
    }
}

/// Stops at the first look.
struct Stopped;

impl halfshaft_numerics::observer::Observer for Stopped {
    fn cancelled(&self) -> bool {
        true
    }
}

// Source: the contract: an answer that was stopped says so, and claims no list that it does not have.
#[test]
fn a_list_cut_short_is_not_called_complete() {
    use halfshaft_model::question::Question;
    let line = driveline(&[]);
    let answer = halfshaft_analysis::ask(&line, &Question::Static, &Stopped).expect("answers");
    let halfshaft_results::Answer::Static(result) = answer else { panic!("{answer:?}") };
    assert!(result.equilibria.is_empty() && !result.complete);
    assert!(!result.header.termination.is_complete());
}

// Source: by hand: 0.1 + 0.2 - 0.3 is nothing, though not in floating point, so that nothing is asked of the
// shaft to the body that no torque acts on.
#[test]
fn what_cancels_asks_nothing_of_a_shaft() {
    let line = line_of(
        r#"
        format = 1
        name = "cancelling"
        inertia = [
            { name = "a", inertia = 1 },
            { name = "b", inertia = 2 },
            { name = "c", inertia = 3 },
        ]
        shaft = [
            { name = "idle", from = "a", to = "b", stiffness = 100 },
            { name = "loaded", from = "b", to = "c", stiffness = 100 },
        ]
        torque = [
            { name = "one", on = "b", mean = 0.1 },
            { name = "two", on = "b", mean = 0.2 },
            { name = "against", on = "c", mean = -0.3 },
        ]"#,
        &[],
    );
    let state = &statics(&line).equilibria[0];
    assert_eq!((state.twist["idle"], state.torque["idle"]), (0.0, 0.0));
    assert_close(state.torque["loaded"], 0.3, 1e-14);
}
