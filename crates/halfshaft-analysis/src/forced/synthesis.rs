//! Half of the range over a period of a sum of orders, for many channels at once.

use std::f64::consts::TAU;

/// Samples over a period of the highest order.
const SAMPLES: usize = 16;
/// Most samples over the common period.
const MOST_SAMPLES: usize = 1 << 16;
/// Newton steps on the slope from the best sample.
const POLISHING: usize = 3;
/// Change of the phase that ends them, in steps of the samples: the value is followed along it to
/// second order, so that what is left out is its cube.
const SETTLED: f64 = 1e-4;
/// Terms of the Taylor series about a sample: half a step of the samples is a fifth of a radian of the
/// highest order, so the first one left out is below rounding.
const TERMS: usize = 12;
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
    /// By order: the factors of its part in the Taylor series.
    weights: Vec<[f64; TERMS]>,
    extremes: Extremes,
    /// Sums of the even and of the odd multiples at a sample.
    even: Vec<f64>,
    odd: Vec<f64>,
}

/// The highest and lowest sample of each channel, with their numbers as they are compared.
struct Extremes {
    high: Vec<f64>,
    high_at: Vec<f64>,
    low: Vec<f64>,
    low_at: Vec<f64>,
}

impl Extremes {
    fn new(channels: usize) -> Self {
        let zeros = || vec![0.0; channels];
        Self { high: zeros(), high_at: zeros(), low: zeros(), low_at: zeros() }
    }

    fn clear(&mut self) {
        self.high.fill(f64::NEG_INFINITY);
        self.low.fill(f64::INFINITY);
        // Of nothing but NaN any sample is as good.
        self.high_at.fill(0.0);
        self.low_at.fill(0.0);
    }

    /// Takes the samples `even ± odd` of the number `at`.
    fn take(&mut self, at: f64, even: &[f64], odd: &[f64], sign: f64) {
        let highs = self.high.iter_mut().zip(&mut self.high_at);
        let lows = self.low.iter_mut().zip(&mut self.low_at);
        for ((even, odd), ((high, high_at), (low, low_at))) in
            even.iter().zip(odd).zip(highs.zip(lows))
        {
            let value = even + sign * odd;
            *high_at = if value > *high { at } else { *high_at };
            *high = if value > *high { value } else { *high };
            *low_at = if value < *low { at } else { *low_at };
            *low = if value < *low { value } else { *low };
        }
    }
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
        Self {
            circle: (0..count).map(point).collect(),
            weights: multiples.iter().flatten().map(|multiple| weights(*multiple)).collect(),
            extremes: Extremes::new(channels),
            even: vec![0.0; channels],
            odd: vec![0.0; channels],
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
                    let (circle, weights) = (&self.circle, &self.weights);
                    let wave = Wave { multiples, circle, weights, re, im, channel };
                    let (high, low) =
                        (self.extremes.high_at[channel], self.extremes.low_at[channel]);
                    *out = 0.5 * (wave.polished(high) - wave.polished(low));
                }
            }
            // One order is its modulus; without a common period all meet at some time.
            _ => out.iter_mut().enumerate().for_each(|(channel, out)| *out = moduli(channel).sum()),
        }
        self.multiples = multiples;
    }

    /// The highest and lowest sample of each channel. Half a common period on, the odd multiples have
    /// the other sign and the even ones are the same.
    fn sample(&mut self, multiples: &[usize], re: &[Vec<f64>], im: &[Vec<f64>]) {
        let count = self.circle.len();
        self.extremes.clear();
        for n in 0..count / 2 {
            self.even.fill(0.0);
            self.odd.fill(0.0);
            for ((multiple, re), im) in multiples.iter().zip(re).zip(im) {
                let (cos, sin) = self.circle[(multiple * n) % count];
                let sums = if multiple % 2 == 0 { &mut self.even } else { &mut self.odd };
                for ((sum, re), im) in sums.iter_mut().zip(re).zip(im) {
                    *sum += re * cos - im * sin;
                }
            }
            #[expect(clippy::cast_precision_loss, reason = "bounded")]
            let (here, across) = (n as f64, (n + count / 2) as f64);
            self.extremes.take(here, &self.even, &self.odd, 1.0);
            self.extremes.take(across, &self.even, &self.odd, -1.0);
        }
    }
}

/// One channel over the common phase.
struct Wave<'w> {
    multiples: &'w [usize],
    circle: &'w [(f64, f64)],
    weights: &'w [[f64; TERMS]],
    re: &'w [Vec<f64>],
    im: &'w [Vec<f64>],
    channel: usize,
}

impl Wave<'_> {
    /// Coefficients of the Taylor series about a sample.
    fn series(&self, sample: usize) -> [f64; TERMS] {
        let mut sums = [0.0; TERMS];
        let orders = self.multiples.iter().zip(self.weights).zip(self.re.iter().zip(self.im));
        for ((multiple, weights), (re, im)) in orders {
            let (cos, sin) = self.circle[(multiple * sample) % self.circle.len()];
            let (re, im) = (re[self.channel], im[self.channel]);
            // Each derivative turns the pair by a right angle.
            let (value, beside) = (re * cos - im * sin, -(re * sin + im * cos));
            for (sums, weights) in sums.chunks_exact_mut(2).zip(weights.chunks_exact(2)) {
                sums[0] += weights[0] * value;
                sums[1] += weights[1] * beside;
            }
        }
        sums
    }

    /// Value at the extreme next to a sample, which is told by its number.
    fn polished(&self, sample: f64) -> f64 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number")]
        let series = self.series(sample as usize);
        #[expect(clippy::cast_precision_loss, reason = "bounded")]
        let step = TAU / self.circle.len() as f64;
        let mut shift = flat(&series).clamp(-step, step);
        let mut best = series[0];
        for _ in 0..POLISHING {
            let (value, slope, curvature) = slopes(&series, shift);
            let moved = if curvature == 0.0 { 0.0 } else { -slope / curvature };
            let moved = moved.clamp(-step - shift, step - shift);
            best = value + moved * (slope + 0.5 * curvature * moved);
            shift += moved;
            if moved.abs() <= SETTLED * step {
                break;
            }
        }
        if best.abs() >= series[0].abs() { best } else { series[0] }
    }
}

/// `k^j / j!`, with the sign that a cosine or sine has after `j` derivatives, two by two.
fn weights(multiple: usize) -> [f64; TERMS] {
    let mut weights = [1.0; TERMS];
    for term in 1..TERMS {
        #[expect(clippy::cast_precision_loss, reason = "bounded")]
        let factor = multiple as f64 / term as f64;
        weights[term] = factor * weights[term - 1];
    }
    for signed in weights.chunks_exact_mut(4) {
        (signed[2], signed[3]) = (-signed[2], -signed[3]);
    }
    weights
}

/// Where the first terms of a series have no slope: near by to third order.
fn flat(series: &[f64; TERMS]) -> f64 {
    let [_, first, second, third, ..] = *series;
    if second == 0.0 {
        return 0.0;
    }
    let root = (second * second - 3.0 * first * third).max(0.0).sqrt();
    -first / (second + root.copysign(second))
}

/// Value, slope and curvature of a series.
fn slopes(series: &[f64; TERMS], shift: f64) -> (f64, f64, f64) {
    let (mut value, mut slope, mut curvature) = (0.0, 0.0, 0.0);
    for coefficient in series.iter().rev() {
        curvature = curvature * shift + slope;
        slope = slope * shift + value;
        value = value * shift + coefficient;
    }
    (value, slope, 2.0 * curvature)
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
