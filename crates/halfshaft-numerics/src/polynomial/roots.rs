//! From the coefficients to the list of roots: what is settled before any iteration.

use super::{Multiplicity, Root, intervals, scaling};

/// All real roots, ascending. `coefficients` has no trailing zeros.
pub(super) fn all(coefficients: &[f64]) -> Vec<Root> {
    if coefficients.iter().any(|c| !c.is_finite()) {
        return Vec::new();
    }
    // A factor x^m is split off exactly; what remains is not zero at x = 0.
    let Some(at_zero) = coefficients.iter().position(|&c| c != 0.0) else {
        return Vec::new();
    };
    let reduced = &coefficients[at_zero..];
    let mut roots = match reduced {
        [_] => Vec::new(),
        [constant, slope] => linear(*constant, *slope),
        [constant, linear, square] => quadratic([*constant, *linear, *square]),
        _ => higher(reduced),
    };
    if at_zero > 0 {
        let multiplicity =
            if at_zero % 2 == 1 { Multiplicity::Simple } else { Multiplicity::Double };
        let place = roots.partition_point(|root| root.value < 0.0);
        roots.insert(place, Root { value: 0.0, multiplicity });
    }
    roots
}

fn linear(constant: f64, slope: f64) -> Vec<Root> {
    let value = -constant / slope;
    if value.is_finite() && value != 0.0 {
        vec![Root { value, multiplicity: Multiplicity::Simple }]
    } else {
        Vec::new()
    }
}

fn quadratic(coefficients: [f64; 3]) -> Vec<Root> {
    let mut roots = Vec::with_capacity(2);
    intervals::quadratic_roots(coefficients, |root| {
        if root.value.is_finite() && root.value != 0.0 {
            roots.push(root);
        }
    });
    roots
}

/// Degree three or more, neither first nor last coefficient zero.
fn higher(coefficients: &[f64]) -> Vec<Root> {
    match scaling::safe_root_bound(coefficients) {
        Some(bound) => intervals::roots_within(coefficients, bound),
        None => scaling::wild_roots(coefficients),
    }
}
