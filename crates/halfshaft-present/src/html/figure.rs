//! One figure of a page.

use maud::{Markup, PreEscaped, html};

use crate::figure::scene::{Level, Rich};
use crate::figure::{Figure, SvgOptions, plotly, svg};
use crate::words::bound;

/// The figures of a page, to be put where the account wants them.
pub(super) struct Figures {
    waiting: Vec<Figure>,
}

impl Figures {
    pub(super) fn new(figures: Vec<Figure>) -> Self {
        Self { waiting: figures }
    }

    /// The figure of that id, once; asked again, the next one that would have had the same id and
    /// was given a number.
    pub(super) fn take(&mut self, id: &str) -> Option<Figure> {
        let numbered = |figure: &Figure| {
            let rest = figure.id.strip_prefix(id).and_then(|rest| rest.strip_prefix('-'));
            rest.is_some_and(|number| number.parse::<usize>().is_ok())
        };
        let own = self.waiting.iter().position(|figure| figure.id == id);
        let index = own.or_else(|| self.waiting.iter().position(numbered))?;
        Some(self.waiting.remove(index))
    }

    /// Figures that no account asked for.
    pub(super) fn rest(&mut self) -> Vec<Figure> {
        std::mem::take(&mut self.waiting)
    }
}

/// A figure: still at first, live when the reader comes near.
pub(super) fn figure(figure: &Figure) -> Markup {
    let value = plotly::figure_json(figure);
    let height = |pointer: &str| {
        value.pointer(pointer).and_then(serde_json::Value::as_f64).unwrap_or(400.0).round()
    };
    let room = format!(
        "--wide:{}px;--narrow:{}px",
        height("/layout/height"),
        height("/layout/meta/narrow/height")
    );
    let still = svg::render(figure, &SvgOptions { embed_in_html: true });
    html! {
        figure.plot id={ "fig-" (figure.id) } {
            div.room style=(room) {
                div.live {}
                div.still { (PreEscaped(still)) }
            }
            script type="application/json" { (PreEscaped(plotly::script_json(&value))) }
            @if !figure.caption.trim().is_empty() {
                figcaption { (rich(&Rich::parse(&bound(&figure.caption)))) }
            }
        }
    }
}

/// A drawing that only stands still.
pub(super) fn still(drawing: &str, caption: &str) -> Markup {
    html! {
        figure.sketch {
            div.scroll tabindex="0" { (PreEscaped(drawing)) }
            figcaption { (caption) }
        }
    }
}

/// A text with its levels.
fn rich(text: &Rich) -> Markup {
    html! {
        @for run in &text.runs {
            @match run.level {
                Level::Base => { (run.text) }
                Level::Sub => { sub { (run.text) } }
                Level::Super => { sup { (run.text) } }
            }
        }
    }
}
