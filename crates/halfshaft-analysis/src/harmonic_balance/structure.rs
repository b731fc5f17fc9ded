//! What the variational equation is written in: the angles of all groups, or a few modes.

use halfshaft_dynamics::EquationsOfMotion;

use super::panels::Tangent;

/// Powers of time of which the springs are one pass over the twists; what they do is written out for
/// four.
pub(super) const BLOCK: usize = 4;

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
    /// (connection, power) and `net` (a row for each coordinate) are stores. `FUSED` where the processor
    /// multiplies and adds in one.
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
    dampers::<W, FUSED>(tangent, &twist[power + 1], &twist[..=power], &mut torque);
    torque
}

/// What the spring of a connection does by the twists known up to the newest, which is the one after
/// those of `known`: at the power of time before that, and at those that follow. One pass for all of
/// them over the twists.
#[inline(always)]
pub(super) fn springs<const W: usize, const FUSED: bool>(
    tangent: &Tangent,
    newest: &[f64; W],
    known: &[[f64; W]],
) -> [[f64; W]; BLOCK] {
    let k = &tangent.stiffness;
    // Each sum has a name, so that all stay in registers; those of every other twist are apart, as a
    // sum waits for the one before.
    let mut now = [0.0; W];
    let mut first = times(k[0], newest);
    let mut second = times(k[1], newest);
    let mut third = times(k[2], newest);
    let [mut now_too, mut first_too, mut second_too, mut third_too] = [[0.0; W]; BLOCK];
    // Beyond the terms that count the stiffness is nothing.
    let terms = tangent.stiffness_terms.min(known.len());
    let mut factors = &tangent.stiffness[..terms + BLOCK - 1];
    let mut twists = &known[known.len() - terms..];
    while let ([a, b, c, d, e, ..], [rest @ .., y, x]) = (factors, twists) {
        axpy::<W, FUSED>(*a, x, &mut now);
        axpy::<W, FUSED>(*b, x, &mut first);
        axpy::<W, FUSED>(*c, x, &mut second);
        axpy::<W, FUSED>(*d, x, &mut third);
        axpy::<W, FUSED>(*b, y, &mut now_too);
        axpy::<W, FUSED>(*c, y, &mut first_too);
        axpy::<W, FUSED>(*d, y, &mut second_too);
        axpy::<W, FUSED>(*e, y, &mut third_too);
        (factors, twists) = (&factors[2..], rest);
    }
    if let ([a, b, c, d, ..], [x]) = (factors, twists) {
        axpy::<W, FUSED>(*a, x, &mut now);
        axpy::<W, FUSED>(*b, x, &mut first);
        axpy::<W, FUSED>(*c, x, &mut second);
        axpy::<W, FUSED>(*d, x, &mut third);
    }
    axpy::<W, FUSED>(1.0, &now_too, &mut now);
    axpy::<W, FUSED>(1.0, &first_too, &mut first);
    axpy::<W, FUSED>(1.0, &second_too, &mut second);
    axpy::<W, FUSED>(1.0, &third_too, &mut third);
    [now, first, second, third]
}

/// Adds what the damper of a connection does at the power of time of the last of the twists that are
/// `known` before the newest.
#[inline(always)]
pub(super) fn dampers<const W: usize, const FUSED: bool>(
    tangent: &Tangent,
    newest: &[f64; W],
    known: &[[f64; W]],
    torque: &mut [f64; W],
) {
    axpy::<W, FUSED>(known.len() as f64 * tangent.damping[0], newest, torque);
    if tangent.damping_terms > 1 {
        resistance::<W, FUSED>(tangent, known, torque);
    }
}

/// What the damper adds by the twists before the newest, power by power.
#[inline(always)]
fn resistance<const W: usize, const FUSED: bool>(
    tangent: &Tangent,
    known: &[[f64; W]],
    torque: &mut [f64; W],
) {
    let twists = known.iter().enumerate().skip(1).rev();
    for (c, (power, twist)) in tangent.damping[1..tangent.damping_terms].iter().zip(twists) {
        axpy::<W, FUSED>(c * power as f64, twist, torque);
    }
}

/// `y += factor x` in all lanes.
#[inline(always)]
pub(super) fn axpy<const W: usize, const FUSED: bool>(factor: f64, x: &[f64; W], y: &mut [f64; W]) {
    for lane in 0..W {
        y[lane] = sum::<FUSED>(factor, x[lane], y[lane]);
    }
}

/// `factor x` in all lanes. As below, a loop: the library's functions for arrays are not sure to be
/// compiled with the instructions at hand.
#[inline(always)]
pub(super) fn times<const W: usize>(factor: f64, x: &[f64; W]) -> [f64; W] {
    let mut out = [0.0; W];
    for lane in 0..W {
        out[lane] = factor * x[lane];
    }
    out
}

/// `factor x + y` in all lanes.
#[inline(always)]
pub(super) fn sums<const W: usize, const FUSED: bool>(
    factor: f64,
    x: &[f64; W],
    y: &[f64; W],
) -> [f64; W] {
    let mut out = *y;
    axpy::<W, FUSED>(factor, x, &mut out);
    out
}

/// `a b + c`.
#[inline(always)]
pub(super) fn sum<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    // Without the instruction `mul_add` is a slow call.
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}
