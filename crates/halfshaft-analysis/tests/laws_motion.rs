//! `simulate` and `shock` across kinks, with friction and with growing torques.

mod common;

use common::{history, line_of, some};
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_results::HistoryResult;

fn at(result: &HistoryResult, channel: &str, time: f64) -> f64 {
    result.table().interpolate(channel, time).unwrap_or_else(|| panic!("{channel} at {time}"))
}

/// A history whose grid holds the times of the reference.
fn simulate(text: &str, duration: &str, step: &str, initial: &[&str]) -> HistoryResult {
    let question = QuestionText {
        tolerance: some("1e-12"),
        duration: some(duration),
        step: some(step),
        initial: initial.iter().map(|text| (*text).to_owned()).collect(),
        ..QuestionText::default()
    };
    history(&line_of(text, &[]), Verb::Simulate, &question)
}

const HELD: &str = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 5\n[[shaft]]\n\
     name = \"s\"\nfrom = \"a\"\nto = \"ground\"\n";

/// Exact motion of one inertia on a gap with linear flanks: each stretch in closed form, the crossings
/// by bisection.
struct Exact {
    stiffness: f64,
    damping: f64,
    gap_damping: f64,
    half: f64,
    inertia: f64,
}

impl Exact {
    /// The state `time` later, as if nothing was crossed.
    fn stretch(&self, [x, v]: [f64; 2], time: f64, side: f64) -> [f64; 2] {
        if side == 0.0 {
            let decay = self.gap_damping / self.inertia;
            if decay == 0.0 {
                return [x + v * time, v];
            }
            let left = (-decay * time).exp();
            return [x + v * (1.0 - left) / decay, v * left];
        }
        let d = x - side * self.half;
        let decay = self.damping / (2.0 * self.inertia);
        let omega = (self.stiffness / self.inertia - decay * decay).sqrt();
        let (sin, cos) = (omega * time).sin_cos();
        let left = (-decay * time).exp();
        let b = (v + decay * d) / omega;
        let moved = left * (d * cos + b * sin);
        let speed = left * ((b * omega - decay * d) * cos - (d * omega + decay * b) * sin);
        [side * self.half + moved, speed]
    }

    /// Where the state is: on a flank (its sign) or in the gap (0), going with its speed at the edge.
    fn side(&self, [x, v]: [f64; 2]) -> f64 {
        let at_edge = (x.abs() - self.half).abs() < 1e-13;
        let outwards = x * v > 0.0;
        if x.abs() > self.half && !at_edge || at_edge && outwards { x.signum() } else { 0.0 }
    }

    fn at(&self, mut state: [f64; 2], time: f64) -> f64 {
        let (mut now, scan) = (0.0, 1e-4_f64);
        let mut side = self.side(state);
        while now < time {
            let step = scan.min(time - now);
            let inside = |[x, _]: [f64; 2]| match side {
                0.0 => x.abs() < self.half,
                side => x * side > self.half,
            };
            if inside(self.stretch(state, step, side)) || now + step >= time {
                state = self.stretch(state, step, side);
                now += step;
                continue;
            }
            let (mut low, mut high) = (0.0, step);
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                // The very start of a stretch stands on the edge.
                if inside(self.stretch(state, middle, side)) || middle < 1e-9 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            state = self.stretch(state, high, side);
            now += high;
            side = self.side([state[0].signum() * self.half, state[1]]);
        }
        state[0]
    }
}

// Source: the exact solution, stretch by stretch. (The reference "Backlash" gives the angles of the
// line without any gap, -1.22431277 at 0.05 s and so on; those come out with a clearance of zero.)
#[test]
fn backlash_follows_the_exact_solution() {
    let gap = std::f64::consts::FRAC_PI_4;
    let times = [0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0];
    let linear = [
        -1.22431277,
        0.954144403,
        0.579302627,
        0.351555956,
        0.129290253,
        -0.036931011,
        0.0105182589,
    ];
    for (word, gap_damping) in [("always", 50.0), ("in contact", 0.0)] {
        let law = format!(
            "stiffness = 20000\ndamping = 50\ndamping_acts = \"{word}\"\nclearance = {gap}\n"
        );
        let start = ["s.twist=1.5707963267948966 rad"];
        let result = simulate(&format!("{HELD}{law}"), "1s", "10ms", &start);
        let exact =
            Exact { stiffness: 2e4, damping: 50.0, gap_damping, half: gap / 2.0, inertia: 5.0 };
        for time in times {
            let found = at(&result, "a.angle", time);
            let exact = exact.at([std::f64::consts::FRAC_PI_2, 0.0], time);
            assert!((found - exact).abs() < 1e-8, "{word}, t = {time}: {found} is not {exact}");
        }
        let energy = result.metrics.energy_balance.expect("an integration");
        assert!(energy.relative_residual < 1e-9, "{energy:?}");
        let closed = law.replace(&gap.to_string(), "0");
        let result = simulate(&format!("{HELD}{closed}"), "1s", "10ms", &start);
        for (time, angle) in times.iter().zip(linear) {
            let found = at(&result, "a.angle", *time);
            assert!((found - angle).abs() < 6e-9, "t = {time}: {found} is not {angle}");
        }
    }
}

// Source: reference "Clearance with cubic contact", whose damping acts in contact only: that is what
// its numbers say.
#[test]
fn a_clearance_with_cubic_contact_follows_the_reference() {
    let text = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 0.3\n[[inertia]]\n\
                name = \"b\"\ninertia = 126\n[[shaft]]\nname = \"s\"\nfrom = \"a\"\nto = \"b\"\n\
                stiffness = 5000\ncubic = 20000\nclearance = 0.02\ndamping = 65\n\
                damping_acts = \"in contact\"\n[[torque]]\nname = \"t\"\non = \"a\"\nmean = 100\n";
    let result = simulate(text, "0.1s", "10ms", &[]);
    for (time, twist) in
        [(0.01, 0.0152564184), (0.02, 0.0276905704), (0.05, 0.0301299188), (0.1, 0.0299200711)]
    {
        let found = at(&result, "s.twist", time);
        assert!((found - twist).abs() < 1e-10, "t = {time}: {found} is not {twist}");
    }
}

// Source: dry friction takes 4 F/k off the swing each period (Lorenz 1924, any book); released at
// x0 the turning points are at x0 - 2 n F/k in turn. The regularisation errs by its speed.
#[test]
fn friction_takes_a_constant_step_off_the_swing() {
    let law = "stiffness = 2000\nfriction = 20\nfriction_speed = 1e-4\n";
    let question = QuestionText {
        tolerance: some("1e-9"),
        duration: some("0.5s"),
        step: some("1ms"),
        friction: some("smoothed"),
        initial: vec!["s.twist=0.1 rad".to_owned()],
        ..QuestionText::default()
    };
    let line = line_of(&format!("{HELD}{law}"), &[]);
    let result = history(&line, Verb::Simulate, &question);
    // Half a period: π sqrt(5/2000) = 0.157 s, then turning at -(0.1 - 0.02), then at 0.06.
    let half = std::f64::consts::PI * (5.0_f64 / 2000.0).sqrt();
    for (halves, twist) in [(1.0, -0.08), (2.0, 0.06), (3.0, -0.04)] {
        let found = at(&result, "s.twist", halves * half);
        assert!((found - twist).abs() < 2e-5, "{halves}: {found}");
    }
    let energy = result.metrics.energy_balance.expect("an integration");
    assert!(energy.relative_residual < 1e-7, "{energy:?}");
    // Heat: F times the path 0.18 + 0.14 + 0.1 and what follows.
    assert!(energy.dissipated > 20.0 * 0.42);
    assert!(result.header.assumptions.iter().any(|a| a.contains("smoothed")));
}

// Source: reference "Geared line" (Modelica's Rotational.First, damper from inertia 2 to ground), with
// a mesh a hundred thousand times stiffer than the shaft in place of the ideal gear.
#[test]
fn a_stiff_mesh_is_nearly_an_ideal_gear() {
    let text = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"motor\"\ninertia = 0.1\n[[inertia]]\n\
                name = \"two\"\ninertia = 2\ndamping = 10\n[[inertia]]\nname = \"load\"\n\
                inertia = 2\n[[gear]]\nname = \"g\"\ninput = \"motor\"\noutput = \"two\"\n\
                ratio = 10\nstiffness = 1e9\ndamping = 3e4\n[[shaft]]\nname = \"s\"\n\
                from = \"two\"\nto = \"load\"\nstiffness = 1e4\n[[torque]]\nname = \"t\"\n\
                on = \"motor\"\namplitude = 10\nfrequency = \"5 Hz\"\nphase = \"-90 deg\"\n";
    let question = QuestionText {
        tolerance: some("1e-10"),
        duration: some("1s"),
        step: some("50ms"),
        ..QuestionText::default()
    };
    let result = history(&line_of(text, &[]), Verb::Simulate, &question);
    let reference = [
        (0.1, 0.429616205, 0.494685357),
        (0.25, 0.187570452, 0.240268635),
        (0.5, 0.371995049, 0.472063857),
        (0.75, 0.122782843, 0.159685818),
        (1.0, -0.112249309, -0.13814528),
    ];
    for (time, second, load) in reference {
        assert!((at(&result, "two.speed", time) - second).abs() < 1e-5, "t = {time}");
        assert!((at(&result, "load.speed", time) - load).abs() < 1e-5, "t = {time}");
    }
    assert!(result.table().column("g.torque").is_some());
}

// Source: the definition: at Ω the amplitudes are (Ω / reference)^power times those written.
#[test]
fn torques_grow_with_the_power_of_the_speed() {
    let line = |torque: &str| {
        format!(
            "{HELD}stiffness = 2000\ncubic = 500\ndamping = 3\n[[torque]]\nname = \"t\"\n\
             on = \"a\"\n{torque}\n"
        )
    };
    let run = |torque: &str| {
        let question = QuestionText {
            tolerance: some("1e-11"),
            duration: some("1s"),
            frequency: some("30 rad/s"),
            ..QuestionText::default()
        };
        history(&line_of(&line(torque), &[]), Verb::Simulate, &question)
    };
    let growing = run("amplitude = 4\nspeed_power = 2\nreference_speed = 20\n\
                       harmonics = [{ order = 2, amplitude = 8 }]");
    let plain = run("amplitude = 9\nharmonics = [{ order = 2, amplitude = 18 }]");
    for time in [0.3, 0.7, 1.0] {
        let (a, b) = (at(&growing, "s.twist", time), at(&plain, "s.twist", time));
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

// Source: energy: a stop returns what it takes, a shock ends in the gap or on a flank.
#[test]
fn a_shock_crosses_a_clearance() {
    let text = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 1\n[[inertia]]\n\
                name = \"b\"\ninertia = 4\n[[shaft]]\nname = \"s\"\nfrom = \"a\"\nto = \"b\"\n\
                stiffness = 3000\nclearance = 0.05\ndamping = 4\n[[torque]]\nname = \"t\"\non = \"a\"\n\
                mean = 30\npulse = { shape = \"half-sine\", peak = -300, duration = 0.05 }\n\
                [[torque]]\nname = \"u\"\non = \"b\"\nmean = \"balance\"\n";
    let question = QuestionText { duration: some("3s"), ..QuestionText::default() };
    let result = history(&line_of(text, &[]), Verb::Shock, &question);
    let twist = &result.metrics.channels["s.twist"];
    assert!(twist.minimum < -0.025 && twist.maximum > 0.025, "{twist:?}");
    // It comes back to the flank: 30 N·m on 3000 N·m/rad beyond half the gap.
    assert!((at(&result, "s.twist", 3.0) - 0.035).abs() < 5e-3);
}

// Source: Newton's law: past its torque of 10 N·m the shaft slips and the rest accelerates the inertia,
// (12 - 10)/5 rad/s²; slipping is no running away.
#[test]
fn a_shaft_without_stiffness_in_its_last_stage_slips() {
    let law = "stages = [{ until = 0.01, stiffness = 1000 }, { stiffness = 0 }]\n[[torque]]\n\
               name = \"t\"\non = \"a\"\nmean = 12\n";
    let result = simulate(&format!("{HELD}{law}"), "5s", "0.5s", &[]);
    assert!(result.header.termination.is_complete(), "{:?}", result.header.termination);
    let (early, late) = (at(&result, "a.speed", 2.0), at(&result, "a.speed", 5.0));
    assert!((late - early - 3.0 * 0.4).abs() < 1e-9);
    assert!((at(&result, "s.torque", 5.0) - 10.0).abs() < 1e-12);
}
