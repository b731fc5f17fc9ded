//! What is told of an answer: sentences, tables and places for figures, in the order of reading.
//!
//! The terminal and the page show the same account, so that the same words and numbers stand in
//! both. One file a kind of answer.

use halfshaft_results::{Answer, Header};

pub(crate) use grid::{Grid, GridColumn, Tone};

pub(crate) mod basins;
pub(crate) mod bifurcation;
pub(crate) mod campbell;
pub(crate) mod check;
pub(crate) mod folds;
pub(crate) mod forced;
pub(crate) mod head;
pub(crate) mod history;
pub(crate) mod jumps;
pub(crate) mod levels;
pub(crate) mod methods;
pub(crate) mod modes;
pub(crate) mod next;
pub(crate) mod periodic;
pub(crate) mod report;
pub(crate) mod resonance;
pub(crate) mod shock;
pub(crate) mod smallest;
pub(crate) mod statics;
pub(crate) mod study;
pub(crate) mod verification;

mod chain;
mod events;
mod grid;

/// A piece of an account.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Block {
    /// A heading within the account.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// An explanation of a term, or how to read what follows.
    Note(String),
    /// Short statements.
    List(Vec<String>),
    /// Lines that keep their breaks and spaces.
    Lines(Vec<String>),
    /// A table.
    Grid(Grid),
    /// The place of the figure of that id, where figures can be shown.
    Figure(String),
}

/// An account while it is written.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Account {
    pub(crate) blocks: Vec<Block>,
}

impl Account {
    pub(crate) fn heading(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Heading(text.into()));
    }

    /// A paragraph of sentences; nothing where there is none.
    pub(crate) fn text(&mut self, sentences: impl IntoIterator<Item = String>) {
        let sentences: Vec<String> =
            sentences.into_iter().filter(|sentence| !sentence.is_empty()).collect();
        if !sentences.is_empty() {
            self.blocks.push(Block::Text(sentences.join(" ")));
        }
    }

    pub(crate) fn note(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Note(text.into()));
    }

    pub(crate) fn list(&mut self, items: Vec<String>) {
        if !items.is_empty() {
            self.blocks.push(Block::List(items));
        }
    }

    pub(crate) fn lines(&mut self, lines: Vec<String>) {
        if !lines.is_empty() {
            self.blocks.push(Block::Lines(lines));
        }
    }

    /// A table, unless it has no row.
    pub(crate) fn grid(&mut self, grid: Grid) {
        if grid.rows() > 0 {
            self.blocks.push(Block::Grid(grid));
        }
    }

    pub(crate) fn figure(&mut self, id: impl Into<String>) {
        self.blocks.push(Block::Figure(id.into()));
    }

    pub(crate) fn append(&mut self, other: Self) {
        self.blocks.extend(other.blocks);
    }
}

/// The account of any answer.
pub(crate) fn of(answer: &Answer) -> Account {
    match answer {
        Answer::Check(result) => check::account(result),
        Answer::Static(result) => statics::account(result),
        Answer::Modes(result) => modes::account(result),
        Answer::Campbell(result) => campbell::account(result),
        Answer::Forced(result) => forced::account(result),
        Answer::History(result) if result.shock.is_some() => shock::account(result),
        Answer::History(result) => history::account(result),
        Answer::Resonance(result) => resonance::account(result),
        Answer::Folds(result) => folds::account(result),
        Answer::Basins(result) => basins::account(result),
        Answer::Bifurcation(result) => bifurcation::account(result),
        Answer::Study(result) => study::account(result),
        Answer::Report(result) => report::account(result),
    }
}

/// Warnings or assumptions of an answer and of the answers in it, each once.
pub(crate) fn gathered(answer: &Answer, of: fn(&Header) -> &Vec<String>) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for text in headers(answer).into_iter().flat_map(of) {
        if !all.contains(text) {
            all.push(text.clone());
        }
    }
    all
}

/// The head of an answer and those of the answers in it.
pub(crate) fn headers(answer: &Answer) -> Vec<&Header> {
    let mut headers = vec![answer.header()];
    match answer {
        Answer::Report(report) => {
            headers.push(&report.check.header);
            headers.extend(report.statics.as_ref().map(|part| &part.header));
            headers.extend(report.modes.as_ref().map(|part| &part.header));
            headers.extend(report.shock.as_ref().map(|part| &part.header));
            let resonances = [&report.resonance, &report.first_harmonic, &report.closed_form];
            headers.extend(resonances.into_iter().flatten().map(|part| &part.header));
            headers.extend(report.basins.as_ref().map(|part| &part.header));
            headers.extend(report.folds.iter().map(|part| &part.header));
            headers.extend(report.closed_folds.iter().map(|part| &part.header));
        }
        Answer::Study(study) => {
            headers
                .extend(study.items.iter().filter_map(|item| Some(item.answer.as_ref()?.header())));
        }
        _ => {}
    }
    headers
}
