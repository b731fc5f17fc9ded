//! What other methods start from: all one-harmonic responses at a frequency.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;

use super::channels::{group_amplitudes, mean_angles};
use super::problem::Problem;
use super::responses::Finder;
use crate::error::AnalysisError;

/// A response of one harmonic: `q(t) = means + Re(amplitudes · e^(i order Ω t))`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FirstHarmonicResponse {
    /// Index of the nonlinear connection.
    pub(crate) connection: usize,
    /// Complex amplitude of its twist, rad.
    pub(crate) twist: Complex,
    /// Its mean twist, rad.
    pub(crate) mean: f64,
    /// Complex amplitude of each group's angle, rad.
    pub(crate) groups: Vec<Complex>,
    /// Mean angle of each group, rad; a free line is turned so that its mass-weighted mean is zero.
    pub(crate) mean_angles: Vec<f64>,
    /// Whether the response is stable as far as one harmonic can tell.
    pub(crate) stable: bool,
}

/// All responses of a line with one nonlinear connection at excitation speed `frequency` (rad/s)
/// under its torques of order `order`, by ascending amplitude. All other orders are left out.
///
/// # Errors
/// [`AnalysisError::MethodDoesNotFit`] for a line with several nonlinear connections.
pub(crate) fn responses_at(
    equations: &EquationsOfMotion,
    frequency: f64,
    order: f64,
) -> Result<Vec<FirstHarmonicResponse>, AnalysisError> {
    let seeder = Seeder::new(equations, order)?;
    Ok(seeder.at(frequency))
}

/// The same for many frequencies of one line: what does not depend on the frequency is worked out
/// once.
pub(crate) struct Seeder {
    problem: Problem,
    finder: Finder,
}

impl Seeder {
    /// For a line and an order.
    ///
    /// # Errors
    /// See [`responses_at`].
    pub(crate) fn new(equations: &EquationsOfMotion, order: f64) -> Result<Self, AnalysisError> {
        let problem = Problem::new(equations.clone(), order)?;
        let finder = Finder::new(&problem);
        Ok(Self { problem, finder })
    }

    /// All responses at an excitation speed, rad/s.
    pub(crate) fn at(&self, frequency: f64) -> Vec<FirstHarmonicResponse> {
        let found = self.finder.all(&self.problem, self.problem.order * frequency);
        let told = found.list.iter().map(|response| FirstHarmonicResponse {
            connection: self.problem.shaft,
            twist: response.twist,
            mean: response.at.mean,
            groups: group_amplitudes(&self.problem, response),
            mean_angles: mean_angles(&self.problem, response),
            stable: response.is_stable(),
        });
        told.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfshaft_model::{Source, read_model};

    const LINE: &str = r#"
format = 1
name = "line"
[[inertia]]
name = "engine"
inertia = 0.3
[[gear]]
name = "gear"
input = "engine"
output = "flange"
ratio = 2.5
[[inertia]]
name = "wheel"
inertia = 1.2
damping = 0.5
[[inertia]]
name = "vehicle"
inertia = 9.0
[[shaft]]
name = "clutch"
from = "flange"
to = "wheel"
stiffness = 900.0
cubic = 40000.0
quadratic = 1500.0
damping = 2.0
[[shaft]]
name = "tyre"
from = "wheel"
to = "vehicle"
stiffness = 2500.0
damping = 6.0
[[torque]]
name = "drive"
on = "engine"
mean = 8.0
amplitude = 25.0
order = 2
phase = 0.7
[[torque]]
name = "road"
on = "vehicle"
mean = "balance"
"#;

    fn line() -> EquationsOfMotion {
        let (line, _) = read_model(Source::new("line.toml", LINE), &[]).expect("a sound model");
        EquationsOfMotion::new(&line).expect("a sound line")
    }

    // Source: the equations of motion of the whole line with the waveform put in, projected on the
    // mean and the first harmonic of each group: torques of inertia, dampers, shafts and drive.
    #[test]
    fn waveforms_satisfy_the_projected_equations_of_motion() {
        let equations = line();
        let mut several = 0;
        for frequency in [8.0, 12.0, 14.0, 16.0, 20.0, 30.0] {
            let found = responses_at(&equations, frequency, 2.0).expect("one nonlinear shaft");
            assert!(!found.is_empty());
            several += usize::from(found.len() == 3);
            for response in &found {
                check(&equations, frequency, response);
            }
        }
        assert!(several > 0);
    }

    fn check(equations: &EquationsOfMotion, frequency: f64, response: &FirstHarmonicResponse) {
        let (groups, count) = (equations.groups(), 64);
        let nu = 2.0 * frequency;
        let mut sums = vec![[0.0_f64; 3]; groups];
        let mean = equations.excitation.mean(groups);
        let drive = equations.excitation.harmonic(groups, 2.0, frequency);
        let mut size = 0.0_f64;
        for k in 0..count {
            let phase = std::f64::consts::TAU * f64::from(k) / f64::from(count);
            let turn = Complex::from_polar(1.0, phase);
            let value = |z: &Complex| (*z * turn).re;
            let waves = response.groups.iter();
            let angles: Vec<f64> =
                waves.zip(&response.mean_angles).map(|(z, mean)| mean + value(z)).collect();
            let speeds: Vec<f64> = response
                .groups
                .iter()
                .map(|z| nu * value(&(*z * Complex::new(0.0, 1.0))))
                .collect();
            let mut net: Vec<f64> = (0..groups)
                .map(|g| {
                    let torque = Complex::new(drive[g].0, drive[g].1);
                    let inertia = nu * nu * equations.inertia[g] * value(&response.groups[g]);
                    mean[g] + value(&torque) + inertia - equations.ground_damping[g] * speeds[g]
                })
                .collect();
            for (index, connection) in equations.connections.iter().enumerate() {
                let (x, v) = (equations.twist(index, &angles), equations.twist(index, &speeds));
                let torque = connection.law.torque(x) + connection.resistance(x, v);
                size = size.max(torque.abs());
                equations.add_direction(index, -torque, &mut net);
            }
            for (sum, net) in sums.iter_mut().zip(&net) {
                sum[0] += net / f64::from(count);
                sum[1] += 2.0 * net * phase.cos() / f64::from(count);
                sum[2] += 2.0 * net * phase.sin() / f64::from(count);
            }
        }
        for sum in &sums {
            assert!(sum.iter().all(|part| part.abs() < 1e-9 * size), "{sums:?} of {size}");
        }
        let twist = equations.twist(response.connection, &response.mean_angles);
        assert!((twist - response.mean).abs() < 1e-12 * twist.abs());
    }

    // Source: the method's own rule for a line with several nonlinear shafts.
    #[test]
    fn two_nonlinear_shafts_are_refused() {
        let text = LINE.replace("stiffness = 2500.0", "stiffness = 2500.0\ncubic = 10.0");
        let (line, _) = read_model(Source::new("line.toml", text), &[]).expect("a sound model");
        let equations = EquationsOfMotion::new(&line).expect("a sound line");
        let found = responses_at(&equations, 10.0, 2.0);
        assert!(matches!(found, Err(AnalysisError::MethodDoesNotFit { .. })));
    }
}
