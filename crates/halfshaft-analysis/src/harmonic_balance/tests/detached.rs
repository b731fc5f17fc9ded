//! Detached branches, held against what must be there.
//!
//! With one harmonic and an odd polynomial law `p` the responses of
//! `x'' + c x' + p(x) = P cos W t` satisfy `A² [(N(A) - W²)² + c² W²] = P²` exactly, with `N` the
//! describing function of the law. For an amplitude `A` this is a quadratic in `W²`, with real
//! solutions where `P²/A² >= c² N - c⁴/4`: each interval of `A` where that holds is one branch, and
//! each of them that does not begin at zero is a detached one. (Kovacic & Brennan, *The Duffing
//! Equation*, 2011, sections 5.4 and 6.3, for the equation; the count is by hand.)

use super::independent::{brute_force, responses_at};
use super::{Traced, lines, setting_of, traced, traced_with};

/// Damping and the coefficients `k1, k3, k5, k7` of an oscillator, amplitude of its torque.
#[derive(Clone, Copy, Debug)]
struct Oscillator {
    damping: f64,
    law: [f64; 4],
    drive: f64,
}

impl Oscillator {
    fn text(&self) -> String {
        let [k1, k3, k5, k7] = self.law;
        let more = format!("cubic = {k3:?}\nquintic = {k5:?}\nseptic = {k7:?}");
        let torque = format!("amplitude = {:?}", self.drive);
        lines::held(&lines::keys(k1, self.damping, &more), &torque)
    }

    /// The describing function at `s = A²`.
    fn stiffness(&self, s: f64) -> f64 {
        let [k1, k3, k5, k7] = self.law;
        k1 + s * (0.75 * k3 + s * (0.625 * k5 + s * 35.0 / 64.0 * k7))
    }

    /// Intervals of the amplitude with responses, and the speeds between which they lie.
    fn branches(&self, largest: f64) -> Vec<[f64; 4]> {
        const COUNT: usize = 200_000;
        let c2 = self.damping * self.damping;
        let mut found: Vec<[f64; 4]> = Vec::new();
        let mut inside = false;
        for k in 1..=COUNT {
            let a = largest * k as f64 / COUNT as f64;
            let s = a * a;
            let n = self.stiffness(s);
            let room = self.drive * self.drive / s - c2 * n + 0.25 * c2 * c2;
            let squares = [-1.0, 1.0].map(|sign| n - 0.5 * c2 + sign * room.max(0.0).sqrt());
            if room < 0.0 || squares[1] <= 0.0 {
                inside = false;
                continue;
            }
            let [low, high] = squares.map(|square| square.max(0.0).sqrt());
            match found.last_mut().filter(|_| inside) {
                Some(last) => {
                    (last[1], last[2], last[3]) = (a, last[2].min(low), last[3].max(high));
                }
                None => found.push([a, a, low, high]),
            }
            inside = true;
        }
        found
    }
}

/// Least and largest first harmonic of the (only) twist of each branch, by the latter.
fn amplitudes(found: &Traced) -> Vec<(f64, f64)> {
    let mut list: Vec<(f64, f64)> = (found.collected.branches.iter())
        // What breaks the mirror symmetry is beyond the truth below.
        .filter(|branch| branch.periods == 1 && branch.samples.iter().all(|s| s.set.is_odd()))
        .map(|branch| {
            let first = branch.samples.iter().map(|s| s.set.modulus(&s.u, 1));
            first.fold((f64::INFINITY, 0.0_f64), |(low, high), a| (low.min(a), high.max(a)))
        })
        .collect();
    list.sort_by(|a, b| a.1.total_cmp(&b.1));
    list
}

/// A softening and then hardening law with the detached branch at `part` (0 to 1) of the way
/// between its birth and its merger.
fn soft_then_hard(damping: f64, ratio: f64, part: f64) -> Oscillator {
    // N = 1 - s + ratio s²; c² s N has its extremes where 1 - 2 s + 3 ratio s² = 0.
    let law = [1.0, -4.0 / 3.0, 1.6 * ratio, 0.0];
    let root = (1.0 - 3.0 * ratio).sqrt();
    let at = |s: f64| damping * damping * s * (1.0 - s + ratio * s * s);
    let (merger, birth) = (at((1.0 - root) / (3.0 * ratio)), at((1.0 + root) / (3.0 * ratio)));
    Oscillator { damping, law, drive: (birth + part * (merger - birth)).sqrt() }
}

#[track_caller]
fn assert_all_found(oscillator: Oscillator, range: (f64, f64), largest: f64) {
    let expected: Vec<[f64; 4]> = (oscillator.branches(largest).into_iter())
        .filter(|branch| branch[2] < range.1 && branch[3] > range.0)
        .collect();
    let setting = setting_of(&oscillator.text(), range);
    let one = amplitudes(&traced_with(setting, 1e-6, Some(1)));
    assert_eq!(one.len(), expected.len(), "{oscillator:?}\n{one:?}\n{expected:?}");
    for ((low, high), branch) in one.iter().zip(&expected) {
        // Samples do not stand at the very top, nor do those of the truth.
        assert!((high / branch[1] - 1.0).abs() < 2e-2, "{one:?} {expected:?}");
        assert!(
            branch[0] < 1e-3 * largest || (low / branch[0] - 1.0).abs() < 3e-2,
            "{one:?} {expected:?}"
        );
    }
}

#[test]
fn one_detached_branch_of_an_oscillator() {
    for (damping, ratio) in [(0.05, 0.30), (0.01, 0.29), (0.1, 0.305), (0.002, 0.27)] {
        for part in [0.1, 0.3, 0.9] {
            let oscillator = soft_then_hard(damping, ratio, part);
            assert_eq!(oscillator.branches(2.5).len(), 2, "{oscillator:?}");
            assert_all_found(oscillator, (0.1, 1.5), 2.5);
        }
    }
}

#[test]
fn no_branch_that_is_not_there() {
    for part in [-0.3, 1.2] {
        let oscillator = soft_then_hard(0.05, 0.3, part);
        assert_eq!(oscillator.branches(2.5).len(), 1, "{oscillator:?}");
        assert_all_found(oscillator, (0.1, 1.5), 2.5);
    }
}

#[test]
fn detached_branches_keep_with_all_harmonics() {
    for (damping, ratio) in [(0.01, 0.29), (0.003, 0.28)] {
        let oscillator = soft_then_hard(damping, ratio, 0.5);
        let found = traced(&oscillator.text(), (0.1, 1.5), 1e-6);
        let list = amplitudes(&found);
        let detached = found.collected.branches.iter().filter(|branch| branch.closed());
        assert!(detached.count() >= 1, "{list:?}");
    }
}

/// Every orbit that shooting finds at a speed from many starts is on a branch.
#[track_caller]
fn assert_covers(text: &str, range: (f64, f64), speeds: &[f64], size: f64, starts: usize) -> usize {
    let found = traced(text, range, 1e-8);
    let mut most = 0;
    for &speed in speeds {
        let known = responses_at(&found, speed);
        let orbits =
            brute_force(&found.setting.line.equations, speed, found.setting.base, size, starts);
        most = most.max(orbits.len());
        for orbit in &orbits {
            let near = known.iter().flatten().map(|state| {
                let away = state.iter().zip(orbit).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
                away.sqrt() / orbit.iter().map(|x| x * x).sum::<f64>().sqrt()
            });
            let nearest = near.fold(f64::INFINITY, f64::min);
            let list = &found.collected.branches;
            let all: Vec<&str> = list.iter().map(|branch| branch.origin.as_str()).collect();
            assert!(nearest < 1e-5, "at {speed} misses {orbit:?} by {nearest:e}; has {all:?}");
        }
    }
    most
}

#[test]
fn all_responses_of_an_absorber() {
    for (drive, speeds, expected) in [
        (0.11, [1.05, 1.2, 1.21], 1),
        (0.15, [1.1, 1.3, 1.5], 1),
        (0.18, [1.2, 1.4, 1.8], 1),
        (0.25, [1.2, 1.6, 2.0], 1),
    ] {
        let most = assert_covers(&lines::absorber(drive), (0.6, 2.6), &speeds, 2.0, 150);
        assert!(most >= expected, "{most} at {drive}");
    }
}

#[test]
fn all_responses_of_duffing_oscillators() {
    assert_covers(&lines::d1(), (0.2, 1.8), &[0.35, 1.0, 1.2], 4.0, 100);
    assert_covers(&lines::theory(15.0), (24.0, 28.0), &[25.7, 26.3], 8.0, 100);
}
