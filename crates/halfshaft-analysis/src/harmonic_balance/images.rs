//! Responses that are the same but for their phase or sign.

use halfshaft_numerics::harmonics::HarmonicSet;

/// A response and what is the same but for its phase, and its mirror images where the line is odd.
pub(super) fn images(set: &HarmonicSet, u: &[f64], periods: u32, odd: bool) -> Vec<Vec<f64>> {
    let part = std::f64::consts::TAU / f64::from(periods);
    let mut list: Vec<Vec<f64>> =
        (0..periods).map(|shift| turned(set, u, f64::from(shift) * part, 1.0)).collect();
    if odd {
        let half = |shift: u32| (f64::from(shift) + 0.5) * part;
        list.extend((0..periods).map(|shift| turned(set, u, half(shift), -1.0)));
    }
    list
}

/// `sign x(θ + by)`.
pub(super) fn turned(set: &HarmonicSet, u: &[f64], by: f64, sign: f64) -> Vec<f64> {
    let mut out: Vec<f64> = u.iter().map(|x| sign * x).collect();
    for node in out.chunks_exact_mut(set.coefficients()) {
        for (order, place) in set.places().filter(|(order, _)| *order > 0) {
            let (sine, cosine) = (order as f64 * by).sin_cos();
            let (a, b) = (node[place], node[place + 1]);
            (node[place], node[place + 1]) = (a * cosine + b * sine, b * cosine - a * sine);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: the series itself at the shifted phase.
    #[test]
    fn turned_series_are_shifted() {
        let set = HarmonicSet::all(3);
        let u = [0.3, 1.0, -0.4, 0.0, 0.2, 0.05, -0.1];
        let images = images(&set, &u, 3, true);
        assert_eq!(images.len(), 6);
        for (k, image) in images.iter().enumerate() {
            let part = std::f64::consts::TAU / 3.0;
            let (by, sign) =
                if k < 3 { (k as f64 * part, 1.0) } else { ((k as f64 - 2.5) * part, -1.0) };
            let value = set.evaluate(image, 0.7).0;
            assert!((value - sign * set.evaluate(&u, 0.7 + by).0).abs() < 1e-14, "{k}");
        }
    }
}
