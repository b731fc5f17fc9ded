//! An account as HTML.

use maud::{Markup, html};

use super::figure::{Figures, figure};
use crate::account::{Account, Block, Grid, GridColumn, Tone};
use crate::words::bound;

/// All blocks in their order; figures go where the account has a place for them.
pub(super) fn account(account: &Account, figures: &mut Figures) -> Markup {
    html! {
        @for block in &account.blocks { (one(block, figures)) }
    }
}

/// One block.
pub(super) fn one(block: &Block, figures: &mut Figures) -> Markup {
    match block {
        Block::Heading(text) => html! { h3 { (text) } },
        Block::Text(text) => html! { p { (bound(text)) } },
        Block::Note(text) => html! { p.note { (bound(text)) } },
        Block::List(items) => list(items),
        // A chain of names is what the sketch shows.
        Block::Lines(_) => html! {},
        Block::Grid(table) => grid(table),
        Block::Figure(id) => figures.take(id).map_or_else(|| html! {}, |found| figure(&found)),
    }
}

/// Short statements.
pub(super) fn list<T: AsRef<str>>(items: &[T]) -> Markup {
    html! {
        @if !items.is_empty() {
            ul { @for item in items { li { (bound(item.as_ref())) } } }
        }
    }
}

/// A table that scrolls in a box of its own where the page is too narrow.
pub(super) fn grid(grid: &Grid) -> Markup {
    html! {
        @if !grid.title.is_empty() { p.title { (grid.title) } }
        div.table tabindex="0" role="region" aria-label=(grid.title) {
            table class=(if grid.rows() <= BRIEF { "brief" } else { "" }) {
                thead { tr { @for column in &grid.columns { (head(column)) } } }
                tbody {
                    @for row in 0..grid.rows() {
                        tr class=(tone(grid.tone(row))) {
                            @for column in &grid.columns { (cell(column, row)) }
                        }
                    }
                }
            }
        }
    }
}

fn head(column: &GridColumn) -> Markup {
    html! {
        th scope="col" class=(kind(column)) {
            (column.name)
            @if !column.unit.is_empty() { " " span.unit { (column.unit) } }
        }
    }
}

fn cell(column: &GridColumn, row: usize) -> Markup {
    let text = column.cells.get(row).map_or("", String::as_str);
    html! { td class=(kind(column)) { (text) } }
}

fn kind(column: &GridColumn) -> &'static str {
    let longest = column.cells.iter().map(|cell| cell.chars().count()).max().unwrap_or(0);
    match longest {
        _ if column.numeric => "number",
        0..=SHORT => "short",
        _ => "words",
    }
}

/// Tables up to this many rows stay on one sheet of paper.
const BRIEF: usize = 15;

/// Words up to this length stay in one line.
const SHORT: usize = 22;

fn tone(tone: Tone) -> &'static str {
    match tone {
        Tone::Usual => "",
        Tone::Good => "good",
        Tone::Bad => "bad",
        Tone::Main => "main",
    }
}
