//! Regions of a plane by the number of responses that coexist in them.
//!
//! The count is known on a grid; where two neighbours of a row differ, the edge is put on the fold
//! curve that crosses the row between them, so that the tint ends on the line that is drawn.

use halfshaft_results::ResponseCount;

use crate::figure::{Colour, Label, Region};
use crate::words::counted;

/// Tinted areas and their numbers.
pub(super) struct Tints {
    pub(super) regions: Vec<Region>,
    pub(super) labels: Vec<Label>,
}

/// A stretch of a row of the grid with one count.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Run {
    count: u32,
    from: f64,
    to: f64,
}

/// The areas of the plane, one region for each number of responses, the fewest first.
pub(super) fn tints(responses: &ResponseCount, curves: &[(Vec<f64>, Vec<f64>)]) -> Tints {
    let rows = runs(responses, curves);
    let mut counts: Vec<u32> = rows.iter().flatten().map(|run| run.count).collect();
    counts.sort_unstable();
    counts.dedup();
    let blocks = blocks(&rows);
    let region = |count: &u32| area(*count, &rows, &responses.parameter, &blocks);
    Tints {
        regions: counts.iter().map(region).collect(),
        labels: counts.iter().filter_map(|count| label(*count, &rows, responses)).collect(),
    }
}

/// What a region is called.
pub(super) fn name(count: u32) -> String {
    match count {
        0 => "no response of the period of the excitation".to_owned(),
        1 => "one response: no jump".to_owned(),
        MANY.. => format!("{} or more", counted(MANY as usize, "response", "responses")),
        count => counted(count as usize, "response", "responses"),
    }
}

/// Numbers from this one on share one colour and one name.
const MANY: u32 = 8;

/// The colour of a number of responses and how dense its tint is: each of the small numbers differs
/// from all others.
fn tint(count: u32) -> (Colour, f64) {
    match count {
        0 => (Colour::Black, 0.16),
        1 => (Colour::SAFE, 0.16),
        2 => (Colour::Rgb(240, 228, 66), 0.35),
        3 => (Colour::Sky, 0.18),
        4 => (Colour::Orange, 0.2),
        5 => (Colour::DANGER, 0.24),
        6 => (Colour::Purple, 0.3),
        7 => (Colour::PRIMARY, 0.36),
        _ => (Colour::Grey, 0.45),
    }
}

/// The stretches of every row; a row whose numbers do not fit the grid has none.
fn runs(responses: &ResponseCount, curves: &[(Vec<f64>, Vec<f64>)]) -> Vec<Vec<Run>> {
    let speeds = &responses.frequency;
    let rows = responses.parameter.iter().zip(&responses.count);
    rows.map(|(parameter, counts)| {
        let crossings = crossings(curves, *parameter);
        let mut runs: Vec<Run> = Vec::new();
        for (column, (count, speed)) in counts.iter().zip(speeds).enumerate() {
            match runs.last_mut() {
                Some(run) if run.count == *count => run.to = *speed,
                Some(run) => {
                    let before = speeds[column - 1];
                    let edge = edge(&crossings, before, *speed);
                    run.to = edge;
                    runs.push(Run { count: *count, from: edge, to: *speed });
                }
                None => runs.push(Run { count: *count, from: *speed, to: *speed }),
            }
        }
        runs
    })
    .collect()
}

/// Speeds at which fold curves cross a value of the parameter.
fn crossings(curves: &[(Vec<f64>, Vec<f64>)], parameter: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for (x, y) in curves {
        for (xs, ys) in x.windows(2).zip(y.windows(2)) {
            let (below, above) = (ys[0] - parameter, ys[1] - parameter);
            if below * above <= 0.0 && below != above {
                found.push(xs[0] + (xs[1] - xs[0]) * below / (below - above));
            }
        }
    }
    found
}

/// The crossing between two neighbours that lies most in the middle, or the middle itself.
fn edge(crossings: &[f64], low: f64, high: f64) -> f64 {
    let middle = f64::midpoint(low, high);
    let between = crossings.iter().copied().filter(|x| *x >= low && *x <= high);
    between.min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs())).unwrap_or(middle)
}

/// Rows that follow each other with the same counts in the same order: first and last.
fn blocks(rows: &[Vec<Run>]) -> Vec<(usize, usize)> {
    let counts = |row: usize| rows[row].iter().map(|run| run.count);
    let mut blocks: Vec<(usize, usize)> = Vec::new();
    for row in 0..rows.len() {
        match blocks.last_mut() {
            Some(block) if counts(block.1).eq(counts(row)) => block.1 = row,
            _ => blocks.push((row, row)),
        }
    }
    blocks
}

/// The area of one count: of every block of rows a closed line up its left edge and down its right.
fn area(count: u32, rows: &[Vec<Run>], heights: &[f64], blocks: &[(usize, usize)]) -> Region {
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for (first, last) in blocks {
        let levels = levels(heights, *first, *last);
        let lowest = rows[*first].iter().enumerate();
        for (place, run) in lowest.filter(|(_, run)| run.count == count) {
            // The outermost rows reach half-way to the next block.
            let inner = (*first..=*last).map(|row| rows[row][place]);
            let edges: Vec<Run> = std::iter::once(*run)
                .chain(inner)
                .chain(std::iter::once(rows[*last][place]))
                .collect();
            x.extend(edges.iter().map(|run| run.from));
            x.extend(edges.iter().rev().map(|run| run.to));
            y.extend(levels.iter());
            y.extend(levels.iter().rev());
            x.push(f64::NAN);
            y.push(f64::NAN);
        }
    }
    let (colour, opacity) = tint(count);
    Region { opacity, ..Region::new(name(count), x, y, colour) }
}

/// Heights of the rows of a block, with its lower and upper edge.
fn levels(heights: &[f64], first: usize, last: usize) -> Vec<f64> {
    let half = |row: usize, next: Option<usize>| {
        let own = heights[row];
        next.and_then(|next| heights.get(next)).map_or(own, |other| f64::midpoint(own, *other))
    };
    let mut levels = vec![half(first, first.checked_sub(1))];
    levels.extend(&heights[first..=last]);
    levels.push(half(last, Some(last + 1)));
    levels
}

/// The number of responses, where its region is widest.
fn label(count: u32, rows: &[Vec<Run>], responses: &ResponseCount) -> Option<Label> {
    let whole = responses.frequency.last()? - responses.frequency.first()?;
    let heights = &responses.parameter;
    let all = rows.iter().zip(heights).enumerate();
    let (height, run) = all
        .flat_map(|(row, (runs, height))| runs.iter().map(move |run| (row, *height, run)))
        .filter(|(_, _, run)| run.count == count)
        .max_by(|a, b| roominess(a, rows).total_cmp(&roominess(b, rows)))
        .map(|(_, height, run)| (height, run))?;
    let wide = run.to - run.from >= 0.03 * whole;
    wide.then(|| Label::new(f64::midpoint(run.from, run.to), height, count.to_string()))
}

/// How much room there is about the middle of a stretch: the smaller of its width and of the rows
/// above and below that hold the same count there, as shares of the plane.
fn roominess((row, _, run): &(usize, f64, &Run), rows: &[Vec<Run>]) -> f64 {
    let middle = f64::midpoint(run.from, run.to);
    let holds = |other: &Vec<Run>| {
        let mut at = other.iter().filter(|one| one.from <= middle && middle <= one.to);
        at.any(|one| one.count == run.count)
    };
    let up = rows[*row..].iter().take_while(|other| holds(other)).count();
    let down = rows[..*row].iter().rev().take_while(|other| holds(other)).count();
    let width = rows[*row].last().map_or(1.0, |last| last.to) - rows[*row][0].from;
    let tall = up.min(down + 1) as f64 / rows.len() as f64;
    tall.min(0.5 * (run.to - run.from) / width)
}

#[cfg(test)]
mod tests {
    use super::{MANY, name, tint, tints};
    use halfshaft_results::ResponseCount;

    /// Oracle: by hand: three responses right of the line x = 1 + y, up to the border.
    #[test]
    fn edges_lie_on_the_fold_curve() {
        let responses = ResponseCount {
            frequency: vec![0.0, 1.0, 2.0, 3.0, 4.0],
            parameter: vec![0.25, 0.5],
            count: vec![vec![1, 1, 3, 3, 3], vec![1, 1, 3, 3, 3]],
        };
        let curve = (vec![1.0, 2.0], vec![0.0, 1.0]);
        let tints = tints(&responses, &[curve]);
        let three = &tints.regions[1];
        assert_eq!(three.name, name(3));
        assert_eq!(three.x[..8], [1.25, 1.25, 1.5, 1.5, 4.0, 4.0, 4.0, 4.0]);
        assert_eq!(three.y[..8], [0.25, 0.25, 0.5, 0.5, 0.5, 0.5, 0.25, 0.25]);
        assert_eq!(tints.labels.len(), 2);
    }

    /// Oracle: the promise: small numbers can be told apart, many never make a long legend.
    #[test]
    fn small_numbers_differ_and_large_ones_share() {
        let looks: Vec<_> = (0..=MANY).map(|count| (tint(count), name(count))).collect();
        for (at, one) in looks.iter().enumerate() {
            assert!(looks[..at].iter().all(|other| other.0.0 != one.0.0 && other.1 != one.1));
        }
        assert_eq!((tint(MANY), name(MANY)), (tint(86), name(86)));
    }

    /// Oracle: the contract: a grid whose parts do not fit each other is no reason to fail.
    #[test]
    fn odd_grids_are_fine() {
        let odd = ResponseCount {
            frequency: vec![1.0],
            parameter: vec![0.0, 1.0, 2.0],
            count: vec![vec![], vec![1, 3, 5]],
        };
        let tints = tints(&odd, &[(vec![f64::NAN], vec![])]);
        assert!(tints.regions.len() <= 1);
    }
}
