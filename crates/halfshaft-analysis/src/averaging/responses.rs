//! The slow flow of one mode: all responses, their stability, all folds.
//!
//! With `z = ρ²`, `S = σ - g(z)`, the backbone `g(z) = κ z + κ2 z² + κ3 z³` and `F = f/(2 ω1)`:
//!
//! - response (45): `z [β²/4 + S²] = F²`;
//! - stability (theory 5): `a1 = β > 0` and `a2 = β²/4 + S (S - 2 z g'(z)) > 0`;
//! - fold: `a2 = 0` on the response, hence `S = F²/(2 z² g')` and
//!   `β² z² G² - 4 F² z G² + F⁴ = 0` with `G = z g'(z)`.

use halfshaft_numerics::polynomial::Polynomial;

/// Coefficients of the slow flow of one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SlowFlow {
    /// Damping coefficient `β`, 1/s.
    pub(crate) beta: f64,
    /// `F = f / (2 ω1)`, rad/s.
    pub(crate) drive: f64,
    /// `κ`, `κ2`, `κ3` of the backbone `σ = κ z + κ2 z² + κ3 z³`.
    pub(crate) backbone: [f64; 3],
}

/// A response at some detuning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Response {
    /// Detuning from the natural frequency, rad/s.
    pub(crate) sigma: f64,
    /// Square of the amplitude, rad².
    pub(crate) z: f64,
    /// `σ - g(z)`: below zero before the backbone, above zero beyond it.
    pub(crate) beyond: f64,
}

impl Response {
    /// Amplitude, rad.
    pub(crate) fn rho(&self) -> f64 {
        self.z.sqrt()
    }
}

impl SlowFlow {
    /// Backbone `g(z)`.
    pub(crate) fn bend(&self, z: f64) -> f64 {
        let [k1, k2, k3] = self.backbone;
        z * (k1 + z * (k2 + z * k3))
    }

    /// `g'(z)`.
    pub(crate) fn bend_slope(&self, z: f64) -> f64 {
        let [k1, k2, k3] = self.backbone;
        k1 + z * (2.0 * k2 + z * 3.0 * k3)
    }

    /// Largest `z` that is reached, at the peak; infinite without damping.
    pub(crate) fn largest_z(&self) -> f64 {
        (2.0 * self.drive / self.beta).powi(2)
    }

    /// Terms of the backbone that differ from zero.
    fn terms(&self) -> usize {
        self.backbone.iter().rposition(|k| *k != 0.0).map_or(0, |last| last + 1)
    }

    /// All responses at a detuning, by ascending amplitude.
    pub(crate) fn responses(&self, sigma: f64) -> Vec<Response> {
        // z [β²/4 + (σ - g)²] - F² as a polynomial of z.
        let mut bracket = [0.0; 7];
        let difference = [sigma, -self.backbone[0], -self.backbone[1], -self.backbone[2]];
        let terms = self.terms();
        for (i, a) in difference[..=terms].iter().enumerate() {
            for (j, b) in difference[..=terms].iter().enumerate() {
                bracket[i + j] += a * b;
            }
        }
        bracket[0] += self.beta * self.beta / 4.0;
        let mut coefficients = [0.0; 8];
        coefficients[0] = -self.drive * self.drive;
        coefficients[1..].copy_from_slice(&bracket);
        let roots = Polynomial::new(&coefficients[..2 * terms + 2]).real_roots();
        let positive = roots.into_iter().map(|root| root.value).filter(|z| *z > 0.0);
        positive.map(|z| Response { sigma, z, beyond: sigma - self.bend(z) }).collect()
    }

    /// `a2` of the Routh-Hurwitz conditions: positive where the response is no saddle.
    pub(crate) fn a2(&self, response: &Response) -> f64 {
        let Response { z, beyond, .. } = *response;
        self.beta * self.beta / 4.0 + beyond * (beyond - 2.0 * z * self.bend_slope(z))
    }

    /// Whether small departures from the response die out.
    pub(crate) fn is_stable(&self, response: &Response) -> bool {
        self.beta > 0.0 && self.a2(response) > 0.0
    }

    /// The response at `z` on one side of the backbone; `None` beyond the peak.
    pub(crate) fn at(&self, z: f64, after_backbone: bool) -> Option<Response> {
        let square = self.drive * self.drive / z - self.beta * self.beta / 4.0;
        if !(z > 0.0 && square >= 0.0) {
            return None;
        }
        let beyond = if after_backbone { square.sqrt() } else { -square.sqrt() };
        Some(Response { sigma: self.bend(z) + beyond, z, beyond })
    }

    /// The largest response, on the backbone; `None` without damping.
    pub(crate) fn peak(&self) -> Option<Response> {
        let z = self.largest_z();
        z.is_finite().then(|| Response { sigma: self.bend(z), z, beyond: 0.0 })
    }

    /// Coefficients in `z` of `h = β² z² G² - 4 F² z G² + F⁴`, whose positive roots are the folds.
    pub(crate) fn fold_polynomial(&self) -> Polynomial {
        let [k1, k2, k3] = self.backbone;
        let slope = [k1, 2.0 * k2, 3.0 * k3];
        let mut square = [0.0; 5];
        for (i, a) in slope.iter().enumerate() {
            for (j, b) in slope.iter().enumerate() {
                square[i + j] += a * b;
            }
        }
        let f2 = self.drive * self.drive;
        let mut h = [0.0; 9];
        h[0] = f2 * f2;
        // G² = z² g'², so z² G² begins at z⁴ and z G² at z³.
        for (power, k) in square.iter().enumerate() {
            h[power + 4] += self.beta * self.beta * k;
            h[power + 3] -= 4.0 * f2 * k;
        }
        Polynomial::new(h)
    }

    /// The fold at a root `z` of the fold polynomial.
    pub(crate) fn fold_at(&self, z: f64) -> Response {
        let beyond = self.drive * self.drive / (2.0 * z * z * self.bend_slope(z));
        Response { sigma: self.bend(z) + beyond, z, beyond }
    }

    /// All folds, by ascending amplitude.
    pub(crate) fn folds(&self) -> Vec<Response> {
        if self.drive == 0.0 || self.terms() == 0 {
            return Vec::new();
        }
        let roots = self.fold_polynomial().real_roots();
        let positive = roots.into_iter().map(|root| root.value).filter(|z| *z > 0.0);
        positive.map(|z| self.fold_at(z)).collect()
    }

    /// Smallest drive `F` at which the response folds, with the `z` of that cusp.
    pub(crate) fn threshold(&self) -> Option<(f64, f64)> {
        threshold(self.beta, self.backbone)
    }
}

/// Smallest drive at which folds exist, and `z` at that cusp.
///
/// For `g = κ z` (theory 5, with `κ = 3 α/(8 ω1)`): `z = β/(√3 |κ|)`, `F² = β³/(3 √3 |κ|)`.
/// Otherwise folds at `z` need `|G| ≥ β/2` and have `F² = 2 z S G` with
/// `|S| = |G| - sqrt(G² - β²/4)` at the lower of the two; the cusp is the least `F²`.
fn threshold(beta: f64, backbone: [f64; 3]) -> Option<(f64, f64)> {
    let [k1, k2, k3] = backbone;
    if beta <= 0.0 {
        // Nothing holds the peak back: any drive bends the response over.
        return (backbone != [0.0; 3]).then_some((0.0, 0.0));
    }
    if k2 == 0.0 && k3 == 0.0 {
        if k1 == 0.0 {
            return None;
        }
        let z = beta / (3.0_f64.sqrt() * k1.abs());
        let drive = (beta.powi(3) / (3.0 * 3.0_f64.sqrt() * k1.abs())).sqrt();
        return Some((drive, z));
    }
    scanned_threshold(beta, backbone)
}

/// The threshold of a backbone of several terms: least `F²` over a fine geometric scan of `z`,
/// refined by golden section.
fn scanned_threshold(beta: f64, backbone: [f64; 3]) -> Option<(f64, f64)> {
    let flow = SlowFlow { beta, drive: 1.0, backbone };
    let drive_squared = |z: f64| {
        let g = (z * flow.bend_slope(z)).abs();
        let excess = g * g - beta * beta / 4.0;
        if excess < 0.0 {
            return f64::INFINITY;
        }
        // The smaller S, written without cancellation.
        2.0 * z * g * (beta * beta / 4.0) / (g + excess.sqrt())
    };
    let scale = backbone
        .iter()
        .zip(1..)
        .filter(|(k, _)| **k != 0.0)
        .map(|(k, power)| (beta / k.abs()).powf(1.0 / f64::from(power)))
        .fold(f64::INFINITY, f64::min);
    let grid: Vec<f64> =
        (0..400).map(|i| scale * 10.0_f64.powf(f64::from(i) / 100.0 - 2.0)).collect();
    let best =
        grid.iter().copied().min_by(|a, b| drive_squared(*a).total_cmp(&drive_squared(*b)))?;
    if !drive_squared(best).is_finite() {
        return None;
    }
    let (mut low, mut high) = (best / 1.03, best * 1.03);
    for _ in 0..100 {
        let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if drive_squared(a) < drive_squared(b) { high = b } else { low = a }
    }
    let z = f64::midpoint(low, high);
    Some((drive_squared(z).sqrt(), z))
}
