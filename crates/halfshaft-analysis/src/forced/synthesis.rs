//! Half of the range over a period of a sum of orders, for many channels at once.

use std::f64::consts::TAU;

/// Samples over a period of the highest order.
const SAMPLES: usize = 16;
/// Most samples over the common period.
const MOST_SAMPLES: usize = 1 << 16;
/// Newton steps on the slope from the best sample.
const POLISHING: usize = 3;
/// Change of the phase that ends them, in steps of the samples: the next one would be its square, and
/// the value moves by the square of that.
const SETTLED: f64 = 1e-4;
/// Terms of the Taylor series about a sample: half a step of the samples is a fifth of a radian of the
/// highest order, so the first one left out is below rounding.
const TERMS: usize = 11;
/// Greatest divisor of the lowest order that is tried for a common period.
const MOST_PARTS: u32 = 1000;

/// Whole multiples of a common base for orders (ascending); `None` where they have none.
pub(super) fn multiples(orders: &[f64]) -> Option<Vec<usize>> {
    let lowest = *orders.first()?;
    (1..=MOST_PARTS).find_map(|parts| {
        let base = lowest / f64::from(parts);
        let near = |order: &f64| {
            let multiple = (order / base).round();
            let whole = (order / base - multiple).abs() <= 1e-9 * multiple;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive")]
            let multiple = multiple as usize;
            whole.then_some(multiple)
        };
        let found: Option<Vec<usize>> = orders.iter().map(near).collect();
        found.filter(|found| found.last().is_none_or(|last| last * SAMPLES <= MOST_SAMPLES))
    })
}

/// Adds orders up in time.
pub(super) struct Synthesis {
    multiples: Option<Vec<usize>>,
    /// Cosine and sine of `2π n / N`.
    circle: Vec<(f64, f64)>,
    extremes: Vec<Extreme>,
    values: Vec<f64>,
}

#[derive(Clone, Copy)]
struct Extreme {
    high: f64,
    high_at: usize,
    low: f64,
    low_at: usize,
}

impl Synthesis {
    pub(super) fn new(orders: &[f64], channels: usize) -> Self {
        let multiples = multiples(orders);
        let count = multiples.as_ref().and_then(|m| m.last()).map_or(1, |last| last * SAMPLES);
        #[expect(clippy::cast_precision_loss, reason = "bounded")]
        let point = |n: usize| {
            let (sin, cos) = (TAU * n as f64 / count as f64).sin_cos();
            (cos, sin)
        };
        let start = Extreme { high: 0.0, high_at: 0, low: 0.0, low_at: 0 };
        Self {
            circle: (0..count).map(point).collect(),
            extremes: vec![start; channels],
            values: vec![0.0; channels],
            multiples,
        }
    }

    /// Half ranges into `out`; `re` and `im` are by order and then by channel.
    pub(super) fn half_ranges(&mut self, re: &[Vec<f64>], im: &[Vec<f64>], out: &mut [f64]) {
        let moduli =
            |channel: usize| re.iter().zip(im).map(move |(re, im)| re[channel].hypot(im[channel]));
        let multiples = self.multiples.take();
        match &multiples {
            Some(multiples) if multiples.len() > 1 => {
                self.sample(multiples, re, im);
                for (channel, out) in out.iter_mut().enumerate() {
                    let Extreme { high_at, low_at, .. } = self.extremes[channel];
                    let circle = &self.circle;
                    let wave = Wave { multiples, circle, re, im, channel };
                    *out = 0.5 * (wave.polished(high_at) - wave.polished(low_at));
                }
            }
            // One order is its modulus; without a common period all meet at some time.
            _ => out.iter_mut().enumerate().for_each(|(channel, out)| *out = moduli(channel).sum()),
        }
        self.multiples = multiples;
    }

    /// The highest and lowest sample of each channel.
    fn sample(&mut self, multiples: &[usize], re: &[Vec<f64>], im: &[Vec<f64>]) {
        let count = self.circle.len();
        let none = Extreme { high: f64::NEG_INFINITY, high_at: 0, low: f64::INFINITY, low_at: 0 };
        self.extremes.fill(none);
        for n in 0..count {
            self.values.fill(0.0);
            for ((multiple, re), im) in multiples.iter().zip(re).zip(im) {
                let (cos, sin) = self.circle[(multiple * n) % count];
                for ((value, re), im) in self.values.iter_mut().zip(re).zip(im) {
                    *value += re * cos - im * sin;
                }
            }
            for (extreme, value) in self.extremes.iter_mut().zip(&self.values) {
                if *value > extreme.high {
                    (extreme.high, extreme.high_at) = (*value, n);
                }
                if *value < extreme.low {
                    (extreme.low, extreme.low_at) = (*value, n);
                }
            }
        }
    }
}

/// One channel over the common phase.
struct Wave<'w> {
    multiples: &'w [usize],
    circle: &'w [(f64, f64)],
    re: &'w [Vec<f64>],
    im: &'w [Vec<f64>],
    channel: usize,
}

impl Wave<'_> {
    /// Coefficients of the Taylor series about a sample.
    fn series(&self, sample: usize) -> [f64; TERMS] {
        let mut sums = [0.0; TERMS];
        for ((multiple, re), im) in self.multiples.iter().zip(self.re).zip(self.im) {
            #[expect(clippy::cast_precision_loss, reason = "bounded")]
            let k = *multiple as f64;
            let (cos, sin) = self.circle[(multiple * sample) % self.circle.len()];
            let (re, im) = (re[self.channel], im[self.channel]);
            // Each derivative turns the pair by a right angle.
            let (mut value, mut beside) = (re * cos - im * sin, -(re * sin + im * cos));
            for (term, sum) in (1_u8..).zip(&mut sums) {
                *sum += value;
                let factor = k / f64::from(term);
                (value, beside) = (factor * beside, -factor * value);
            }
        }
        sums
    }

    /// Value at the extreme next to a sample.
    fn polished(&self, sample: usize) -> f64 {
        let series = self.series(sample);
        let slopes = |shift: f64| {
            let (mut value, mut slope, mut curvature) = (0.0, 0.0, 0.0);
            for coefficient in series.iter().rev() {
                curvature = curvature * shift + slope;
                slope = slope * shift + value;
                value = value * shift + coefficient;
            }
            (value, slope, 2.0 * curvature)
        };
        #[expect(clippy::cast_precision_loss, reason = "bounded")]
        let step = TAU / self.circle.len() as f64;
        if series[2] == 0.0 {
            return series[0];
        }
        let mut shift = (-0.5 * series[1] / series[2]).clamp(-step, step);
        for _ in 0..POLISHING {
            let (_, slope, curvature) = slopes(shift);
            if curvature == 0.0 {
                break;
            }
            let next = (shift - slope / curvature).clamp(-step, step);
            let moved = (next - shift).abs();
            shift = next;
            if moved <= SETTLED * step {
                break;
            }
        }
        let (value, ..) = slopes(shift);
        if value.abs() >= series[0].abs() { value } else { series[0] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: cos t + cos 2t / 4 has its maximum 5/4 at 0 and its minimum -3/4 at π; and
    // cos t + cos 2t its minimum -9/8 where cos t = -1/4.
    #[test]
    fn ranges_are_those_of_the_sum_in_time() {
        let mut synthesis = Synthesis::new(&[0.5, 1.0], 2);
        let (re, im) = (vec![vec![1.0, 1.0], vec![0.25, 1.0]], vec![vec![0.0; 2]; 2]);
        let mut out = [0.0; 2];
        synthesis.half_ranges(&re, &im, &mut out);
        assert!((out[0] - 1.0).abs() < 1e-13, "{out:?}");
        assert!((out[1] - (2.0 + 9.0 / 8.0) / 2.0).abs() < 1e-13, "{out:?}");
    }

    #[test]
    fn orders_without_a_common_period_add_up() {
        assert_eq!(multiples(&[0.5, 1.0, 1.5]), Some(vec![1, 2, 3]));
        assert_eq!(multiples(&[1.0, 1.5]), Some(vec![2, 3]));
        assert_eq!(multiples(&[1.0, 2.0_f64.sqrt()]), None);
        let mut synthesis = Synthesis::new(&[1.0, 2.0_f64.sqrt()], 1);
        let mut out = [0.0];
        synthesis.half_ranges(&[vec![3.0], vec![0.0]], &[vec![4.0], vec![2.0]], &mut out);
        assert!((out[0] - 7.0).abs() < 1e-13);
    }
}
