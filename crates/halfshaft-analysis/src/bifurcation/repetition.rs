//! Whether the states at the beginning of periods come to repeat.

use std::collections::VecDeque;

use crate::shooting::length;

/// Most periods of the excitation after which a motion may repeat to be told as periodic.
pub(super) const MOST_PERIODS: usize = 16;
/// States that are kept: two repetitions and one more.
const KEPT: usize = 2 * MOST_PERIODS + 2;

/// The last states.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    /// The newest in front, each with its distance from rest.
    states: VecDeque<(Vec<f64>, f64)>,
}

/// When states count as repeating.
#[derive(Clone, Copy, Debug)]
pub(super) struct Repeats {
    /// How far from the orbit the motion may still be, as its approach lets expect, relative.
    pub(super) within: f64,
    /// Changes that are no more than the error of the integration, relative.
    pub(super) error: f64,
    /// States of an orbit this near to each other, relative, are one.
    pub(super) same: f64,
}

impl History {
    pub(super) fn push(&mut self, state: Vec<f64>, size: f64) {
        self.states.truncate(KEPT - 1);
        self.states.push_front((state, size));
    }

    pub(super) fn clear(&mut self) {
        self.states.clear();
    }

    /// The last states, oldest first.
    pub(super) fn last(&self, count: usize) -> Vec<Vec<f64>> {
        self.states.iter().take(count).rev().map(|(state, _)| state.clone()).collect()
    }

    /// The fewest periods after which the states repeat.
    ///
    /// A small change alone does not tell: next to a bifurcation a motion creeps. What is left of its way
    /// is that of a geometric series whose ratio the last two repetitions give.
    pub(super) fn period(&self, repeats: Repeats) -> Option<usize> {
        let size = self.states.iter().map(|(_, size)| *size).fold(0.0, f64::max);
        let found = (1..=MOST_PERIODS).find(|p| {
            let (Some(late), Some(early)) = (self.change(0, *p), self.change(*p, *p)) else {
                return false;
            };
            let ratio = late / early;
            let left = if ratio < 1.0 { late * ratio / (1.0 - ratio) } else { f64::INFINITY };
            late <= repeats.error * size || left <= repeats.within * size
        })?;
        // Complex multipliers turn the changes, so that those over several periods may look small first.
        let one = |p: &usize| self.change(0, *p).is_some_and(|late| late <= repeats.same * size);
        Some((1..found).find(one).unwrap_or(found))
    }

    /// The larger of two neighbouring changes over `p` periods, `ago` periods back: of one alone the
    /// turning of a complex multiplier may hide a part.
    fn change(&self, ago: usize, p: usize) -> Option<f64> {
        let apart = |at: usize| {
            let (a, b) = (&self.states.get(at)?.0, &self.states.get(at + p)?.0);
            Some(length(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>()))
        };
        Some(apart(ago)?.max(apart(ago + 1)?))
    }
}

#[cfg(test)]
mod tests {
    use super::{History, Repeats};

    const REPEATS: Repeats = Repeats { within: 1e-6, error: 1e-12, same: 1e-4 };

    fn after(count: i32, of: impl Fn(i32) -> f64) -> Option<usize> {
        let mut history = History::default();
        for n in 0..count {
            let x = of(n);
            history.push(vec![x, 1.0], x.hypot(1.0));
        }
        history.period(REPEATS)
    }

    // Source: sequences whose limits are known.
    #[test]
    fn periods_are_those_of_known_sequences() {
        assert_eq!(after(60, |n| 0.5_f64.powi(n)), Some(1));
        assert_eq!(after(60, |n| 0.3 * (-1.0_f64).powi(n) + 0.5_f64.powi(n)), Some(2));
        assert_eq!(after(60, |n| f64::from(n % 7)), Some(7));
        // Changes of less than 1e-6 of a motion that still has 5e-4 to go.
        assert_eq!(after(400, |n| 0.999_f64.powi(7000 + n)), None);
        // A spiral into a fixed point, whose changes over 6 periods are the first to vanish.
        assert_eq!(after(90, |n| 0.8_f64.powi(n) * (1.05 * f64::from(n)).cos()), Some(1));
        // An irrational rotation, and growth.
        assert_eq!(after(60, |n| (1.234_567 * f64::from(n)).cos()), None);
        assert_eq!(after(60, |n| 1e-9 * 1.1_f64.powi(n)), None);
    }
}
