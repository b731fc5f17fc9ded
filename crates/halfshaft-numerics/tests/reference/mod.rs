//! Reference problems for tests and benchmarks: equations, parameters, exact or published answers.

// Each test program uses only some of them.
#![allow(dead_code)]

use halfshaft_numerics::ode::{Linearised, System};

/// `x'' + c x' + k x + g x³ = P cos(W t)`; state `(x, x')`.
#[derive(Debug, Clone, Copy)]
pub struct Duffing {
    pub damping: f64,
    pub stiffness: f64,
    pub cubic: f64,
    pub force: f64,
    pub frequency: f64,
}

impl Duffing {
    /// `x'' + 679 x - 0.679 x³ + 0.0952 x' = 15 cos(26.1 t)`.
    pub const DRIVELINE: Self =
        Self { damping: 0.0952, stiffness: 679.0, cubic: -0.679, force: 15.0, frequency: 26.1 };
    /// Where [`Self::DRIVELINE`] starts.
    pub const DRIVELINE_START: [f64; 2] = [0.1, 0.0];
    /// [`Self::DRIVELINE`] after 200 forcing periods: Taylor series of 26 terms in arithmetic of 34
    /// digits (mpmath), state before rounding x = -2.056173482458339112434,
    /// x' = 31.13948284909108005279.
    pub const DRIVELINE_AFTER_200: [f64; 2] = [-2.056173482458339, 31.13948284909108];

    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.frequency
    }

    /// `x'²/2 + k x²/2 + g x⁴/4`, constant without damping and force.
    pub fn energy(&self, state: &[f64]) -> f64 {
        let square = state[0] * state[0];
        0.5 * (state[1] * state[1] + self.stiffness * square) + 0.25 * self.cubic * square * square
    }
}

impl System for Duffing {
    fn dimension(&self) -> usize {
        2
    }

    #[inline]
    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        let (x, v) = (state[0], state[1]);
        rate[0] = v;
        rate[1] = self.force * (self.frequency * t).cos()
            - self.damping * v
            - x * (self.stiffness + self.cubic * x * x);
    }
}

impl Linearised for Duffing {
    fn linearised(&mut self, _: f64, state: &[f64], direction: &[f64], out: &mut [f64]) {
        let tangent = self.stiffness + 3.0 * self.cubic * state[0] * state[0];
        out[0] = direction[1];
        out[1] = -tangent * direction[0] - self.damping * direction[1];
    }
}

/// The free, undamped Duffing oscillation from `x = amplitude` at rest, exactly:
/// `x = A cn(λ t, m)` with `λ² = k + g A²`, `m = g A² / (2 λ²)` (for `g > 0`).
///
/// Returns `(x, x')`. Source: Kovacic & Brennan (eds.), *The Duffing Equation* (2011), section 4.2.
pub fn free_duffing(stiffness: f64, cubic: f64, amplitude: f64, t: f64) -> [f64; 2] {
    let lambda = (stiffness + cubic * amplitude * amplitude).sqrt();
    let m = cubic * amplitude * amplitude / (2.0 * lambda * lambda);
    let (sn, cn, dn) = jacobi(lambda * t, m);
    [amplitude * cn, -amplitude * lambda * sn * dn]
}

/// Jacobi's elliptic functions `sn, cn, dn` of parameter `m` in [0, 1) by the descending
/// arithmetic-geometric mean (Abramowitz & Stegun, 16.4).
pub fn jacobi(u: f64, m: f64) -> (f64, f64, f64) {
    let (mut a, mut b, mut levels) = (1.0_f64, (1.0 - m).sqrt(), Vec::new());
    while (a - b).abs() > 1e-16 * a && levels.len() < 20 {
        levels.push((a, 0.5 * (a - b)));
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let mut phi = a * u * f64::from(2.0_f32).powi(levels.len() as i32);
    for k in (0..levels.len()).rev() {
        let (_, c) = levels[k];
        phi = 0.5 * (phi + (c / a * phi.sin()).asin());
        a = levels[k].0;
    }
    (phi.sin(), phi.cos(), (1.0 - m * phi.sin().powi(2)).sqrt())
}

/// The plane Kepler problem `r'' = -r / |r|³`; state `(x, y, x', y')`.
#[derive(Debug, Clone, Copy)]
pub struct Kepler;

impl Kepler {
    /// Start at the pericentre of an orbit of eccentricity 0.5, semi-axis 1, period 2π.
    pub const START: [f64; 4] = [0.5, 0.0, 0.0, 1.732_050_807_568_877_2];
}

impl System for Kepler {
    fn dimension(&self) -> usize {
        4
    }

    #[inline]
    fn derivative(&mut self, _: f64, state: &[f64], rate: &mut [f64]) {
        let square = state[0] * state[0] + state[1] * state[1];
        let pull = -1.0 / (square * square.sqrt());
        rate[0] = state[2];
        rate[1] = state[3];
        rate[2] = pull * state[0];
        rate[3] = pull * state[1];
    }
}

/// Inertias of 1 in a row, each shaft with stiffness 1000, cubic part -500, damping 0.5; the first
/// held to ground by stiffness 1000, damping 0.05 to ground on each, `5 cos(w t)` on the last.
/// State: angles, then speeds.
#[derive(Debug, Clone, Copy)]
pub struct Chain {
    pub inertias: usize,
    pub frequency: f64,
}

impl System for Chain {
    fn dimension(&self) -> usize {
        2 * self.inertias
    }

    #[inline]
    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        let n = self.inertias;
        let (angles, speeds) = state.split_at(n);
        let (angle_rates, torques) = rate.split_at_mut(n);
        angle_rates.copy_from_slice(speeds);
        for (torque, speed) in torques.iter_mut().zip(speeds) {
            *torque = -0.05 * speed;
        }
        torques[0] -= 1000.0 * angles[0];
        torques[n - 1] += 5.0 * (self.frequency * t).cos();
        for k in 1..n {
            let twist = angles[k] - angles[k - 1];
            let torque =
                twist * (1000.0 - 500.0 * twist * twist) + 0.5 * (speeds[k] - speeds[k - 1]);
            torques[k] -= torque;
            torques[k - 1] += torque;
        }
    }
}

/// Two inertias, the second a light absorber:
/// `x1'' + 0.002 x1' + x1 + x1³ + h = P cos W t`, `0.05 x2'' = h`,
/// `h = 0.0453 (x1 - x2) + 0.013 (x1' - x2') + 0.0042 (x1 - x2)³`; state `(x1, x2, x1', x2')`.
#[derive(Debug, Clone, Copy)]
pub struct Absorber {
    pub force: f64,
    pub frequency: f64,
}

impl System for Absorber {
    fn dimension(&self) -> usize {
        4
    }

    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        let (x, twist, slip) = (state[0], state[0] - state[1], state[2] - state[3]);
        let h = 0.0453 * twist + 0.013 * slip + 0.0042 * twist.powi(3);
        rate[0] = state[2];
        rate[1] = state[3];
        let drive = self.force * (self.frequency * t).cos();
        rate[2] = drive - 0.002 * state[2] - x * (1.0 + x * x) - h;
        rate[3] = h / 0.05;
    }
}

impl Linearised for Absorber {
    fn linearised(&mut self, _: f64, state: &[f64], direction: &[f64], out: &mut [f64]) {
        let (twist, d) = (state[0] - state[1], direction);
        let tangent = 0.0453 + 0.0126 * twist * twist;
        let h = tangent * (d[0] - d[1]) + 0.013 * (d[2] - d[3]);
        out[0] = d[2];
        out[1] = d[3];
        out[2] = -0.002 * d[2] - (1.0 + 3.0 * state[0] * state[0]) * d[0] - h;
        out[3] = h / 0.05;
    }
}

/// A reproducible stream of numbers in [-1, 1): SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
