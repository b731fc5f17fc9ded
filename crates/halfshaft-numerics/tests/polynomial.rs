//! Polynomials and their real roots.

mod reference;

use halfshaft_numerics::dense::{Matrix, eigenvalues};
use halfshaft_numerics::polynomial::{Multiplicity, Polynomial, Root};
use proptest::prelude::{Just, Strategy, prop_assert, prop_assert_eq, proptest};
use reference::Random;

/// `scale Π (x - root)`.
fn with_roots(roots: &[f64], scale: f64) -> Polynomial {
    let start = Polynomial::new([scale]);
    roots.iter().fold(start, |product, root| product.multiply(&Polynomial::new([-root, 1.0])))
}

fn values(roots: &[Root]) -> Vec<f64> {
    roots.iter().map(|root| root.value).collect()
}

fn multiplicities(roots: &[Root]) -> Vec<Multiplicity> {
    roots.iter().map(|root| root.multiplicity).collect()
}

/// Whether the value at every root is zero within the stated bound, and the order ascending.
fn is_consistent(polynomial: &Polynomial, roots: &[Root]) -> bool {
    let small = |root: &Root| {
        let (value, bound) = polynomial.evaluate_with_error_bound(root.value);
        // Where the plain evaluation overflows nothing can be said.
        !bound.is_finite() || value.abs() <= Polynomial::ZERO_FACTOR * bound
    };
    roots.iter().all(small) && roots.windows(2).all(|pair| pair[0].value < pair[1].value)
}

/// Number of distinct real roots by Sturm's theorem in exact integers.
fn sturm_count(coefficients: &[i128]) -> usize {
    let trimmed = |mut p: Vec<i128>| {
        while p.last() == Some(&0) {
            p.pop();
        }
        let content = p.iter().fold(0, |a: i128, b| gcd(a, b.abs()));
        p.iter_mut().for_each(|c| *c /= content.max(1));
        p
    };
    let derivative =
        coefficients.iter().enumerate().skip(1).map(|(k, c)| c * k as i128).collect::<Vec<_>>();
    let mut chain = vec![trimmed(coefficients.to_vec()), trimmed(derivative)];
    while let [.., a, b] = chain.as_slice() {
        if b.len() <= 1 {
            break;
        }
        // Minus the remainder, multiplied by a positive number that keeps it integer.
        let (mut remainder, leading) = (a.clone(), b[b.len() - 1]);
        while remainder.len() >= b.len() {
            let (top, shift) = (remainder[remainder.len() - 1], remainder.len() - b.len());
            remainder.iter_mut().for_each(|c| *c *= leading.abs());
            for (k, c) in b.iter().enumerate() {
                remainder[k + shift] -= top * leading.signum() * c;
            }
            remainder.pop();
        }
        let next = trimmed(remainder.iter().map(|c| -c).collect());
        if next.is_empty() {
            break;
        }
        chain.push(next);
    }
    let changes = |at_minus_infinity: bool| {
        let sign = |p: &Vec<i128>| {
            let odd = p.len().is_multiple_of(2);
            p[p.len() - 1].signum() * if at_minus_infinity && odd { -1 } else { 1 }
        };
        let signs: Vec<i128> = chain.iter().map(sign).collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    };
    changes(true) - changes(false)
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Source of truth: Sturm's theorem in integer arithmetic, on every polynomial of degree up to 4
/// with coefficients -3..3 and on random ones of degree 5 with coefficients -9..9.
#[test]
fn the_count_of_distinct_roots_is_that_of_sturm() {
    let check = |coefficients: &[i128]| {
        if coefficients.iter().skip(1).all(|c| *c == 0) {
            return;
        }
        let floats: Vec<f64> = coefficients.iter().map(|c| *c as f64).collect();
        let polynomial = Polynomial::new(&floats);
        let roots = polynomial.real_roots();
        assert_eq!(roots.len(), sturm_count(coefficients), "{coefficients:?} gave {roots:?}");
        assert!(is_consistent(&polynomial, &roots), "{coefficients:?} gave {roots:?}");
    };
    for code in 0..7_i128.pow(5) {
        let digits: Vec<i128> = (0..5).map(|k| code / 7_i128.pow(k) % 7 - 3).collect();
        check(&digits);
    }
    let mut random = Random(1);
    for _ in 0..5000 {
        let digits: Vec<i128> = (0..6).map(|_| (random.next() * 9.99) as i128).collect();
        check(&digits);
    }
}

/// Source of truth: eigenvalues of the companion matrix. Polynomials with a pair of eigenvalues so
/// close to the real axis that it might be either are left out.
#[test]
fn roots_are_the_real_eigenvalues_of_the_companion_matrix() {
    let mut random = Random(2);
    let mut compared = 0;
    for case in 0..4000 {
        let degree = 2 + case % 8;
        let c: Vec<f64> = (0..=degree).map(|_| random.next()).collect();
        let companion = Matrix::from_fn(degree, degree, |i, j| match (i, j) {
            (0, j) => -c[degree - 1 - j] / c[degree],
            (i, j) if i == j + 1 => 1.0,
            _ => 0.0,
        });
        let eigenvalues = eigenvalues(&companion).expect("finite");
        if eigenvalues.iter().any(|z| z.im != 0.0 && z.im.abs() < 1e-5 * z.modulus()) {
            continue;
        }
        let mut real: Vec<f64> = eigenvalues.iter().filter(|z| z.im == 0.0).map(|z| z.re).collect();
        real.sort_by(f64::total_cmp);
        if real.windows(2).any(|pair| pair[1] - pair[0] < 1e-4 * pair[1].abs()) {
            continue;
        }
        compared += 1;
        let found = values(&Polynomial::new(&c).real_roots());
        assert_eq!(found.len(), real.len(), "{c:?}: {found:?} against {real:?}");
        for (a, b) in found.iter().zip(&real) {
            assert!((a - b).abs() <= 1e-8 * b.abs().max(1.0), "{c:?}: {a} against {b}");
        }
    }
    assert!(compared > 3500, "only {compared} cases were clear");
}

/// Between two and nine roots in [-10, 10], no two closer than 0.1.
fn separated_roots() -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(0.1..2.0_f64, 2..10).prop_flat_map(|gaps| {
        let total: f64 = gaps.iter().sum();
        (Just(gaps), -10.0..(10.0 - total).max(-9.9)).prop_map(|(gaps, first)| {
            let mut place = first;
            gaps.iter()
                .map(|gap| {
                    place += gap;
                    place
                })
                .collect()
        })
    })
}

proptest! {
    /// Source of truth: the roots that the polynomial was built from. Each may be off by the
    /// rounding of the coefficients and of the evaluation, divided by the slope.
    #[test]
    fn known_roots_are_found_at_any_scale(
        roots in separated_roots(),
        exponent in -90..90_i32,
        stretch in -12..12_i32,
    ) {
        let stretch = 10.0_f64.powi(stretch);
        let stretched: Vec<f64> = roots.iter().map(|root| root * stretch).collect();
        let polynomial = with_roots(&stretched, 10.0_f64.powi(exponent));
        let found = polynomial.real_roots();
        prop_assert_eq!(found.len(), roots.len());
        prop_assert!(is_consistent(&polynomial, &found));
        for (found, known) in found.iter().zip(&stretched) {
            let (_, slope) = polynomial.evaluate_with_slope(*known);
            let (_, bound) = polynomial.evaluate_with_error_bound(*known);
            let uncertainty = 30.0 * bound / slope.abs() + 4.0 * f64::EPSILON * known.abs();
            prop_assert!((found.value - known).abs() <= uncertainty);
            prop_assert_eq!(found.multiplicity, Multiplicity::Simple);
        }
    }

    /// Source of truth: powers of ten chosen as roots, so far apart that each coefficient of the
    /// polynomial is dominated by one product and carries hardly any rounding.
    #[test]
    fn roots_of_wildly_different_size_are_all_found(
        steps in proptest::collection::vec((9..35_i32, proptest::bool::ANY), 2..5),
        lowest in -60..-20_i32,
        exponent in -90..20_i32,
    ) {
        let mut e = lowest;
        let mut roots: Vec<f64> = steps.iter().map(|(step, negative)| {
            e += step;
            10.0_f64.powi(e) * if *negative { -1.0 } else { 1.0 }
        }).collect();
        let polynomial = with_roots(&roots, 10.0_f64.powi(exponent));
        roots.sort_by(f64::total_cmp);
        let found = polynomial.real_roots();
        prop_assert_eq!(found.len(), roots.len());
        for (found, known) in found.iter().zip(&roots) {
            prop_assert!((found.value / known - 1.0).abs() < 3e-9);
        }
    }

    /// Source of truth: calculus. `k1 x + k3 x³ = T` with `k3 < 0` has its greatest load
    /// `T = 2/3 k1 √(k1 / 3|k3|)` at `x = √(k1 / 3|k3|)`, touching, and a third root at `-2x`.
    #[test]
    fn a_load_exactly_at_the_maximum_keeps_its_root(
        k1 in 1e-3..1e6_f64,
        exponent in -30.0..30.0_f64,
        negative in proptest::bool::ANY,
    ) {
        let k3 = -(10.0_f64.powf(exponent));
        let top = (k1 / (3.0 * k3.abs())).sqrt();
        let load = 2.0 / 3.0 * k1 * top * if negative { -1.0 } else { 1.0 };
        let mut roots = Polynomial::new([-load, k1, 0.0, k3]).real_roots();
        if negative {
            roots.reverse();
            roots.iter_mut().for_each(|root| root.value = -root.value);
        }
        prop_assert_eq!(multiplicities(&roots), [Multiplicity::Simple, Multiplicity::Double]);
        prop_assert!((roots[0].value / (-2.0 * top) - 1.0).abs() < 1e-14);
        prop_assert!((roots[1].value / top - 1.0).abs() < 1e-14);
    }

    /// Source of truth: the definitions of shift, sum, product, derivative and antiderivative, at a
    /// point.
    #[test]
    fn algebra_means_what_it_says(
        p in proptest::collection::vec(-2.0..2.0_f64, 0..14),
        q in proptest::collection::vec(-2.0..2.0_f64, 0..5),
        x in -1.5..1.5_f64,
        x0 in -1.0..1.0_f64,
    ) {
        let (p, q) = (Polynomial::new(p), Polynomial::new(q));
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * 3.0_f64.powi(18);
        prop_assert!(near(p.shifted(x0).evaluate(x - x0), p.evaluate(x)));
        prop_assert!(near(p.add(&q).evaluate(x), p.evaluate(x) + q.evaluate(x)));
        prop_assert!(near(p.multiply(&q).evaluate(x), p.evaluate(x) * q.evaluate(x)));
        prop_assert!(near(p.scaled(-3.0).evaluate(x), -3.0 * p.evaluate(x)));
        prop_assert_eq!(p.evaluate_with_slope(x).0, p.evaluate(x));
        prop_assert!(near(p.evaluate_with_slope(x).1, p.derivative().evaluate(x)));
        prop_assert_eq!(p.antiderivative().evaluate(0.0), 0.0);
        let back = p.antiderivative().derivative();
        prop_assert_eq!(back.coefficients().len(), p.coefficients().len());
        for (a, b) in back.coefficients().iter().zip(p.coefficients()) {
            prop_assert!((a - b).abs() <= f64::EPSILON * b.abs());
        }
    }
}

/// Source of truth: for `k3 > 0` the characteristic `k1 x + k3 x³` is monotone, one root; for
/// `k3 < 0` three roots below the greatest load and one above it (calculus, as above).
#[test]
fn cubic_characteristics_keep_their_roots_over_sixty_decades() {
    let k1 = 6420.0;
    for exponent in -30..=30 {
        let k3 = 10.0_f64.powi(exponent);
        for load in [1e-100, 1e-9, 1.0, 850.0, 1e9, 1e100] {
            let hardening = Polynomial::new([-load, k1, 0.0, k3]);
            let roots = hardening.real_roots();
            assert_eq!(roots.len(), 1, "k3 = {k3}, load {load}");
            assert!(is_consistent(&hardening, &roots), "k3 = {k3}, load {load}: {roots:?}");
            let most = 2.0 / 3.0 * k1 * (k1 / (3.0 * k3)).sqrt();
            let softening = Polynomial::new([-load, k1, 0.0, -k3]);
            let roots = softening.real_roots();
            let count = if load < most { 3 } else { 1 };
            assert_eq!(roots.len(), count, "k3 = -{k3}, load {load}");
            assert!(is_consistent(&softening, &roots), "k3 = -{k3}, load {load}: {roots:?}");
        }
    }
}

/// Source of truth: to first order in tiny or to leading order in huge coefficients the roots
/// follow from the two terms that balance.
#[test]
fn extreme_magnitudes_neither_overflow_nor_vanish() {
    // c2 x² + c3 x³ balance at -1e200; c0 + c2 x² has no real root.
    let roots = Polynomial::new([1e-100, 0.0, 1e100, 1e-100]).real_roots();
    assert_eq!(roots.len(), 1);
    assert!((roots[0].value / -1e200 - 1.0).abs() < 1e-15);
    // ±√(1e-200): the constant and the square term.
    let roots = values(&Polynomial::new([-1e-100, 0.0, 1e100, 1e-100]).real_roots());
    assert_eq!(roots.len(), 3);
    assert!((roots[1] / -1e-100 - 1.0).abs() < 1e-15 && (roots[2] / 1e-100 - 1.0).abs() < 1e-15);
    // The other root, -1e400, is beyond the range of numbers.
    let roots = values(&Polynomial::new([1e-100, 1e200, 1e-200]).real_roots());
    assert_eq!(roots.len(), 1);
    assert!((roots[0] / -1e-300 - 1.0).abs() < 1e-15);
    assert!(Polynomial::new([1e300, 1e-300]).real_roots().is_empty());
    for scale in [1e-290, 1e290] {
        let polynomial = with_roots(&[1.0, 2.0, 3.0], scale);
        for (root, known) in values(&polynomial.real_roots()).iter().zip([1.0, 2.0, 3.0]) {
            assert!((root - known).abs() < 1e-13);
        }
    }
}

/// Source of truth: Sturm's theorem in exact rational arithmetic (Python's `fractions`), which also
/// confirmed some 200 000 random polynomials like these. They have vanishing coefficients, gaps of
/// many decades between the others, and stationary points where several derivatives vanish.
#[test]
fn hard_polynomials_have_the_count_of_exact_arithmetic() {
    let cases: [(usize, &[f64]); 6] = [
        (3, &[2.6e-55, -1.776_982e22, 0.0, 0.0, 5.285_308e35, 1.326_256e53, 0.0, 4.402_291e53]),
        (4, &[-3.642_481e-80, -2.100_414e72, 5.691_044e64, 3.334_702e35, 2.195_464e-89]),
        (4, &[0.015_616, 0.0, -6.157_335, 0.0, 0.0, 0.0, 159.259_715, 8.620_921e-5, 0.317_8]),
        (2, &[9.4e-6, -3.4e31, 0.0, 0.0, -1.47e-7, 5.397e-37, -3.113e11, 2.4e-4, -4.885e-3]),
        (2, &[-0.528_765, 0.729_287, 0.0, 0.0, 0.0, -0.195_776, 1.276_892, -1.022_394, 0.947_557]),
        (2, &[0.566_339_7, 0.0, 0.0, 0.087_676, -22.878_872, -52.468_023, -41.876_460]),
    ];
    for (count, coefficients) in cases {
        let polynomial = Polynomial::new(coefficients);
        let roots = polynomial.real_roots();
        assert_eq!(roots.len(), count, "{coefficients:?} gave {roots:?}");
        assert!(is_consistent(&polynomial, &roots), "{coefficients:?} gave {roots:?}");
    }
}

/// Source of truth: the factorised form.
#[test]
fn multiple_roots_are_reported_once() {
    use Multiplicity::{Double, Simple};
    let cases: [(&[f64], &[f64], &[Multiplicity]); 8] = [
        (&[1.0, 1.0], &[1.0], &[Double]),
        (&[1.0, 1.0, -2.0], &[-2.0, 1.0], &[Simple, Double]),
        (&[1.0, 1.0, 1.0], &[1.0], &[Simple]),
        (&[1.0, 1.0, 2.0, 2.0], &[1.0, 2.0], &[Double, Double]),
        (&[0.0, 0.0, 3.0], &[0.0, 3.0], &[Double, Simple]),
        (&[0.0, 0.0, 0.0, -3.0], &[-3.0, 0.0], &[Simple, Simple]),
        (&[0.0], &[0.0], &[Simple]),
        (&[1.0, 1.0, 1.0, 1.0, 5.0], &[1.0, 5.0], &[Double, Simple]),
    ];
    for (built_from, expected, kinds) in cases {
        let roots = with_roots(built_from, 3.0).real_roots();
        assert_eq!(multiplicities(&roots), kinds, "{built_from:?} gave {roots:?}");
        for (root, known) in values(&roots).iter().zip(expected) {
            assert!((root - known).abs() <= 1e-3 * known.abs(), "{built_from:?} gave {roots:?}");
        }
    }
}

/// Source of truth: two roots at distance `2 d` about 1 can be told apart when `d²` is well above
/// the rounding of the value, and not when it is well below.
#[test]
fn a_close_pair_is_two_roots_or_one_never_three() {
    for k in 0..120 {
        let d = 10.0_f64.powf(-2.0 - 0.07 * f64::from(k));
        let polynomial =
            Polynomial::new([1.0 - d * d, -2.0, 1.0]).multiply(&Polynomial::new([3.0, 1.0]));
        let roots = polynomial.real_roots();
        assert!((roots[0].value + 3.0).abs() < 1e-14);
        match &roots[1..] {
            [a, b] => {
                assert!(d > 1e-9, "told apart at {d}");
                let distance = b.value - a.value;
                assert!((distance / (2.0 * d) - 1.0).abs() < 1e-14 / (d * d));
            }
            [touching] => {
                assert!(d < 1e-6, "not told apart at {d}");
                assert_eq!(touching.multiplicity, Multiplicity::Double);
            }
            others => panic!("{} roots at {d}: {others:?}", others.len()),
        }
    }
}

/// Source of truth: the roots of the Chebyshev polynomial `T_n` are `cos((2k - 1) π / 2n)`.
#[test]
fn chebyshev_polynomials_up_to_degree_sixteen() {
    let mut before = Polynomial::new([1.0]);
    let mut here = Polynomial::new([0.0, 1.0]);
    for degree in 1..=16 {
        let roots = values(&here.real_roots());
        assert_eq!(roots.len(), degree);
        for (k, root) in roots.iter().rev().enumerate() {
            let known = ((2 * k + 1) as f64 * std::f64::consts::PI / (2 * degree) as f64).cos();
            // The conditioning grows like (1 + √2)^n.
            assert!((root - known).abs() < 1e-16 * 2.5_f64.powi(degree as i32) + 1e-15);
        }
        let next = here.multiply(&Polynomial::new([0.0, 2.0])).add(&before.scaled(-1.0));
        (before, here) = (here, next);
    }
}

/// Source of truth: the documented results.
#[test]
fn degenerate_polynomials_have_documented_roots() {
    assert!(Polynomial::new([]).is_zero() && Polynomial::new([0.0, 0.0]).is_zero());
    assert!(Polynomial::new([0.0]).real_roots().is_empty());
    assert!(Polynomial::new([2.0]).real_roots().is_empty());
    assert_eq!(values(&Polynomial::new([0.0, 0.0, 5.0]).real_roots()), [0.0]);
    assert_eq!(values(&Polynomial::new([6.0, -3.0, 0.0]).real_roots()), [2.0]);
    assert!(Polynomial::new([1.0, f64::NAN]).real_roots().is_empty());
    assert!(Polynomial::new([f64::INFINITY, 1.0, 1.0]).real_roots().is_empty());
    assert_eq!(Polynomial::new([1.0, 2.0, 0.0]).degree(), 1);
    assert_eq!(Polynomial::new([1.0, 2.0, 0.0]), Polynomial::new([1.0, 2.0]));
    assert!(Polynomial::new([]).antiderivative().is_zero());
    assert!(Polynomial::new([3.0]).derivative().is_zero());
    assert_eq!(Polynomial::new([]).evaluate(3.0), 0.0);
}

/// Source of truth: the factorised form, with ends on, beside and beyond the roots.
#[test]
fn intervals_include_their_ends() {
    let polynomial = with_roots(&[1.0, 2.0, 3.0], 1.0);
    assert_eq!(polynomial.real_roots_in(1.0, 2.0).len(), 2);
    assert_eq!(polynomial.real_roots_in(1.0 + 1e-9, 3.0 - 1e-9).len(), 1);
    assert_eq!(polynomial.real_roots_in(f64::NEG_INFINITY, 2.5).len(), 2);
    assert!(polynomial.real_roots_in(2.0, 1.0).is_empty());
    assert!(polynomial.real_roots_in(f64::NAN, 1.0).is_empty());
    // The end lies on the root of √2 up to rounding, and the root is returned inside.
    let root = Polynomial::new([-2.0, 0.0, 1.0]).real_roots_in(0.0, 2.0_f64.sqrt());
    assert!(root.len() == 1 && root[0].value <= 2.0_f64.sqrt());
}

/// Source of truth: exact value of `(x - 1)^9` at `1 + 2^-10`, expanded coefficients.
#[test]
fn the_error_bound_holds_where_cancellation_is_worst() {
    let polynomial = with_roots(&[1.0; 9], 1.0);
    let (value, bound) = polynomial.evaluate_with_error_bound(1.0 + 2.0_f64.powi(-10));
    let exact = 2.0_f64.powi(-90);
    assert!((value - exact).abs() <= bound);
    assert!(bound < 1e-12, "the bound {bound} is not a bound of rounding");
}
