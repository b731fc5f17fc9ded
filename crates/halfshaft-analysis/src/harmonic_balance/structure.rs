//! What the variational equation is written in: the angles of all groups, or a few modes.

use halfshaft_dynamics::EquationsOfMotion;

use super::panels::Tangent;

/// Coordinates of the variational equation, and its recurrence in them.
pub(super) trait Structure {
    /// Number of coordinates.
    fn coordinates(&self) -> usize;

    /// Order of the monodromy matrix.
    fn columns(&self) -> usize;

    /// Indices of the connections whose tangents the recurrence takes, in its order.
    fn connections(&self) -> &[usize];

    /// Tells `set` each column of the start, as column, power of time and coordinates: unit changes,
    /// rates measured by `speed`.
    fn start(&self, speed: f64, set: &mut dyn FnMut(usize, usize, &[f64]));

    /// All coefficients (power, coordinate) to power `degree` from those of powers 0 and 1. `twists`
    /// (connection, power) and `net` (a row for each coordinate, then for each connection) are stores. `FUSED` where the processor multiplies and adds in one.
    fn recur<const W: usize, const FUSED: bool>(
        &self,
        tangents: &[Tangent],
        degree: usize,
        coordinates: &mut [[f64; W]],
        twists: &mut [[f64; W]],
        net: &mut [[f64; W]],
    );

    /// Tells `set` the rows of the monodromy matrix of coordinates (power 0) or of their rates (1).
    fn finish(&self, power: usize, values: &[f64], set: &mut dyn FnMut(usize, f64));
}

/// Whether the speed of a free line as a whole is part of its response.
pub(super) fn with_speed(equations: &EquationsOfMotion) -> bool {
    equations.rigid.as_ref().is_some_and(|rigid| rigid.ground_damping > 0.0)
}

/// Coefficient of the torque of a connection at a power of time, from those of its twist.
#[inline(always)]
pub(super) fn torque<const W: usize, const FUSED: bool>(
    tangent: &Tangent,
    twist: &[[f64; W]],
    power: usize,
) -> [f64; W] {
    let mut torque = [0.0_f64; W];
    let terms = tangent.stiffness_terms.min(power + 1);
    for (k, x) in tangent.stiffness[..terms].iter().zip(twist[..=power].iter().rev()) {
        axpy::<W, FUSED>(*k, x, &mut torque);
    }
    dampers::<W, FUSED>(tangent, twist, power, &mut torque);
    torque
}

/// What the spring of a connection adds to its torque at a power of time, and at the next.
#[inline(always)]
pub(super) fn springs<const W: usize, const FUSED: bool>(
    tangent: &Tangent,
    twist: &[[f64; W]],
    power: usize,
) -> ([f64; W], [f64; W]) {
    let terms = tangent.stiffness_terms.min(power + 1);
    let mut now = [0.0_f64; W];
    let mut next = twist[power + 1].map(|x| tangent.stiffness[0] * x);
    let factors = tangent.stiffness[..=terms].windows(2);
    for (k, x) in factors.zip(twist[power + 1 - terms..=power].iter().rev()) {
        axpy::<W, FUSED>(k[0], x, &mut now);
        axpy::<W, FUSED>(k[1], x, &mut next);
    }
    (now, next)
}

/// Adds what the damper of a connection does at a power of time.
#[inline(always)]
pub(super) fn dampers<const W: usize, const FUSED: bool>(
    tangent: &Tangent,
    twist: &[[f64; W]],
    power: usize,
    torque: &mut [f64; W],
) {
    if tangent.damping_terms == 1 {
        axpy::<W, FUSED>(tangent.damping[0] * (power + 1) as f64, &twist[power + 1], torque);
        return;
    }
    let terms = tangent.damping_terms.min(power + 1);
    for (j, c) in tangent.damping[..terms].iter().enumerate() {
        if *c != 0.0 {
            axpy::<W, FUSED>(c * (power - j + 1) as f64, &twist[power - j + 1], torque);
        }
    }
}

/// `y += factor x` in all lanes.
#[inline(always)]
pub(super) fn axpy<const W: usize, const FUSED: bool>(factor: f64, x: &[f64; W], y: &mut [f64; W]) {
    for lane in 0..W {
        y[lane] = sum::<FUSED>(factor, x[lane], y[lane]);
    }
}

/// `factor x + y` in all lanes.
#[inline(always)]
pub(super) fn sums<const W: usize, const FUSED: bool>(
    factor: f64,
    x: &[f64; W],
    y: &[f64; W],
) -> [f64; W] {
    std::array::from_fn(|lane| sum::<FUSED>(factor, x[lane], y[lane]))
}

/// `a b + c`.
#[inline(always)]
pub(super) fn sum<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    // Without the instruction `mul_add` is a slow call.
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}
