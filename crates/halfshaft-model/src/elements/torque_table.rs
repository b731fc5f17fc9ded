//! A torque over time given by points.

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Points of time and torque, as many of one as of the other; straight lines between them, and before the
/// first and after the last the torque stays.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TorqueTable {
    /// Times, ascending, s.
    pub time_s: Vec<f64>,
    /// Torques at these times, N·m.
    pub torque_nm: Vec<f64>,
}

/// Keys of `table = { ... }` of a torque.
pub static TORQUE_TABLE: TableSpec = TableSpec {
    name: "torque table",
    doc: "Points of time and torque, for `simulate` and `shock`: straight lines between them, and before \
          the first and after the last point the torque stays. In place of the two lists a text is the \
          path of a CSV file, relative to the model file: two columns, time and torque, with units in \
          the header (`time [ms], torque [N·m]`) or in SI. The points have the addresses \
          `<name of the torque>.table.torque.1` and so on.",
    keys: &[
        KeySpec::new(
            "time",
            ValueSpec::Quantities(QuantityKind::Time, Sign::Any),
            "Times, ascending.",
        )
        .required(),
        KeySpec::new(
            "torque",
            ValueSpec::Quantities(QuantityKind::Torque, Sign::Any),
            "Torques at these times.",
        )
        .required(),
    ],
};

/// Most points.
const MOST_POINTS: usize = 100_000;

impl TorqueTable {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self { time_s: table.numbers("time").to_vec(), torque_nm: table.numbers("torque").to_vec() }
    }

    /// Torque at time `t` (s), N·m; zero for a table without points.
    pub fn torque(&self, t: f64) -> f64 {
        let (Some(first), Some(last)) = (self.torque_nm.first(), self.torque_nm.last()) else {
            return 0.0;
        };
        match self.time_s.partition_point(|time| *time <= t) {
            0 => *first,
            next if next >= self.time_s.len().min(self.torque_nm.len()) => *last,
            next => {
                let (t0, t1) = (self.time_s[next - 1], self.time_s[next]);
                let (a, b) = (self.torque_nm[next - 1], self.torque_nm[next]);
                a + (b - a) * (t - t0) / (t1 - t0)
            }
        }
    }

    /// The torque of largest magnitude, N·m.
    pub fn largest(&self) -> f64 {
        self.torque_nm.iter().fold(0.0, |most, torque| most.max(torque.abs()))
    }

    /// What keeps it from being a torque over time, and what to write instead.
    pub fn fault(&self) -> Option<(String, &'static str)> {
        let (times, torques) = (self.time_s.len(), self.torque_nm.len());
        if times != torques {
            let message = format!("the table has {times} times and {torques} torques");
            return Some((message, "each time needs its torque"));
        }
        if times < 2 {
            return Some(("the table has fewer than two points".to_owned(), "add points"));
        }
        if times > MOST_POINTS {
            let message = format!("the table has {times} points");
            return Some((message, "thin it out: up to 100 000 points are taken"));
        }
        let at = self.time_s.windows(2).position(|pair| pair[1] <= pair[0])?;
        let message = format!("the times do not ascend from point {} to {}", at + 1, at + 2);
        Some((message, "order the points by time; a jump takes a short while, e.g. 0.1 ms"))
    }

    /// The numeric value behind `torque.1` and so on.
    pub(super) fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        let (column, number) = key.split_once('.')?;
        let index = number.parse::<usize>().ok()?.checked_sub(1)?;
        match column {
            "torque" => self.torque_nm.get_mut(index),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: straight lines by hand.
    #[test]
    fn torques_lie_on_straight_lines() {
        let table = TorqueTable { time_s: vec![0.0, 0.5, 0.6], torque_nm: vec![10.0, 20.0, -5.0] };
        for (t, torque) in [
            (-1.0, 10.0),
            (0.0, 10.0),
            (0.25, 15.0),
            (0.5, 20.0),
            (0.55, 7.5),
            (0.6, -5.0),
            (9.0, -5.0),
        ] {
            assert!((table.torque(t) - torque).abs() < 1e-12, "{t}");
        }
        assert_eq!(table.fault(), None);
        let back = TorqueTable { time_s: vec![0.0, 0.5, 0.5], ..table };
        assert!(back.fault().is_some_and(|(message, _)| message.contains("from point 2 to 3")));
    }
}
