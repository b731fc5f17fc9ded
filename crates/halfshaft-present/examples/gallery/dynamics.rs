//! Responses over speed and over time.

use halfshaft_present::figure::{
    Anchor, Axis, Colour, Curve, Figure, Label, Line, Marker, Panel, Points, Reference,
};

/// The Duffing oscillator `x'' + 2 d x' + w0^2 x - k3 x^3 = p cos(w t)` by one-term averaging: at an
/// amplitude `a` the backbone is at `w0^2 - 3/4 k3 a^2`, and the response where
/// `(backbone^2 - w^2)^2 a^2 + (2 d w a)^2 = p^2`, a quadratic in `w^2`.
struct Oscillator {
    stiffness: f64,
    softening: f64,
    damping: f64,
    load: f64,
}

impl Oscillator {
    fn backbone(&self, amplitude: f64) -> f64 {
        (self.stiffness - 0.75 * self.softening * amplitude * amplitude).max(0.0).sqrt()
    }

    /// The speeds below and above the backbone at which the response has this amplitude.
    fn speeds(&self, amplitude: f64) -> Option<(f64, f64)> {
        let square = self.backbone(amplitude).powi(2);
        let damping = 2.0 * self.damping * self.damping;
        let spread = (self.load / amplitude).powi(2) - 2.0 * damping * square + damping.powi(2);
        let root = (spread >= 0.0).then(|| spread.sqrt())?;
        Some(((square - damping - root).max(0.0).sqrt(), (square - damping + root).sqrt()))
    }

    /// The whole branch, up the left flank over the peak and down the right one.
    fn branch(&self) -> (Vec<f64>, Vec<f64>) {
        let amplitudes: Vec<f64> = (20..4000).map(|i| f64::from(i) * 5e-4).collect();
        let reached = amplitudes.iter().filter_map(|&a| self.speeds(a).map(|s| (a, s)));
        let reached: Vec<(f64, (f64, f64))> = reached.collect();
        let left = reached.iter().map(|&(a, (speed, _))| (speed, a));
        let right = reached.iter().rev().map(|&(a, (_, speed))| (speed, a));
        left.chain(right).filter(|&(speed, _)| (22.5..28.5).contains(&speed)).unzip()
    }
}

/// A softening resonance with two folds, its backbone, and rpm above rad/s.
pub fn resonance() -> Figure {
    let oscillator = Oscillator { stiffness: 679.0, softening: 80.0, damping: 0.35, load: 25.0 };
    let (speed, amplitude) = oscillator.branch();
    // Softening: the right flank comes first in speed, and the branch turns back between the folds.
    let turning: Vec<usize> = (1..speed.len() - 1)
        .filter(|&i| (speed[i + 1] - speed[i]) * (speed[i] - speed[i - 1]) < 0.0)
        .collect();
    let between = |i: usize| turning.len() >= 2 && turning[0] < i && i < turning[1];
    let stable: Vec<bool> = (0..speed.len()).map(|i| !between(i)).collect();
    let folds = Points::new(
        "fold",
        turning.iter().map(|&i| speed[i]).collect(),
        turning.iter().map(|&i| amplitude[i]).collect(),
        Colour::DANGER,
    )
    .with_labels(turning.iter().map(|&i| format!("{:.2} rad/s", speed[i])).collect());
    let heights: Vec<f64> = (0..400).map(|i| f64::from(i) * 0.005).collect();
    let spine = heights.iter().map(|&a| oscillator.backbone(a)).collect();
    let x = Axis::new("Excitation speed Ω", "rad/s").with_range(22.5, 28.5).with_secondary(
        "Excitation speed",
        "rpm",
        30.0 / std::f64::consts::PI,
    );
    let panel = Panel::new(x, Axis::new("Twist amplitude a_1", "rad").with_range(0.0, 1.6))
        .with(
            Curve::new("backbone", spine, heights, Colour::AUXILIARY)
                .with_line(Line::DashDot)
                .with_width(1.0),
        )
        .with_all(Curve::by_stability("response", &speed, &amplitude, &stable, Colour::PRIMARY))
        .with(folds);
    Figure::new("resonance", "Softening resonance of the two-mass driveline")
        .with_caption("The response jumps at the two folds; the dashed part is unstable.")
        .with(panel)
}

fn decaying(count: u32, duration: f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let time: Vec<f64> =
        (0..count).map(|i| duration * f64::from(i) / f64::from(count - 1)).collect();
    let wave = |t: &f64, lag: f64| (-0.55 * t).exp() * (26.0 * t - lag).cos();
    let twist = time.iter().map(|t| 3.1e-3 * wave(t, 0.0)).collect();
    let speed = time.iter().map(|t| 104.7 + 0.08 * wave(t, 1.6) + 0.004 * t).collect();
    (time, twist, speed)
}

/// Twist and speed over a common time.
pub fn decay() -> Figure {
    let (time, twist, speed) = decaying(20_000, 6.0);
    let envelope: Vec<f64> = time.iter().map(|t| 3.1e-3 * (-0.55 * t).exp()).collect();
    let axis = Axis::new("Time t", "s");
    let upper = Panel::new(axis.clone(), Axis::new("Shaft twist θ", "rad"))
        .with(Curve::new("twist", time.clone(), twist, Colour::PRIMARY))
        .with(
            Curve::new("envelope e^{−δt}", time.clone(), envelope, Colour::DANGER)
                .with_line(Line::Dashed)
                .with_width(1.0),
        );
    let speed_axis = Axis::new("Engine speed", "rad/s").with_secondary("", "rpm", 9.549_296_585_5);
    let lower = Panel::new(axis, speed_axis)
        .with(Curve::new("engine", time, speed, Colour::index(2)).unlisted());
    Figure::new("decay", "Free decay after a torque step").with(upper).with(lower)
}

/// A record of a million points.
pub fn dense_record() -> Figure {
    let time: Vec<f64> = (0..1_000_000).map(|i| f64::from(i) * 1e-4).collect();
    let torque = |t: &f64| {
        let beat = 1.0 + 0.5 * (0.4 * t).sin();
        120.0 * beat * (151.0 * t).sin() + 30.0 * (37.0 * t * t).sin()
    };
    let values = time.iter().map(torque).collect();
    let panel = Panel::new(Axis::new("Time t", "s"), Axis::new("Shaft torque", "N·m"))
        .with(Curve::new("torque", time, values, Colour::PRIMARY).with_width(0.8));
    Figure::new("dense", "A record of one million points").with(panel)
}

/// A compliance over three decades on logarithmic axes.
pub fn compliance() -> Figure {
    let speed: Vec<f64> = (0..2000).map(|i| 10f64.powf(-1.0 + f64::from(i) * 0.0015)).collect();
    let mode = |w: f64, w0: f64, gain: f64| {
        gain / ((w0 * w0 - w * w).powi(2) + (0.02 * w0 * w).powi(2)).sqrt()
    };
    let line = |gain: f64| -> Vec<f64> {
        speed.iter().map(|&w| 1e-4 * (mode(w, 2.0, 4.0) + gain * mode(w, 25.0, 40.0))).collect()
    };
    let panel = Panel::new(
        Axis::new("Frequency", "Hz").logarithmic(),
        Axis::new("Compliance |θ/M|", "rad/(N·m)").logarithmic(),
    )
    .with(Curve::new("soft clutch", speed.clone(), line(1.0), Colour::index(0)))
    .with(
        Curve::new("stiff clutch", speed.clone(), line(0.1), Colour::index(1))
            .with_line(Line::Dashed),
    )
    .with(
        Points::new(
            "measured",
            vec![0.3, 1.0, 4.0, 12.0],
            vec![1.2e-4, 1.6e-4, 4e-5, 6e-6],
            Colour::Black,
        )
        .with_marker(Marker::Square)
        .hollow(),
    )
    .with(Reference::vertical(25.0, "idle firing order", Colour::AUXILIARY))
    .with(Label { anchor: Anchor::Right, ..Label::new(2.1, 3e-3, "driveline mode") });
    Figure::new("compliance", "Torsional compliance at the flywheel").with(panel)
}
