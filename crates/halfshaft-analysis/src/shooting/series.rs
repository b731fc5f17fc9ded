//! Taylor series in time: cosines, laws of torque, friction, one power after the other.

use halfshaft_dynamics::laws::Piece;

/// Highest power of time that is kept.
pub(super) const DEGREE: usize = 20;

/// Coefficients by power of time.
pub(super) type Series = [f64; DEGREE + 1];

pub(super) const ZERO: Series = [0.0; DEGREE + 1];

/// Series of `cos(speed (t + τ) + phase)` and of the sine in `τ`.
pub(super) fn cosine_and_sine(speed: f64, t: f64, phase: f64) -> (Series, Series) {
    let (sin, cos) = (speed * t + phase).sin_cos();
    let (mut cosine, mut sine) = (ZERO, ZERO);
    (cosine[0], sine[0]) = (cos, sin);
    for power in 1..=DEGREE {
        let factor = speed / power as f64;
        cosine[power] = -factor * sine[power - 1];
        sine[power] = factor * cosine[power - 1];
    }
    (cosine, sine)
}

/// Value and slope at `t`.
pub(super) fn evaluate(series: &Series, t: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for c in series.iter().rev() {
        slope = slope * t + value;
        value = value * t + c;
    }
    (value, slope)
}

/// One polynomial piece of a law along a twist whose series grows power by power.
#[derive(Clone, Debug)]
pub(super) struct GrowingLaw {
    origin: f64,
    coefficients: Vec<f64>,
    /// The partial sums of Horner's rule, highest first.
    partial: Vec<Series>,
}

impl GrowingLaw {
    pub(super) fn new(piece: &Piece) -> Self {
        let coefficients = piece.torque.coefficients().to_vec();
        let partial = vec![ZERO; coefficients.len().saturating_sub(2)];
        Self { origin: piece.origin, coefficients, partial }
    }

    /// Coefficient `power` of the torque, when the twist is known to that power; powers come in order.
    pub(super) fn next(&mut self, twist: &Series, power: usize) -> f64 {
        let shifted = |k: usize| if k == 0 { twist[0] - self.origin } else { twist[k] };
        let constant = |at: usize| {
            if power == 0 { self.coefficients.get(at).copied().unwrap_or(0.0) } else { 0.0 }
        };
        let degree = self.coefficients.len().saturating_sub(1);
        if degree == 0 {
            return constant(0);
        }
        let highest = self.coefficients[degree];
        let mut value = highest * shifted(power) + constant(degree - 1);
        for at in (0..degree - 1).rev() {
            let partial = &mut self.partial[degree - 2 - at];
            partial[power] = value;
            value =
                constant(at) + (0..=power).map(|k| partial[k] * shifted(power - k)).sum::<f64>();
        }
        value
    }

    /// The tangent stiffness along the whole twist.
    pub(super) fn tangent(&self, twist: &Series) -> Series {
        let mut out = ZERO;
        let mut shifted = *twist;
        shifted[0] -= self.origin;
        let mut terms = self.coefficients.iter().enumerate().skip(1).rev();
        if let Some((power, k)) = terms.next() {
            out[0] = power as f64 * k;
        }
        for (power, k) in terms {
            out = product(&out, &shifted);
            out[0] += power as f64 * k;
        }
        out
    }
}

/// `tanh` of a rate of twist over the regularisation speed, power by power, with its derivative.
#[derive(Clone, Debug)]
pub(super) struct GrowingFriction {
    torque: f64,
    speed: f64,
    rate: Series,
    tanh: Series,
    /// `1 - tanh²`.
    slope: Series,
}

impl GrowingFriction {
    pub(super) fn new(torque: f64, speed: f64) -> Self {
        Self { torque, speed, rate: ZERO, tanh: ZERO, slope: ZERO }
    }

    /// Coefficient `power` of the torque, when the twist is known to one power more.
    pub(super) fn next(&mut self, twist: &Series, power: usize) -> f64 {
        let k = power;
        self.rate[k] = (k + 1) as f64 * twist[k + 1] / self.speed;
        if k == 0 {
            self.tanh[0] = self.rate[0].tanh();
        } else {
            // k tanh_k = Σ i w_i (1 - tanh²)_{k-i}.
            let sum: f64 = (1..=k).map(|i| i as f64 * self.rate[i] * self.slope[k - i]).sum();
            self.tanh[k] = sum / k as f64;
        }
        let square: f64 = (0..=k).map(|i| self.tanh[i] * self.tanh[k - i]).sum();
        self.slope[k] = if k == 0 { (1.0 - self.tanh[0]) * (1.0 + self.tanh[0]) } else { -square };
        self.torque * self.tanh[k]
    }

    /// The slope of the torque over the rate along the motion.
    pub(super) fn tangent(&self) -> Series {
        self.slope.map(|value| value * self.torque / self.speed)
    }
}

/// Product of two series.
pub(super) fn product(a: &Series, b: &Series) -> Series {
    let mut out = ZERO;
    for (i, factor) in a.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
        for (out, value) in out[i..].iter_mut().zip(b) {
            *out += factor * value;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use halfshaft_numerics::polynomial::Polynomial;

    use super::*;

    // Source: the functions themselves where the series has converged.
    #[test]
    fn series_are_the_functions() {
        let (t, dt, speed) = (0.4, 0.15, 1.7);
        let (twist, _) = cosine_and_sine(speed, t, 0.3);
        let x = |time: f64| (speed * time + 0.3).cos();
        let v = |time: f64| -speed * (speed * time + 0.3).sin();
        let coefficients = [0.5, 2.0, -1.0, 0.7, 0.0, 0.2];
        let piece = Piece {
            from: f64::NEG_INFINITY,
            to: f64::INFINITY,
            origin: -0.2,
            torque: Polynomial::new(coefficients),
        };
        let mut law = GrowingLaw::new(&piece);
        let mut torque = ZERO;
        let mut friction = GrowingFriction::new(1.5, 0.9);
        let mut dry = ZERO;
        for power in 0..DEGREE {
            torque[power] = law.next(&twist, power);
            dry[power] = friction.next(&twist, power);
        }
        let exact = piece.torque.evaluate_with_slope(x(t + dt) + 0.2);
        assert!((evaluate(&torque, dt).0 - exact.0).abs() < 1e-13);
        assert!((evaluate(&law.tangent(&twist), dt).0 - exact.1).abs() < 1e-12);
        let w = v(t + dt) / 0.9;
        assert!((evaluate(&dry, dt).0 - 1.5 * w.tanh()).abs() < 1e-9);
        let slope = 1.5 / 0.9 * (1.0 - w.tanh().powi(2));
        assert!((evaluate(&friction.tangent(), dt).0 - slope).abs() < 1e-8);
    }

    // Source: torques of degree 0 and 1 by hand.
    #[test]
    fn short_laws_are_lines() {
        let piece = |coefficients: &[f64]| Piece {
            from: 0.0,
            to: 1.0,
            origin: 1.0,
            torque: Polynomial::new(coefficients),
        };
        let mut twist = ZERO;
        twist[0] = 3.0;
        twist[1] = 5.0;
        let mut flat = GrowingLaw::new(&piece(&[2.0]));
        assert_eq!((flat.next(&twist, 0), flat.next(&twist, 1)), (2.0, 0.0));
        assert_eq!(flat.tangent(&twist)[0], 0.0);
        let mut line = GrowingLaw::new(&piece(&[2.0, 4.0]));
        assert_eq!((line.next(&twist, 0), line.next(&twist, 1)), (10.0, 20.0));
        assert_eq!(line.tangent(&twist)[0], 4.0);
    }
}
