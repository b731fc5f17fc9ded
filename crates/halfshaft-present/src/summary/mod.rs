//! The answer as plain text for a terminal: warnings first, then the answer in words and tables,
//! then what was assumed.
//!
//! No line is wider than [`WIDTH`] columns, and no name can act on the terminal.

use halfshaft_results::{Answer, Header};

use crate::account::{self, Block, check::minus, head};
use crate::words::plain;
use page::Page;

mod page;
mod table;
mod wrap;

/// Widest line, in columns.
pub const WIDTH: usize = 100;

/// The plain-text answer.
///
/// ```
/// use halfshaft_present::summary;
/// use halfshaft_results::{Answer, Header, ModelIdentity, StudyResult, Termination};
///
/// let header = Header {
///     analysis: "run".to_owned(),
///     model: ModelIdentity { name: "My study".to_owned(), digest: "00".to_owned() },
///     settings: serde_json::json!({}),
///     termination: Termination::completed(),
///     version: "0.1.0".to_owned(),
///     warnings: vec!["nothing was asked".to_owned()],
///     assumptions: Vec::new(),
/// };
/// let study = StudyResult {
///     header,
///     description: String::new(),
///     items: Vec::new(),
///     figures: Vec::new(),
///     comparisons: Vec::new(),
/// };
/// let text = summary::text(&Answer::Study(study));
/// assert!(text.starts_with("warning: nothing was asked\n"));
/// ```
#[must_use]
pub fn text(answer: &Answer) -> String {
    let header = answer.header();
    let mut page = Page::default();
    let warnings = account::gathered(answer, |header: &Header| &header.warnings);
    for warning in &warnings {
        page.paragraph("warning: ", &minus(&plain(warning)));
    }
    for end in head::early_ends(answer) {
        page.paragraph("warning: ", &end);
    }
    page.gap();
    page.title(&format!("{}: {}", head::title(&header.analysis), plain(&header.model.name)));
    for block in &account::of(answer).blocks {
        add(&mut page, block);
    }
    let assumptions = account::gathered(answer, |header: &Header| &header.assumptions);
    if !assumptions.is_empty() {
        page.heading("Assumptions");
        page.list(&assumptions.iter().map(|text| minus(&plain(text))).collect::<Vec<_>>());
    }
    if let Some(next) = account::next::next(answer) {
        page.gap();
        page.paragraph("Next: ", &next);
    }
    page.gap();
    page.paragraph("", &head::provenance(header));
    page.finish()
}

fn add(page: &mut Page, block: &Block) {
    match block {
        Block::Heading(text) => page.heading(text),
        Block::Text(text) | Block::Note(text) => {
            page.gap();
            page.paragraph("", text);
        }
        Block::List(items) => {
            page.gap();
            page.list(items);
        }
        Block::Lines(lines) => {
            page.gap();
            for line in lines {
                page.kept(&format!("    {line}"));
            }
        }
        Block::Grid(grid) => {
            page.gap();
            page.lines(&table::render(grid, WIDTH));
        }
        Block::Figure(_) => {}
    }
}
