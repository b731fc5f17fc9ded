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
