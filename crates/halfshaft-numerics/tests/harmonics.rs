//! Truncated Fourier series: samples, spectra, products.

mod reference;

use std::f64::consts::TAU;

use halfshaft_numerics::harmonics::{HarmonicSet, Sampler, Spectrum, add_product};
use proptest::prelude::{prop_assert, proptest};
use reference::Random;

fn set_of(odd: bool, highest: usize) -> HarmonicSet {
    if odd { HarmonicSet::odd(highest) } else { HarmonicSet::all(highest) }
}

fn random(count: usize, random: &mut Random) -> Vec<f64> {
    (0..count).map(|_| random.next()).collect()
}

/// The series by its definition, term by term.
fn by_hand(set: &HarmonicSet, x: &[f64], theta: f64) -> f64 {
    let mut at = 0;
    let mut sum = 0.0;
    for &order in set.orders() {
        if order == 0 {
            sum += x[at];
            at += 1;
        } else {
            let angle = order as f64 * theta;
            sum += x[at] * angle.cos() + x[at + 1] * angle.sin();
            at += 2;
        }
    }
    assert_eq!(at, x.len());
    sum
}

/// Coefficients of a signal over a set by the trapezoidal rule, exact for trigonometric polynomials
/// below `count` less the set's highest order.
fn project(set: &HarmonicSet, count: usize, signal: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut out = vec![0.0; set.coefficients()];
    for k in 0..count {
        let theta = TAU * k as f64 / count as f64;
        let value = signal(theta) / count as f64;
        for (order, place) in set.places() {
            if order == 0 {
                out[place] += value;
            } else {
                out[place] += 2.0 * value * (order as f64 * theta).cos();
                out[place + 1] += 2.0 * value * (order as f64 * theta).sin();
            }
        }
    }
    out
}

#[test]
fn sets_hold_the_orders_that_they_say() {
    let all = HarmonicSet::all(3);
    assert_eq!((all.orders(), all.coefficients(), all.highest()), (&[0, 1, 2, 3][..], 7, 3));
    assert_eq!([0, 1, 2, 3].map(|k| all.place(k)), [0, 1, 3, 5]);
    let odd = HarmonicSet::odd(6);
    assert_eq!((odd.orders(), odd.coefficients(), odd.highest()), (&[1, 3, 5][..], 6, 5));
    assert_eq!([0, 1, 2].map(|k| odd.place(k)), [0, 2, 4]);
    assert!(odd.is_odd() && !all.is_odd());
    assert_eq!((odd.place_of(3), odd.place_of(2), odd.place_of(0)), (Some(2), None, None));
    assert_eq!((all.up_to(1), odd.up_to(1)), (HarmonicSet::all(1), HarmonicSet::odd(1)));
    // A mean alone.
    assert_eq!(HarmonicSet::all(0).coefficients(), 1);
    assert_eq!(HarmonicSet::all(0).evaluate(&[2.5], 1.0), (2.5, 0.0));
}

proptest! {
    // Source: the definition of the series.
    #[test]
    fn samples_and_values_are_those_of_the_definition(
        seed in 0_u64..1 << 40, odd: bool, highest in 1_usize..20, spare in 1_usize..40,
    ) {
        let mut numbers = Random(seed);
        let set = set_of(odd, highest);
        let x = random(set.coefficients(), &mut numbers);
        let mut sampler = Sampler::new(2 * highest + spare);
        let mut samples = vec![0.0; sampler.count()];
        sampler.samples(&set, &x, &mut samples);
        for (k, sample) in samples.iter().enumerate() {
            let theta = TAU * k as f64 / samples.len() as f64;
            prop_assert!((sample - by_hand(&set, &x, theta)).abs() < 1e-12);
            let (value, slope) = set.evaluate(&x, theta);
            prop_assert!((value - sample).abs() < 1e-12);
            let h = 1e-5;
            let quotient =
                (by_hand(&set, &x, theta + h) - by_hand(&set, &x, theta - h)) / (2.0 * h);
            let cube = (highest as f64).powi(3) * 40.0;
            prop_assert!((slope - quotient).abs() < cube * h * h + 1e-8);
        }
        // There and back.
        let mut spectrum = Spectrum::default();
        sampler.spectrum(&mut samples, &mut spectrum);
        let mut back = vec![f64::NAN; x.len()];
        spectrum.coefficients(&set, &mut back);
        prop_assert!(back.iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-13));
        // Parts and their signs.
        for order in 1..=highest.cast_signed() {
            let (c, s) = (spectrum.cosine(order), spectrum.sine(order));
            prop_assert!(spectrum.cosine(-order) == c && spectrum.sine(-order) == -s);
            let place = set.place_of(order.unsigned_abs());
            let (a, b) = place.map_or((0.0, 0.0), |place| (x[place], x[place + 1]));
            prop_assert!((2.0 * c - a).abs() < 1e-13 && (2.0 * s - b).abs() < 1e-13);
        }
    }

    // Source: the pointwise product, projected by the trapezoidal rule with samples enough.
    #[test]
    fn the_product_matrix_multiplies(
        seed in 0_u64..1 << 40, odd: bool, highest in 1_usize..12, scale in -2.0..2.0_f64,
    ) {
        let mut numbers = Random(seed);
        let set = set_of(odd, highest);
        let m = set.coefficients();
        // A product of odd series with a signal of even orders only is odd.
        let signal = HarmonicSet::all(2 * highest);
        let mut k = random(signal.coefficients(), &mut numbers);
        if odd {
            for (order, place) in signal.places().filter(|(order, _)| order % 2 == 1) {
                k[place..place + 2].fill(0.0);
                assert!(order % 2 == 1);
            }
        }
        let x = random(m, &mut numbers);
        let mut sampler = Sampler::new(4 * highest + 2);
        let mut samples = vec![0.0; sampler.count()];
        sampler.samples(&signal, &k, &mut samples);
        let mut spectrum = Spectrum::default();
        sampler.spectrum(&mut samples, &mut spectrum);
        let start = random(m * m, &mut numbers);
        let mut matrix = start.clone();
        add_product(&set, &spectrum, scale, &mut matrix);
        let exact =
            project(&set, 8 * highest, |t| by_hand(&signal, &k, t) * by_hand(&set, &x, t));
        for row in 0..m {
            let entries = matrix[row * m..(row + 1) * m].iter().zip(&start[row * m..]);
            let found: f64 = entries.zip(&x).map(|((a, b), x)| (a - b) * x).sum();
            prop_assert!((found - scale * exact[row]).abs() < 1e-11, "row {row}");
        }
    }

    // Source: the phase of the subharmonic: a series of cos jθ is one of cos (factor j)(θ / factor).
    #[test]
    fn series_move_to_other_sets(
        seed in 0_u64..1 << 40, odd: bool, highest in 1_usize..9, other in 1_usize..20,
        factor in 1_usize..4,
    ) {
        let mut numbers = Random(seed);
        let (from, to) = (set_of(odd, highest), HarmonicSet::all(other));
        let x = random(from.coefficients(), &mut numbers);
        let mut y = random(to.coefficients(), &mut numbers);
        to.take(&from, factor, &x, &mut y);
        let mut kept = x.clone();
        for (order, place) in from.places().filter(|(order, _)| factor * order > other) {
            kept[place..(place + if order == 0 { 1 } else { 2 })].fill(0.0);
        }
        for k in 0..17 {
            let theta = TAU * f64::from(k) / 17.0;
            let exact = by_hand(&from, &kept, factor as f64 * theta);
            prop_assert!((by_hand(&to, &y, theta) - exact).abs() < 1e-12);
        }
        for order in 0..=other {
            let size = (order % factor == 0).then(|| from.modulus(&kept, order / factor));
            prop_assert!((to.modulus(&y, order) - size.unwrap_or(0.0)).abs() < 1e-15);
        }
    }
}

// Orders that the samples cannot hold are left out, none is folded onto another.
#[test]
fn orders_beyond_the_samples_are_left_out() {
    let set = HarmonicSet::all(8);
    let mut x = vec![0.0; set.coefficients()];
    x[set.place(1)] = 1.0;
    x[set.place(4)] = 5.0;
    x[set.place(7) + 1] = 7.0;
    let mut sampler = Sampler::new(8);
    let mut samples = vec![0.0; 8];
    sampler.samples(&set, &x, &mut samples);
    for (k, sample) in samples.iter().enumerate() {
        let exact = (TAU * k as f64 / 8.0).cos();
        assert!((sample - exact).abs() < 1e-14);
    }
    assert_eq!(Sampler::new(1).count(), 2);
    assert_eq!(Sampler::new(7).count(), 8);
}

// Source: exact Fourier series of cos³ and of cos² (addition theorems): alternating
// frequency-time is exact where the samples resolve the highest power.
#[test]
fn powers_are_exact() {
    let set = HarmonicSet::all(3);
    let mut x = vec![0.0; set.coefficients()];
    x[set.place(1)] = 2.0;
    let mut sampler = Sampler::new(8);
    let mut samples = vec![0.0; 8];
    let mut spectrum = Spectrum::default();
    sampler.samples(&set, &x, &mut samples);
    samples.iter_mut().for_each(|x| *x = *x * *x * *x + *x * *x);
    sampler.spectrum(&mut samples, &mut spectrum);
    let mut f = vec![0.0; x.len()];
    spectrum.coefficients(&set, &mut f);
    // 8 cos³ = 6 cos + 2 cos 3θ, 4 cos² = 2 + 2 cos 2θ.
    let exact = [2.0, 6.0, 0.0, 2.0, 0.0, 2.0, 0.0];
    assert!(f.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-14), "{f:?}");
}
