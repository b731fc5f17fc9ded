//! The coefficients against the order conditions that they must satisfy.

use super::tableau::{A1, A2, A3, A4, A5, B, C, D4, E, STAGES};
use crate::ode::lanes::Term;

const ROWS: [&[Term]; STAGES] = [&[], &A1, &A2, &A3, &A4, &A5, &B];

fn sum(row: &[Term], of: impl Fn(usize) -> f64) -> f64 {
    row.iter().map(|&(stage, weight)| weight * of(stage)).sum()
}

/// Source of truth: `Σ_j a_ij = c_i`; quadrature `Σ b_i c_i^(k-1) = 1/k` and the trees with one
/// branch, `Σ b_i c_i^m Σ a_ij c_j^n = 1 / ((n+1)(m+n+2))`, up to order 5 (Hairer et al., II.2).
#[test]
fn the_order_conditions_hold() {
    for (stage, row) in ROWS.iter().enumerate() {
        assert!((sum(row, |_| 1.0) - C[stage]).abs() < 2e-14, "row {stage}");
    }
    for k in 1..=5 {
        assert!((sum(&B, |i| C[i].powi(k - 1)) - 1.0 / f64::from(k)).abs() < 1e-15, "moment {k}");
    }
    for m in 0..=3_i32 {
        for n in 0..=(3 - m) {
            let moment = sum(&B, |i| C[i].powi(m) * sum(ROWS[i], |j| C[j].powi(n)));
            let exact = 1.0 / f64::from((n + 1) * (m + n + 2));
            assert!((moment - exact).abs() < 1e-14, "m {m}, n {n}");
        }
    }
}

/// Source of truth: the estimate vanishes for derivatives of degree up to 3 and no further.
#[test]
fn the_error_estimate_has_order_four() {
    for k in 0..=3 {
        assert!(sum(&E, |i| C[i].powi(k)).abs() < 1e-16, "moment {k}");
    }
    assert!(sum(&E, |i| C[i].powi(4)).abs() > 1e-4);
}

/// Source of truth: the polynomial reproduces `∫ t^k dt` inside the step up to `k = 3`: order 4.
#[test]
fn dense_output_integrates_cubics_exactly() {
    for k in 0..=3_i32 {
        let slope = |i: usize| C[i].powi(k);
        let change = 1.0 / f64::from(k + 1);
        let at_start = slope(0) - change;
        let at_end = change - slope(6) - at_start;
        for s in [0.1, 0.35, 0.5, 0.77, 0.9] {
            let t = 1.0 - s;
            let value = s * (change + t * (at_start + s * (at_end + t * sum(&D4, slope))));
            assert!((value - s.powi(k + 1) * change).abs() < 1e-14, "degree {k} at {s}");
        }
    }
}
