//! The page of an answer that is no report.

use halfshaft_results::{Answer, Header};
use maud::{Markup, html};

use super::Section;
use super::blocks::{self, list};
use super::figure::{Figures, figure, still};
use super::shell::Sheet;
use crate::account::{self, Account, Block, check::minus, head};
use crate::words::plain;
use crate::{figures, sketch};

/// The page: warnings, then the account with its figures, then what it rests on.
pub(super) fn sheet(answer: &Answer) -> Sheet {
    let header = answer.header();
    let mut left = Figures::new(figures::of(answer));
    let mut sections = Vec::new();
    let parts = parts(account::of(answer), &head::title(&header.analysis));
    for (index, (title, account)) in parts.iter().enumerate() {
        let body = html! {
            @if index == 0 { (warnings(answer)) (drawing(answer)) }
            (blocks::account(account, &mut left))
            @if index + 1 == parts.len() {
                @for rest in left.rest() { (figure(&rest)) }
            }
        };
        sections.push(Section::new(&format!("part-{}", index + 1), title.clone(), body));
    }
    sections.push(Section::new("basis", "What this rests on", basis(answer)));
    Sheet {
        kind: format!("halfshaft {}", plain(&header.analysis)),
        title: plain(&header.model.name),
        lead: String::new(),
        sections,
    }
}

/// An account cut at its headings.
fn parts(account: Account, title: &str) -> Vec<(String, Account)> {
    let mut parts = vec![(title.to_owned(), Account::default())];
    for block in account.blocks {
        match block {
            Block::Heading(text) => parts.push((text, Account::default())),
            block => {
                if let Some((_, part)) = parts.last_mut() {
                    part.blocks.push(block);
                }
            }
        }
    }
    parts
}

/// Warnings and early ends, before anything else.
pub(super) fn warnings(answer: &Answer) -> Markup {
    let mut texts = head::early_ends(answer);
    let of = |header: &Header| -> Vec<String> { header.warnings.clone() };
    let gathered = account::headers(answer).into_iter().flat_map(of);
    for text in gathered.map(|text| minus(&plain(&text))) {
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    html! {
        @if !texts.is_empty() {
            div.warnings role="note" {
                p { strong { "Warnings" } }
                (list(&texts))
            }
        }
    }
}

fn drawing(answer: &Answer) -> Markup {
    match answer {
        Answer::Check(check) => still(&sketch::embedded(check), sketch::LEGEND),
        _ => html! {},
    }
}

/// Assumptions, settings, program and model.
pub(super) fn basis(answer: &Answer) -> Markup {
    let assumptions = account::gathered(answer, |header| &header.assumptions);
    let assumptions: Vec<String> = assumptions.iter().map(|text| minus(&plain(text))).collect();
    html! {
        @if !assumptions.is_empty() {
            h3 { "Assumptions" }
            (list(&assumptions))
        }
        h3 { "Program and model" }
        dl {
            dt { "Program" } dd { "halfshaft " (plain(&answer.header().version)) }
            dt { "Model" } dd { (plain(&answer.header().model.name)) }
            dt { "Digest of the model (SHA-256)" }
            dd.digest { (plain(&answer.header().model.digest)) }
        }
        (settings(answer))
    }
}

/// The settings of every analysis.
fn settings(answer: &Answer) -> Markup {
    let mut told: Vec<(String, Vec<String>)> = Vec::new();
    for header in account::headers(answer) {
        let one = (plain(&header.analysis), head::settings(header));
        // Studies ask many questions with the same settings about other models.
        if !one.1.is_empty() && !told.contains(&one) {
            told.push(one);
        }
    }
    html! {
        @if !told.is_empty() {
            h3 { "Settings" }
            dl {
                @for (analysis, settings) in &told {
                    dt { (analysis) } dd { (settings.join("; ")) }
                }
            }
        }
    }
}
