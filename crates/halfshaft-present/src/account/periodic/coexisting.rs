//! Responses that exist beside each other: how many, the detached ones, those of longer periods,
//! and where none is stable.

use halfshaft_results::Branch;

use crate::reading::{Reading, Sample, Stop, bounds, holds};
use crate::words::{angle, capital, counted, list, number, plain};

/// All of it as sentences.
pub(super) fn told(reading: &Reading<'_>) -> Vec<String> {
    let mut sentences = Vec::new();
    sentences.push(number_of_responses(reading));
    let branches = reading.result.branches.iter().enumerate();
    for (index, branch) in branches.filter(|(_, branch)| special(branch)) {
        sentences.extend(set_apart(reading, index, branch));
    }
    let gaps: Vec<String> =
        unstable_gaps(reading).into_iter().map(|(from, to)| reading.x.between(from, to)).collect();
    if !gaps.is_empty() {
        sentences.push(format!(
            "No stable periodic response was found {}: what the line does there, `halfshaft simulate` \
             shows.",
            list(&gaps)
        ));
    }
    sentences
}

/// Whether a branch has a sentence of its own.
fn special(branch: &Branch) -> bool {
    branch.periods > 1 || branch.is_detached()
}

/// How many responses of the excitation's own period exist side by side.
fn number_of_responses(reading: &Reading<'_>) -> String {
    match most_coexisting(reading) {
        None => String::new(),
        Some((1, ..)) => {
            let what = if reading.x.is_speed() { "speed" } else { "value" };
            format!("There is one response at every {what} of the range.")
        }
        Some((most, from, to)) => format!(
            "Up to {} exist side by side, {}.",
            counted(most, "response", "responses"),
            reading.x.between(from, to)
        ),
    }
}

/// The largest number of responses that exist side by side, and between which values; those of
/// longer periods are not counted.
pub(crate) fn most_coexisting(reading: &Reading<'_>) -> Option<(usize, f64, f64)> {
    let courses = reading.courses().into_iter().zip(&reading.result.branches);
    let own = courses.filter(|(_, branch)| branch.periods <= 1);
    // Where pieces begin (+1) and end (-1); a piece lies between two neighbours of a branch.
    let mut changes: Vec<(f64, i64)> = Vec::new();
    for pair in own.flat_map(|(course, _)| pieces(&course)) {
        let (low, high) = span(&pair);
        if low < high {
            changes.extend([(low, 1), (high, -1)]);
        }
    }
    // At one value the ends come first, so that a piece that follows another does not count twice.
    changes.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut count = 0;
    let mut best: Option<(i64, f64, f64)> = None;
    let mut open = false;
    for (index, (x, change)) in changes.iter().enumerate() {
        count += change;
        let next = changes.get(index + 1).map_or(*x, |next| next.0);
        if best.is_none_or(|best| count > best.0) && next > *x {
            best = Some((count, *x, next));
            open = true;
        } else if let Some(best) = &mut best
            && open
            && next > *x
        {
            // The stretch goes on as long as the number stays.
            open = count == best.0;
            best.2 = if open { next } else { best.2 };
        }
    }
    best.and_then(|(count, from, to)| Some((usize::try_from(count).ok()?, from, to)))
}

/// A detached response, or one of a longer period, as a sentence.
fn set_apart(reading: &Reading<'_>, index: usize, branch: &Branch) -> Option<String> {
    let samples: Vec<Sample> =
        reading.samples().into_iter().filter(|sample| sample.branch == index).collect();
    let (from, to) = bounds(samples.iter().map(|sample| sample.x))?;
    let (least, most) = bounds(samples.iter().map(|sample| sample.swing))?;
    let stable = samples.iter().filter(|sample| sample.stable).count();
    let stability = match stable {
        0 => "nowhere stable",
        count if count == samples.len() => "stable throughout",
        _ => "stable in part",
    };
    let swings = format!("±{} to ±{} rad, {stability}", number(least, 4), angle_end(most));
    let place = reading.x.between(from, to);
    let twist = reading.shaft().map_or_else(String::new, |shaft| format!("twist of the {shaft} "));
    Some(if branch.is_detached() {
        let period = match branch.periods {
            0 | 1 => String::new(),
            periods => format!(" of {}", periods_words(periods)),
        };
        format!(
            "A detached response{period} exists {place} ({twist}{swings}), which a slow sweep never \
             shows; a shock can throw the line onto it."
        )
    } else {
        let origin = plain(&branch.origin);
        let from = if origin.is_empty() { String::new() } else { format!(", from the {origin}") };
        capital(&format!(
            "{place} there is a response of {}{from} ({twist}{swings}).",
            periods_words(branch.periods)
        ))
    })
}

fn angle_end(swing: f64) -> String {
    // The unit follows in the sentence.
    angle(swing).split('\u{a0}').next().unwrap_or_default().to_owned()
}

/// How long a response is in periods of the excitation.
pub(crate) fn periods_words(periods: u32) -> String {
    match periods {
        0 | 1 => "the period of the excitation".to_owned(),
        2 => "twice the period of the excitation".to_owned(),
        periods => format!("{periods} times the period of the excitation"),
    }
}

/// The stretches between neighbouring stops of a branch.
fn pieces(course: &[Stop]) -> Vec<[Stop; 2]> {
    course.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// Where a stretch lies.
fn span([from, to]: &[Stop; 2]) -> (f64, f64) {
    (from.sample.x.min(to.sample.x), from.sample.x.max(to.sample.x))
}

/// Stretches of the range in which no response is stable.
pub(crate) fn unstable_gaps(reading: &Reading<'_>) -> Vec<(f64, f64)> {
    let courses = reading.courses();
    let Some((low, high)) = bounds(courses.iter().flatten().map(|stop| stop.sample.x)) else {
        return Vec::new();
    };
    let mut held: Vec<(f64, f64)> = courses
        .iter()
        .flat_map(|course| pieces(course))
        .filter(|[from, to]| holds(from, to))
        .map(|pair| span(&pair))
        .collect();
    held.sort_by(|a, b| a.0.total_cmp(&b.0));
    // A branch of twice the period does not begin exactly where the other one loses its stability.
    let shortest = 2e-5 * (high - low);
    let mut gaps = Vec::new();
    let mut reached = low;
    for (from, to) in held.into_iter().chain([(high, high)]) {
        if from - reached > shortest {
            gaps.push((reached, from));
        }
        reached = reached.max(to);
    }
    gaps
}
