//! What the reader must know of an answer: branches that stop, harmonics that do not suffice.

use halfshaft_model::question::ResonanceQuestion;
use halfshaft_results::{Reason, ResonanceResult, Termination};

use super::answer::Setting;
use super::branches::Collected;
use super::tracer::{BranchEnd, Sample};

pub(super) fn messages(
    setting: &Setting,
    question: &ResonanceQuestion,
    all: &Collected,
    result: &mut ResonanceResult,
) {
    let header = &mut result.header;
    header.warnings.extend(all.messages.iter().cloned());
    // Over another number of the line the places are values of that.
    let unit = if question.parameter.is_some() { "" } else { " rad/s" };
    lost_guesses(all, unit, &mut header.warnings);
    if all.branches.is_empty() {
        header.warnings.push(format!(
            "no periodic response was found between {:.6} and {:.6} rad/s; try a narrower range or a \
             lower amplitude",
            setting.range.0, setting.range.1
        ));
    }
    stops(all, question.tolerance, &mut header.warnings);
    let unknown = all.branches.iter().flat_map(|branch| &branch.stability);
    let unknown = unknown.filter(|stability| !stability.is_known()).count();
    if unknown > 0 {
        header.warnings.push(format!(
            "the stability of {unknown} responses could not be found; their column stable is empty"
        ));
    }
    if all.exhausted {
        header.warnings.push(format!(
            "even {} harmonics leave more than the tolerance of {:e} of some waveforms; see the column \
             truncation",
            super::tracer::MOST_HARMONICS,
            question.tolerance
        ));
    }
    if all.cut {
        header.warnings.push(
            "responses are so many here that some branches were not looked for; ask for a narrower range \
             to see all of them there"
                .to_owned(),
        );
    }
    if all.exact {
        header.assumptions.push(
            "laws with kinks: branches are orbits of the full motion by shooting from kink to kink, \
             harmonics are taken from them"
                .to_owned(),
        );
    }
    if let Some(harmonics) = question.harmonics {
        header.assumptions.push(format!("{harmonics} harmonics, as asked"));
    }
    if all.cancelled {
        let detail = "branches were left before their end".to_owned();
        header.termination = Termination::early(Reason::Cancelled, detail);
    }
}

/// Places at which one harmonic has a response and no other is known.
fn lost_guesses(all: &Collected, unit: &str, warnings: &mut Vec<String>) {
    let unknown = all.lost.iter().filter(|p| !all.is_known_at(**p));
    let mut places: Vec<String> = unknown.map(|p| format!("{p:.6}")).collect();
    places.dedup();
    if !places.is_empty() {
        warnings.push(format!(
            "one harmonic alone has a response at {}{unit}, but none was found there with more: try \
             --method first-harmonic to see it, and a wider range",
            places.join(", ")
        ));
    }
}

/// Branches that stop before the range does, and what to try.
fn stops(all: &Collected, tolerance: f64, warnings: &mut Vec<String>) {
    for branch in &all.branches {
        let mut stopped = |end: BranchEnd, sample: Option<&Sample>| {
            let Some(sample) = sample else { return };
            let why = match end {
                BranchEnd::StepTooSmall => "no step was small enough to go on",
                BranchEnd::SampleLimit => "as many samples as allowed were taken",
                BranchEnd::Unbounded => "the response grows beyond all measure",
                BranchEnd::Chattering => {
                    "a contact closes and opens too often within a period to be followed"
                }
                BranchEnd::Grazing => {
                    "a twist grazes a break of its law and no response was found beyond"
                }
                _ => return,
            };
            if all.exact {
                warnings.push(format!(
                    "the branch from the {} stops at {:.6} rad/s: {why}",
                    branch.origin, sample.p
                ));
                return;
            }
            warnings.push(format!(
                "the branch from the {} stops at {:.6} rad/s: {why}; try --tolerance {:.0e} or a \
                 narrower range",
                branch.origin,
                sample.p,
                10.0 * tolerance
            ));
        };
        stopped(branch.ends[0], branch.samples.first());
        stopped(branch.ends[1], branch.samples.last());
    }
}
