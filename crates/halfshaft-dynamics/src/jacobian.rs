//! The Jacobian of a motion, for implicit integrators.

use halfshaft_numerics::dense::Matrix;
use halfshaft_numerics::ode::{Differentiated, System};

use crate::motion::Motion;

/// Step of the differences for the Jacobian, relative to the component or to the least size.
const DIFFERENCE: f64 = 1e-7;
const LEAST_SIZE: f64 = 1e-3;

impl Differentiated for Motion<'_> {
    /// By differences on both sides, in the modes at hand; nothing depends on work and heat.
    fn jacobian(&mut self, t: f64, state: &[f64], out: &mut Matrix) {
        let (n, dimension) = (2 * self.coordinates(), state.len());
        let mut moved = state.to_vec();
        let (mut above, mut below) = (vec![0.0; dimension], vec![0.0; dimension]);
        for column in 0..dimension {
            if column < n {
                let step = DIFFERENCE * state[column].abs().max(LEAST_SIZE);
                moved[column] = state[column] + step;
                self.derivative(t, &moved, &mut above);
                moved[column] = state[column] - step;
                self.derivative(t, &moved, &mut below);
                moved[column] = state[column];
                for row in 0..dimension {
                    out[(row, column)] = (above[row] - below[row]) / (2.0 * step);
                }
            } else {
                (0..dimension).for_each(|row| out[(row, column)] = 0.0);
            }
        }
    }
}
