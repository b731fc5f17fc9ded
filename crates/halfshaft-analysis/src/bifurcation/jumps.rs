//! Where the amplitude jumps from one value of a sweep to the next.

use halfshaft_results::SweepJump;

use super::sweep::Row;

/// A jump is more than this part of the larger amplitude.
const LEAST: f64 = 0.1;
/// And more than this many times the changes before and after it: a steep flank changes evenly.
const STANDS_OUT: f64 = 4.0;

/// The jumps between motions of which at least one repeats: chaotic amplitudes scatter.
pub(super) fn jumps(rows: &[Row]) -> Vec<SweepJump> {
    let amplitude = |row: &Row| row.seen.as_ref().map_or(f64::NAN, |seen| seen.amplitude);
    let repeats = |row: &Row| row.seen.as_ref().is_ok_and(|seen| seen.period.is_some());
    let change = |at: usize| {
        let (a, b) = (rows.get(at)?, rows.get(at + 1)?);
        (a.direction == b.direction).then(|| (amplitude(b) - amplitude(a)).abs())
    };
    let mut found = Vec::new();
    for (at, pair) in rows.windows(2).enumerate() {
        let Some(size) = change(at) else { continue };
        let (before, after) = (amplitude(&pair[0]), amplitude(&pair[1]));
        let beside = [at.checked_sub(1).and_then(change), change(at + 1)];
        let even = beside.into_iter().flatten().fold(0.0, f64::max);
        if (repeats(&pair[0]) || repeats(&pair[1]))
            && size > LEAST * before.max(after)
            && size > STANDS_OUT * even
        {
            let (last, first) = (pair[0].value, pair[1].value);
            found.push(SweepJump { direction: pair[0].direction, last, first, before, after });
        }
    }
    found
}
