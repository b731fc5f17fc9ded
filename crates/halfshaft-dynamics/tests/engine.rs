//! Torque orders of piston engines.

use std::f64::consts::{PI, TAU};

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::engine::{CylinderOrder, cylinder_orders};
use halfshaft_model::{Driveline, Source, read_model};
use halfshaft_numerics::Complex;

const CRANK: [f64; 3] = [0.086, 0.09, 0.145];

fn line_of(engine: &str) -> Driveline {
    let text = format!(
        "format = 1\nname = \"engine\"\n[[inertia]]\nname = \"crank\"\ninertia = 0.2\n[[inertia]]\n\
         name = \"flywheel\"\ninertia = 1\n[[shaft]]\nname = \"shaft\"\nfrom = \"crank\"\nto = \"flywheel\"\n\
         stiffness = 1e5\n[[engine]]\nname = \"four\"\non = [\"crank\"]\n{engine}"
    );
    match read_model(Source::new("engine.toml", text), &[]) {
        Ok((line, _)) => line,
        Err(found) => panic!("{}", found.plain()),
    }
}

/// Orders with moduli and phases of no pattern, of half the crank's speed and its multiples.
fn known(count: u32) -> Vec<(f64, f64)> {
    let number = |k: u32, a: u32| f64::from((a * k + 3) % 17) / 17.0;
    (0..count).map(|k| (1e5 * (0.1 + number(k, 7)), 6.0 * number(k, 11) - 3.0)).collect()
}

/// `Σ modulus cos(k α / 2 + phase)`, the first one the mean.
fn wave(orders: &[(f64, f64)], alpha: f64) -> f64 {
    let term = |(k, (modulus, phase)): (u32, &(f64, f64))| match k {
        0 => *modulus,
        _ => modulus * (f64::from(k) * alpha / 2.0 + phase).cos(),
    };
    (0..).zip(orders).map(term).sum()
}

fn listed(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(", ")
}

/// A table over one cycle from `first` (rad) in `count` steps, with or without the end.
fn table(orders: &[(f64, f64)], first: f64, count: u32, end: bool, column: &str) -> String {
    let angles: Vec<f64> = (0..count + u32::from(end))
        .map(|n| first + 2.0 * TAU * f64::from(n) / f64::from(count))
        .collect();
    let values: Vec<f64> = angles.iter().map(|angle| wave(orders, *angle)).collect();
    format!("{{ angle = [{}], {column} = [{}] }}", listed(&angles), listed(&values))
}

fn with_pressure(orders: &[(f64, f64)], first: f64, end: bool, others: &str) -> Driveline {
    let [bore, stroke, rod] = CRANK;
    line_of(&format!(
        "firing_order = [1, 3, 4, 2]\nbore = {bore}\nstroke = {stroke}\nrod_length = {rod}\n\
         pressure = {}\n{others}",
        table(orders, first, 720, end, "pressure")
    ))
}

fn near(found: &[CylinderOrder], expected: &[(f64, f64)], scale: f64) {
    assert!(found.len() >= expected.len());
    for (found, (modulus, phase)) in found.iter().zip(expected) {
        let expected = match found.order {
            0.0 => Complex::from(*modulus),
            _ => Complex::from_polar(*modulus, *phase),
        };
        let error = (found.value - expected).modulus();
        assert!(error <= 1e-12 * scale, "{found:?} {expected:?} {error:e}");
    }
}

// Source: the orders from which the table is made.
#[test]
fn a_table_made_from_orders_gives_them_back() {
    let orders = known(25);
    for (first, end) in [(0.0, false), (0.0, true), (-TAU, true), (-TAU, false), (0.3, true)] {
        let line = with_pressure(&orders, first, end, "");
        near(&cylinder_orders(&line.engines()[0]).pressure, &orders, 1e5);
    }
    let line = line_of(&format!("torque = {}\n", table(&orders, 0.0, 360, true, "torque")));
    near(&cylinder_orders(&line.engines()[0]).gas, &orders, 1e5);
    // Seven points more than twice the highest order are enough.
    let line = line_of(&format!("torque = {}\n", table(&orders, 0.0, 56, false, "torque")));
    near(&cylinder_orders(&line.engines()[0]).gas, &orders, 1e5);
}

/// Travel of the piston from the top, by the geometry of crank and rod.
fn travel(alpha: f64) -> f64 {
    let [_, stroke, rod] = CRANK;
    let radius = stroke / 2.0;
    let pin = radius * alpha.cos() + (rod * rod - (radius * alpha.sin()).powi(2)).sqrt();
    radius + rod - pin
}

// Source: virtual work, pressure times area times the travel's central difference (Richardson), and the
// trapezoidal rule with many points, which is exact for periodic functions.
#[test]
fn gas_torque_is_pressure_times_area_times_lever() {
    let orders = known(25);
    let line = with_pressure(&orders, 0.0, true, "crankcase_pressure = 3e4\n");
    let [bore, ..] = CRANK;
    let area = PI / 4.0 * bore * bore;
    let slope = |alpha: f64| {
        let difference = |h: f64| (travel(alpha + h) - travel(alpha - h)) / (2.0 * h);
        (4.0 * difference(1e-3) - difference(2e-3)) / 3.0
    };
    let count = 4000;
    let torque: Vec<(f64, f64)> = (0..count)
        .map(|n| 2.0 * TAU * f64::from(n) / f64::from(count))
        .map(|alpha| (alpha, (wave(&orders, alpha) - 3e4) * area * slope(alpha)))
        .collect();
    for found in cylinder_orders(&line.engines()[0]).gas {
        let term =
            |(alpha, torque): &(f64, f64)| Complex::from_polar(*torque, -found.order * alpha);
        let sum = torque.iter().map(term).fold(Complex::default(), |sum, term| sum + term);
        let share = if found.order == 0.0 { 1.0 } else { 2.0 } / f64::from(count);
        let error = (found.value - sum.scaled(share)).modulus();
        // The differences hold ten digits of torques of tens of N·m.
        assert!(error < 1e-7, "{found:?} {error:e}");
    }
}

// Source: the series of the oscillating torque in powers of λ = r / l (Ker Wilson, Practical Solution of
// Torsional Vibration Problems): m r² Ω² [λ/4 sin α - 1/2 sin 2α - 3λ/4 sin 3α - λ²/4 sin 4α ...].
#[test]
fn masses_have_the_orders_of_the_known_series() {
    let (radius, ratio, mass) = (0.045, 1e-3, 0.7);
    let line = line_of(&format!(
        "cylinders = 1\nbore = 0.08\nstroke = {}\nrod_length = {:?}\noscillating_mass = {mass}\n",
        2.0 * radius,
        radius / ratio
    ));
    let found = cylinder_orders(&line.engines()[0]).mass;
    let expected = [ratio / 4.0, -0.5, -0.75 * ratio, -ratio * ratio / 4.0];
    for (found, sine) in found.iter().zip(expected) {
        // sine · sin = Re[-i sine exp(i)].
        let error = found.value - Complex::new(0.0, -sine * mass * radius * radius);
        assert!(error.modulus() < 2e-9 * mass * radius * radius, "{found:?} {error:?}");
    }
}

// Source: the definition: every cylinder makes the same torque, later by its firing angle.
#[test]
fn cylinders_add_up_with_their_firing_angles() {
    let orders = known(25);
    let mass = "oscillating_mass = 0.6\n";
    let line = with_pressure(&orders, 0.0, true, mass);
    let engine = &line.engines()[0];
    let half = TAU / 2.0;
    let expected = [0.0, 3.0 * half, half, 2.0 * half];
    for (found, expected) in engine.firing_rad.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-15);
    }
    let one = cylinder_orders(engine);
    let equations = EquationsOfMotion::new(&line).expect("is sound");
    let speed: f64 = 150.0;
    for angle in [0.0, 0.4, 2.9, 7.7] {
        let of = |list: &[CylinderOrder], alpha: f64| -> f64 {
            list.iter()
                .map(|order| (order.value * Complex::from_polar(1.0, order.order * alpha)).re)
                .sum()
        };
        let direct: f64 = engine
            .firing_rad
            .iter()
            .map(|firing| {
                of(&one.gas, angle - firing) + speed * speed * of(&one.mass, angle - firing)
            })
            .sum();
        let sources = equations.excitation.sources.iter();
        let told: f64 = sources
            .map(|source| {
                let harmonics = source.harmonics.iter();
                let sum: f64 =
                    harmonics.map(|h| h.amplitude_nm * (h.order * angle + h.phase_rad).cos()).sum();
                source.mean + source.growth(speed) * sum
            })
            .sum();
        assert!((direct - told).abs() < 1e-9 * direct.abs().max(1.0), "{direct} {told}");
    }
    // Even firing leaves multiples of half the number of cylinders.
    let gas = &equations.excitation.sources[0].harmonics;
    assert!(gas.iter().all(|harmonic| harmonic.order % 2.0 == 0.0), "{gas:?}");
    assert_eq!(gas.len(), 6);
}
