//! Model texts of the lines that periodic responses are tried on.
#![allow(dead_code, reason = "each test program uses a part of this")]

/// A model file in the making. Keys are lines of the file.
#[derive(Clone)]
pub struct Model(pub String);

impl Model {
    pub fn new() -> Self {
        Self("format = 1\nname = \"line under test\"\n".to_owned())
    }

    pub fn inertia(mut self, name: &str, inertia: f64, keys: &str) -> Self {
        self.0 += &format!("[[inertia]]\nname = \"{name}\"\ninertia = {inertia:?}\n{keys}\n");
        self
    }

    pub fn shaft(mut self, name: &str, from: &str, to: &str, keys: &str) -> Self {
        let ends = format!("from = \"{from}\"\nto = \"{to}\"");
        self.0 += &format!("[[shaft]]\nname = \"{name}\"\n{ends}\n{keys}\n");
        self
    }

    pub fn gear(mut self, name: &str, input: &str, output: &str, ratio: f64, keys: &str) -> Self {
        let ends = format!("input = \"{input}\"\noutput = \"{output}\"");
        self.0 += &format!("[[gear]]\nname = \"{name}\"\n{ends}\nratio = {ratio:?}\n{keys}\n");
        self
    }

    pub fn torque(mut self, name: &str, on: &str, keys: &str) -> Self {
        self.0 += &format!("[[torque]]\nname = \"{name}\"\non = \"{on}\"\n{keys}\n");
        self
    }
}

/// Keys of a shaft: stiffness, damping, and more lines.
pub fn keys(stiffness: f64, damping: f64, more: &str) -> String {
    format!("stiffness = {stiffness:?}\ndamping = {damping:?}\n{more}")
}

/// One inertia of 1 on a shaft to ground with the given keys, under torques of the given keys.
pub fn held(shaft: &str, torque: &str) -> String {
    Model::new()
        .inertia("disc", 1.0, "")
        .shaft("spring", "disc", "ground", shaft)
        .torque("drive", "disc", torque)
        .0
}

/// `x'' + c x' + k x + g x³ = P cos(W t)`.
pub fn duffing(c: f64, k: f64, g: f64, p: f64) -> String {
    held(&keys(k, c, &format!("cubic = {g:?}")), &format!("amplitude = {p:?}"))
}

/// D1 of the reference numbers.
pub fn d1() -> String {
    duffing(0.05, 1.0, 0.1, 0.18)
}

/// D2 of the reference numbers.
pub fn d2() -> String {
    duffing(0.04, 1.0, 1.0, 0.015)
}

/// The theory's driveline as its one oscillator.
pub fn theory(f: f64) -> String {
    let square = 26.057_723_985_895_066_f64 * 26.057_723_985_895_066;
    duffing(0.095_187_613_924_078_2, square, -0.679_004_979_325_091, f)
}

/// `count` inertias of 1 in a row: stiffness 1000, damping 0.5 between neighbours, the first held to
/// ground by 1000, damping 0.05 to ground on each, `5 cos(w t)` on the last. Shafts between inertias
/// for which `nonlinear` holds have a cubic part of -500.
pub fn chain(count: usize, nonlinear: impl Fn(usize) -> bool) -> String {
    let mut model = Model::new();
    for k in 0..count {
        model = model.inertia(&format!("n{k}"), 1.0, "damping = 0.05");
    }
    model = model.shaft("held", "n0", "ground", "stiffness = 1000");
    for k in 1..count {
        let cubic = if nonlinear(k) { "cubic = -500" } else { "" };
        let (from, to) = (format!("n{}", k - 1), format!("n{k}"));
        model = model.shaft(&format!("s{k}"), &from, &to, &keys(1000.0, 0.5, cubic));
    }
    model.torque("drive", &format!("n{}", count - 1), "amplitude = 5").0
}

/// Two inertias, the second a light nonlinear absorber.
pub fn absorber(p: f64) -> String {
    Model::new()
        .inertia("main", 1.0, "")
        .inertia("absorber", 0.05, "")
        .shaft("ground spring", "main", "ground", &keys(1.0, 0.002, "cubic = 1"))
        .shaft("link", "main", "absorber", &keys(0.0453, 0.013, "cubic = 0.0042"))
        .torque("drive", "main", &format!("amplitude = {p:?}"))
        .0
}

/// Two discs in a free line, mean torque through it, a law that differs between drive and coast.
pub fn free_with_mean() -> String {
    Model::new()
        .inertia("engine", 0.3, "")
        .inertia("load", 1.5, "")
        .shaft("shaft", "engine", "load", &keys(100.0, 0.4, "quadratic = 60\ncubic = 300"))
        .torque("drive", "engine", "mean = 12\namplitude = 8")
        .torque("road", "load", "mean = \"balance\"")
        .0
}

/// A free line out of balance: the whole accelerates.
pub fn free_unbalanced() -> String {
    Model::new()
        .inertia("engine", 0.3, "")
        .inertia("load", 1.5, "")
        .shaft("shaft", "engine", "load", &keys(100.0, 0.4, "quadratic = 60\ncubic = 300"))
        .torque("drive", "engine", "mean = 12\namplitude = 8")
        .0
}

/// A free line that dampers to ground hold at a steady speed.
pub fn free_damped() -> String {
    Model::new()
        .inertia("engine", 0.3, "damping = 0.2")
        .inertia("middle", 0.2, "")
        .inertia("load", 1.5, "damping = 0.9")
        .shaft("front", "engine", "middle", &keys(150.0, 0.3, ""))
        .shaft("rear", "middle", "load", &keys(120.0, 0.3, "quadratic = 40\ncubic = 200"))
        .torque("drive", "engine", "mean = 12\namplitude = 6")
        .0
}

/// Orders 0.5, 1 and 2 with phases from two sources, one of which grows with the square of speed.
pub fn many_orders() -> String {
    let orders = "amplitude = 0.6\nphase = 0.7\nharmonics = [\n  { order = 0.5, amplitude = 0.3, phase = -0.4 },\n  \
                  { order = 2, amplitude = 0.5, phase = 1.9 },\n]";
    let growing = "amplitude = 0.2\norder = 2\nphase = 2.5\nspeed_power = 2\nreference_speed = 9";
    Model::new()
        .inertia("engine", 0.5, "")
        .inertia("load", 1.0, "")
        .shaft("front", "engine", "load", &keys(60.0, 0.25, "cubic = 90"))
        .shaft("rear", "load", "ground", &keys(90.0, 0.3, "cubic = -20\nquintic = 5"))
        .torque("firing", "engine", orders)
        .torque("unbalance", "load", growing)
        .0
}

/// A geared, branched train: engine, elastic mesh, two axles with nonlinear half-shafts, wheels held.
pub fn geared() -> String {
    Model::new()
        .inertia("engine", 0.2, "")
        .inertia("gearbox", 0.05, "damping = 0.01")
        .inertia("left wheel", 2.0, "damping = 0.5")
        .inertia("right wheel", 2.5, "damping = 0.5")
        .shaft("clutch", "engine", "gearbox", &keys(300.0, 0.6, "cubic = 400\npreload = 2"))
        .gear("final drive", "gearbox", "differential", -3.2, "stiffness = 4000\ndamping = 1.5")
        .inertia("differential", 0.3, "")
        .shaft("left", "differential", "left wheel", &keys(700.0, 4.0, "cubic = -900"))
        .gear("hub", "differential", "hub flange", 0.5, "")
        .shaft("right", "hub flange", "right wheel", &keys(400.0, 4.0, "quadratic = 50"))
        .shaft("left road", "left wheel", "ground", "stiffness = 120")
        .shaft("right road", "right wheel", "ground", "stiffness = 150")
        .torque(
            "drive",
            "engine",
            "mean = 5\namplitude = 3\nharmonics = [{ order = 2, amplitude = 1 }]",
        )
        .0
}

/// A loop of shafts: a triangle with a tail, one nonlinear shaft in the loop and one in the tail.
pub fn mesh() -> String {
    let mut model = Model::new();
    for (name, inertia) in [("a", 0.4), ("b", 0.6), ("c", 0.5), ("d", 0.8), ("e", 0.3)] {
        model = model.inertia(name, inertia, "");
    }
    model
        .shaft("ab", "a", "b", &keys(80.0, 0.3, "cubic = 150"))
        .shaft("bc", "b", "c", &keys(60.0, 0.3, ""))
        .shaft("ca", "c", "a", &keys(70.0, 0.3, ""))
        .shaft("cd", "c", "d", &keys(50.0, 0.3, ""))
        .shaft("de", "d", "e", &keys(40.0, 0.3, "cubic = 60\nquadratic = 10"))
        .shaft("ea", "e", "a", &keys(30.0, 0.2, ""))
        .shaft("held", "b", "ground", &keys(45.0, 0.3, ""))
        .torque("drive", "d", "amplitude = 2\nmean = 1")
        .0
}

/// Four inertias, each pair joined, all linear but one shaft: groups with three neighbours that are
/// no ends of the nonlinear shaft.
pub fn full_mesh() -> String {
    let mut model = Model::new();
    for k in 0..6 {
        model = model.inertia(&format!("n{k}"), 0.3 + 0.1 * f64::from(k), "");
    }
    for a in 0..6 {
        for b in 0..a {
            let law = if (a, b) == (1, 0) { "cubic = 200" } else { "" };
            let stiffness = 20.0 + 7.0 * f64::from(a) + 3.0 * f64::from(b);
            let (from, to) = (format!("n{a}"), format!("n{b}"));
            model = model.shaft(&format!("s{a}{b}"), &from, &to, &keys(stiffness, 0.1, law));
        }
    }
    model
        .shaft("held", "n5", "ground", &keys(30.0, 0.3, ""))
        .torque("drive", "n3", "amplitude = 3")
        .0
}

/// A row of `count` inertias, all different, held or free, with one nonlinear shaft after inertia
/// `at`, mean torque through it.
pub fn long_row(count: usize, at: usize, held: bool) -> String {
    let mut model = Model::new();
    for k in 0..count {
        let vary = 1.0 + 0.3 * (k as f64 * 1.3).sin();
        model = model.inertia(&format!("n{k}"), vary, "");
    }
    if held {
        model = model.shaft("held", "n0", "ground", &keys(900.0, 0.4, ""));
    }
    for k in 1..count {
        let vary = 1000.0 * (1.0 + 0.2 * (k as f64 * 0.7).cos());
        let law = if k == at { "quadratic = -150\ncubic = -300" } else { "" };
        let (from, to) = (format!("n{}", k - 1), format!("n{k}"));
        model = model.shaft(&format!("s{k}"), &from, &to, &keys(vary, 0.6, law));
    }
    model
        .torque("drive", &format!("n{}", count - 1), "mean = 20\namplitude = 6\nphase = 0.3")
        .torque("side", &format!("n{}", count / 3), "amplitude = 2\norder = 2")
        .torque("brake", "n0", "mean = -20")
        .0
}
