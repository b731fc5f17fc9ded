//! Torque orders of a piston engine.
//!
//! What the gas does is a product: the pressure over the crank angle, given by points over one working
//! cycle, times the lever of the crank gear. The pressure is the trigonometric polynomial through its
//! points, the lever a sine series that falls off as powers of the rod ratio, and the Fourier
//! coefficients of the product are their convolution: exact orders, without a sampling of the product.

use std::f64::consts::{PI, TAU};

use halfshaft_model::elements::{CrankGear, CrankTable, Engine, Harmonic, MOST_HIGHEST_ORDER};
use halfshaft_numerics::Complex;

/// Orders of the lever that are kept: `(r / 2 l)^32` is below rounding for rods of 1.2 crank radii.
const LEVER_ORDERS: usize = 64;
/// Points of the crank gear over a revolution.
const LEVER_POINTS: usize = 1024;

/// One order of one cylinder: `modulus · cos(order · α + phase)` over its crank angle `α`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderOrder {
    /// Cycles per revolution; 0 for the mean.
    pub order: f64,
    /// Modulus and argument.
    pub value: Complex,
}

/// The orders of one cylinder over its own crank angle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CylinderOrders {
    /// Gas pressure, Pa; empty where torques are given.
    pub pressure: Vec<CylinderOrder>,
    /// Torque that does not depend on the speed, N·m.
    pub gas: Vec<CylinderOrder>,
    /// Torque of the oscillating mass at Ω = 1 rad/s, N·m: it grows with Ω².
    pub mass: Vec<CylinderOrder>,
}

/// First and second derivative of the piston's travel by the crank angle, m.
fn travel(crank: &CrankGear, angle: f64) -> (f64, f64) {
    let (radius, rod) = (crank.stroke_m / 2.0, crank.rod_length_m);
    let (sin, cos) = angle.sin_cos();
    let slant = (rod * rod - radius * radius * sin * sin).sqrt();
    let first = radius * sin * (1.0 + radius * cos / slant);
    let second = radius * cos
        + radius * radius * (cos * cos - sin * sin) / slant
        + radius.powi(4) * sin * sin * cos * cos / slant.powi(3);
    (first, second)
}

/// Fourier coefficients `c_k = 1/N Σ f_n exp(-i k (first + 2π n / N))`, `k` from 0, of values over one
/// period that begins at phase `first`; zero where the points cannot tell them.
fn coefficients(values: &[f64], first: f64, most: usize) -> Vec<Complex> {
    let count = values.len();
    #[expect(clippy::cast_precision_loss, reason = "counts of points")]
    let part = |n: usize| n as f64 / count as f64;
    let turns: Vec<Complex> =
        (0..count).map(|n| Complex::from_polar(1.0, -TAU * part(n))).collect();
    let coefficient = |k: usize| {
        if 2 * k > count {
            return Complex::default();
        }
        let terms =
            values.iter().enumerate().map(|(n, value)| turns[(k * n) % count].scaled(*value));
        let sum = terms.fold(Complex::default(), |sum, term| sum + term);
        #[expect(clippy::cast_precision_loss, reason = "counts of points")]
        let (start, count_real) = (Complex::from_polar(1.0, -(k as f64) * first), count as f64);
        // The highest one that the points tell stands for both signs.
        let share = if 2 * k == count { 0.5 } else { 1.0 };
        (sum * start).scaled(share / count_real)
    };
    (0..=most).map(coefficient).collect()
}

/// Coefficients 0, 1, 2, ... of a table over its working cycle.
fn cycle_coefficients(table: &CrankTable, revolutions: f64, most: usize) -> Vec<Complex> {
    let Ok((first, values)) = table.cycle(revolutions) else {
        return Vec::new(); // validation tells it
    };
    coefficients(values, first / revolutions, most)
}

/// Coefficients of `f` over a revolution.
fn revolution_coefficients(f: impl Fn(f64) -> f64, most: usize) -> Vec<Complex> {
    #[expect(clippy::cast_precision_loss, reason = "a count")]
    let angle = |n: usize| TAU * n as f64 / LEVER_POINTS as f64;
    let values: Vec<f64> = (0..LEVER_POINTS).map(|n| f(angle(n))).collect();
    coefficients(&values, 0.0, most)
}

/// The coefficient of any sign of a real function.
fn at(coefficients: &[Complex], k: isize) -> Complex {
    let value = coefficients.get(k.unsigned_abs()).copied().unwrap_or_default();
    if k < 0 { value.conjugate() } else { value }
}

/// Orders of one cylinder of an engine.
pub fn cylinder_orders(engine: &Engine) -> CylinderOrders {
    let revolutions = engine.revolutions();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "rounded down")]
    let most = (highest_order(engine) * revolutions + 1e-9).floor() as usize;
    let listed = |coefficients: &[Complex]| -> Vec<CylinderOrder> {
        let order = |(k, value): (usize, &Complex)| {
            #[expect(clippy::cast_precision_loss, reason = "a few dozen orders")]
            let order = k as f64 / revolutions;
            // Both signs of a real function together, the mean as it is.
            CylinderOrder { order, value: if k == 0 { *value } else { value.scaled(2.0) } }
        };
        coefficients.iter().take(most + 1).enumerate().map(order).collect()
    };
    let mut orders = CylinderOrders::default();
    if let Some(torque) = &engine.torque {
        orders.gas = listed(&cycle_coefficients(torque, revolutions, most));
    }
    let Some(crank) = &engine.crank else { return orders };
    if let Some(pressure) = &engine.pressure {
        let step = if revolutions == 2.0 { 2 } else { 1 };
        let mut gas = cycle_coefficients(pressure, revolutions, most + step * LEVER_ORDERS);
        orders.pressure = listed(&gas);
        if let Some(mean) = gas.first_mut() {
            mean.re -= engine.crankcase_pressure_pa;
        }
        orders.gas = listed(&gas_torque(&gas, crank, most, step));
    }
    if crank.oscillating_mass_kg > 0.0 {
        orders.mass = mass_torque(crank, highest_order(engine));
    }
    orders
}

/// The highest order, within what can be taken: a sweep may have set it.
fn highest_order(engine: &Engine) -> f64 {
    engine.highest_order.min(MOST_HIGHEST_ORDER)
}

/// Coefficients of pressure times area times lever: `T_k = A Σ_m x'_m p_(k - step m)`.
fn gas_torque(pressure: &[Complex], crank: &CrankGear, most: usize, step: usize) -> Vec<Complex> {
    let area = PI / 4.0 * crank.bore_m * crank.bore_m;
    let lever = revolution_coefficients(|angle| travel(crank, angle).0, LEVER_ORDERS);
    let (reach, step) = (LEVER_ORDERS.cast_signed(), step.cast_signed());
    (0..=most)
        .map(|k| {
            let k = k.cast_signed();
            let terms = (-reach..=reach).map(|m| at(&lever, m) * at(pressure, k - step * m));
            terms.fold(Complex::default(), |sum, term| sum + term).scaled(area)
        })
        .collect()
}

/// `-m x' x''` in whole orders.
fn mass_torque(crank: &CrankGear, highest: f64) -> Vec<CylinderOrder> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
    let most = highest.min(LEVER_POINTS as f64 / 4.0).floor() as usize;
    let torque = |angle| {
        let (first, second) = travel(crank, angle);
        -crank.oscillating_mass_kg * first * second
    };
    let coefficients = revolution_coefficients(torque, most);
    #[expect(clippy::cast_precision_loss, reason = "a few dozen orders")]
    let order =
        |(k, value): (usize, &Complex)| CylinderOrder { order: k as f64, value: value.scaled(2.0) };
    coefficients.iter().enumerate().skip(1).map(order).collect()
}

/// Speed at which torques of oscillating masses are told, rad/s: 1000 rpm.
pub const REFERENCE_SPEED: f64 = 1000.0 * PI / 30.0;

/// A torque of an engine on one node.
pub(crate) struct EngineTorque {
    pub(crate) name: String,
    pub(crate) node: String,
    pub(crate) mean: f64,
    pub(crate) harmonics: Vec<Harmonic>,
    /// Whether it grows with the square of the speed; then it is told at [`REFERENCE_SPEED`].
    pub(crate) grows: bool,
}

/// The torques of an engine: for each node what its cylinders do together, that of the gas and that
/// of the masses.
pub(crate) fn torques(engine: &Engine) -> Vec<EngineTorque> {
    let orders = cylinder_orders(engine);
    let mut nodes: Vec<&str> = Vec::new();
    for cylinder in 0..engine.firing_rad.len() {
        if !nodes.contains(&engine.node(cylinder)) {
            nodes.push(engine.node(cylinder));
        }
    }
    let mut torques = Vec::new();
    for node in nodes {
        let firing: Vec<f64> = (0..engine.firing_rad.len())
            .filter(|cylinder| engine.node(*cylinder) == node)
            .map(|cylinder| engine.firing_rad[cylinder])
            .collect();
        for (list, what, grows) in [(&orders.gas, "gas", false), (&orders.mass, "masses", true)] {
            if list.is_empty() {
                continue;
            }
            let (mean, mut harmonics) = together(list, &firing);
            let growth = if grows { REFERENCE_SPEED.powi(2) } else { 1.0 };
            harmonics.iter_mut().for_each(|harmonic| harmonic.amplitude_nm *= growth);
            let name = format!("{}: {what} on {node}", engine.name);
            torques.push(EngineTorque { name, node: node.to_owned(), mean, harmonics, grows });
        }
    }
    torques
}

/// Share of the largest single order below which a sum over cylinders has cancelled.
const CANCELLED: f64 = 1e-13;

/// The orders of several cylinders with their firing angles, and the mean.
fn together(orders: &[CylinderOrder], firing: &[f64]) -> (f64, Vec<Harmonic>) {
    let largest = orders.iter().map(|order| order.value.modulus()).fold(0.0, f64::max);
    let mut mean = 0.0;
    let mut harmonics = Vec::new();
    for CylinderOrder { order, value } in orders {
        let late = |angle: &f64| Complex::from_polar(1.0, -order * angle);
        let sum = firing.iter().map(late).fold(Complex::default(), |sum, term| sum + term) * *value;
        if *order == 0.0 {
            mean = sum.re;
        } else if sum.modulus() > CANCELLED * largest {
            let (amplitude_nm, phase_rad) = (sum.modulus(), sum.argument());
            harmonics.push(Harmonic { order: *order, amplitude_nm, phase_rad });
        }
    }
    (mean, harmonics)
}
