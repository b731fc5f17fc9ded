//! Critical speeds, how far they are from the operating range, and what they would do.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_results::CriticalSpeed;

use crate::modal::ElasticMode;
use crate::modal::damping_ratio;
use crate::modal::vibration::Vibration;

/// Where orders meet modes within a range of speeds, ascending by speed.
pub(super) fn speeds(
    vibration: &Vibration,
    modes: &[ElasticMode],
    pairs: &[[Complex; 2]],
    orders: &[f64],
    (from, to): (f64, f64),
    operating: Option<(f64, f64)>,
) -> Vec<CriticalSpeed> {
    let mut speeds = Vec::new();
    for (index, (mode, pair)) in modes.iter().zip(pairs).enumerate() {
        let frequency = mode.frequency();
        for order in orders.iter().filter(|_| frequency > 0.0) {
            let speed = frequency / order;
            if speed < from || speed > to {
                continue;
            }
            let worst = worst(vibration, mode, damping_ratio(*pair), *order, speed);
            speeds.push(CriticalSpeed {
                mode: index + 1,
                order: *order,
                speed,
                frequency,
                margin: operating.map(|range| margin(speed, range)),
                shaft: worst.as_ref().map(|(shaft, _)| shaft.clone()),
                torque: worst.map(|(_, torque)| torque).filter(|torque| torque.is_finite()),
            });
        }
    }
    speeds.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    speeds
}

/// Distance from a range over its nearer end, 0 inside.
fn margin(speed: f64, (from, to): (f64, f64)) -> f64 {
    if speed < from {
        (from - speed) / from
    } else if speed > to {
        (speed - to) / to
    } else {
        0.0
    }
}

/// The shaft that a mode loads most at resonance with an order, and the amplitude of its torque, N·m;
/// infinite without damping.
fn worst(
    vibration: &Vibration,
    mode: &ElasticMode,
    damping_ratio: f64,
    order: f64,
    speed: f64,
) -> Option<(String, f64)> {
    let equations = &vibration.equations;
    let force = modal_force(equations, mode, order, speed);
    if force == 0.0 {
        return None;
    }
    let omega = mode.eigenvalue.sqrt();
    let amplitude = force / (2.0 * damping_ratio * mode.eigenvalue);
    let connections = equations.connections.iter().zip(&vibration.state.twists).zip(&mode.twists);
    let torques = connections.map(|((connection, x), twist)| {
        let stiffness = connection.law.stiffness(*x);
        let damping = connection.damping_at(*x) * omega + connection.loss_factor * stiffness;
        (connection.name.clone(), stiffness.hypot(damping) * twist.abs() * amplitude)
    });
    torques.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// `|φᵀ T|` of the torques of an order.
fn modal_force(equations: &EquationsOfMotion, mode: &ElasticMode, order: f64, speed: f64) -> f64 {
    let torques = equations.excitation.harmonic(equations.groups(), order, speed);
    let largest: f64 = torques.iter().map(|(re, im)| re.hypot(*im)).sum();
    let sum = torques.iter().zip(&mode.shape).fold((0.0, 0.0), |(re, im), (torque, shape)| {
        (re + torque.0 * shape, im + torque.1 * shape)
    });
    let force = sum.0.hypot(sum.1);
    let scale = mode.shape.iter().fold(0.0_f64, |most, shape| most.max(shape.abs()));
    // A torque at a node of the mode does nothing but rounding.
    if force <= 1e-13 * largest * scale { 0.0 } else { force }
}
