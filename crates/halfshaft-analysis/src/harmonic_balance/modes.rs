//! The variational equation of a line in a few of its modes.

use halfshaft_numerics::Complex;
use halfshaft_numerics::dense::{Matrix, solve};

use super::panels::{TERMS, Tangent};
use super::structure::{Structure, axpy, torque};

/// Modes with unit mass: `y'' + C y' + ω² y + Σ w f = 0`.
#[derive(Clone, Debug)]
pub(super) struct Modes {
    /// `ω²`, 1/s²; last that of the motion as a whole, where it counts.
    pub(super) squares: Vec<f64>,
    /// `C` row by row, 1/s.
    pub(super) damping: Vec<f64>,
    /// Twist of each nonlinear connection in each mode, connection by connection.
    pub(super) directions: Vec<f64>,
    /// Indices of these connections, ascending.
    pub(super) connections: Vec<usize>,
    /// Whether the motion as a whole is the last mode.
    pub(super) whole: bool,
}

impl Modes {
    /// Twists of the nonlinear connections by unit torques at each, at `nu` rad/s, with springs of the
    /// stiffness `held` in their places.
    pub(super) fn receptance(&self, nu: f64, held: &[f64]) -> Option<Vec<Complex>> {
        let n = self.squares.len();
        let mut matrix = Matrix::zeros(2 * n, 2 * n);
        for i in 0..n {
            for j in 0..n {
                let directions = self.directions.chunks_exact(n).zip(held);
                let mut real: f64 = directions.map(|(w, k)| k * w[i] * w[j]).sum();
                if i == j {
                    real += self.squares[i] - nu * nu;
                }
                let imaginary = nu * self.damping[i * n + j];
                matrix[(i, j)] = real;
                matrix[(n + i, n + j)] = real;
                matrix[(i, n + j)] = -imaginary;
                matrix[(n + i, j)] = imaginary;
            }
        }
        let mut twists = Vec::new();
        for w in self.directions.chunks_exact(n) {
            let mut load = w.to_vec();
            load.resize(2 * n, 0.0);
            let x = solve(&matrix, &load).ok()?;
            for other in self.directions.chunks_exact(n) {
                let of = |x: &[f64]| other.iter().zip(x).map(|(w, x)| w * x).sum();
                twists.push(Complex::new(of(&x[..n]), of(&x[n..])));
            }
        }
        Some(twists)
    }
}

impl Structure for Modes {
    fn coordinates(&self) -> usize {
        self.squares.len()
    }

    fn columns(&self) -> usize {
        2 * self.squares.len() - usize::from(self.whole)
    }

    fn connections(&self) -> &[usize] {
        &self.connections
    }

    fn start(&self, speed: f64, set: &mut dyn FnMut(usize, usize, &[f64])) {
        let n = self.squares.len();
        let angles = self.columns() - n;
        let mut unit = vec![0.0; n];
        for column in 0..self.columns() {
            let (power, mode) = if column < angles { (0, column) } else { (1, column - angles) };
            unit.fill(0.0);
            unit[mode] = if power == 0 { 1.0 } else { speed };
            set(column, power, &unit);
        }
    }

    #[inline(always)]
    fn recur<const W: usize, const FUSED: bool>(
        &self,
        tangents: &[Tangent],
        degree: usize,
        y: &mut [[f64; W]],
        twists: &mut [[f64; W]],
        net: &mut [[f64; W]],
    ) {
        let n = self.squares.len();
        for (w, row) in self.directions.chunks_exact(n).zip(twists.chunks_exact_mut(TERMS)) {
            row[0] = twist::<W, FUSED>(w, &y[..n]);
        }
        for power in 0..degree - 1 {
            let (known, later) = y.split_at_mut((power + 2) * n);
            let (now, rates) = known[power * n..].split_at(n);
            let factor = -((power + 1) as f64);
            for (row, net) in self.damping.chunks_exact(n).zip(net.iter_mut()) {
                let drag = twist::<W, FUSED>(row, rates);
                *net = [0.0; W];
                axpy::<W, FUSED>(factor, &drag, net);
            }
            let parts = self.directions.chunks_exact(n).zip(tangents);
            for ((w, tangent), row) in parts.zip(twists.chunks_exact_mut(TERMS)) {
                row[power + 1] = twist::<W, FUSED>(w, rates);
                let torque = torque::<W, FUSED>(tangent, row, power);
                w.iter()
                    .zip(net.iter_mut())
                    .for_each(|(w, net)| axpy::<W, FUSED>(-w, &torque, net));
            }
            let scale = 1.0 / ((power + 1) * (power + 2)) as f64;
            for (((q, net), square), y) in
                later[..n].iter_mut().zip(net.iter_mut()).zip(&self.squares).zip(now)
            {
                axpy::<W, FUSED>(-square, y, net);
                *q = [0.0; W];
                axpy::<W, FUSED>(scale, net, q);
            }
        }
    }

    fn finish(&self, power: usize, values: &[f64], set: &mut dyn FnMut(usize, f64)) {
        let angles = self.columns() - self.squares.len();
        if power == 0 {
            values[..angles].iter().enumerate().for_each(|(row, value)| set(row, *value));
        } else {
            values.iter().enumerate().for_each(|(row, value)| set(angles + row, *value));
        }
    }
}

/// `Σ w y` in all lanes.
#[inline(always)]
fn twist<const W: usize, const FUSED: bool>(w: &[f64], y: &[[f64; W]]) -> [f64; W] {
    let mut out = [0.0; W];
    w.iter().zip(y).for_each(|(w, y)| axpy::<W, FUSED>(*w, y, &mut out));
    out
}
