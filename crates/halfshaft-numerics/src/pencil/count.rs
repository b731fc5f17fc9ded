//! Numbers of eigenvalues on one side of a value, and brackets of them.

use super::Pencil;

/// Halvings of a bracket: to about a thousandth, from any ratio of the ends that doubles express.
const MOST_HALVINGS: usize = 200;

impl Pencil {
    /// Number of eigenvalues below `value`; where `M` is singular, infinite ones count above.
    pub fn below(&self, value: f64) -> usize {
        self.shifted(value).negative()
    }

    /// An upper bound of the size of the finite eigenvalues, roughly: entries of `K` over those of `M`.
    pub(super) fn scale(&self) -> f64 {
        let nodes = self.pattern.nodes();
        let (mut stiffness, mut inertia) = (vec![0.0; nodes], vec![0.0; nodes]);
        for term in &self.terms {
            for (node, entry) in [Some(term.first), term.second].into_iter().flatten() {
                stiffness[node] += term.stiffness.abs() * entry * entry;
                inertia[node] += term.inertia.max(0.0) * entry * entry;
            }
        }
        let heavy = stiffness.iter().zip(&inertia).filter(|(_, m)| **m > 0.0);
        let largest = heavy.map(|(k, m)| k / m).fold(0.0, f64::max);
        if largest > 0.0 { 4.0 * largest } else { 1.0 }
    }

    /// A value below which there are fewer than `number` eigenvalues and not far above which there are
    /// as many, positive; `None` where none of `number` is positive and finite.
    pub(super) fn floor_of(&self, number: usize) -> Option<f64> {
        let mut high = self.scale();
        let mut low = high * 1e-30;
        if self.below(low) >= number || self.below(high) < number {
            return None;
        }
        for _ in 0..MOST_HALVINGS {
            if high <= 1.5 * low {
                break;
            }
            let middle = (low * high).sqrt();
            if self.below(middle) < number {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }

    /// A negative value below which there is no eigenvalue, not farther than needed.
    pub(super) fn under_all(&self, near: f64) -> f64 {
        let mut shift = -near;
        while self.below(shift) > 0 && shift.is_finite() {
            shift *= 4.0;
        }
        shift
    }
}
