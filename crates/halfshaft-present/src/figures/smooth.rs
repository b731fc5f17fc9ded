//! Smooth lines through few samples.
//!
//! A continuation takes few, exact samples where a curve is calm. Between them the line is the cubic
//! that has the samples' own directions at both ends; it passes through every sample.

/// With this many samples straight pieces are as good.
const ENOUGH: usize = 300;

/// Samples of a branch for drawing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Samples {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) stable: Vec<bool>,
}

impl Samples {
    /// The same with places between neighbours; a place between two samples is stable only if both
    /// are. The longest lists are cut to the shortest.
    pub(super) fn smoothed(&self) -> Self {
        let count = self.x.len().min(self.y.len()).min(self.stable.len());
        if !(3..ENOUGH).contains(&count) {
            return self.clone();
        }
        let pieces = (ENOUGH / count).clamp(2, 12);
        let (x, y) = (&self.x[..count], &self.y[..count]);
        let scale = (width(x), width(y));
        let mut drawn = Self { x: Vec::new(), y: Vec::new(), stable: Vec::new() };
        for row in 0..count {
            drawn.push(x[row], y[row], self.stable[row]);
            if row + 1 == count {
                break;
            }
            let stable = self.stable[row] && self.stable[row + 1];
            for step in 1..pieces {
                let share = step as f64 / pieces as f64;
                let (x, y) = between(x, y, row, share, scale);
                drawn.push(x, y, stable);
            }
        }
        drawn
    }

    fn push(&mut self, x: f64, y: f64, stable: bool) {
        self.x.push(x);
        self.y.push(y);
        self.stable.push(stable);
    }
}

fn width(values: &[f64]) -> f64 {
    let (low, high) = crate::reading::bounds(values.iter().copied()).unwrap_or((0.0, 1.0));
    if high > low { high - low } else { 1.0 }
}

/// A place between the samples `row` and `row + 1`, by the cubic of Catmull and Rom over the square
/// root of the chords, which makes no loops.
fn between(x: &[f64], y: &[f64], row: usize, share: f64, scale: (f64, f64)) -> (f64, f64) {
    let last = x.len() - 1;
    let knot = |from: usize, to: usize| {
        let chord = ((x[to] - x[from]) / scale.0).hypot((y[to] - y[from]) / scale.1);
        chord.sqrt().max(1e-9)
    };
    let middle = knot(row, row + 1);
    let before = row.checked_sub(1).map(|before| (before, knot(before, row)));
    let after = (row + 2 <= last).then(|| (row + 2, knot(row + 1, row + 2)));
    let at = |values: &[f64]| {
        let (from, to) = (values[row], values[row + 1]);
        let chord = (to - from) / middle;
        // The direction at a sample: the parabola through it and its neighbours.
        let blend = |other: f64, gap: f64| (other * middle + chord * gap) / (middle + gap);
        let start = before.map_or(chord, |(index, gap)| blend((from - values[index]) / gap, gap));
        let end = after.map_or(chord, |(index, gap)| blend((values[index] - to) / gap, gap));
        hermite(from, to, start * middle, end * middle, share)
    };
    (at(x), at(y))
}

fn hermite(from: f64, to: f64, start: f64, end: f64, t: f64) -> f64 {
    let (square, cube) = (t * t, t * t * t);
    (2.0 * cube - 3.0 * square + 1.0) * from
        + (cube - 2.0 * square + t) * start
        + (3.0 * square - 2.0 * cube) * to
        + (cube - square) * end
}

#[cfg(test)]
mod tests {
    use super::Samples;

    fn circle(count: u32) -> Samples {
        let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(count);
        let (y, x) = (0..=count).map(|k| turn(k).sin_cos()).unzip();
        Samples { x, y, stable: vec![true; count as usize + 1] }
    }

    /// Largest distance from the unit circle, its ends left out.
    fn error(samples: &Samples) -> f64 {
        let inner = samples.x.len() / 8..samples.x.len() * 7 / 8;
        let off = |row: usize| (samples.x[row].hypot(samples.y[row]) - 1.0).abs();
        inner.map(off).fold(0.0, f64::max)
    }

    /// Oracle: a circle, and the order of a cubic with such directions: a third of the step makes at
    /// least a sixth of the error.
    #[test]
    fn lines_follow_the_curve_between_samples() {
        let (coarse, fine) = (error(&circle(16).smoothed()), error(&circle(48).smoothed()));
        // Straight pieces are off by 1 − cos(π/16), 2 %.
        assert!(coarse < 2e-3 && fine < coarse / 6.0, "{coarse} {fine}");
    }

    /// Oracle: the contract: samples stay, in their order; between them both must be stable.
    #[test]
    fn samples_stay_where_they_are() {
        let mut samples = circle(12);
        samples.stable[4] = false;
        let drawn = samples.smoothed();
        let pieces = (drawn.x.len() - 1) / 12;
        for row in 0..=12 {
            assert_eq!(drawn.x[row * pieces], samples.x[row]);
            assert_eq!(drawn.stable[row * pieces], samples.stable[row]);
        }
        assert!(!drawn.stable[4 * pieces - 1] && !drawn.stable[4 * pieces + 1]);
        // Samples that are no numbers, and too few of them, are handed on.
        let odd = Samples { x: vec![1.0, f64::NAN, 2.0], y: vec![0.0; 3], stable: vec![true; 3] };
        assert!(odd.smoothed().x.len() > 3);
        let two = Samples { x: vec![1.0, 2.0], y: vec![0.0; 2], stable: vec![true; 2] };
        assert_eq!(two.smoothed(), two);
    }
}
