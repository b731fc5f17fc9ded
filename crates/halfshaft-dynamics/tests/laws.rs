//! Laws against their definitions, written out here, and against quadrature and differences.

use std::f64::consts::PI;

use halfshaft_dynamics::TorqueLaw;
use halfshaft_dynamics::laws::{
    ClearanceLaw, DescribingFunction, OneSidedContact, PiecewiseLinearLaw, PolynomialLaw, Stage,
    TableLaw,
};
use proptest::prelude::{prop_assert, proptest};

fn cubic(k1: f64, k2: f64, k3: f64) -> PolynomialLaw {
    PolynomialLaw::new([0.0, k1, k2, k3, 0.0, 0.0, 0.0, 0.0])
}

fn stages(list: &[(f64, f64)]) -> Vec<Stage> {
    list.iter().map(|(until, stiffness)| Stage { until: *until, stiffness: *stiffness }).collect()
}

const DRIVE: [(f64, f64); 3] = [(0.2, 200.0), (0.5, 1200.0), (f64::INFINITY, 9000.0)];
const COAST: [(f64, f64); 2] = [(0.3, 0.0), (f64::INFINITY, 4000.0)];
const POINTS: [(f64, f64); 7] = [
    (-0.8, -300.0),
    (-0.3, -120.0),
    (-0.1, -10.0),
    (0.05, 5.0),
    (0.4, 90.0),
    (0.6, 90.0),
    (0.9, 40.0),
];

/// A law and its definition.
type Defined = (TorqueLaw, fn(f64) -> f64);

/// One law of each kind and its definition.
fn laws() -> Vec<Defined> {
    let preloaded = PolynomialLaw::new([7.0, 500.0, 60.0, -40.0, 0.0, 30.0, 0.0, -2.0]);
    let all: Vec<Defined> = vec![
        (TorqueLaw::Polynomial(preloaded), |x| {
            7.0 + 500.0 * x + 60.0 * x.powi(2) - 40.0 * x.powi(3) + 30.0 * x.powi(5)
                - 2.0 * x.powi(7)
        }),
        (TorqueLaw::Clearance(ClearanceLaw::new(0.3, &cubic(800.0, 0.0, 0.0), 3.0)), |x| {
            3.0 + 800.0 * ((x - 0.15).max(0.0) + (x + 0.15).min(0.0))
        }),
        (TorqueLaw::Clearance(ClearanceLaw::new(0.3, &cubic(800.0, 90.0, 700.0), -3.0)), |x| {
            let p = (x.abs() - 0.15).max(0.0);
            -3.0 + (800.0 * p + 90.0 * p * p + 700.0 * p.powi(3)) * x.signum()
        }),
        (TorqueLaw::Clearance(ClearanceLaw::new(0.0, &cubic(800.0, 90.0, 0.0), 0.0)), |x| {
            800.0 * x + 90.0 * x * x.abs()
        }),
        (TorqueLaw::OneSided(OneSidedContact::new(0.25, &cubic(600.0, 0.0, 0.0), 2.0)), |x| {
            2.0 + 600.0 * (x - 0.25).max(0.0)
        }),
        (TorqueLaw::OneSided(OneSidedContact::new(-0.2, &cubic(600.0, 50.0, 400.0), 0.0)), |x| {
            let p = (x + 0.2).max(0.0);
            600.0 * p + 50.0 * p * p + 400.0 * p.powi(3)
        }),
        (
            TorqueLaw::PiecewiseLinear(PiecewiseLinearLaw::new(
                &stages(&DRIVE),
                &stages(&DRIVE),
                0.0,
            )),
            |x| {
                let a = x.abs();
                let torque = 200.0 * a + 1000.0 * (a - 0.2).max(0.0) + 7800.0 * (a - 0.5).max(0.0);
                torque * x.signum()
            },
        ),
        (
            TorqueLaw::PiecewiseLinear(PiecewiseLinearLaw::new(
                &stages(&DRIVE),
                &stages(&COAST),
                11.0,
            )),
            |x| {
                let up = 1000.0 * (x - 0.2).max(0.0) + 7800.0 * (x - 0.5).max(0.0);
                11.0 + 200.0 * x.max(0.0) + up + 4000.0 * (x + 0.3).min(0.0)
            },
        ),
    ];
    all
}

/// All laws, the measured one too, whose definition is its properties.
fn every_law() -> Vec<TorqueLaw> {
    let table = TableLaw::new(&POINTS, 0.5).expect("has points");
    laws().into_iter().map(|(law, _)| law).chain([TorqueLaw::Table(table)]).collect()
}

/// Twists where the law is not smooth.
fn breaks(law: &TorqueLaw) -> Vec<f64> {
    law.pieces().list().iter().map(|piece| piece.from).filter(|x| x.is_finite()).collect()
}

/// Averages over a swing by Simpson's rule from break to break, with a small step.
fn by_summation(law: &TorqueLaw, mean: f64, amplitude: f64) -> (f64, f64) {
    let mut angles = vec![0.0, PI];
    let cosines = breaks(law).into_iter().map(|x| (x - mean) / amplitude);
    angles.extend(cosines.filter(|c| c.abs() < 1.0).map(f64::acos));
    angles.sort_by(f64::total_cmp);
    let (mut torque, mut first) = (0.0, 0.0);
    for pair in angles.windows(2) {
        let count = 2000;
        let step = (pair[1] - pair[0]) / f64::from(count);
        for i in 0..=count {
            let angle = pair[0] + step * f64::from(i);
            let weight = if i == 0 || i == count { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            let value = weight * step / 3.0 * law.torque(mean + amplitude * angle.cos());
            torque += value;
            first += value * angle.cos();
        }
    }
    (torque / PI, 2.0 * first / PI / amplitude)
}

// Source: the definitions, written out beside each law.
#[test]
fn torques_are_those_of_the_definitions() {
    for (law, torque) in laws() {
        for i in -100..=100 {
            let x = f64::from(i) * 0.013;
            let (found, exact) = (law.torque(x), torque(x));
            assert!((found - exact).abs() < 1e-11 * (1.0 + exact.abs()), "{} {x}", law.name());
        }
    }
}

// Source: a curve through points goes through them and has its extremes there.
#[test]
fn the_table_goes_through_its_points_and_keeps_their_shape() {
    let law = TorqueLaw::Table(TableLaw::new(&POINTS, 0.5).expect("has points"));
    for (x, torque) in POINTS {
        assert!((law.torque(x) - torque - 0.5).abs() < 1e-12 * torque.abs());
    }
    for pair in POINTS.windows(2) {
        let ((a, low), (b, high)) = (pair[0], pair[1]);
        let mut last = low;
        for i in 1..=200 {
            let torque = law.torque(a + (b - a) * f64::from(i) / 200.0) - 0.5;
            let step = (torque - last) * (high - low).signum();
            assert!(step >= -1e-12 * high.abs(), "falls back between {a} and {b}");
            assert!(low != high || (torque - low).abs() < 1e-12 * low);
            last = torque;
        }
    }
    // Beyond the ends it goes on straight.
    let slope = law.stiffness(0.9);
    assert!((law.torque(2.9) - law.torque(0.9) - 2.0 * slope).abs() < 1e-9);
    assert!(slope < 0.0);
}

// Source: three points on a line, and a table of two, are a straight law.
#[test]
fn points_on_a_line_are_a_straight_law() {
    let law = TableLaw::new(&[(-1.0, -20.0), (0.5, 10.0), (1.0, 20.0)], 0.0).expect("has points");
    assert!(law.is_linear() && law.torque(3.0) == 60.0);
    assert!(TableLaw::new(&[(0.0, 1.0)], 0.0).is_none());
}

// Source: the sides of each break, a little beside it.
#[test]
fn laws_are_continuous_and_switch_only_where_they_say() {
    for law in every_law() {
        let e = 1e-9;
        for x in breaks(&law) {
            let size = 1.0 + law.torque(x).abs() + 9000.0;
            assert!((law.torque(x + e) - law.torque(x - e)).abs() < 1e-7 * size);
            let jumps = (law.stiffness(x + e) - law.stiffness(x - e)).abs() > 1e-3;
            assert_eq!(law.switching_twists().contains(&x), jumps, "{} at {x}", law.name());
        }
        assert!(law.switching_twists().is_sorted());
        assert!(law.energy(0.0).abs() < 1e-12);
    }
}

// Source: the definition of an odd law, at many twists.
#[test]
fn odd_laws_are_recognised() {
    for law in every_law() {
        let odd = (0..100).map(|i| f64::from(i) * 0.013);
        let odd = odd.into_iter().all(|x| (law.torque(x) + law.torque(-x)).abs() < 1e-9);
        assert_eq!(law.is_odd(), odd, "{}", law.name());
    }
}

proptest! {
    // Source: central differences within smooth parts.
    #[test]
    fn derivatives_agree_with_differences(x in -1.2..1.2_f64) {
        let h = 1e-5;
        for law in every_law() {
            if breaks(&law).iter().any(|at| (at - x).abs() < 2.0 * h) {
                continue;
            }
            let by_difference = |f: &dyn Fn(f64) -> f64| (f(x + h) - f(x - h)) / (2.0 * h);
            let slope = by_difference(&|x| law.energy(x));
            prop_assert!((slope - law.torque(x)).abs() < 1e-5 * (1.0 + slope.abs()));
            let slope = by_difference(&|x| law.torque(x));
            prop_assert!((slope - law.stiffness(x)).abs() < 1e-5 * (1.0 + slope.abs()));
            let slope = by_difference(&|x| law.stiffness(x));
            prop_assert!((slope - law.curvature(x)).abs() < 1e-5 * (10.0 + slope.abs()));
        }
    }

    // Source: the same law as polynomials joined end to end.
    #[test]
    fn pieces_are_the_law(x in -1.5..1.5_f64) {
        for law in every_law() {
            let pieces = law.pieces();
            let size = 1.0 + law.torque(x).abs();
            prop_assert!((pieces.torque(x) - law.torque(x)).abs() < 1e-11 * size);
            prop_assert!((pieces.stiffness(x) - law.stiffness(x)).abs() < 1e-9 * (1.0 + size));
            for a in [-1.0, 2.5, -0.4] {
                let found = pieces.stretched(a).torque(x / a);
                prop_assert!((found - a * law.torque(x)).abs() < 1e-10 * size);
            }
            for other in every_law() {
                let sum = pieces.add(&other.pieces()).torque(x);
                let exact = law.torque(x) + other.torque(x);
                prop_assert!((sum - exact).abs() < 1e-9 * (1.0 + exact.abs()));
            }
        }
    }

    // Source: every twist found has the torque, and between two scan points with a change of sign
    // there is one.
    #[test]
    fn all_twists_of_a_torque_are_found(torque in -400.0..400.0_f64) {
        for law in every_law() {
            let found = law.twists_at(torque);
            prop_assert!(found.is_sorted());
            for x in &found {
                prop_assert!((law.torque(*x) - torque).abs() < 1e-8 * (1.0 + torque.abs()));
            }
            let scan: Vec<f64> = (-3000..=3000).map(|i| f64::from(i) * 1e-3 + 1.234e-5).collect();
            let crossings = scan.windows(2).filter(|pair| {
                (law.torque(pair[0]) - torque) * (law.torque(pair[1]) - torque) < 0.0
            });
            for pair in crossings {
                prop_assert!(found.iter().any(|x| pair[0] <= *x && *x <= pair[1]));
            }
        }
    }

    // Source: the averages by summation.
    #[test]
    fn describing_functions_are_the_averages(
        mean in -0.8..0.8_f64, amplitude in 1e-3..1.5_f64,
    ) {
        for law in every_law() {
            let found = law.describing_function(mean, amplitude);
            let (torque, gain) = by_summation(&law, mean, amplitude);
            let size = 1.0 + torque.abs();
            prop_assert!((found.mean_torque - torque).abs() < 1e-9 * size, "{}", law.name());
            let size = 100.0 + gain.abs() + torque.abs() / amplitude;
            prop_assert!((found.gain - gain).abs() < 1e-9 * size, "{}", law.name());
        }
    }

    // Source: central differences.
    #[test]
    fn derivatives_of_describing_functions_agree_with_differences(
        mean in -0.8..0.8_f64, amplitude in 0.05..1.5_f64,
    ) {
        let h = 1e-5;
        for law in every_law() {
            // At grazing the derivatives have the square-root behaviour that differences miss.
            let near = |x: &f64| ((x - mean).abs() - amplitude).abs() < 3e-3;
            if breaks(&law).iter().any(near) {
                continue;
            }
            let at = |m: f64, a: f64| law.describing_function(m, a);
            let d = at(mean, amplitude);
            let (up, down) = (at(mean + h, amplitude), at(mean - h, amplitude));
            let close = |found: f64, a: f64, b: f64| {
                let slope = (a - b) / (2.0 * h);
                (found - slope).abs() < 2e-4 * (100.0 + slope.abs())
            };
            prop_assert!(close(d.mean_by_mean, up.mean_torque, down.mean_torque), "{}", law.name());
            prop_assert!(close(d.gain_by_mean, up.gain, down.gain), "{}", law.name());
            let (up, down) = (at(mean, amplitude + h), at(mean, amplitude - h));
            prop_assert!(close(d.mean_by_amplitude, up.mean_torque, down.mean_torque));
            prop_assert!(close(d.gain_by_amplitude, up.gain, down.gain), "{}", law.name());
        }
    }

    // Source: the limit of a small swing is the tangent; a negative amplitude is half a turn later.
    #[test]
    fn small_and_negative_swings(mean in -1.0..1.0_f64, amplitude in 0.01..1.0_f64) {
        for law in every_law() {
            if breaks(&law).iter().any(|x| (x - mean).abs() < 1e-6) {
                continue;
            }
            let still = law.describing_function(mean, 0.0);
            prop_assert!((still.mean_torque - law.torque(mean)).abs() < 1e-9);
            let stiffness = law.stiffness(mean);
            prop_assert!((still.gain - stiffness).abs() < 1e-9 * (1.0 + stiffness.abs()));
            let curvature = law.curvature(mean);
            prop_assert!((still.gain_by_mean - curvature).abs() < 1e-7 * (1.0 + curvature.abs()));
            let (a, b) = (law.describing_function(mean, amplitude),
                law.describing_function(mean, -amplitude));
            let turned = DescribingFunction {
                mean_by_amplitude: -b.mean_by_amplitude,
                gain_by_amplitude: -b.gain_by_amplitude,
                ..b
            };
            prop_assert!(a == turned);
        }
    }
}

// Source: the middle of the gap stands for all of it; a flat part without end has its end.
#[test]
fn flat_parts_have_one_twist_that_stands_for_them() {
    let gap = TorqueLaw::Clearance(ClearanceLaw::new(0.3, &cubic(800.0, 0.0, 0.0), 3.0));
    assert_eq!(gap.twists_at(3.0), vec![0.0]);
    let stop = TorqueLaw::OneSided(OneSidedContact::new(0.25, &cubic(600.0, 0.0, 0.0), 0.0));
    assert_eq!(stop.twists_at(0.0), vec![0.25]);
    assert!(stop.twists_at(-1.0).is_empty());
    let coast = PiecewiseLinearLaw::new(&stages(&DRIVE), &stages(&COAST), 0.0);
    assert_eq!(TorqueLaw::PiecewiseLinear(coast).twists_at(0.0), vec![-0.15]);
    let nothing = TorqueLaw::PiecewiseLinear(PiecewiseLinearLaw::new(&[], &[], 0.0));
    assert_eq!(nothing.twists_at(0.0), vec![0.0]);
    assert!(nothing.twists_at(1.0).is_empty());
}

// Source: the first harmonic of c v over the arcs in contact, by summation.
#[test]
fn the_contact_share_is_the_damping_that_acts() {
    for law in every_law() {
        for (mean, amplitude) in [(0.0, 0.1), (0.0, 0.4), (0.1, 0.3), (-0.3, 0.2), (0.6, 0.1)] {
            let count = 400_000;
            let acting = (0..count).map(|i| {
                let angle = PI * (f64::from(i) + 0.5) / f64::from(count);
                let contact = law.in_contact(mean + amplitude * angle.cos());
                if contact { angle.sin().powi(2) } else { 0.0 }
            });
            let share = 2.0 * acting.sum::<f64>() / f64::from(count);
            let found = law.contact_share(mean, amplitude).share;
            assert!((found - share).abs() < 1e-5, "{}: {found} {share}", law.name());
        }
    }
}
