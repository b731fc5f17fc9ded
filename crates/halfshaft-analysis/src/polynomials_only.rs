//! For methods that know polynomial laws only.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::PolynomialLaw;

use crate::error::AnalysisError;

/// The laws of all connections, for a method that takes polynomials without friction.
///
/// # Errors
/// [`AnalysisError::MethodDoesNotFit`] with the shaft and its law.
pub(crate) fn polynomial_laws<'l>(
    equations: &'l EquationsOfMotion,
    method: &'static str,
) -> Result<Vec<&'l PolynomialLaw>, AnalysisError> {
    let refuse = |name: &str, law: &str| AnalysisError::MethodDoesNotFit {
        method,
        reason: format!("{name} has {law}, and the method knows polynomial laws only"),
    };
    equations
        .connections
        .iter()
        .map(|connection| {
            let name = connection.name.as_str();
            if connection.friction.is_some() {
                return Err(refuse(name, "dry friction"));
            }
            let law = &connection.law;
            law.polynomial().ok_or_else(|| refuse(name, &format!("a {} law", law.name())))
        })
        .collect()
}
