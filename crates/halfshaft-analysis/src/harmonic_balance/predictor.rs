//! Where the next sample of a curve is expected: beyond the tangent, from the last two or three samples.
//!
//! Newton's method then needs one step where it would need two from the tangent.

use halfshaft_numerics::harmonics::HarmonicSet;

use super::problem::Metric;
use super::tracer::{Sample, refit};

/// Directions of neighbours that differ by more than this cosine are not fitted together.
const LEAST_TURN: f64 = 0.5;
/// Steps longer than so many times the way to a sample are not extrapolated from it.
const LONGEST: f64 = 3.0;
/// Samples from which the next is predicted.
pub(super) const PREDICTED_FROM: usize = 3;

/// A sample of a curve: its coordinates, and its direction of any length.
pub(super) struct Waypoint {
    pub(super) place: Vec<f64>,
    pub(super) direction: Vec<f64>,
}

/// Moves a prediction along the tangent `along` (of unit length under `dot`) to the polynomial through the
/// last samples, the latest first, that has the directions of all: of third degree for two, of fifth for
/// three. Its variable is the way along the tangent, by which the next sample is found.
fn bend(
    recent: &[Waypoint],
    dot: &dyn Fn(&[f64], &[f64]) -> f64,
    step: f64,
    along: &[f64],
    point: &mut [f64],
) {
    let Some((last, earlier)) = recent.split_first() else { return };
    let mut known: Vec<Known<'_>> = Vec::with_capacity(earlier.len());
    for waypoint in earlier {
        let place = Known::new(last, waypoint, dot, along);
        // In order, and near enough to tell what comes.
        let nearest = known.last().map_or(0.0, |known| known.way);
        let tells = place.way < nearest && step <= -LONGEST * place.way;
        if !tells {
            break;
        }
        known.push(place);
    }
    let fitting = known.iter().take_while(|known| known.turn.is_some()).count();
    if let (Some(before), 0) = (known.first(), fitting) {
        // Directions too far apart: the chord alone.
        let square = (step / before.way).powi(2);
        for ((x, back), along) in point.iter_mut().zip(&before.back).zip(along) {
            *x += square * (back - before.way * along);
        }
        return;
    }
    known.truncate(fitting);
    let ways: Vec<f64> = std::iter::once(0.0).chain(known.iter().map(|k| k.way)).collect();
    let weights = hermite(&ways, step);
    // The latest sample's direction, of which the prediction has a share already.
    let own = weights[0].1 - step;
    point.iter_mut().zip(along).for_each(|(x, along)| *x += own * along);
    for (place, (value, slope)) in known.iter().zip(&weights[1..]) {
        let slope = slope / place.turn.unwrap_or(1.0);
        for ((x, back), direction) in point.iter_mut().zip(&place.back).zip(place.direction) {
            *x += value * back + slope * direction;
        }
    }
}

/// Where a step along a direction from the latest of the recent samples is expected to end.
pub(super) fn predicted(
    recent: &[&Sample],
    set: &HarmonicSet,
    metric: &Metric,
    step: f64,
    (along, along_p): (&[f64], f64),
) -> (Vec<f64>, f64) {
    let waypoint = |sample: &&Sample| Waypoint {
        place: joined(&sample.set, set, &sample.u, &[sample.p]),
        direction: joined(&sample.set, set, &sample.tangent, &[sample.tangent_p]),
    };
    let list: Vec<Waypoint> = recent.iter().map(waypoint).collect();
    let along = joined(set, set, along, &[along_p]);
    let m = along.len() - 1;
    let dot = |a: &[f64], b: &[f64]| metric.dot((&a[..m], a[m]), (&b[..m], b[m]));
    let mut point = ahead(&list, &dot, step, &along);
    let p = point.pop().unwrap_or(f64::NAN);
    (point, p)
}

/// Coefficients over another set of harmonics with parameters behind them.
pub(super) fn joined(
    from: &HarmonicSet,
    to: &HarmonicSet,
    u: &[f64],
    parameters: &[f64],
) -> Vec<f64> {
    let mut whole = refit(from, to, 1, u);
    whole.extend_from_slice(parameters);
    whole
}

/// The point a step ahead of the first waypoint: along the tangent, and bent.
pub(super) fn ahead(
    list: &[Waypoint],
    dot: &dyn Fn(&[f64], &[f64]) -> f64,
    step: f64,
    along: &[f64],
) -> Vec<f64> {
    let Some(last) = list.first() else { return Vec::new() };
    let mut point: Vec<f64> = last.place.iter().zip(along).map(|(x, t)| x + step * t).collect();
    bend(list, dot, step, along, &mut point);
    point
}

/// An earlier sample as the latest sees it.
struct Known<'w> {
    /// Way along the last tangent, negative behind the latest.
    way: f64,
    /// From the latest sample to it.
    back: Vec<f64>,
    direction: &'w [f64],
    /// Share of its direction in the last tangent; `None` where they point apart.
    turn: Option<f64>,
}

impl<'w> Known<'w> {
    fn new(
        last: &Waypoint,
        waypoint: &'w Waypoint,
        dot: &dyn Fn(&[f64], &[f64]) -> f64,
        along: &[f64],
    ) -> Self {
        let back: Vec<f64> = waypoint.place.iter().zip(&last.place).map(|(a, b)| a - b).collect();
        let direction = &waypoint.direction[..];
        let turn = dot(direction, along);
        let fits = turn > LEAST_TURN * dot(direction, direction).sqrt();
        Self { way: dot(&back, along), back, direction, turn: fits.then_some(turn) }
    }
}

/// Weights of values and slopes at the nodes in the Hermite polynomial through them at `s`.
fn hermite(nodes: &[f64], s: f64) -> Vec<(f64, f64)> {
    let of = |(at, node): (usize, &f64)| {
        let others = || nodes.iter().enumerate().filter(move |(other, _)| *other != at);
        let basis: f64 = others().map(|(_, other)| (s - other) / (node - other)).product();
        let slope: f64 = others().map(|(_, other)| 1.0 / (node - other)).sum();
        let away = s - node;
        ((1.0 - 2.0 * away * slope) * basis * basis, away * basis * basis)
    };
    nodes.iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: curves of third and fifth degree, which are predicted exactly from two and three samples.
    #[test]
    fn polynomials_are_predicted_exactly() {
        for (count, fifth) in [(2, 0.0), (3, 0.4)] {
            let more = |s: f64| fifth * s.powi(5) - 2.0 * fifth * s.powi(4);
            let curve = |s: f64| vec![0.3 * s * s - 0.1 * s.powi(3) + more(s), 0.2 * s.powi(3), s];
            let slope = |s: f64| {
                let more = 5.0 * fifth * s.powi(4) - 8.0 * fifth * s.powi(3);
                [0.6 * s - 0.3 * s * s + more, 0.6 * s * s, 1.0]
            };
            let waypoint = |(s, scale): (f64, f64)| Waypoint {
                place: curve(s),
                direction: slope(s).iter().map(|x| scale * x).collect(),
            };
            let list = [(0.0, 1.0), (-0.3, 0.7), (-0.5, 0.9)];
            let list: Vec<Waypoint> = list.into_iter().take(count).map(waypoint).collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            // The last tangent is along the third coordinate, so that the way along it is that.
            let (step, mut point) = (0.4, vec![0.0, 0.0, 0.4]);
            bend(&list, &dot, step, &[0.0, 0.0, 1.0], &mut point);
            for (x, exact) in point.iter().zip(curve(step)) {
                assert!((x - exact).abs() < 1e-14, "{point:?}");
            }
        }
    }

    // Source: by hand. One sample tells no more than its tangent, one that points away only its place.
    #[test]
    fn what_does_not_fit_is_left_out() {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let waypoint = |place: [f64; 2], direction: [f64; 2]| Waypoint {
            place: place.to_vec(),
            direction: direction.to_vec(),
        };
        let along = [1.0, 0.0];
        let ahead = |list: &[Waypoint]| {
            let mut point = vec![0.5, 0.0];
            bend(list, &dot, 0.5, &along, &mut point);
            point
        };
        let last = || waypoint([0.0, 0.0], [1.0, 0.0]);
        assert_eq!(ahead(&[last()]), [0.5, 0.0]);
        assert_eq!(ahead(&[last(), waypoint([0.2, 0.1], [1.0, 0.0])]), [0.5, 0.0]);
        let apart = waypoint([-0.5, 0.3], [0.0, 1.0]);
        assert_eq!(ahead(&[last(), apart]), [0.5, 0.3]);
        // Too near to tell what comes.
        assert_eq!(ahead(&[last(), waypoint([-0.1, 0.3], [1.0, 0.0])]), [0.5, 0.0]);
    }
}
