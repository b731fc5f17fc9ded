//! One self-contained page for an answer.
//!
//! The page needs no network and forbids it to itself: style, scripts, figures and numbers are
//! inside. Every figure stands in it twice: as SVG, which is there at once, prints, and needs no
//! script, and as data for plotly, which takes its place when the reader comes near.
//!
//! | part | file |
//! |---|---|
//! | head, contents, scripts around everything | `shell` |
//! | sections of a report | `report` |
//! | sections of a study | `study` |
//! | sections of any other answer | `single` |
//! | an account as paragraphs and tables | `blocks` |
//! | one figure | `figure` |

use halfshaft_results::Answer;

mod blocks;
mod figure;
mod report;
mod shell;
mod single;
mod study;

/// The page of an answer.
///
/// ```
/// use halfshaft_present::html;
/// use halfshaft_results::{Answer, Header, ModelIdentity, StudyResult, Termination};
///
/// let header = Header {
///     analysis: "run".to_owned(),
///     model: ModelIdentity { name: "<My> study".to_owned(), digest: "00".to_owned() },
///     settings: serde_json::json!({}),
///     termination: Termination::completed(),
///     version: "0.1.0".to_owned(),
///     warnings: Vec::new(),
///     assumptions: Vec::new(),
/// };
/// let study = StudyResult {
///     header,
///     description: String::new(),
///     items: Vec::new(),
///     figures: Vec::new(),
///     comparisons: Vec::new(),
/// };
/// let page = html::page(&Answer::Study(study));
/// assert!(page.starts_with("<!DOCTYPE html>") && page.contains("&lt;My&gt; study"));
/// ```
#[must_use]
pub fn page(answer: &Answer) -> String {
    let sheet = match answer {
        Answer::Report(report) => report::sheet(answer, report),
        Answer::Study(study) => study::sheet(answer, study),
        _ => single::sheet(answer),
    };
    shell::render(&sheet, answer)
}

/// A section with its place in the contents.
struct Section {
    id: String,
    title: String,
    body: maud::Markup,
}

impl Section {
    fn new(id: &str, title: impl Into<String>, body: maud::Markup) -> Self {
        Self { id: id.to_owned(), title: title.into(), body }
    }
}
