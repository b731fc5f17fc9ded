//! Sets of starts: grids and random ones over states and parameters.

use super::task::{Start, Starts};

/// A number of a start that differs from trajectory to trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Varied {
    /// Component of the state.
    State(usize),
    /// Parameter.
    Parameter(usize),
}

/// A number with the range in which it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Which number.
    pub varied: Varied,
    /// Its least value.
    pub from: f64,
    /// Its largest value.
    pub to: f64,
}

impl Starts {
    /// All combinations of evenly spaced values, so many along each axis with both ends (one: the
    /// middle); the first axis changes fastest. Everything else is as in `base`.
    pub fn grid(base: &Start, axes: &[(Axis, usize)]) -> Self {
        let total = axes.iter().map(|(_, count)| *count).product();
        let start = |index: usize| {
            let (mut start, mut rest) = (base.clone(), index);
            for (axis, count) in axes {
                let at = rest % count;
                rest /= count;
                let share = if *count > 1 { at as f64 / (count - 1) as f64 } else { 0.5 };
                axis.set(&mut start, axis.from + (axis.to - axis.from) * share);
            }
            start
        };
        Self((0..total).map(start).collect())
    }

    /// So many starts with values spread evenly at random over the axes. The same seed gives the same
    /// starts, and more of them begin with those of fewer. Source of the numbers: G. Steele, D. Lea,
    /// C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014 (SplitMix64).
    pub fn random(base: &Start, axes: &[Axis], count: usize, seed: u64) -> Self {
        let mut random = SplitMix(seed);
        let start = |_| {
            let mut start = base.clone();
            for axis in axes {
                axis.set(&mut start, axis.from + (axis.to - axis.from) * random.share());
            }
            start
        };
        Self((0..count).map(start).collect())
    }
}

impl Axis {
    /// Sets the number where the start has it.
    fn set(&self, start: &mut Start, value: f64) {
        let place = match self.varied {
            Varied::State(index) => start.state.get_mut(index),
            Varied::Parameter(index) => start.parameters.get_mut(index),
        };
        if let Some(place) = place {
            *place = value;
        }
    }
}

/// Numbers that look like random ones.
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// From 0 to less than 1, in steps of 2⁻⁵³.
    fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 * (0.5_f64).powi(53)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn base() -> Start {
        Start { time: 0.0, state: vec![1.0, 2.0], parameters: vec![3.0], end: 4.0 }
    }

    // Source: by hand.
    #[test]
    fn grids_hold_all_combinations() {
        let x = Axis { varied: Varied::State(0), from: -1.0, to: 1.0 };
        let p = Axis { varied: Varied::Parameter(0), from: 10.0, to: 20.0 };
        let starts = Starts::grid(&base(), &[(x, 3), (p, 2)]).0;
        let found: Vec<(f64, f64, f64)> =
            starts.iter().map(|s| (s.state[0], s.state[1], s.parameters[0])).collect();
        let expected = [
            (-1.0, 2.0, 10.0),
            (0.0, 2.0, 10.0),
            (1.0, 2.0, 10.0),
            (-1.0, 2.0, 20.0),
            (0.0, 2.0, 20.0),
            (1.0, 2.0, 20.0),
        ];
        assert_eq!(found, expected);
        assert_eq!(Starts::grid(&base(), &[(x, 1)]).0[0].state[0], 0.0);
    }

    // Source: the first outputs of SplitMix64 for the seed 1234567, published with the reference
    // implementation; mean 1/2 and variance 1/12 of an even spread.
    #[test]
    fn random_starts_are_those_of_their_seed() {
        let mut random = SplitMix(1_234_567);
        let first = [random.next(), random.next(), random.next()];
        assert_eq!(
            first,
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]
        );
        let v = Axis { varied: Varied::State(1), from: 5.0, to: 6.0 };
        let many = Starts::random(&base(), &[v], 20_000, 7).0;
        let few = Starts::random(&base(), &[v], 10, 7).0;
        assert_eq!(many[..10], few[..]);
        let shares: Vec<f64> = many.iter().map(|start| start.state[1] - 5.0).collect();
        let mean = shares.iter().sum::<f64>() / shares.len() as f64;
        let variance = shares.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / shares.len() as f64;
        assert!((mean - 0.5).abs() < 0.01 && (variance - 1.0 / 12.0).abs() < 0.003);
        assert!(shares.iter().all(|share| (0.0..1.0).contains(share)));
    }
}
