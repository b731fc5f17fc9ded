//! All real roots of polynomials as they arise in static torque and response equations.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use halfshaft_numerics::polynomial::Polynomial;

fn roots(criterion: &mut Criterion) {
    let cases: [(&str, usize, &[f64]); 8] = [
        ("quadratic, two roots", 2, &[2.0, -3.0, 1.0]),
        // Steady twist of the softening half-shaft at three quarters of its torque capacity.
        ("cubic, three roots", 3, &[-5900.0, 6420.0, 0.0, -642.0]),
        ("cubic, one root", 1, &[-5900.0, 6420.0, 0.0, 642.0]),
        ("cubic, hardly cubic", 1, &[-850.0, 6420.0, 0.0, 1e-30]),
        ("cubic, wild", 1, &[-850.0, 6420.0, 0.0, 1e-150]),
        ("quartic, four roots", 4, &[24.0, -50.0, 35.0, -10.0, 1.0]),
        ("quintic, five roots", 5, &[-120.0, 274.0, -225.0, 85.0, -15.0, 1.0]),
        (
            "degree 9, nine roots",
            9,
            &[-0.02, 9.0, 0.0, -120.0, 0.0, 432.0, 0.0, -576.0, 0.0, 256.0],
        ),
    ];
    let mut group = criterion.benchmark_group("real_roots");
    for (name, count, coefficients) in cases {
        // A benchmark only of what is also right.
        assert_eq!(Polynomial::new(coefficients).real_roots().len(), count, "{name}");
        group.bench_function(name, |bencher| {
            bencher.iter(|| Polynomial::new(black_box(coefficients)).real_roots());
        });
    }
    group.finish();

    let cubic = Polynomial::new([-5900.0, 6420.0, 0.0, -642.0]);
    criterion.bench_function("evaluate a cubic", |bencher| {
        bencher.iter(|| black_box(&cubic).evaluate(black_box(1.2)));
    });
}

criterion_group!(benches, roots);
criterion_main!(benches);
