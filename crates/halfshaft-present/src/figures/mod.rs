//! Figures of results.
//!
//! [`of`] gives the figures of one answer, those of a report with all its parts; their ids are
//! unique in it. [`study_figures`] draws the figures that a study describes. Names of users are
//! shown letter by letter, and results without values give figures that say so, or none.

use std::collections::HashSet;

use halfshaft_results::{Answer, ReportResult};

use crate::figure::Figure;

pub use study::study_figures;

pub(crate) mod basins;
pub(crate) mod bifurcation;
pub(crate) mod campbell;
pub(crate) mod folds;
pub(crate) mod forced;
pub(crate) mod history;
pub(crate) mod levels;
pub(crate) mod methods;
pub(crate) mod modes;
pub(crate) mod orders;
pub(crate) mod periodic;
pub(crate) mod resonance;
pub(crate) mod statics;
pub(crate) mod study;

mod axes;
mod detuned;
mod marks;
mod multipliers;
mod regions;
mod smooth;

/// The figures of an answer, in the order of reading.
#[must_use]
pub fn of(answer: &Answer) -> Vec<Figure> {
    let figures = match answer {
        Answer::Check(_) => Vec::new(),
        Answer::Static(result) => statics::figures(result),
        Answer::Modes(result) => modes::figures(result),
        Answer::Campbell(result) => campbell::figures(result),
        Answer::Forced(result) => forced::figures(result),
        Answer::History(result) => {
            let mut figures = history::figures(result);
            figures.extend(methods::figure(result));
            figures.extend(orders::figures(result));
            figures
        }
        Answer::Resonance(result) => resonance::figures(result),
        Answer::Folds(result) => vec![folds::compared(result, None)],
        Answer::Basins(result) => vec![basins::figure(result)],
        Answer::Bifurcation(result) => vec![bifurcation::figure(result)],
        Answer::Study(result) => study_figures(result),
        Answer::Report(report) => of_report(report),
    };
    with_unique_ids(figures)
}

/// Names that differ only in signs would give one id twice.
fn with_unique_ids(mut figures: Vec<Figure>) -> Vec<Figure> {
    let mut known = HashSet::new();
    for figure in &mut figures {
        let base = figure.id.clone();
        let mut number = 2;
        while !known.insert(figure.id.clone()) {
            figure.id = format!("{base}-{number}");
            number += 1;
        }
    }
    figures
}

fn of_report(report: &ReportResult) -> Vec<Figure> {
    let mut figures = Vec::new();
    figures.extend(report.statics.iter().flat_map(statics::figures));
    figures.extend(report.modes.iter().flat_map(modes::figures));
    figures.extend(report.campbell.iter().flat_map(campbell::figures));
    figures.extend(report.forced.iter().flat_map(forced::figures));
    if let Some(shock) = &report.shock {
        figures.extend(history::figures(shock));
        figures.extend(methods::figure(shock));
    }
    figures.extend(report.best_resonance().into_iter().flat_map(resonance::figures));
    figures.extend(levels::figure(report));
    // The closed form has a section of its own where another method leads.
    let closed = report.closed_form.iter().filter(|_| report.resonance.is_some());
    figures.extend(closed.flat_map(resonance::figures));
    figures.extend(report.basins.as_ref().map(basins::figure));
    figures.extend(planes(report));
    figures
}

/// The fold planes of a report, those by two methods in one figure.
fn planes(report: &ReportResult) -> Vec<Figure> {
    // Of an empty plane a report says so in words.
    let full = folds::pairs(report).into_iter();
    let full = full.filter(|(main, other)| {
        let curves = other.map_or(0, |other| other.curves.len());
        !main.curves.is_empty() || curves > 0
    });
    full.map(|(main, other)| folds::compared(main, other)).collect()
}

/// A name as part of an id and of the name of a file: letters, digits, points and hyphens.
pub(crate) fn slug(name: &str) -> String {
    let mut slug = String::with_capacity(name.len());
    for c in name.chars() {
        if c.is_alphanumeric() || (c == '.' && !slug.is_empty()) || c == '_' {
            slug.push(c);
        } else if !slug.ends_with('-') && !slug.is_empty() {
            slug.push('-');
        }
    }
    let slug: String = slug.trim_matches(['-', '.']).chars().take(60).collect();
    if slug.is_empty() { "figure".to_owned() } else { slug }
}

#[cfg(test)]
mod tests {
    use super::slug;

    /// Oracle: the contract: nothing that a file system or a selector acts on.
    #[test]
    fn slugs_are_safe_names() {
        assert_eq!(slug("half-shaft"), "half-shaft");
        assert_eq!(slug("../a b/<c>"), "a-b-c");
        assert_eq!(slug("  "), "figure");
        assert_eq!(slug("Welle 1 (links)"), "Welle-1-links");
        assert_eq!(slug("figure_08.x"), "figure_08.x");
    }
}
