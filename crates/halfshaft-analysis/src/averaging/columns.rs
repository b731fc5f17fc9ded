//! Channels of the line along a response curve.
//!
//! To the order of averaging the motion is `x = ρ cos(ω t - η)` plus a shift of its mean, so every
//! twist, angle and speed has one harmonic and its amplitude is half of peak to peak. The torque
//! of a shaft has the describing function of its law beside its damper.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::PolynomialLaw;
use halfshaft_numerics::polynomial::Polynomial;
use halfshaft_results::{Column, Named};

use super::mode_equation::ModeEquation;
use super::responses::Response;

/// Amplitude, mean and first harmonic of one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ChannelValue {
    mean: f64,
    harmonic: f64,
}

/// A channel as a function of the response.
struct ChannelMap {
    name: String,
    unit: &'static str,
    kind: ChannelKind,
}

enum ChannelKind {
    /// Proportional to `x`, with a mean: factor and mean at rest and mean per unit of shift.
    Motion { factor: f64, rest: f64 },
    /// Proportional to `x'`, without a mean.
    Rate { factor: f64 },
    /// Torque of a shaft: law about rest, twist per x, damping.
    Torque { about: Polynomial, factor: f64, damping: f64 },
}

/// All channels of a line for one mode.
pub(crate) struct ChannelMaps {
    maps: Vec<ChannelMap>,
}

impl ChannelMaps {
    /// The channels of a line moving in one mode.
    pub(crate) fn new(equations: &EquationsOfMotion, mode: &ModeEquation) -> Self {
        let mut maps = Vec::new();
        for (index, connection) in equations.connections.iter().enumerate() {
            let (factor, rest) = (mode.twist_per_x[index], mode.rest_twists[index]);
            let mut add = |word: &str, unit, kind| {
                maps.push(ChannelMap { name: format!("{}.{word}", connection.name), unit, kind });
            };
            // A mode is only made of polynomial laws.
            let law = connection.law.polynomial();
            let law = law.map_or(Polynomial::new([]), PolynomialLaw::polynomial);
            let about = law.shifted(rest);
            let damping = connection.damping;
            add("twist", "rad", ChannelKind::Motion { factor, rest });
            add("twist_rate", "rad/s", ChannelKind::Rate { factor });
            add("torque", "N·m", ChannelKind::Torque { about, factor, damping });
        }
        for node in &equations.nodes {
            let factor = node.ratio * mode.group_per_x[node.group];
            let mut add = |word: &str, unit, kind| {
                maps.push(ChannelMap { name: format!("{}.{word}", node.name), unit, kind });
            };
            add("angle", "rad", ChannelKind::Motion { factor, rest: 0.0 });
            add("speed", "rad/s", ChannelKind::Rate { factor });
        }
        Self { maps }
    }

    /// Columns of a list of responses: `frequency`, the channels, stability, `sigma`, `rho`,
    /// `phase`.
    pub(crate) fn columns(&self, mode: &ModeEquation, responses: &[Response]) -> Vec<Column> {
        let flow = mode.slow_flow();
        let of =
            |value: &dyn Fn(&Response) -> f64| responses.iter().map(value).collect::<Vec<f64>>();
        let mut columns = vec![Column::new("frequency", "rad/s", of(&|r| mode.frequency(r.sigma)))];
        for map in &self.maps {
            let values: Vec<ChannelValue> = responses.iter().map(|r| map.value(mode, r)).collect();
            let harmonic: Vec<f64> = values.iter().map(|value| value.harmonic).collect();
            let mean = values.iter().map(|value| value.mean).collect();
            let mut add = |word: &str, values| {
                columns.push(Column::new(format!("{}.{word}", map.name), map.unit, values));
            };
            add("amplitude", harmonic.clone());
            add("mean", mean);
            add("harmonic1", harmonic);
        }
        let stable = of(&|r| f64::from(u8::from(flow.is_stable(r))));
        let unstable = of(&|r| f64::from(u8::from(flow.a2(r) < 0.0)));
        columns.push(Column::new("stable", "1", stable));
        columns.push(Column::new("unstable_dimension", "1", unstable));
        columns.push(Column::new("sigma", "rad/s", of(&|r| r.sigma)));
        columns.push(Column::new("rho", "rad", of(&Response::rho)));
        columns.push(Column::new("phase", "rad", of(&|r| phase_lag(mode, r))));
        columns
    }

    /// The same for one response, by column name.
    pub(crate) fn values(&self, mode: &ModeEquation, response: &Response) -> Named<f64> {
        let columns = self.columns(mode, std::slice::from_ref(response));
        columns.into_iter().map(|column| (column.name, column.values[0])).collect()
    }

    /// First harmonics of all channels for one response, by name.
    pub(crate) fn harmonics(&self, mode: &ModeEquation, response: &Response) -> Named<f64> {
        let of = |map: &ChannelMap| {
            (format!("{}.harmonic1", map.name), map.value(mode, response).harmonic)
        };
        self.maps.iter().map(of).collect()
    }

    /// First harmonics of all channels for one response, in the order of their names.
    pub(crate) fn harmonic_values<'m>(
        &'m self,
        mode: &'m ModeEquation,
        response: &'m Response,
    ) -> impl Iterator<Item = f64> + 'm {
        self.maps.iter().map(move |map| map.value(mode, response).harmonic)
    }

    /// Names and units of the first harmonics.
    pub(crate) fn harmonic_names(&self) -> impl Iterator<Item = (String, &'static str)> + '_ {
        self.maps.iter().map(|map| (format!("{}.harmonic1", map.name), map.unit))
    }
}

impl ChannelMap {
    fn value(&self, mode: &ModeEquation, response: &Response) -> ChannelValue {
        let rho = response.rho();
        let speed = mode.omega + response.sigma;
        let shift = mode.mean_shift(response.z);
        match &self.kind {
            ChannelKind::Motion { factor, rest } => {
                ChannelValue { mean: rest + factor * shift, harmonic: (factor * rho).abs() }
            }
            ChannelKind::Rate { factor } => {
                ChannelValue { mean: 0.0, harmonic: (factor * rho * speed).abs() }
            }
            ChannelKind::Torque { about, factor, damping } => {
                let (mean, spring) = describing(about, factor * shift, factor * rho);
                let damper = damping * factor * rho * speed;
                ChannelValue { mean, harmonic: spring.hypot(damper) }
            }
        }
    }
}

/// Mean and first harmonic of a polynomial of `shift + amplitude cos`.
fn describing(law: &Polynomial, shift: f64, amplitude: f64) -> (f64, f64) {
    let about = law.shifted(shift);
    let (mut mean, mut harmonic) = (0.0, 0.0);
    // The mean of cos^n for even n is the product 1/2 · 3/4 ...; the first harmonic of
    // cos^n for odd n is twice the mean of cos^(n+1).
    let mut even_mean = 1.0;
    let mut power = 1.0;
    for (n, k) in about.coefficients().iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "powers up to seven")]
        if n % 2 == 0 {
            mean += k * power * even_mean;
        } else {
            even_mean *= n as f64 / (n + 1) as f64;
            harmonic += k * power * 2.0 * even_mean;
        }
        power *= amplitude;
    }
    (mean, harmonic)
}

/// Lag `η` of the response behind the excitation, from 0 to π.
pub(crate) fn phase_lag(mode: &ModeEquation, response: &Response) -> f64 {
    // (43), (44) at rest: f sin η = β ω1 ρ, f cos η = -2 ω1 ρ S.
    (mode.beta).atan2(-2.0 * response.beyond)
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: Fourier coefficients by the rectangle rule, exact for trigonometric polynomials.
    #[test]
    fn the_describing_function_is_the_first_fourier_coefficient() {
        let law = Polynomial::new([3.0, 2.0, -1.5, 0.7, 0.2, -0.4, 0.0, 0.3]);
        let (shift, amplitude) = (0.3, 0.9);
        let (mean, harmonic) = describing(&law, shift, amplitude);
        let n = 64;
        let angle = |k: i32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
        let value = |k: i32| law.evaluate(shift + amplitude * angle(k).cos()) / f64::from(n);
        let exact_mean: f64 = (0..n).map(value).sum();
        let exact: f64 = (0..n).map(|k| 2.0 * value(k) * angle(k).cos()).sum();
        assert!((mean - exact_mean).abs() < 1e-14, "{mean} {exact_mean}");
        assert!((harmonic - exact).abs() < 1e-14, "{harmonic} {exact}");
    }
}
