//! Straight pieces of torque over twist: multi-stage dampers, drive and coast side alike or not.

use super::describing::DescribingFunction;

/// One stage: a stiffness up to a twist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Magnitude of the twist at which the next stage begins, rad; infinite for the last.
    pub until: f64,
    /// Stiffness, N·m/rad.
    pub stiffness: f64,
}

/// A straight piece of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Straight {
    /// A twist of the piece (the end nearer to zero, or zero) with torque and energy there.
    origin: f64,
    torque: f64,
    energy: f64,
    stiffness: f64,
}

/// A continuous torque of straight pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewiseLinearLaw {
    /// Where the stiffness jumps, ascending.
    kinks: Vec<f64>,
    /// One more than kinks, ascending.
    pieces: Vec<Straight>,
    /// The piece that holds zero twist; of two that meet there the upper one.
    middle: usize,
}

impl PiecewiseLinearLaw {
    /// A law of stages from zero twist outwards, `drive` for positive and `coast` for negative
    /// twist, and the torque at zero twist.
    ///
    /// The last stage of each side goes on for ever, whatever its `until`; limits that do not
    /// ascend are skipped. A side without a stage carries no more than the preload.
    pub fn new(drive: &[Stage], coast: &[Stage], preload: f64) -> Self {
        let (up_kinks, up) = side(drive, 1.0, preload);
        let (down_kinks, down) = side(coast, -1.0, preload);
        let joint = up[0].stiffness == down[0].stiffness;
        let mut kinks: Vec<f64> = down_kinks.into_iter().rev().collect();
        let mut pieces: Vec<Straight> = down.into_iter().rev().collect();
        if joint {
            pieces.pop();
        } else {
            kinks.push(0.0);
        }
        let middle = pieces.len();
        kinks.extend(up_kinks);
        pieces.extend(up);
        Self { kinks, pieces, middle }
    }

    /// Stage and side of a piece by ascending twist: the stage counted from zero twist outwards, from 1, and
    /// whether it is of the drive side (positive twist), as is a piece of both sides.
    pub fn stage(&self, piece: usize) -> (usize, bool) {
        if piece >= self.middle {
            return (piece - self.middle + 1, true);
        }
        let joint = !self.kinks.contains(&0.0);
        (self.middle - piece + usize::from(joint), false)
    }

    /// Stiffness of the pieces by ascending twist, N·m/rad.
    pub fn stiffnesses(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.pieces.iter().map(|piece| piece.stiffness)
    }

    /// Torque at zero twist, N·m.
    pub fn preload(&self) -> f64 {
        self.pieces[self.middle].torque
    }

    /// Index of the piece at `x`; at a kink the lower one.
    #[inline]
    fn index_at(&self, x: f64) -> usize {
        self.kinks.iter().map(|kink| usize::from(*kink < x)).sum()
    }

    #[inline]
    fn at(&self, x: f64) -> &Straight {
        &self.pieces[self.index_at(x)]
    }

    /// Torque at twist `x`, N·m.
    #[inline]
    pub fn torque(&self, x: f64) -> f64 {
        let piece = self.at(x);
        piece.torque + piece.stiffness * (x - piece.origin)
    }

    /// Tangent stiffness at twist `x`, N·m/rad; at a kink that below it.
    #[inline]
    pub fn stiffness(&self, x: f64) -> f64 {
        self.at(x).stiffness
    }

    /// Potential energy above zero twist, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        let piece = self.at(x);
        let d = x - piece.origin;
        piece.energy + d * (piece.torque + 0.5 * piece.stiffness * d)
    }

    /// Where the stiffness jumps, ascending.
    pub fn switching_twists(&self) -> &[f64] {
        &self.kinks
    }

    /// Whether the tangent stiffness is the same everywhere.
    pub fn is_linear(&self) -> bool {
        self.kinks.is_empty()
    }

    /// Whether `T(-x) = -T(x)`.
    pub fn is_odd(&self) -> bool {
        let kinks = self.kinks.iter().zip(self.kinks.iter().rev());
        let pieces = self.pieces.iter().zip(self.pieces.iter().rev());
        self.preload() == 0.0
            && kinks.into_iter().all(|(a, b)| *a == -*b)
            && pieces.into_iter().all(|(a, b)| a.stiffness == b.stiffness)
    }

    /// The describing function for an amplitude of zero or more, in closed form: the middle piece
    /// and one ramp for each kink.
    pub fn describing_function(&self, mean: f64, amplitude: f64) -> DescribingFunction {
        let index = self.index_at(mean);
        let crosses = self.kinks.iter().any(|kink| (kink - mean).abs() < amplitude);
        let piece = &self.pieces[if crosses { self.middle } else { index }];
        let mut result = DescribingFunction {
            mean_torque: piece.torque + piece.stiffness * (mean - piece.origin),
            gain: piece.stiffness,
            mean_by_mean: piece.stiffness,
            ..DescribingFunction::default()
        };
        if !crosses {
            return result;
        }
        for (kink, pair) in self.kinks.iter().zip(self.pieces.windows(2)) {
            let jump = pair[1].stiffness - pair[0].stiffness;
            // A kink at zero lies below the middle piece.
            if *kink > 0.0 {
                result.add_ramp_above(*kink, jump, mean, amplitude);
            } else {
                result.add_ramp_below(*kink, -jump, mean, amplitude);
            }
        }
        result
    }

    /// Twist and torque of a point of each piece and its stiffness, ascending.
    pub(super) fn straight_pieces(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        self.pieces.iter().map(|piece| (piece.origin, piece.torque, piece.stiffness))
    }
}

/// Kinks and pieces of one side, from zero twist outwards; `sign` is that of the twists.
fn side(stages: &[Stage], sign: f64, preload: f64) -> (Vec<f64>, Vec<Straight>) {
    let first = stages.first().map_or(0.0, |stage| stage.stiffness);
    let mut kinks = Vec::new();
    let mut pieces = vec![Straight { origin: 0.0, torque: preload, energy: 0.0, stiffness: first }];
    let mut reached = 0.0;
    for pair in stages.windows(2) {
        let (until, next) = (pair[0].until, pair[1].stiffness);
        let last = pieces[pieces.len() - 1];
        if until.partial_cmp(&reached) != Some(std::cmp::Ordering::Greater) {
            continue;
        }
        reached = until;
        if next == last.stiffness {
            continue;
        }
        let kink = sign * until;
        let d = kink - last.origin;
        pieces.push(Straight {
            origin: kink,
            torque: last.torque + last.stiffness * d,
            energy: last.energy + d * (last.torque + 0.5 * last.stiffness * d),
            stiffness: next,
        });
        kinks.push(kink);
    }
    (kinks, pieces)
}
