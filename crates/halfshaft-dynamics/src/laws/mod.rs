//! Torque laws of connections: torque, its derivatives, its energy and its averages.
//!
//! To add a law: a file here, a variant of [`TorqueLaw`], a line in each of its methods, and its keys
//! in `of_element`.

mod clearance;
mod describing;
mod friction;
mod function;
mod of_element;
mod one_sided;
mod pieces;
mod piecewise_linear;
mod polynomial;
mod quadrature;
mod table;

use halfshaft_numerics::polynomial::Polynomial;

pub use clearance::ClearanceLaw;
pub use describing::DescribingFunction;
pub use friction::{Friction, FrictionDescribingFunction};
pub use function::FunctionLaw;
pub(crate) use of_element::{law_of_mesh, law_of_shaft};
pub use one_sided::OneSidedContact;
pub use pieces::{Piece, Pieces};
pub use piecewise_linear::{PiecewiseLinearLaw, Stage};
pub use polynomial::PolynomialLaw;
pub use table::TableLaw;

/// Torque of a connection as a function of its twist. Continuous, whatever the law.
#[derive(Clone, Debug, PartialEq)]
pub enum TorqueLaw {
    /// `k0 + k1 x + k2 x² + k3 x³ + k5 x⁵ + k7 x⁷`.
    Polynomial(PolynomialLaw),
    /// Backlash.
    Clearance(ClearanceLaw),
    /// Stages of constant stiffness.
    PiecewiseLinear(PiecewiseLinearLaw),
    /// A stop on one side.
    OneSided(OneSidedContact),
    /// Measured points.
    Table(TableLaw),
    /// A function of the host program.
    Function(FunctionLaw),
}

/// Share of a swing's damping that acts in contact, see [`TorqueLaw::contact_share`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactShare {
    /// From 0, never in contact, to 1.
    pub share: f64,
    /// Derivative by the mean twist, 1/rad.
    pub by_mean: f64,
    /// Derivative by the amplitude, 1/rad.
    pub by_amplitude: f64,
}

/// Calls one method of whichever law it is.
macro_rules! of_each {
    ($law:expr, $name:ident => $call:expr) => {
        match $law {
            TorqueLaw::Polynomial($name) => $call,
            TorqueLaw::Clearance($name) => $call,
            TorqueLaw::PiecewiseLinear($name) => $call,
            TorqueLaw::OneSided($name) => $call,
            TorqueLaw::Table($name) => $call,
            TorqueLaw::Function($name) => $call,
        }
    };
}

impl TorqueLaw {
    /// Torque at twist `x` (rad), N·m.
    #[inline]
    pub fn torque(&self, x: f64) -> f64 {
        of_each!(self, law => law.torque(x))
    }

    /// Tangent stiffness at twist `x` (rad), N·m/rad; where it jumps, that on the side towards zero
    /// twist or below.
    #[inline]
    pub fn stiffness(&self, x: f64) -> f64 {
        of_each!(self, law => law.stiffness(x))
    }

    /// `d²T/dx²` at twist `x` (rad), N·m/rad²; zero in straight pieces and where the tangent
    /// stiffness jumps.
    #[inline]
    pub fn curvature(&self, x: f64) -> f64 {
        match self {
            Self::Polynomial(law) => law.curvature(x),
            Self::Clearance(law) => law.curvature(x),
            Self::PiecewiseLinear(_) => 0.0,
            Self::OneSided(law) => law.curvature(x),
            Self::Table(law) => law.curvature(x),
            Self::Function(law) => law.curvature(x),
        }
    }

    /// Whether the connection is in contact at twist `x` (rad): outside a gap, beyond where a stop
    /// touches; laws without free play always are.
    #[inline]
    pub fn in_contact(&self, x: f64) -> bool {
        match self {
            Self::Clearance(law) => x.abs() > law.half_gap(),
            Self::OneSided(law) => x > law.contact_twist(),
            Self::Polynomial(_) | Self::PiecewiseLinear(_) | Self::Table(_) | Self::Function(_) => {
                true
            }
        }
    }

    /// Potential energy at twist `x` (rad) above the untwisted state, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        of_each!(self, law => law.energy(x))
    }

    /// Torque and tangent stiffness at many twists: one look at the law for all of them. The
    /// slices have one length.
    pub fn evaluate(&self, twists: &[f64], torque: &mut [f64], stiffness: &mut [f64]) {
        if let Self::Function(law) = self {
            // One look for both: finding the polynomial is most of the work.
            for ((x, torque), stiffness) in twists.iter().zip(torque).zip(stiffness) {
                (*torque, *stiffness) = law.both(*x);
            }
            return;
        }
        of_each!(self, law => {
            for ((x, torque), stiffness) in twists.iter().zip(torque).zip(stiffness) {
                *torque = law.torque(*x);
                *stiffness = law.stiffness(*x);
            }
        });
    }

    /// Twists at which the tangent stiffness jumps, ascending; none where only higher derivatives
    /// do.
    pub fn switching_twists(&self) -> &[f64] {
        match self {
            Self::Polynomial(_) | Self::Table(_) => &[],
            Self::Clearance(law) => law.switching_twists(),
            Self::PiecewiseLinear(law) => law.switching_twists(),
            Self::OneSided(law) => law.switching_twists(),
            Self::Function(law) => law.kinks(),
        }
    }

    /// Whether the tangent stiffness is the same everywhere. A preload may add a constant: the
    /// torque is `torque(0) + stiffness(0) x`.
    pub fn is_linear(&self) -> bool {
        of_each!(self, law => law.is_linear())
    }

    /// Whether all derivatives of the torque are continuous: a polynomial, or a function without kinks,
    /// whose polynomials join to rounding.
    pub fn is_smooth(&self) -> bool {
        match self {
            Self::Polynomial(_) => true,
            Self::Function(law) => law.kinks().is_empty(),
            _ => false,
        }
    }

    /// Whether `T(-x) = -T(x)`.
    pub fn is_odd(&self) -> bool {
        of_each!(self, law => law.is_odd())
    }

    /// Name of the kind of law.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Polynomial(_) => "polynomial",
            Self::Clearance(_) => "clearance",
            Self::PiecewiseLinear(_) => "multi-stage",
            Self::OneSided(_) => "one-sided contact",
            Self::Table(_) => "table",
            Self::Function(_) => "function",
        }
    }

    /// The law where it is a polynomial.
    pub fn polynomial(&self) -> Option<&PolynomialLaw> {
        match self {
            Self::Polynomial(law) => Some(law),
            _ => None,
        }
    }

    /// All twists with the given torque (N·m), ascending.
    ///
    /// Where the law is flat at that torque (inside a gap), one twist stands for all of the flat part;
    /// see [`Pieces::twists_at`].
    pub fn twists_at(&self, torque: f64) -> Vec<f64> {
        self.pieces().twists_at(torque)
    }

    /// The law as polynomials joined end to end.
    pub fn pieces(&self) -> Pieces {
        let constant = |torque: f64| Polynomial::new([torque]);
        let contact = |law: &PolynomialLaw, preload| law.polynomial().add(&constant(preload));
        match self {
            Self::Polynomial(law) => Pieces::new(&[], std::iter::once((0.0, law.polynomial()))),
            Self::Clearance(law) => {
                let half = law.half_gap();
                let flank = contact(law.contact(), law.preload());
                // Mirrored: T(-h - p) - preload = -(T(h + p) - preload).
                let mut mirrored = law.contact().polynomial().coefficients().to_vec();
                mirrored.iter_mut().step_by(2).for_each(|k| *k = -*k);
                let lower = Polynomial::new(mirrored).add(&constant(law.preload()));
                if half == 0.0 {
                    return Pieces::new(&[0.0], [(0.0, lower), (0.0, flank)].into_iter());
                }
                let inside = constant(law.preload());
                let all = [(-half, lower), (0.0, inside), (half, flank)];
                Pieces::new(&[-half, half], all.into_iter())
            }
            Self::PiecewiseLinear(law) => {
                let straight = |(origin, torque, k)| (origin, Polynomial::new([torque, k]));
                Pieces::new(law.switching_twists(), law.straight_pieces().map(straight))
            }
            Self::OneSided(law) => {
                let touch = law.contact_twist();
                let flank = contact(law.contact(), law.preload());
                Pieces::new(
                    &[touch],
                    [(touch, constant(law.preload())), (touch, flank)].into_iter(),
                )
            }
            Self::Table(law) => {
                let cubic = |(origin, coefficients)| (origin, Polynomial::new(coefficients));
                Pieces::new(law.points(), law.cubic_pieces().map(cubic))
            }
            Self::Function(law) => Pieces::new(law.breaks(), law.polynomials()),
        }
    }

    /// Share of viscous damping that acts over a swing `x = mean + amplitude cos φ` (rad) where the
    /// damping acts in contact only: the first-harmonic damping torque over that of a damper that
    /// always acts, with its derivatives; in closed form.
    pub fn contact_share(&self, mean: f64, amplitude: f64) -> ContactShare {
        // 2 ⟨sin² φ⟩ over the arcs in contact is the gain of flanks of unit stiffness.
        let unit = PolynomialLaw::new([0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let flanks = match self {
            Self::Clearance(law) => {
                Self::Clearance(ClearanceLaw::new(2.0 * law.half_gap(), &unit, 0.0))
            }
            Self::OneSided(law) => {
                Self::OneSided(OneSidedContact::new(law.contact_twist(), &unit, 0.0))
            }
            Self::Polynomial(_) | Self::PiecewiseLinear(_) | Self::Table(_) | Self::Function(_) => {
                return ContactShare { share: 1.0, by_mean: 0.0, by_amplitude: 0.0 };
            }
        };
        let flanks = flanks.describing_function(mean, amplitude);
        ContactShare {
            share: flanks.gain,
            by_mean: flanks.gain_by_mean,
            by_amplitude: flanks.gain_by_amplitude,
        }
    }

    /// Mean torque and first-harmonic gain over a swing `x = mean + amplitude cos φ` (rad), with
    /// their derivatives.
    ///
    /// Polynomials, stages and gaps or stops with a linear contact in closed form; the others by
    /// quadrature from break to break, to rounding. At amplitude zero the gain is the tangent
    /// stiffness.
    pub fn describing_function(&self, mean: f64, amplitude: f64) -> DescribingFunction {
        let size = amplitude.abs();
        let mut result = of_each!(self, law => law.describing_function(mean, size));
        if amplitude < 0.0 {
            // Half a turn later it is the same swing.
            result.mean_by_amplitude = -result.mean_by_amplitude;
            result.gain_by_amplitude = -result.gain_by_amplitude;
        }
        result
    }
}
