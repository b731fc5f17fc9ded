//! Laws given by a function of the host program.

use std::convert::Infallible;
use std::f64::consts::PI;

use halfshaft_model::elements::SampledLaw;
use halfshaft_model::{Driveline, FunctionError};
use halfshaft_numerics::polynomial::sampled;

pub use halfshaft_numerics::polynomial::SampleError;

/// Over which twists a function is sampled, and where it bends.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    /// Least and greatest twist, rad; beyond, the law goes on straight. Half a turn to both sides where
    /// nothing else is said.
    pub range_rad: (f64, f64),
    /// Twists within the range at which the stiffness jumps, rad.
    pub kinks_rad: Vec<f64>,
}

impl Default for Sampling {
    fn default() -> Self {
        Self { range_rad: (-PI, PI), kinks_rad: Vec::new() }
    }
}

/// A torque law from a function of many twists (rad) at a time that gives as many torques (N·m) or
/// fails.
///
/// The function is asked here and not again: where it bends it is asked more closely, until polynomials
/// meet it to about 1e-13. All analyses take the law then, at their usual speed.
///
/// # Errors
/// [`SampleError`] where the function fails, is not finite, or bends where no kink is told.
pub fn sample_law<E>(
    torque_nm: impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
    sampling: &Sampling,
) -> Result<SampledLaw, SampleError<E>> {
    let found = sampled(torque_nm, sampling.range_rad, &sampling.kinks_rad)?;
    let mut kinks = sampling.kinks_rad.clone();
    kinks.sort_by(f64::total_cmp);
    kinks.dedup();
    let (origins, coefficients) = found
        .pieces
        .iter()
        .map(|(origin, torque)| (*origin, torque.coefficients().to_vec()))
        .unzip();
    SampledLaw::new(found.breaks, origins, coefficients, kinks).ok_or(SampleError::TooFine)
}

/// Why a line cannot have a function as a law.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LawError {
    /// The function cannot be sampled.
    #[error("the torque of \"{shaft}\" cannot be sampled: {reason}")]
    Function {
        /// Name of the shaft.
        shaft: String,
        /// Why.
        reason: SampleError,
    },
    /// The shaft cannot have it.
    #[error(transparent)]
    Shaft(#[from] FunctionError),
}

/// The line with the torque (N·m) of a shaft over its twist (rad) given by a function; damping, friction
/// and preload stay as they are.
///
/// ```
/// use halfshaft::{Sampling, load_embedded, with_law};
///
/// let line = load_embedded(&[])?.line;
/// let hardening = with_law(&line, "half-shaft", |twist| 5e3 * twist.sinh(), &Sampling::default())?;
/// assert_ne!(hardening.digest(), line.digest());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`LawError`].
pub fn with_law(
    line: &Driveline,
    shaft: &str,
    torque_nm: impl Fn(f64) -> f64,
    sampling: &Sampling,
) -> Result<Driveline, LawError> {
    let all = |twists: &[f64]| Ok::<_, Infallible>(twists.iter().map(|x| torque_nm(*x)).collect());
    let law = sample_law(all, sampling)
        .map_err(|reason| LawError::Function { shaft: shaft.to_owned(), reason })?;
    Ok(line.with_function(shaft, law)?)
}
