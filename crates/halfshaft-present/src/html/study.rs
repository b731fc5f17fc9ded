//! The sections of a study: every figure with its comparisons, and all comparisons at the end.

use halfshaft_results::{Answer, StudyFigureSpec, StudyResult};
use maud::{Markup, html};

use super::Section;
use super::blocks;
use super::figure::{Figures, figure};
use super::shell::Sheet;
use super::single::{basis, warnings};
use crate::account::{Account, study};
use crate::figures;
use crate::words::plain;

/// The page of a study.
pub(super) fn sheet(answer: &Answer, result: &StudyResult) -> Sheet {
    let mut left = Figures::new(figures::study_figures(result));
    let mut sections = vec![Section::new("study", "What was asked", opening(answer, result))];
    for (index, spec) in result.figures.iter().enumerate() {
        let body = blocks::account(&study::figure(result, spec), &mut left);
        sections.push(Section::new(&format!("figure-{}", index + 1), title(spec), body));
    }
    let rest = left.rest();
    if !rest.is_empty() {
        let body = html! { @for one in &rest { (figure(one)) } };
        sections.push(Section::new("more", "Further figures", body));
    }
    if !result.comparisons.is_empty() {
        let mut all = Account::default();
        all.grid(study::comparisons(result, None));
        let body = blocks::account(&all, &mut Figures::new(Vec::new()));
        sections.push(Section::new("comparisons", "All comparisons", body));
    }
    sections.push(Section::new("basis", "What this rests on", basis(answer)));
    Sheet {
        kind: "Study".to_owned(),
        title: plain(&result.header.model.name),
        lead: plain(&result.description),
        sections,
    }
}

fn title(spec: &StudyFigureSpec) -> String {
    let title = plain(&spec.title);
    if title.trim().is_empty() { plain(&spec.name) } else { title }
}

fn opening(answer: &Answer, result: &StudyResult) -> Markup {
    let account = study::opening(result);
    html! {
        (warnings(answer))
        // The description stands above already.
        @for block in account.blocks.iter().skip(usize::from(!result.description.is_empty())) {
            (blocks::one(block, &mut Figures::new(Vec::new())))
        }
    }
}
