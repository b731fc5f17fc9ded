//! Events of `simulate`: contacts, stages, stick and slip against exact piecewise solutions.

#![allow(clippy::needless_pass_by_value, reason = "options are made in place")]

mod common;

use common::{assert_close, history, line_of, some};
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_results::{HistoryResult, Reason};

fn simulate(line: &halfshaft_model::Driveline, text: QuestionText) -> HistoryResult {
    let result = history(line, Verb::Simulate, &text);
    assert_eq!(result.header.termination.reason, Reason::Completed, "{:?}", result.header);
    result
}

/// `x` and `x'` of `m x'' + c x' + k x = f` a time after a state; `k` may be zero.
fn free(m: f64, c: f64, k: f64, f: f64, (x0, v0): (f64, f64), t: f64) -> (f64, f64) {
    if k == 0.0 {
        if c == 0.0 {
            return (x0 + v0 * t + 0.5 * f / m * t * t, v0 + f / m * t);
        }
        let (rate, end) = (c / m, f / c);
        let decay = (-rate * t).exp();
        return (x0 + end * t + (v0 - end) * (1.0 - decay) / rate, end + (v0 - end) * decay);
    }
    let (d, rest) = (0.5 * c / m, f / k);
    let w = (k / m - d * d).sqrt();
    let (a, b) = (x0 - rest, (v0 + d * (x0 - rest)) / w);
    let (sin, cos) = (w * t).sin_cos();
    let decay = (-d * t).exp();
    let x = decay * (a * cos + b * sin);
    (rest + x, -d * x + decay * w * (b * cos - a * sin))
}

/// First time after `from` at which `value` falls below zero, by bisection to rounding.
fn falls(value: impl Fn(f64) -> f64, from: f64, step: f64) -> f64 {
    let mut low = from;
    while value(low + step) > 0.0 {
        low += step;
        if low > 100.0 {
            return f64::INFINITY;
        }
    }
    let mut high = low + step;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if value(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

const GAP: &str = "\
format = 1
name = \"Mass in a gap\"
[[inertia]]
name = \"disc\"
inertia = 5
[[shaft]]
name = \"coupling\"
from = \"disc\"
to = \"ground\"
stiffness = 20000
damping = 50
clearance = 0.7853981633974483
";

// Source: the closed solution of each piece, pieces joined at times found by bisection.
#[test]
fn backlash_follows_the_exact_pieces() {
    let line = line_of(GAP, &[]);
    let text = QuestionText {
        initial: vec!["coupling.twist=1.5707963267948966".to_owned()],
        duration: some("1s"),
        step: some("0.05s"),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    let (m, k, c, half) = (5.0, 20000.0, 50.0, std::f64::consts::FRAC_PI_8);
    let (mut state, mut t) = ((4.0 * half, 0.0), 0.0);
    let mut events = Vec::new();
    let piece = |x: f64, v: f64| {
        if x.abs() > half || (x.abs() == half && x * v > 0.0) { x.signum() } else { 0.0 }
    };
    let mut side = 1.0;
    let mut pieces = Vec::new();
    while t < 1.0 {
        let start = state;
        let (stiffness, torque) = if side == 0.0 { (0.0, 0.0) } else { (k, k * side * half) };
        let at = move |dt: f64| free(m, c, stiffness, torque, start, dt);
        pieces.push((t, start, stiffness, torque));
        let inside = |dt: f64| {
            let x = at(dt).0;
            if side == 0.0 { half - x.abs() } else { x * side - half }
        };
        // Left at once when it starts on the border.
        let dt = falls(inside, 1e-9, 1e-4);
        t += dt;
        if t > 1.0 {
            break;
        }
        state = at(dt);
        state.0 = half * state.0.signum();
        if t < 1.0 {
            events.push((t, state.1));
        }
        side = piece(state.0, state.1);
    }
    assert_eq!(result.events.len(), events.len());
    for (found, (time, rate)) in result.events.iter().zip(&events) {
        assert!((found.time - time).abs() < 1e-11, "{} for {time}", found.time);
        assert!((found.twist_rate - rate).abs() < 1e-9 * 80.0, "{} for {rate}", found.twist_rate);
        assert!((found.twist.abs() - half).abs() < 1e-14);
    }
    for (time, x) in result.values("time").iter().zip(result.values("coupling.twist")) {
        let (t0, start, stiffness, torque) =
            *pieces.iter().rev().find(|piece| piece.0 <= *time).expect("begins at zero");
        let exact = free(m, c, stiffness, torque, start, time - t0).0;
        assert!((x - exact).abs() < 1e-9, "{x} for {exact} at {time}");
    }
    let first = &result.events[0];
    assert_eq!(first.text, "shaft \"coupling\": contact lost on the drive side");
    let counted = &result.metrics.events["coupling"];
    let contacts = events.iter().filter(|(t, _)| *t < 1.0).count() as u64;
    assert_eq!(counted.contacts + counted.separations, contacts);
    assert_eq!(counted.lash_crossings, counted.contacts);
    let energy = result.events[1].energy.expect("a contact has one");
    assert_close(energy, 0.5 * m * result.events[1].twist_rate.powi(2), 1e-12);
}

// Source: the reference of transients, whose numbers for this line are those without a gap.
#[test]
fn without_its_gap_the_mass_swings_as_the_reference() {
    let line = line_of(GAP, &["coupling.clearance=0"]);
    let text = QuestionText {
        initial: vec!["coupling.twist=1.5707963267948966".to_owned()],
        duration: some("1s"),
        step: some("0.05s"),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    for (time, x) in [
        (0.05, -1.224_312_77),
        (0.1, 0.954_144_403),
        (0.2, 0.579_302_627),
        (0.3, 0.351_555_956),
        (0.5, 0.129_290_253),
        (0.75, -0.036_931_011),
        (1.0, 0.010_518_258_9),
    ] {
        let found = result.table().interpolate("coupling.twist", time).expect("recorded");
        assert!((found - x).abs() < 6e-9, "{found} for {x}");
    }
}

const RUBBING: &str = "\
format = 1
name = \"Mass with dry friction\"
[[inertia]]
name = \"disc\"
inertia = 2
[[shaft]]
name = \"spring\"
from = \"disc\"
to = \"ground\"
stiffness = 200
friction = 10
";

// Source: free vibration with dry friction in closed form: each half swing lasts π/ω and is shorter by
// 4 F / k from end to end; it ends for good where the spring no longer overcomes the friction.
#[test]
fn dry_friction_ends_a_vibration_as_it_does_on_paper() {
    let line = line_of(RUBBING, &[]);
    let text = QuestionText {
        initial: vec!["spring.twist=0.33".to_owned()],
        duration: some("4s"),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    let (half, loss) = (std::f64::consts::PI / 10.0, 2.0 * 10.0 / 200.0);
    // 0.33, -0.23, 0.13, -0.03: there 6 N·m are less than 10.
    let turns: Vec<(f64, f64)> = result
        .events
        .iter()
        .filter(|event| event.time > 0.0)
        .map(|event| (event.time, event.twist))
        .collect();
    assert_eq!(turns.len(), 3);
    let mut twist = 0.33_f64;
    for (k, (time, found)) in turns.iter().enumerate() {
        twist = -(twist.abs() - loss) * twist.signum();
        assert!((time - (k + 1) as f64 * half).abs() < 1e-11, "{time}");
        assert!((found - twist).abs() < 1e-11, "{found} for {twist}");
    }
    let kinds: Vec<&str> = result.events.iter().map(|event| event.kind.as_str()).collect();
    assert_eq!(kinds, ["slip", "slip", "stick"]);
    let last = result.values("spring.twist").last().copied().expect("recorded");
    assert!((last + 0.03).abs() < 1e-11);
    let counted = &result.metrics.events["spring"];
    assert_eq!((counted.slips, counted.sticks), (2, 1));
    assert!((counted.stuck_share - (4.0 - 3.0 * half) / 4.0).abs() < 1e-10);
    // The torque of the stuck connection is what holds it: none on a disc at rest.
    let torque = result.values("spring.torque").last().copied().expect("recorded");
    assert!(torque.abs() < 1e-9);
    let heat = result.metrics.energy_balance.expect("integrated").dissipated;
    assert_close(heat, 10.0 * (0.56 + 0.36 + 0.16), 1e-10);
}

const DRIVEN: &str = "\
format = 1
name = \"Stick and slip\"
[[inertia]]
name = \"disc\"
inertia = 1
[[shaft]]
name = \"spring\"
from = \"disc\"
to = \"ground\"
stiffness = 4
friction = 1
[[torque]]
name = \"drive\"
on = \"disc\"
amplitude = 2.2
frequency = 0.7
";

// Source: sliding pieces in closed form (forced, undamped oscillator), sticking until the sum of spring and
// drive exceeds the friction; switching times by bisection.
#[test]
fn stick_and_slip_follow_the_exact_pieces() {
    let line = line_of(DRIVEN, &[]);
    let text = QuestionText {
        duration: some("40s"),
        step: some("0.1s"),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    let (k, friction, p, w) = (4.0_f64, 1.0, 2.2, 0.7_f64);
    let gain = p / (k - w * w);
    let own = k.sqrt();
    let drive = |t: f64| p * (w * t).cos();
    let slide = |sign: f64, t0: f64, (x0, v0): (f64, f64), t: f64| {
        let rest = -sign * friction / k;
        let (a, b) = (x0 - rest - gain * (w * t0).cos(), (v0 + gain * w * (w * t0).sin()) / own);
        let (sin, cos) = (own * (t - t0)).sin_cos();
        (
            rest + gain * (w * t).cos() + a * cos + b * sin,
            -gain * w * (w * t).sin() + own * (b * cos - a * sin),
        )
    };
    let mut list = Vec::new();
    let (mut t, mut state) = (0.0, (0.0, 0.0));
    // At the start the drive alone breaks it away.
    let mut sign = 1.0;
    while t < 40.0 {
        let (t0, start) = (t, state);
        if sign == 0.0 {
            let held = |t: f64| friction - (drive(t) - k * start.0).abs();
            t = falls(held, t0, 1e-3);
            sign = (drive(t) - k * start.0).signum();
            list.push((t, "slip"));
            continue;
        }
        t = falls(|t| sign * slide(sign, t0, start, t).1, t0 + 1e-4, 1e-3);
        state = (slide(sign, t0, start, t).0, 0.0);
        let needed = drive(t) - k * state.0;
        sign = if needed.abs() <= friction { 0.0 } else { needed.signum() };
        list.push((t, if sign == 0.0 { "stick" } else { "slip" }));
    }
    let found: Vec<(f64, &str)> = result
        .events
        .iter()
        .filter(|event| event.time > 0.0)
        .map(|event| (event.time, event.kind.as_str()))
        .collect();
    let list: Vec<_> = list.into_iter().filter(|(t, _)| *t < 40.0).collect();
    assert_eq!(found.len(), list.len(), "{found:?} for {list:?}");
    assert!(list.iter().any(|(_, kind)| *kind == "stick"));
    for ((time, kind), (exact, exact_kind)) in found.iter().zip(&list) {
        assert!((time - exact).abs() < 1e-9 && kind == exact_kind, "{time} {kind} for {exact}");
    }
}

const CLUTCH: &str = "\
format = 1
name = \"A clutch engages\"
[[inertia]]
name = \"engine\"
inertia = 0.2
[[inertia]]
name = \"vehicle\"
inertia = 1.8
[[shaft]]
name = \"clutch\"
from = \"engine\"
to = \"vehicle\"
stiffness = 0
friction = 60
engagement = { start = \"0.1 s\", duration = \"0.4 s\" }
";

// Source: conservation of angular momentum; the slip speed falls by the integral of the torque over the
// reduced inertia; the heat is the kinetic energy of the slip.
#[test]
fn a_clutch_engages_as_momentum_demands() {
    let line = line_of(CLUTCH, &[]);
    let text = QuestionText {
        initial: vec!["engine.speed=100".to_owned()],
        duration: some("1s"),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    let reduced = 0.2 * 1.8 / 2.0;
    // 60 s²/(2·0.4) = 100 · 0.18 after 0.1 s, unless the rise ends before: (t - 0.1)² = 0.24.
    let rise_end = 60.0 * 0.4 / 2.0;
    let left = 100.0 * reduced - rise_end;
    let locked = 0.5 + left / 60.0;
    let stick = result.events.iter().find(|event| event.kind == "stick").expect("locks");
    assert!((stick.time - locked).abs() < 1e-11, "{} for {locked}", stick.time);
    for node in ["engine", "vehicle"] {
        let speed = *result.values(&format!("{node}.speed")).last().expect("recorded");
        assert!((speed - 10.0).abs() < 1e-9, "{speed}");
    }
    let heat = result.metrics.energy_balance.expect("integrated").dissipated;
    assert_close(heat, 0.5 * reduced * 1e4, 1e-9);
}

const CUBIC: &str = "\
format = 1
name = \"Clearance with cubic contact\"
[[inertia]]
name = \"small\"
inertia = 0.3
[[inertia]]
name = \"large\"
inertia = 126
[[shaft]]
name = \"coupling\"
from = \"small\"
to = \"large\"
stiffness = 5000
cubic = 20000
damping = 65
damping_acts = \"in contact\"
clearance = 0.02
[[torque]]
name = \"step\"
on = \"small\"
mean = 100
";

// Source: the reference of transients, from an independent program. Its damper acts in contact only.
#[test]
fn a_clearance_with_cubic_contact_agrees_with_the_reference() {
    let line = line_of(CUBIC, &[]);
    let text = QuestionText {
        duration: some("0.1s"),
        step: some("0.01s"),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    for (time, x) in [
        (0.01, 0.015_256_418_4),
        (0.02, 0.027_690_570_4),
        (0.05, 0.030_129_918_8),
        (0.1, 0.029_920_071_1),
    ] {
        let found = result.table().interpolate("coupling.twist", time).expect("recorded");
        assert!((found - x).abs() < 6e-11, "{found} for {x}");
    }
}

const STAGES: &str = "\
format = 1
name = \"Two stages and a gear with backlash\"
[[inertia]]
name = \"engine\"
inertia = 0.3
[[inertia]]
name = \"pinion\"
inertia = 0.01
[[inertia]]
name = \"load\"
inertia = 2
[[shaft]]
name = \"damper\"
from = \"engine\"
to = \"pinion\"
stages = [ { until = 0.05, stiffness = 200 }, { stiffness = 2000 } ]
damping = 1
[[gear]]
name = \"mesh\"
input = \"pinion\"
output = \"load\"
ratio = 3
stiffness = 5e4
damping = 5
clearance = 0.01
[[torque]]
name = \"drive\"
on = \"engine\"
amplitude = 60
frequency = 25
[[torque]]
name = \"road\"
on = \"load\"
mean = 0
amplitude = 1
frequency = 5
";

// Source: between events the integration sees smooth equations, so that its error falls with the
// tolerance, and the energy closes: initial + work - heat = stored. What is counted is what is listed.
#[test]
fn stages_and_a_mesh_with_backlash_close_their_energy() {
    let line = line_of(STAGES, &[]);
    let run = |tolerance: &str| {
        let text = QuestionText {
            duration: some("2s"),
            step: some("1e-3"),
            tolerance: some(tolerance),
            ..QuestionText::default()
        };
        simulate(&line, text)
    };
    let (fine, coarse) = (run("1e-12"), run("1e-9"));
    for (result, bound) in [(&fine, 3e-11), (&coarse, 3e-8)] {
        let energy = result.metrics.energy_balance.expect("integrated");
        assert!(energy.relative_residual < bound, "{energy:?}");
    }
    assert_eq!(fine.events.len(), coarse.events.len());
    let count = |kind: &str, element: &str| {
        let of = fine.events.iter().filter(|e| e.kind == kind && e.element == element);
        of.count() as u64
    };
    let (mesh, damper) = (&fine.metrics.events["mesh"], &fine.metrics.events["damper"]);
    assert!(mesh.contacts > 10 && damper.stage_changes > 10);
    assert_eq!(mesh.contacts, count("contact", "mesh"));
    assert_eq!(damper.stage_changes, count("stage", "damper"));
    assert!(mesh.free_share > 0.0 && mesh.free_share < 1.0);
    assert!(fine.events.iter().any(|e| e.text == "gear \"mesh\": contact on the coast side"));
    // Each event finds its twist on the border.
    for event in &fine.events {
        let border: f64 = if event.element == "mesh" { 0.005 } else { 0.05 };
        assert!((event.twist.abs() - border).abs() < 1e-13, "{event:?}");
    }
}

const RISING: &str = "\
format = 1
name = \"Run-up of one inertia\"
[[inertia]]
name = \"disc\"
inertia = 2
[[shaft]]
name = \"shaft\"
from = \"disc\"
to = \"ground\"
stiffness = 800
damping = 4
[[torque]]
name = \"unbalance\"
on = \"disc\"
amplitude = 3
order = 2
phase = 0.3
speed_power = 2
reference_speed = 10
";

// Source: fixed-step Runge-Kutta of order 4 on the equation with Ω(t) = 5 + 2 t and phase 2 ∫Ω + 0.3,
// extrapolated over two steps.
#[test]
fn a_run_up_follows_the_equation_with_moving_speed() {
    let line = line_of(RISING, &[]);
    let text = QuestionText {
        frequency: some("5..25 rad/s"),
        duration: some("10s"),
        step: some("1s"),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    let by_rate = QuestionText {
        frequency: some("5..25 rad/s"),
        rate: some("2 rad/s²"),
        step: some("1s"),
        tolerance: some("1e-12"),
        ..QuestionText::default()
    };
    assert_eq!(simulate(&line, by_rate).values("shaft.twist"), result.values("shaft.twist"));
    let rate = |t: f64, (x, v): (f64, f64)| {
        let speed = 5.0 + 2.0 * t;
        let torque = 3.0 * (speed / 10.0).powi(2) * (2.0 * (5.0 * t + t * t) + 0.3).cos();
        (v, (torque - 800.0 * x - 4.0 * v) / 2.0)
    };
    let end = |steps: i32| {
        let h = 10.0 / f64::from(steps);
        let mut y = (0.0, 0.0);
        for k in 0..steps {
            let t = h * f64::from(k);
            let add = |y: (f64, f64), a: f64, k: (f64, f64)| (y.0 + a * k.0, y.1 + a * k.1);
            let k1 = rate(t, y);
            let k2 = rate(t + 0.5 * h, add(y, 0.5 * h, k1));
            let k3 = rate(t + 0.5 * h, add(y, 0.5 * h, k2));
            let k4 = rate(t + h, add(y, h, k3));
            for (weight, k) in [(1.0, k1), (2.0, k2), (2.0, k3), (1.0, k4)] {
                y = add(y, h * weight / 6.0, k);
            }
        }
        y.0
    };
    let (coarse, fine) = (end(40_000), end(80_000));
    let exact = fine + (fine - coarse) / 15.0;
    let found = *result.values("shaft.twist").last().expect("recorded");
    assert!((found - exact).abs() < 1e-10 * 0.1, "{found} for {exact}");
}

// Source: a torque table in straight lines on a free inertia: speed and angle are its integrals.
#[test]
fn a_torque_table_acts_along_its_straight_lines() {
    let text = "\
format = 1
name = \"Table\"
[[inertia]]
name = \"a\"
inertia = 2
[[inertia]]
name = \"b\"
inertia = 2
[[shaft]]
name = \"shaft\"
from = \"a\"
to = \"b\"
stiffness = 100
[[torque]]
name = \"drive\"
on = \"a\"
table = { time = [0.5, 1, \"1200 ms\"], torque = [0, 10, -4] }
[[torque]]
name = \"other\"
on = \"b\"
table = { time = [0.5, 1, \"1200 ms\"], torque = [0, 10, -4] }
";
    let line = line_of(text, &[]);
    let text =
        QuestionText { duration: some("2s"), tolerance: some("1e-12"), ..QuestionText::default() };
    let result = simulate(&line, text);
    // Up to 1 s 2.5, to 1.2 s 0.6 more, then -4 for 0.8 s.
    let speed = *result.values("a.speed").last().expect("recorded");
    assert!((speed - (2.5 + 0.6 - 3.2) / 2.0).abs() < 1e-12, "{speed}");
    let twist = result.values("shaft.twist").iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(twist < 1e-13);
}

const STIFF: &str = "\
format = 1
name = \"A very stiff mesh\"
[[inertia]]
name = \"motor\"
inertia = 0.1
[[inertia]]
name = \"wheel\"
inertia = 2
damping = 10
[[inertia]]
name = \"load\"
inertia = 2
[[gear]]
name = \"mesh\"
input = \"motor\"
output = \"wheel\"
ratio = 10
stiffness = 1e9
damping = 1e6
[[shaft]]
name = \"shaft\"
from = \"wheel\"
to = \"load\"
stiffness = 1e4
[[torque]]
name = \"drive\"
on = \"motor\"
amplitude = 10
frequency = \"5 Hz\"
phase = \"-90 deg\"
";

// Source: the limit: with ever stiffer teeth the line is the one with a rigid gear, whose speeds are the
// reference of transients; the explicit integrator, held back by stability, finds the same.
#[test]
fn a_stiff_mesh_is_integrated_implicitly() {
    let line = line_of(STIFF, &[]);
    let run = |integrator: Option<&str>, tolerance: &str| {
        let text = QuestionText {
            duration: some("1s"),
            step: some("0.05s"),
            tolerance: some(tolerance),
            integrator: integrator.map(str::to_owned),
            ..QuestionText::default()
        };
        simulate(&line, text)
    };
    let automatic = run(None, "1e-8");
    let used = &automatic.metrics.integrators;
    assert_eq!(used.len(), 2, "{used:?}");
    assert!(used[1].method.contains("Radau") && used[1].why.contains("stiff"));
    let explicit = run(Some("dop853"), "1e-8");
    assert_eq!(explicit.metrics.integrators.len(), 1);
    assert!(automatic.metrics.steps * 5 < explicit.metrics.steps);
    for (time, wheel, load) in [
        (0.1, 0.429_616_205, 0.494_685_357),
        (0.25, 0.187_570_452, 0.240_268_635),
        (0.5, 0.371_995_049, 0.472_063_857),
        (0.75, 0.122_783_842, 0.159_685_818),
        (1.0, -0.112_249_309, -0.138_145_28),
    ] {
        for result in [&automatic, &explicit] {
            let at = |name: &str| result.table().interpolate(name, time).expect("recorded");
            assert!((at("wheel.speed") - wheel).abs() < 1e-5, "{} {wheel}", at("wheel.speed"));
            assert!((at("load.speed") - load).abs() < 1e-5, "{} {load}", at("load.speed"));
        }
    }
}

// Source: a stiff shaft between two inertias carries the torque that accelerates the far one: the amplitudes
// of both orders are those of the closed form at every speed; nothing is at other orders.
#[test]
fn order_cuts_are_the_amplitudes_of_the_closed_form() {
    let text = "\
format = 1
name = \"Two orders\"
[[inertia]]
name = \"a\"
inertia = 1
[[inertia]]
name = \"b\"
inertia = 3
[[shaft]]
name = \"shaft\"
from = \"a\"
to = \"b\"
stiffness = 1e6
damping = 100
[[torque]]
name = \"drive\"
on = \"a\"
amplitude = 10
harmonics = [ { order = 2.5, amplitude = 4, phase = 1 } ]
";
    let line = line_of(text, &[]);
    let ask = |frequency: &str, duration: &str| {
        let text = QuestionText {
            frequency: some(frequency),
            duration: some(duration),
            ..QuestionText::default()
        };
        simulate(&line, text)
    };
    let amplitude = |order: f64, torque: f64, speed: f64| {
        // T = f 3 / (1 - 3 w² / (4 k) ...): relative motion of two masses about their middle.
        let (w, reduced, k, c) = (order * speed, 0.75, 1e6, 100.0);
        let stiff = f64::hypot(k, c * w);
        torque * stiff / f64::hypot(k - reduced * w * w, c * w) * 0.75
    };
    for (frequency, duration, close) in [("40", "6s", 1e-4), ("20..60", "20s", 2e-3)] {
        let result = ask(frequency, duration);
        let map = result.orders.expect("has a speed");
        assert_eq!(map.channel, "shaft.torque");
        assert!(map.cuts.contains(&1.0) && map.cuts.contains(&2.5), "{:?}", map.cuts);
        for (order, torque) in [(1.0, 10.0), (2.5, 4.0)] {
            // The first blocks hold the free vibration of the start.
            for (speed, found) in map.frequency.iter().zip(map.cut(order)).skip(2) {
                assert_close(found, amplitude(order, torque, *speed), close);
            }
        }
        assert!(map.cut(4.0).iter().skip(2).all(|a| *a < 0.02));
    }
}

// Source: closed forms of a tip-in: an undamped line under a step of torque overshoots by all of the way, and
// its torque peaks at twice the final one; the largest acceleration is at the start.
#[test]
fn a_tip_in_has_its_metrics() {
    let text = "\
format = 1
name = \"Tip-in\"
[[inertia]]
name = \"a\"
inertia = 2
[[shaft]]
name = \"shaft\"
from = \"a\"
to = \"ground\"
stiffness = 200
damping = 0.2
[[torque]]
name = \"tip-in\"
on = \"a\"
pulse = { shape = \"ramp\", peak = 30, start = \"0 s\", duration = \"1 ms\" }
";
    let line = line_of(text, &[]);
    let result = simulate(&line, QuestionText { duration: some("10s"), ..QuestionText::default() });
    let (d, w0) = (0.05_f64, 10.0_f64);
    let w = (w0 * w0 - d * d).sqrt();
    let shaft = &result.metrics.shafts["shaft"];
    assert_close(shaft.final_torque.expect("settles"), 30.0, 1e-12);
    let overshoot = (-d * std::f64::consts::PI / w).exp();
    assert_close(shaft.overshoot.expect("turns"), overshoot, 1e-4);
    assert_close(shaft.peak_torque, 30.0 * (1.0 + overshoot), 1e-4);
    assert_close(shaft.first_peak_time.expect("turns"), std::f64::consts::PI / w + 5e-4, 1e-5);
    assert_close(shaft.oscillation_frequency.expect("rings"), w, 1e-8);
    assert_close(shaft.decay_rate.expect("rings"), d, 1e-6);
    let node = &result.metrics.nodes["a"];
    assert_close(node.peak_acceleration, 15.0, 1e-3);
    assert_close(node.peak_jerk, 15.0 / 1e-3, 1e-3);
    assert_eq!(node.speed_irregularity, None);
}
