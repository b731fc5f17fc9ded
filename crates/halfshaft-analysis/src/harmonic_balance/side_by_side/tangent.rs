//! What a connection opposes to changes of several orbits.

use halfshaft_dynamics::laws::Piece;

use super::super::lanes::Rows;
use super::super::monodromy::Orbit;
use super::super::series::Waves;
use super::super::structure::sum;
use super::{Lane, ORBITS};

/// Tangent stiffness and damping of one connection in all orbits, over the phase.
pub(super) struct Tangent {
    pub(super) law: Option<Piece>,
    /// Coefficients of the twist.
    pub(super) twist: Vec<Lane>,
    /// Coefficients of the stiffness by power of the phase.
    pub(super) stiffness: Rows<ORBITS>,
    pub(super) terms: usize,
    pub(super) damping: Lane,
}

impl Tangent {
    /// Writes the stiffness `P'(x - origin)` along the twist about the phase of `waves`, times
    /// `scale`, which is one over the square of the frequency; `x` and `store` have a row for each power.
    #[inline(always)]
    pub(super) fn expand<const FUSED: bool>(
        &mut self,
        waves: &Waves,
        orbit: &Orbit<'_>,
        (scale, x, store): (&Lane, &mut [Lane], &mut [Lane]),
    ) {
        let Some(law) = &self.law else { return };
        waves.sums(orbit.set, &self.twist, x);
        x[0] = x[0].map(|x| x - law.origin);
        let out = &mut self.stiffness[..];
        out.fill([0.0; ORBITS]);
        let powers = law.torque.coefficients().iter().enumerate().skip(1).rev();
        for (step, (power, k)) in powers.enumerate() {
            match step {
                0 => {}
                1 => {
                    let highest = out[0];
                    for (out, x) in out.iter_mut().zip(&*x) {
                        *out = std::array::from_fn(|lane| highest[lane] * x[lane]);
                    }
                }
                _ => {
                    store.copy_from_slice(out);
                    product::<FUSED>(store, x, out);
                }
            }
            out[0] = out[0].map(|sum| sum + power as f64 * k);
        }
        for row in out {
            *row = std::array::from_fn(|lane| row[lane] * scale[lane]);
        }
    }
}

/// Product of two series of as many terms, cut off after as many.
#[inline(always)]
fn product<const FUSED: bool>(a: &[Lane], b: &[Lane], out: &mut [Lane]) {
    for (power, out) in out.iter_mut().enumerate() {
        let mut sum = [0.0; ORBITS];
        for (a, b) in a[..=power].iter().zip(b[..=power].iter().rev()) {
            add_product::<FUSED>(a, b, &mut sum);
        }
        *out = sum;
    }
}

/// `out += a b` in each lane.
#[inline(always)]
pub(super) fn add_product<const FUSED: bool>(a: &Lane, b: &Lane, out: &mut Lane) {
    for lane in 0..ORBITS {
        out[lane] = sum::<FUSED>(a[lane], b[lane], out[lane]);
    }
}
