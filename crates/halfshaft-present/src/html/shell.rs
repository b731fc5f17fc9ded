//! What stands around the sections of a page.

use halfshaft_results::Answer;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::Section;
use crate::account::head;
use crate::figure::plotly;
use crate::words::{number, plain};

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Nothing may be loaded from anywhere.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

/// Numbers beyond this size do not travel with the page, in bytes.
const MOST_DATA: usize = 12_000_000;

/// A page before it is put together.
pub(super) struct Sheet {
    /// What the page is, above its title.
    pub(super) kind: String,
    pub(super) title: String,
    /// One line about it; may be empty.
    pub(super) lead: String,
    pub(super) sections: Vec<Section>,
}

/// The whole page.
pub(super) fn render(sheet: &Sheet, answer: &Answer) -> String {
    let data = data(answer);
    let live = sheet.sections.iter().any(|section| section.body.0.contains("class=\"live\""));
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="referrer" content="no-referrer";
                title { (sheet.title) " – " (sheet.kind) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                a.skip href="#content" { "Skip to the content" }
                header.masthead {
                    p.kind { (sheet.kind) }
                    h1 { (sheet.title) }
                    @if !sheet.lead.trim().is_empty() { p.lead { (sheet.lead) } }
                    p.facts { (head::provenance(answer.header())) }
                    (save_button(sheet, data.as_deref()))
                }
                div.frame {
                    (contents(sheet))
                    main id="content" {
                        @for section in &sheet.sections {
                            section id=(section.id) {
                                h2 { (section.title) }
                                (section.body)
                            }
                        }
                    }
                }
                @if let Some(data) = &data {
                    script type="application/json" id="answer" { (PreEscaped(data)) }
                }
                @if live {
                    script { (PreEscaped(closed(plotly::BUNDLE))) }
                    script { (PreEscaped(closed(plotly::DRAW))) }
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// A script that cannot end its element early: plotly holds no such text today, and a later one
/// must not surprise.
fn closed(script: &str) -> String {
    script.replace("</script", "<\\/script").replace("<!--", "<\\!--")
}

fn contents(sheet: &Sheet) -> Markup {
    html! {
        @if sheet.sections.len() > 1 {
            nav.contents aria-label="Contents" {
                ol {
                    @for section in &sheet.sections {
                        li { a href={ "#" (section.id) } { (section.title) } }
                    }
                }
            }
        }
    }
}

fn save_button(sheet: &Sheet, data: Option<&str>) -> Markup {
    let Some(data) = data else { return html! {} };
    #[expect(clippy::cast_precision_loss, reason = "only for reading")]
    let size = number(data.len() as f64 / 1e6, 2);
    let name = crate::figures::slug(&plain(&sheet.title));
    html! {
        button.save type="button" hidden data-name={ (name) ".json" } {
            "Save the numbers (JSON, " (size) " MB)"
        }
    }
}

/// The answer as JSON that may stand in a script element; none where it is too large or does not
/// go into JSON.
fn data(answer: &Answer) -> Option<String> {
    let text = serde_json::to_string(answer).ok()?;
    let text = text.replace('<', "\\u003c").replace('>', "\\u003e");
    (text.len() <= MOST_DATA).then_some(text)
}
