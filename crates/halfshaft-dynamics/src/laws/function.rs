//! A law given by a function of the host program, as the polynomials that it was sampled into.
//!
//! The polynomials meet the function to about 1e-13, so that nothing is asked of the host while a motion
//! is computed; slope, curvature and energy are those of the polynomials, exactly. Beyond the range that
//! the function was sampled over the law goes on straight.

use std::f64::consts::FRAC_1_SQRT_2;

use halfshaft_model::elements::SampledLaw;
use halfshaft_numerics::polynomial::Polynomial;

use super::describing::DescribingFunction;

/// One of the polynomials.
#[derive(Clone, Debug, PartialEq)]
struct Stretch {
    origin: f64,
    torque: Polynomial,
    stiffness: Polynomial,
    /// Energy above zero twist, J.
    energy: Polynomial,
}

/// The law of a function.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionLaw {
    /// Where a polynomial ends and the next begins, ascending, rad.
    breaks: Vec<f64>,
    /// One more than breaks.
    stretches: Vec<Stretch>,
    /// Where the stiffness jumps, rad.
    kinks: Vec<f64>,
    is_odd: bool,
}

impl FunctionLaw {
    /// The sampled law with `preload` (N·m) added.
    pub fn new(law: &SampledLaw, preload: f64) -> Self {
        let preload = Polynomial::new([preload]);
        let stretch = |(origin, coefficients): (f64, &[f64])| {
            let torque = Polynomial::new(coefficients).add(&preload);
            Stretch {
                origin,
                energy: torque.antiderivative(),
                stiffness: torque.derivative(),
                torque,
            }
        };
        let stretches: Vec<Stretch> = law.pieces().map(stretch).collect();
        let breaks = law.breaks_rad().to_vec();
        let is_odd = is_odd(&breaks, &stretches);
        let mut law = Self { breaks, stretches, kinks: law.kinks_rad().to_vec(), is_odd };
        law.level_energy();
        law
    }

    /// Makes the energy continuous, and zero at zero twist.
    fn level_energy(&mut self) {
        for index in 1..self.stretches.len() {
            let [before, here] = &self.stretches[index - 1..=index] else { continue };
            let join = self.breaks[index - 1];
            let step = before.energy.evaluate(join - before.origin)
                - here.energy.evaluate(join - here.origin);
            let raised = here.energy.add(&Polynomial::new([step]));
            self.stretches[index].energy = raised;
        }
        let zero = Polynomial::new([-self.energy(0.0)]);
        for stretch in &mut self.stretches {
            stretch.energy = stretch.energy.add(&zero);
        }
    }

    #[inline]
    fn at(&self, x: f64) -> &Stretch {
        &self.stretches[self.breaks.partition_point(|end| *end < x)]
    }

    /// Torque at twist `x`, N·m.
    #[inline]
    pub fn torque(&self, x: f64) -> f64 {
        let stretch = self.at(x);
        stretch.torque.evaluate(x - stretch.origin)
    }

    /// Tangent stiffness at twist `x`, N·m/rad.
    #[inline]
    pub fn stiffness(&self, x: f64) -> f64 {
        self.both(x).1
    }

    /// Torque and tangent stiffness at twist `x`.
    #[inline]
    pub(super) fn both(&self, x: f64) -> (f64, f64) {
        let stretch = self.at(x);
        stretch.torque.evaluate_with_slope(x - stretch.origin)
    }

    /// `d²T/dx²` at twist `x`, N·m/rad²; at a break that below it.
    #[inline]
    pub fn curvature(&self, x: f64) -> f64 {
        let stretch = self.at(x);
        stretch.stiffness.evaluate_with_slope(x - stretch.origin).1
    }

    /// Potential energy above zero twist, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        let stretch = self.at(x);
        stretch.energy.evaluate(x - stretch.origin)
    }

    /// Whether the tangent stiffness is the same everywhere.
    pub fn is_linear(&self) -> bool {
        let slope =
            |stretch: &Stretch| stretch.torque.coefficients().get(1).copied().unwrap_or(0.0);
        let first = slope(&self.stretches[0]);
        let same = |stretch: &Stretch| stretch.torque.degree() <= 1 && slope(stretch) == first;
        self.stretches.iter().all(same)
    }

    /// Whether `T(-x) = -T(x)`.
    pub fn is_odd(&self) -> bool {
        self.is_odd
    }

    /// Twists at which the tangent stiffness jumps, ascending, rad.
    pub fn kinks(&self) -> &[f64] {
        &self.kinks
    }

    /// Twists at which one polynomial ends and the next begins, ascending, rad.
    pub(super) fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Origins and polynomials, ascending.
    pub(super) fn polynomials(&self) -> impl Iterator<Item = (f64, Polynomial)> + '_ {
        self.stretches.iter().map(|stretch| (stretch.origin, stretch.torque.clone()))
    }

    /// The describing function for an amplitude of zero or more, by quadrature.
    pub fn describing_function(&self, mean: f64, amplitude: f64) -> DescribingFunction {
        if amplitude == 0.0 {
            let (torque, stiffness) = self.both(mean);
            return DescribingFunction {
                mean_torque: torque,
                gain: stiffness,
                mean_by_mean: stiffness,
                gain_by_mean: self.curvature(mean),
                ..DescribingFunction::default()
            };
        }
        // Quarters of half a turn: the rule is good to rounding for their degree there.
        let quarters = [-FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2].map(|c| mean + amplitude * c);
        let crossed = self.breaks.iter().copied().filter(|b| (b - mean).abs() < amplitude);
        let mut parts: Vec<f64> = crossed.chain(quarters).collect();
        parts.sort_by(f64::total_cmp);
        DescribingFunction::by_parts(mean, amplitude, &parts, |x| self.both(x))
    }
}

/// Whether the polynomials are their own mirror images to the last bit.
fn is_odd(breaks: &[f64], stretches: &[Stretch]) -> bool {
    let mirrored = |(a, b): (&Stretch, &Stretch)| {
        let (a, b) = ((a.origin, a.torque.coefficients()), (b.origin, b.torque.coefficients()));
        let opposite = |(power, (c, d)): (usize, (&f64, &f64))| {
            if power % 2 == 0 { *c == -*d } else { c == d }
        };
        a.0 == -b.0 && a.1.len() == b.1.len() && a.1.iter().zip(b.1).enumerate().all(opposite)
    };
    breaks.iter().zip(breaks.iter().rev()).all(|(a, b)| *a == -*b)
        && stretches.iter().zip(stretches.iter().rev()).all(mirrored)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::{PolynomialLaw, TorqueLaw};

    /// A softening cubic, cut at some twists although one polynomial would do.
    fn cut() -> (FunctionLaw, PolynomialLaw) {
        let whole = PolynomialLaw::new([0.0, 6.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0]);
        let law = Polynomial::new([0.0, 6.0, 0.0, -0.5]);
        let breaks = vec![-1.0, -0.4, 0.4, 1.0];
        let origins = vec![-1.0, -0.7, 0.0, 0.7, 1.0];
        let mut pieces: Vec<Vec<f64>> =
            origins.iter().map(|x| law.shifted(*x).coefficients().to_vec()).collect();
        pieces[0].truncate(2);
        pieces[4].truncate(2);
        let sampled = SampledLaw::new(breaks, origins, pieces, Vec::new()).expect("fitting lists");
        (FunctionLaw::new(&sampled, 0.0), whole)
    }

    // Source: the same law as one polynomial, whose parts are in closed form.
    #[test]
    fn a_law_in_pieces_is_the_law() {
        let (law, whole) = cut();
        assert!(law.is_odd() && !law.is_linear());
        for k in -19..=20 {
            let x = 0.05 * f64::from(k);
            assert!((law.torque(x) - whole.torque(x)).abs() < 1e-14, "{x}");
            assert!((law.stiffness(x) - whole.stiffness(x)).abs() < 1e-14, "{x}");
            assert!((law.energy(x) - whole.energy(x)).abs() < 1e-14, "{x}");
            assert!((law.curvature(x) - whole.curvature(x)).abs() < 1e-13, "{x}");
        }
        for (mean, amplitude) in [(0.0, 0.0), (0.1, 0.2), (0.0, 0.9), (-0.3, 0.6)] {
            let (a, b) = (
                law.describing_function(mean, amplitude),
                whole.describing_function(mean, amplitude),
            );
            assert!((a.mean_torque - b.mean_torque).abs() < 1e-13, "{mean} {amplitude}");
            assert!((a.gain - b.gain).abs() < 1e-13, "{mean} {amplitude}");
            assert!((a.gain_by_amplitude - b.gain_by_amplitude).abs() < 1e-12);
        }
    }

    // Source: by hand: beyond 1 rad the slope is 6 - 1.5 and the torque there 5.5.
    #[test]
    fn beyond_its_range_it_goes_on_straight() {
        let (law, _) = cut();
        assert!((law.torque(3.0) - (5.5 + 2.0 * 4.5)).abs() < 1e-14);
        assert_eq!(law.curvature(3.0), 0.0);
        // ∫₀¹ (6 x - x³/2) dx + 5.5 · 2 + 4.5 · 2² / 2
        assert!((law.energy(3.0) - (2.875 + 11.0 + 9.0)).abs() < 1e-13);
    }

    // Source: the law turned round by hand.
    #[test]
    fn all_twists_with_a_torque_are_found() {
        let (law, whole) = cut();
        let found = TorqueLaw::Function(law).twists_at(whole.torque(0.7));
        assert_eq!(found.len(), 1);
        assert!((found[0] - 0.7).abs() < 1e-14);
    }
}
