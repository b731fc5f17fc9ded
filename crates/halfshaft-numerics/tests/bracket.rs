//! Roots and minima on an interval.

use halfshaft_numerics::Error;
use halfshaft_numerics::bracket::{Ending, MinimumSettings, RootSettings, find_minimum, find_root};
use proptest::prelude::{prop_assert, proptest};

/// Function, two ends, root.
type Case = (fn(f64) -> f64, f64, f64, f64);

/// Functions with their bracket and root, from T. R. Chandrupatla's paper and other collections of
/// hard cases. Source of truth: the root solves the equation by inspection.
fn cases() -> Vec<Case> {
    vec![
        (|x| x * x * x - 8.0, 0.0, 5.0, 2.0),
        (|x| (x - 1.0) * (1.0 + (x - 1.0).powi(2)), 0.0, 3.0, 1.0),
        (|x| x * x - 5.0, 0.0, 9.0, 5.0_f64.sqrt()),
        (|x| x.exp_m1(), -50.0, 10.0, 0.0),
        // Flat over nearly the whole bracket.
        (|x| (x - 3.0).powi(19), -4.0, 5.0, 3.0),
        (|x| (40.0 * (x - 0.75)).tanh(), 0.0, 1.0, 0.75),
        // A jump without a zero.
        (|x| if x < std::f64::consts::E { -1.0 } else { 2.0 }, -3.0, 1e6, std::f64::consts::E),
    ]
}

#[test]
fn roots_are_found_to_the_last_bits_in_either_direction() {
    for (which, (function, a, b, root)) in cases().into_iter().enumerate() {
        for (a, b) in [(a, b), (b, a)] {
            let found = find_root(function, a, b, RootSettings::default()).expect("bracketed");
            assert_eq!(found.ending, Ending::Converged, "case {which}");
            let tolerance = 4.0 * f64::EPSILON * root.abs().max(f64::MIN_POSITIVE);
            // The flat function underflows to zero near its root.
            let tolerance = if which == 4 { 1e-3 } else { tolerance };
            assert!((found.value - root).abs() <= tolerance, "case {which}: {found:?}");
            assert!(found.interval.0 <= found.value && found.value <= found.interval.1);
            assert!(found.iterations <= 120, "case {which}: {} iterations", found.iterations);
        }
    }
}

/// Source of truth: the number of halvings that bisection would need, from width and tolerance.
#[test]
fn smooth_functions_take_far_fewer_steps_than_bisection() {
    let settings = RootSettings { absolute_tolerance: 1e-12, ..RootSettings::default() };
    let found = find_root(|x| x.cos() - x, 0.0, 1.0, settings).expect("bracketed");
    assert!((found.value - 0.739_085_133_215_160_6).abs() < 1e-12);
    assert!(found.iterations <= 10, "{} of 40 halvings", found.iterations);
}

/// Source of truth: the documented errors and endings.
#[test]
fn misuse_is_told() {
    let settings = RootSettings::default();
    let error = find_root(|x| x * x + 1.0, -1.0, 2.0, settings).expect_err("no change of sign");
    let expected =
        Error::NotBracketed { lower: -1.0, upper: 2.0, value_at_lower: 2.0, value_at_upper: 5.0 };
    assert_eq!(error, expected);
    assert!(matches!(find_root(|_| f64::NAN, 0.0, 1.0, settings), Err(Error::NonFinite { .. })));
    assert!(matches!(
        find_root(|x| x, -1.0, f64::INFINITY, settings),
        Err(Error::NonFinite { .. })
    ));
    let negative = RootSettings { relative_tolerance: -1.0, ..settings };
    assert!(matches!(find_root(|x| x, -1.0, 1.0, negative), Err(Error::Setting { .. })));
    let impatient = RootSettings { iteration_limit: 3, ..settings };
    let found = find_root(|x| x.exp() - 2.0, -50.0, 50.0, impatient).expect("bracketed");
    assert_eq!((found.ending, found.iterations), (Ending::IterationLimit, 3));
    assert!(found.interval.0 <= 2.0_f64.ln() && 2.0_f64.ln() <= found.interval.1);
    // A root at an end needs no search.
    let found = find_root(|x| x - 1.0, 1.0, 2.0, settings).expect("zero at an end");
    assert_eq!((found.value, found.iterations), (1.0, 0));
}

proptest! {
    /// Source of truth: the vertex of a parabola with a quartic part, which keeps its place.
    #[test]
    fn the_minimum_of_a_bowl_is_found(
        place in -50.0..50.0_f64,
        left in 0.1..100.0_f64,
        right in 0.1..100.0_f64,
        quartic in 0.0..3.0_f64,
    ) {
        let bowl = |x: f64| (x - place).powi(2) + quartic * (x - place).powi(4) - 7.0;
        let settings = MinimumSettings::default();
        let found = find_minimum(bowl, place + right, place - left, settings).expect("finite");
        prop_assert!(found.ending == Ending::Converged);
        // The value -7 hides changes of the place below about √(8e-16).
        prop_assert!((found.argument - place).abs() < 2e-7 * place.abs().max(1.0));
        prop_assert!((found.value + 7.0).abs() < 1e-12);
        prop_assert!(found.iterations < 80);
    }
}

/// Source of truth: Γ on (0, ∞) has its minimum at 1.461632144968..., 0.885603194410... (Abramowitz
/// & Stegun 6.1.34); here from ln Γ by Stirling's series shifted by 8.
#[test]
fn a_smooth_minimum_takes_few_steps() {
    let ln_gamma = |x: f64| {
        let z = x + 8.0;
        let series = 1.0 / (12.0 * z) - 1.0 / (360.0 * z.powi(3)) + 1.0 / (1260.0 * z.powi(5));
        let stirling = (z - 0.5) * z.ln() - z + 0.5 * std::f64::consts::TAU.ln() + series;
        stirling - (0..8).map(|k| (x + f64::from(k)).ln()).sum::<f64>()
    };
    let found = find_minimum(ln_gamma, 0.5, 4.0, MinimumSettings::default()).expect("finite");
    assert!((found.argument - 1.461_632_144_968).abs() < 1e-6);
    assert!((found.value.exp() - 0.885_603_194_410).abs() < 1e-10);
    assert!(found.iterations < 20, "{} function values", found.iterations);
}

/// Source of truth: a monotone function has its least value at an end.
#[test]
fn a_monotone_function_leads_to_the_end() {
    let found = find_minimum(|x| x, 2.0, 9.0, MinimumSettings::default()).expect("finite");
    assert!((found.argument - 2.0).abs() < 1e-6);
    let error = find_minimum(|_| f64::NAN, 0.0, 1.0, MinimumSettings::default());
    assert!(matches!(error, Err(Error::NonFinite { .. })));
}
