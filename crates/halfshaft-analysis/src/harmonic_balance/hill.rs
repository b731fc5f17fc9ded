//! Floquet multipliers by Hill's method: exponents from the harmonics of a response alone, without
//! integration.
//!
//! A small change `e^(λθ) s(θ)` of a response, with `s` as periodic as the response, satisfies
//!
//! ```text
//! [ λ² M ω² + λ (2 M ω² D + ω C) + M ω² D² + ω C D + K ] s = 0
//! ```
//!
//! where `D` differentiates Fourier coefficients and `C`, `K` multiply by the tangent damping and
//! stiffness along the response. Truncated, this quadratic eigenproblem has far more exponents than
//! the line has multipliers: each multiplier comes with all its shifts `λ + i j`, and the shifts near
//! the border of the truncation are wrong. Each family of shifts has one member whose eigenvector is
//! centred about order zero; those are taken, the best converged first. Sources: G. von Groll, D. J.
//! Ewins, *J. Sound Vib.* 241 (2001) 223; A. Lazarus, O. Thomas, *C. R. Mécanique* 338 (2010) 510; the
//! choice by the eigenvector: B. Bentvelsen, A. Lazarus, *Nonlinear Dyn.* 91 (2018) 1349.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_numerics::dense::{Lu, Matrix, eigen};
use halfshaft_numerics::harmonics::{HarmonicSet, Sampler, Spectrum, add_product};

use super::monodromy::Orbit;
use super::problem::Failure;

/// Orders beyond those of the response.
const BEYOND: usize = 12;
/// Samples a wave of the highest order.
const SAMPLES_PER_WAVE: usize = 8;
/// The strip of centres over the distance of shifts: its ends keep away from 0 and ±1/2, where those
/// of real multipliers are.
const STRIP: (f64, f64) = (-0.4, 0.6);

/// The multipliers of an orbit, largest modulus first; of half a period for one that mirrors itself
/// then.
pub(super) fn multipliers(
    equations: &EquationsOfMotion,
    orbit: &Orbit<'_>,
) -> Result<Vec<Complex>, Failure> {
    let set = orbit.set.up_to(orbit.set.highest() + BEYOND);
    let space = Space::new(equations);
    let companion = companion(equations, orbit, &set, &space)?;
    let found = eigen(&companion).map_err(|_| Failure::NotConverged)?;
    let wanted = 2 * space.count();
    // Odd orders shift by two.
    let apart = if set.is_odd() { 2.0 } else { 1.0 };
    let mut candidates: Vec<(f64, Complex)> = Vec::new();
    for (value, vector) in found.values.iter().zip(&found.vectors) {
        let shape = Shape::of(vector, &set, space.count());
        let centre = shape.centre / apart;
        if centre > STRIP.0 && centre <= STRIP.1 {
            candidates.push((shape.spread, *value));
        }
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    candidates.truncate(wanted);
    if candidates.len() < wanted {
        return Err(Failure::NotConverged);
    }
    let of = |(_, exponent): &(f64, Complex)| {
        if set.is_odd() {
            -exponent.scaled(std::f64::consts::PI).exp()
        } else {
            exponent.scaled(std::f64::consts::TAU).exp()
        }
    };
    let mut values: Vec<Complex> = candidates.iter().map(of).map(real_where_real).collect();
    if space.with_angle {
        without_angle(&mut values);
    }
    values.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
    Ok(values)
}

/// Rounding leaves real multipliers an imaginary part.
fn real_where_real(value: Complex) -> Complex {
    if value.im.abs() <= 1e-9 * value.modulus() { Complex::from(value.re) } else { value }
}

/// The angle of a free line as a whole is no part of its responses.
fn without_angle(values: &mut Vec<Complex>) {
    let away = |value: &Complex| (*value - Complex::from(1.0)).modulus();
    let nearest = (0..values.len()).min_by(|a, b| away(&values[*a]).total_cmp(&away(&values[*b])));
    if let Some(nearest) = nearest {
        values.swap_remove(nearest);
    }
}

/// Coordinates without the motion as a whole, where nothing else depends on that.
struct Space {
    /// Angles of the groups, coordinate by coordinate.
    columns: Vec<Vec<f64>>,
    /// Whether the angle of the whole is among them.
    with_angle: bool,
}

impl Space {
    fn new(equations: &EquationsOfMotion) -> Self {
        let groups = equations.groups();
        let free = equations.rigid.as_ref().filter(|rigid| rigid.ground_damping == 0.0);
        let Some(rigid) = free else {
            let unit = |at: usize| (0..groups).map(|g| f64::from(u8::from(g == at))).collect();
            let with_angle = equations.rigid.is_some();
            return Self { columns: (0..groups).map(unit).collect(), with_angle };
        };
        let tree = equations.network.tree.len();
        let mut columns = Vec::with_capacity(tree);
        for edge in 0..tree {
            let mut unit = vec![0.0; tree];
            unit[edge] = 1.0;
            let mut angles = vec![0.0; groups];
            equations.group_angles(&unit, &mut angles);
            let mean = rigid.mean(&angles);
            angles.iter_mut().zip(&rigid.speeds).for_each(|(q, r)| *q -= mean * r);
            columns.push(angles);
        }
        Self { columns, with_angle: false }
    }

    fn count(&self) -> usize {
        self.columns.len()
    }

    fn matrix(&self, diagonal: &[f64]) -> Matrix {
        let entry = |a: &Vec<f64>, b: &Vec<f64>| -> f64 {
            a.iter().zip(b).zip(diagonal).map(|((a, b), m)| a * b * m).sum()
        };
        let n = self.count();
        Matrix::from_fn(n, n, |i, j| entry(&self.columns[i], &self.columns[j]))
    }

    fn twists(&self, equations: &EquationsOfMotion, connection: usize) -> Vec<f64> {
        self.columns.iter().map(|column| equations.twist(connection, column)).collect()
    }
}

/// The quadratic problem as a linear one of twice the size.
fn companion(
    equations: &EquationsOfMotion,
    orbit: &Orbit<'_>,
    set: &HarmonicSet,
    space: &Space,
) -> Result<Matrix, Failure> {
    let (n, m) = (space.count(), set.coefficients());
    let size = n * m;
    let speed = orbit.speed;
    let turn = turning(set);
    // Damping over ω, and stiffness with what damping adds over ω².
    let mut damping = Matrix::zeros(size, size);
    let mut stiffness = Matrix::zeros(size, size);
    let ground = space.matrix(&equations.ground_damping);
    for (i, j) in pairs(n) {
        add_multiple(&mut damping, (i, j), m, ground[(i, j)] / speed);
    }
    for index in 0..equations.connections.len() {
        let twists = space.twists(equations, index);
        let (k, c) = operators(equations, orbit, set, index);
        for (i, j) in pairs(n) {
            let factor = twists[i] * twists[j];
            if factor != 0.0 {
                add_block(&mut stiffness, (i, j), m, &k, factor / (speed * speed));
                add_block(&mut damping, (i, j), m, &c, factor / speed);
            }
        }
    }
    let spun = apply_right(&damping, &turn, n, m);
    stiffness.as_mut_slice().iter_mut().zip(spun.as_slice()).for_each(|(k, c)| *k += c);
    let mass = Lu::new(&space.matrix(&equations.inertia)).map_err(|_| Failure::Singular)?;
    divide(&mass, &mut damping, n, m)?;
    divide(&mass, &mut stiffness, n, m)?;
    let mut out = Matrix::zeros(2 * size, 2 * size);
    for row in 0..size {
        out[(row, size + row)] = 1.0;
        for column in 0..size {
            out[(size + row, column)] = -stiffness[(row, column)];
            out[(size + row, size + column)] = -damping[(row, column)];
        }
    }
    for i in 0..n {
        for (order, place) in set.places().filter(|(order, _)| *order > 0) {
            let nu = order as f64;
            for at in [place, place + 1] {
                out[(size + i * m + at, i * m + at)] += nu * nu;
            }
            out[(size + i * m + place, size + i * m + place + 1)] -= 2.0 * nu;
            out[(size + i * m + place + 1, size + i * m + place)] += 2.0 * nu;
        }
    }
    Ok(out)
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)))
}

/// Derivative by the phase, `m` by `m`.
fn turning(set: &HarmonicSet) -> Vec<f64> {
    let m = set.coefficients();
    let mut out = vec![0.0; m * m];
    for (order, place) in set.places().filter(|(order, _)| *order > 0) {
        out[place * m + place + 1] = order as f64;
        out[(place + 1) * m + place] = -(order as f64);
    }
    out
}

/// What multiplies by the tangent stiffness and by the tangent damping of a connection.
fn operators(
    equations: &EquationsOfMotion,
    orbit: &Orbit<'_>,
    set: &HarmonicSet,
    index: usize,
) -> (Vec<f64>, Vec<f64>) {
    let m = set.coefficients();
    let connection = &equations.connections[index];
    let known = orbit.twists.iter().find(|(connection, _)| *connection == index);
    let (mut k, mut c) = (vec![0.0; m * m], vec![0.0; m * m]);
    let Some((_, twist)) = known else {
        for at in 0..m {
            k[at * m + at] = connection.law.stiffness(0.0);
            c[at * m + at] = connection.damping;
        }
        return (k, c);
    };
    let count = (SAMPLES_PER_WAVE * set.highest()).max(256).next_power_of_two();
    let mut sampler = Sampler::new(count);
    let (mut x, mut v) = (vec![0.0; count], vec![0.0; count]);
    sampler.samples(orbit.set, twist, &mut x);
    let mut rate = vec![0.0; twist.len()];
    super::alternating::differentiate(orbit.set, twist, orbit.speed, &mut rate);
    sampler.samples(orbit.set, &rate, &mut v);
    let mut spectrum = Spectrum::default();
    let mut slopes: Vec<f64> = x.iter().map(|x| connection.law.stiffness(*x)).collect();
    sampler.spectrum(&mut slopes, &mut spectrum);
    add_product(set, &spectrum, 1.0, &mut k);
    let mut slopes: Vec<f64> =
        x.iter().zip(&v).map(|(x, v)| connection.resistance_slope(*x, *v)).collect();
    sampler.spectrum(&mut slopes, &mut spectrum);
    add_product(set, &spectrum, 1.0, &mut c);
    (k, c)
}

fn add_multiple(matrix: &mut Matrix, (i, j): (usize, usize), m: usize, factor: f64) {
    for at in 0..m {
        matrix[(i * m + at, j * m + at)] += factor;
    }
}

fn add_block(matrix: &mut Matrix, (i, j): (usize, usize), m: usize, block: &[f64], factor: f64) {
    for (row, values) in block.chunks_exact(m).enumerate() {
        let target = &mut matrix.row_mut(i * m + row)[j * m..(j + 1) * m];
        target.iter_mut().zip(values).for_each(|(t, v)| *t += factor * v);
    }
}

/// `A (I ⊗ B)`.
fn apply_right(a: &Matrix, b: &[f64], n: usize, m: usize) -> Matrix {
    let mut out = Matrix::zeros(n * m, n * m);
    for row in 0..n * m {
        for j in 0..n {
            for k in 0..m {
                let factor = a[(row, j * m + k)];
                if factor != 0.0 {
                    let target = &mut out.row_mut(row)[j * m..(j + 1) * m];
                    let values = &b[k * m..(k + 1) * m];
                    target.iter_mut().zip(values).for_each(|(t, v)| *t += factor * v);
                }
            }
        }
    }
    out
}

/// `(M⁻¹ ⊗ I) A` in place.
fn divide(mass: &Lu, a: &mut Matrix, n: usize, m: usize) -> Result<(), Failure> {
    let mut right = vec![0.0; n];
    for at in 0..m {
        for column in 0..n * m {
            for (i, value) in right.iter_mut().enumerate() {
                *value = a[(i * m + at, column)];
            }
            mass.solve_in_place(&mut right).map_err(|_| Failure::Singular)?;
            for (i, value) in right.iter().enumerate() {
                a[(i * m + at, column)] = *value;
            }
        }
    }
    Ok(())
}

/// About which order an eigenvector is centred, and how far it spreads about zero.
struct Shape {
    centre: f64,
    spread: f64,
}

impl Shape {
    fn of(vector: &[Complex], set: &HarmonicSet, n: usize) -> Self {
        let m = set.coefficients();
        let (mut total, mut first, mut second) = (0.0, 0.0, 0.0);
        for i in 0..n {
            for (order, place) in set.places() {
                let a = vector[i * m + place];
                if order == 0 {
                    total += a.modulus().powi(2);
                    continue;
                }
                let b = vector[i * m + place + 1];
                // a cos + b sin = (a - i b)/2 e^(ikθ) + (a + i b)/2 e^(-ikθ).
                let turned = Complex::new(-b.im, b.re);
                let up = 0.25 * (a - turned).modulus().powi(2);
                let down = 0.25 * (a + turned).modulus().powi(2);
                let k = order as f64;
                total += up + down;
                first += k * (up - down);
                second += k * k * (up + down);
            }
        }
        Self { centre: first / total, spread: second / total }
    }
}
