//! A law that a function of the host program gave, as the polynomials that it was sampled into.

use serde::Serialize;

/// A torque over the twist as polynomials joined end to end.
///
/// Model files know no such law: it comes from a function, through
/// [`Driveline::with_function`](crate::Driveline::with_function).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SampledLaw {
    /// Twists at which a polynomial ends and the next begins, ascending, rad.
    breaks_rad: Vec<f64>,
    /// Twists that the polynomials count from, one more than breaks, rad.
    origins_rad: Vec<f64>,
    /// Coefficients of each polynomial, ascending from the constant, N·m/radⁿ.
    coefficients: Vec<Vec<f64>>,
    /// Breaks at which the stiffness jumps, rad.
    kinks_rad: Vec<f64>,
}

impl SampledLaw {
    /// A law of at least three polynomials, the first and the last of which go on for ever; `None`
    /// where the lists do not fit, the breaks do not ascend, or a number is not finite.
    pub fn new(
        breaks_rad: Vec<f64>,
        origins_rad: Vec<f64>,
        coefficients: Vec<Vec<f64>>,
        kinks_rad: Vec<f64>,
    ) -> Option<Self> {
        let count = breaks_rad.len() + 1;
        let fits = count >= 3
            && origins_rad.len() == count
            && coefficients.len() == count
            && breaks_rad.windows(2).all(|pair| pair[0] < pair[1])
            && kinks_rad.windows(2).all(|pair| pair[0] < pair[1])
            && kinks_rad.iter().all(|kink| breaks_rad.contains(kink));
        let numbers = breaks_rad.iter().chain(&origins_rad).chain(coefficients.iter().flatten());
        let sound = fits && numbers.into_iter().all(|number| number.is_finite());
        sound.then_some(Self { breaks_rad, origins_rad, coefficients, kinks_rad })
    }

    /// Twists at which a polynomial ends and the next begins, ascending, rad.
    pub fn breaks_rad(&self) -> &[f64] {
        &self.breaks_rad
    }

    /// Breaks at which the stiffness jumps, ascending, rad.
    pub fn kinks_rad(&self) -> &[f64] {
        &self.kinks_rad
    }

    /// Origins (rad) and coefficients (ascending, N·m/radⁿ) of the polynomials, ascending.
    pub fn pieces(&self) -> impl ExactSizeIterator<Item = (f64, &[f64])> + '_ {
        let coefficients = self.coefficients.iter().map(Vec::as_slice);
        self.origins_rad.iter().copied().zip(coefficients)
    }

    /// Least and greatest twist that the function was asked for, rad.
    pub fn range_rad(&self) -> (f64, f64) {
        (self.breaks_rad[0], self.breaks_rad[self.breaks_rad.len() - 1])
    }

    /// Whether there is no torque at any twist.
    pub(super) fn is_silent(&self) -> bool {
        self.coefficients.iter().flatten().all(|c| *c == 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::SampledLaw;

    #[test]
    fn lists_that_do_not_fit_are_no_law() {
        let law = |breaks: &[f64], kinks: &[f64], slope: f64| {
            let straight = vec![vec![0.0, slope]; 3];
            SampledLaw::new(breaks.to_vec(), vec![0.0; 3], straight, kinks.to_vec())
        };
        let sound = law(&[-1.0, 2.0], &[], 3.0).expect("a sound law");
        assert_eq!(sound.range_rad(), (-1.0, 2.0));
        assert_eq!(sound.pieces().len(), 3);
        assert!(law(&[-1.0, 2.0], &[2.0], 3.0).is_some());
        assert!(law(&[2.0, -1.0], &[], 3.0).is_none());
        assert!(law(&[0.0], &[], 3.0).is_none());
        assert!(law(&[-1.0, 2.0], &[0.5], 3.0).is_none());
        assert!(law(&[-1.0, 2.0], &[], f64::NAN).is_none());
    }
}
