//! All responses at a frequency, by whichever way fits the law.

use halfshaft_numerics::Complex;

use super::amplitude_polynomial::{AmplitudePolynomial, Approach};
use super::bracketed;
use super::problem::{Point, Problem};
use super::shaft_law::Balanced;
use super::sheets::Sheets;

/// How all amplitudes are found.
pub(super) enum Finder {
    /// Roots of a polynomial.
    Polynomial(AmplitudePolynomial),
    /// Certified cells.
    Cells(Box<Sheets>),
}

/// A response at a frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Response {
    /// Circular frequency of the order, rad/s.
    pub(super) nu: f64,
    /// Complex amplitude of the twist.
    pub(super) twist: Complex,
    /// Mean twist and what holds it.
    pub(super) at: Balanced,
    /// Whether the amplitude rises with the drive: else there is one more unstable direction.
    pub(super) rises: bool,
    /// Whether anything takes energy out of the motion.
    pub(super) damped: bool,
}

impl Response {
    /// Amplitude of the twist, rad.
    pub(super) fn amplitude(&self) -> f64 {
        self.twist.modulus()
    }

    /// Unstable directions as far as one harmonic and the mean can tell.
    pub(super) fn unstable_dimension(&self) -> u8 {
        u8::from(!self.rises) + u8::from(self.at.held < 0.0)
    }

    /// Whether small departures die out.
    pub(super) fn is_stable(&self) -> bool {
        self.damped && self.unstable_dimension() == 0
    }
}

/// All responses at a frequency.
#[derive(Clone, Debug, Default)]
pub(super) struct Responses {
    /// By ascending amplitude.
    pub(super) list: Vec<Response>,
    /// Places at which two responses are too close to be told apart.
    pub(super) open: usize,
}

impl Finder {
    /// The way that fits the law of a problem.
    pub(super) fn new(problem: &Problem) -> Self {
        match AmplitudePolynomial::of(&problem.law) {
            Some(polynomial) => Self::Polynomial(polynomial),
            None => Self::Cells(Box::new(Sheets::new(&problem.law))),
        }
    }

    /// All responses at a circular frequency.
    pub(super) fn all(&self, problem: &Problem, nu: f64) -> Responses {
        let Some(point) = problem.value(nu) else { return Responses::default() };
        let (roots, open) = self.roots(problem, &point);
        let list = roots.iter().map(|(a, at)| response(problem, &point, *a, at)).collect();
        Responses { list, open }
    }

    fn roots(&self, problem: &Problem, point: &Point<Complex>) -> (Vec<(f64, Balanced)>, usize) {
        match self {
            Self::Polynomial(polynomial) => {
                let (amplitudes, double) = polynomial.amplitudes(point);
                let at = |a: f64| Some((a, problem.law.balanced(a, 0.0)?));
                (amplitudes.into_iter().filter_map(at).collect(), usize::from(double))
            }
            Self::Cells(sheets) => {
                let found = bracketed::all(problem, sheets, point);
                (found.roots, found.open)
            }
        }
    }

    /// How many responses there are.
    pub(super) fn count(&self, problem: &Problem, point: &Point<Complex>) -> u32 {
        match self {
            Self::Polynomial(polynomial) => polynomial.count(point),
            Self::Cells(sheets) => {
                let count = bracketed::all(problem, sheets, point).roots.len();
                u32::try_from(count).unwrap_or(u32::MAX)
            }
        }
    }

    /// Where two responses nearly are born, for polynomials.
    pub(super) fn approaches(&self, problem: &Problem, nu: f64) -> Vec<Approach> {
        match (self, problem.value(nu)) {
            (Self::Polynomial(polynomial), Some(point)) => polynomial.approaches(&point),
            _ => Vec::new(),
        }
    }
}

/// The response of an amplitude at a frequency.
pub(super) fn response(
    problem: &Problem,
    point: &Point<Complex>,
    amplitude: f64,
    at: &Balanced,
) -> Response {
    let (whole, slope) = problem.whole_and_slope(point, amplitude, at);
    Response {
        nu: point.nu,
        twist: problem.twist(point, amplitude, at),
        at: *at,
        rises: whole.re * slope.re + whole.im * slope.im > 0.0,
        damped: problem.is_damped(point),
    }
}
