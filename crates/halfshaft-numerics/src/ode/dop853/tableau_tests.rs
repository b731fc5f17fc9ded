//! The coefficients against the order conditions that they must satisfy.

use super::tableau::{
    A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A13, A14, A15, B, B3, C, D4, D5, D6, D7, E5,
    STAGES, Term,
};

const ROWS: [&[Term]; STAGES] =
    [&[], &A1, &A2, &A3, &A4, &A5, &A6, &A7, &A8, &A9, &A10, &A11, &B, &A13, &A14, &A15];

fn sum(row: &[Term], of: impl Fn(usize) -> f64) -> f64 {
    row.iter().map(|&(stage, weight)| weight * of(stage)).sum()
}

fn size(row: &[Term]) -> f64 {
    row.iter().map(|(_, weight)| weight.abs()).sum::<f64>().max(1.0)
}

/// Source of truth: every stage is consistent, `Σ_j a_ij = c_i`, and from the second on of order
/// two, `Σ_j a_ij c_j = c_i² / 2`, as the method's construction demands (Hairer et al., II.5).
#[test]
fn rows_are_consistent() {
    for (stage, row) in ROWS.iter().enumerate() {
        assert!((sum(row, |_| 1.0) - C[stage]).abs() < 1e-15 * size(row), "row {stage}");
        let half_square = if stage == 1 { 0.0 } else { 0.5 * C[stage] * C[stage] };
        assert!((sum(row, |j| C[j]) - half_square).abs() < 1e-15 * size(row), "row {stage}");
        assert!(row.iter().all(|(j, _)| *j < stage.max(1)), "row {stage} is explicit");
    }
}

/// Source of truth: the quadrature conditions `Σ b_i c_i^(k-1) = 1/k`, `k = 1..8`, and those of the
/// trees with one branch on the stem, `Σ b_i c_i^m Σ a_ij c_j^n = 1 / ((n+1)(m+n+2))`, up to order
/// 8.
#[test]
fn weights_have_order_eight() {
    for k in 1..=8 {
        let moment = sum(&B, |i| C[i].powi(k - 1));
        assert!((moment - 1.0 / f64::from(k)).abs() < 1e-15 * size(&B), "moment {k}");
    }
    for m in 0..=6_i32 {
        for n in 0..=(6 - m) {
            let inner = |i: usize| sum(ROWS[i], |j| C[j].powi(n));
            let moment = sum(&B, |i| C[i].powi(m) * inner(i));
            let exact = 1.0 / f64::from((n + 1) * (m + n + 2));
            assert!((moment - exact).abs() < 1e-14 * size(&B), "m {m}, n {n}");
        }
    }
}

/// Source of truth: an error estimate vanishes for polynomials of its order: `E5` up to degree 4 of
/// the derivative and no further, `B - B3` up to degree 2.
#[test]
fn error_estimates_have_their_orders() {
    let fifth = |k: i32| sum(&E5, |i| C[i].powi(k));
    let third = |k: i32| sum(&B, |i| C[i].powi(k)) - sum(&B3, |i| C[i].powi(k));
    for k in 0..=4 {
        assert!(fifth(k).abs() < 1e-15 * size(&E5), "moment {k}: {}", fifth(k));
    }
    for k in 0..=2 {
        assert!(third(k).abs() < 1e-15, "moment {k}: {}", third(k));
    }
    assert!(fifth(5).abs() > 1e-6 && third(3).abs() > 1e-6);
}

/// Source of truth: the polynomial of the dense output reproduces `∫ t^k dt` inside the step for
/// every degree `k` up to 6, since it has order 7.
#[test]
fn dense_output_integrates_powers_exactly() {
    for k in 0..=6_i32 {
        let slope = |i: usize| C[i].powi(k);
        let change = 1.0 / f64::from(k + 1);
        let at_start = slope(0) - change;
        let at_end = change - slope(12) - at_start;
        let c = [
            0.0,
            change,
            at_start,
            at_end,
            sum(&D4, slope),
            sum(&D5, slope),
            sum(&D6, slope),
            sum(&D7, slope),
        ];
        for s in [0.1, 0.35, 0.5, 0.77, 0.9] {
            let t = 1.0 - s;
            let inner = c[4] + s * (c[5] + t * (c[6] + s * c[7]));
            let value = c[0] + s * (c[1] + t * (c[2] + s * (c[3] + t * inner)));
            let exact = s.powi(k + 1) * change;
            assert!((value - exact).abs() < 2e-14, "degree {k} at {s}: {value} against {exact}");
        }
    }
}
