//! Small dense linear algebra.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use halfshaft_numerics::dense::{Matrix, eigenvalues, solve, symmetric_eigen};

/// The stiffness matrix of a chain: its eigenvalues are `4 sin²(π k / (2 (n + 1)))`.
fn chain(order: usize) -> Matrix {
    Matrix::from_fn(order, order, |i, j| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    })
}

fn dense(criterion: &mut Criterion) {
    for order in [1, 2, 4, 20] {
        let matrix = chain(order);
        criterion.bench_function(&format!("symmetric_eigen {order}"), |bencher| {
            bencher.iter(|| symmetric_eigen(black_box(&matrix)));
        });
        let skewed = Matrix::from_fn(order, order, |i, j| matrix[(i, j)] + (i * 7 % 5) as f64);
        criterion.bench_function(&format!("eigenvalues {order}"), |bencher| {
            bencher.iter(|| eigenvalues(black_box(&skewed)));
        });
    }
    for order in [1, 2, 6, 20, 32, 33, 100] {
        let matrix = chain(order);
        let right = vec![1.0; order];
        criterion.bench_function(&format!("solve {order}"), |bencher| {
            bencher.iter(|| solve(black_box(&matrix), black_box(&right)));
        });
    }
}

criterion_group!(benches, dense);
criterion_main!(benches);
