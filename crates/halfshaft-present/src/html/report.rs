//! The sections of a report: first what was found, then everything behind it.

use halfshaft_results::{Answer, ReportResult};
use maud::{Markup, html};

use super::Section;
use super::blocks;
use super::figure::{Figures, figure, still};
use super::shell::Sheet;
use super::single::{basis, warnings};
use crate::account::{
    Account, basins, campbell, check, folds, forced, head, levels, modes, resonance, shock, statics,
};
use crate::findings::{self, COMFORTABLE, Finding, Standing};
use crate::words::{bound, capital, number, plain};
use crate::{figures, sketch};

/// The page of a report.
pub(super) fn sheet(answer: &Answer, report: &ReportResult) -> Sheet {
    let mut left = Figures::new(figures::of(answer));
    let mut sections = vec![
        Section::new("summary", "In short", summary(answer, report)),
        Section::new("line", head::title("check"), line(report)),
    ];
    let mut add = |analysis: &str, account: Option<Account>| {
        if let Some(account) = account {
            let body = blocks::account(&account, &mut left);
            sections.push(Section::new(analysis, head::title(analysis), body));
        }
    };
    add("static", report.statics.as_ref().map(statics::account));
    add("modes", report.modes.as_ref().map(modes::account));
    add("campbell", report.campbell.as_ref().map(campbell::account));
    add("forced", report.forced.as_ref().map(forced::account));
    add("shock", report.shock.as_ref().map(shock::account));
    add("resonance", report.best_resonance().map(resonance::account));
    add("levels", Some(levels::account(report)).filter(|account| !account.blocks.is_empty()));
    let closed = report.closed_form.as_ref().filter(|_| report.resonance.is_some());
    add("closed-form", closed.map(resonance::account));
    add("basins", report.basins.as_ref().map(basins::account));
    if !report.folds.is_empty() || !report.closed_folds.is_empty() {
        let body = planes(report, &mut left);
        sections.push(Section::new("folds", head::title("folds"), body));
    }
    let rest = left.rest();
    if !rest.is_empty() {
        let body = html! { @for one in &rest { (figure(one)) } };
        sections.push(Section::new("more", "Further figures", body));
    }
    sections.push(Section::new("basis", "What this rests on", basis(answer)));
    Sheet {
        kind: "Driveline report".to_owned(),
        title: plain(&report.header.model.name),
        lead: plain(&report.check.description),
        sections,
    }
}

/// What is safe, what is not, by how much.
fn summary(answer: &Answer, report: &ReportResult) -> Markup {
    let found = findings::of(report);
    html! {
        p.headline { (findings::headline(&found)) }
        ul.findings { @for finding in &found { (one(finding)) } }
        p.note {
            "A margin is what a part can carry over what is asked of it; below "
            (number(COMFORTABLE, 3)) " it is marked “watch”. "
            span.screen {
                "Figures: drag to zoom, double-click to go back, point to read off, click a name in the \
                 legend to hide its curve."
            }
        }
        (warnings(answer))
    }
}

fn one(finding: &Finding) -> Markup {
    let (class, sign) = match finding.standing {
        Standing::Unsafe => ("unsafe", "✗"),
        Standing::Watch => ("watch", "!"),
        Standing::Open => ("open", "?"),
        Standing::Safe => ("safe", "✓"),
        Standing::Note => ("about", "i"),
    };
    html! {
        li class=(class) {
            span.mark { span.sign aria-hidden="true" { (sign) } " " (finding.standing.word()) }
            div { strong { (finding.topic) ". " } (bound(&finding.text)) }
        }
    }
}

/// What the line is made of.
fn line(report: &ReportResult) -> Markup {
    let line = &report.check;
    let none = &mut Figures::new(Vec::new());
    html! {
        p { (capital(&check::makeup(line))) "." }
        (still(&sketch::embedded(line), sketch::LEGEND))
        p { (check::nonlinearities(line)) }
        (blocks::account(&check::elements(line), none))
    }
}

/// Every fold plane under its own heading.
fn planes(report: &ReportResult, left: &mut Figures) -> Markup {
    html! {
        @for (index, (plane, closed)) in figures::folds::pairs(report).into_iter().enumerate() {
            h3 { "Over the " (folds::parameter(plane)) }
            (blocks::account(&folds::plane(plane, index == 0), left))
            (blocks::account(&folds::beside(closed), left))
        }
    }
}
