//! Reference problems over lanes.

use halfshaft_numerics::ensemble::{
    Expansion, LaneSystem, Lanes, Plan, RECIPROCALS, SeriesSystem, Task, Trajectory,
    cosine_and_sine, product, sin_cos, square,
};

use super::reference::Duffing;

/// `x'' + c x' + k x + g x³ = P cos(W t)` with parameters `c, k, g, P, W`.
#[derive(Clone, Copy, Debug)]
pub struct DuffingLanes;

impl SeriesSystem for DuffingLanes {
    fn coordinates(&self) -> usize {
        1
    }

    fn parameters(&self) -> usize {
        5
    }

    fn helpers(&self) -> usize {
        3
    }

    #[inline(always)]
    fn expand<L: Lanes>(&self, expansion: &mut Expansion<'_, L>) {
        let terms = expansion.terms;
        let [damping, stiffness, cubic, force, speed] = parameters(expansion.parameters);
        let x = &mut expansion.coordinates[..terms];
        let (squares, rest) = expansion.helpers.split_at_mut(terms);
        let (cosine, sine) = rest.split_at_mut(terms);
        cosine_and_sine(speed * expansion.time, speed, cosine, sine);
        for k in 0..terms - 2 {
            squares[k] = square(&x[..=k]);
            let cube = product(&x[..=k], &squares[..=k]);
            let rate = x[k + 1] * L::splat((k + 1) as f64);
            let sum = force * cosine[k];
            let sum = (-damping).mul_add(rate, sum);
            let sum = (-stiffness).mul_add(x[k], sum);
            let sum = (-cubic).mul_add(cube, sum);
            x[k + 2] = sum * L::splat(RECIPROCALS[k + 1] * RECIPROCALS[k + 2]);
        }
    }
}

impl LaneSystem for DuffingLanes {
    fn dimension(&self) -> usize {
        2
    }

    fn parameters(&self) -> usize {
        5
    }

    #[inline(always)]
    fn derivative<L: Lanes>(&self, time: L, values: &[L], state: &[L], rate: &mut [L]) {
        let [damping, stiffness, cubic, force, speed] = parameters(values);
        let (x, v) = (state[0], state[1]);
        let tangent = cubic.mul_add(x * x, stiffness);
        let sum = force * sin_cos(speed * time).1;
        let sum = (-damping).mul_add(v, sum);
        rate[0] = v;
        rate[1] = (-tangent).mul_add(x, sum);
    }
}

#[inline(always)]
fn parameters<L: Lanes>(values: &[L]) -> [L; 5] {
    [values[0], values[1], values[2], values[3], values[4]]
}

/// Oscillators of Duffing, each with a start of its own, over so many periods of their excitation.
#[derive(Clone, Debug)]
pub struct ManyDuffing {
    pub oscillators: Vec<(Duffing, [f64; 2])>,
    pub periods: f64,
}

impl ManyDuffing {
    /// The driveline's oscillator at speeds from 24 to 28 from displacements from -1 to 1; number 0 is
    /// the one of which the end is known.
    pub fn drivelines(count: usize) -> Self {
        let one = |index: usize| {
            let part = index as f64 / count as f64;
            let frequency = if index == 0 { 26.1 } else { 24.0 + 4.0 * part };
            let start = if index == 0 { 0.1 } else { (17.0 * part).sin() };
            (Duffing { frequency, ..Duffing::DRIVELINE }, [start, 0.0])
        };
        Self { oscillators: (0..count).map(one).collect(), periods: 200.0 }
    }
}

impl Task for ManyDuffing {
    type Memory = ();

    fn begin(&self, index: usize, trajectory: &mut Trajectory<'_>) -> ((), Plan) {
        let (oscillator, start) = &self.oscillators[index];
        trajectory.state.copy_from_slice(start);
        let Duffing { damping, stiffness, cubic, force, frequency } = *oscillator;
        trajectory.parameters.copy_from_slice(&[damping, stiffness, cubic, force, frequency]);
        ((), Plan::to(self.periods * oscillator.period()))
    }
}
