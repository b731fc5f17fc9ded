//! `report`: everything in one page.

use std::path::Path;

use halfshaft::{Answer, present, write};

use super::{load_line, prepare};
use crate::args::Report;
use crate::console;
use crate::failure::Failure;
use crate::watch::Watch;

/// Where the report goes when nobody says.
const DEFAULT: &str = "report.html";

/// Asks everything and writes the page.
pub fn run(report: &Report, watch: &Watch) -> Result<(), Failure> {
    let common = &report.model.common;
    let line = load_line(&report.model)?;
    // JSON goes to standard output; a page is then only written where asked for.
    let path = common.out.as_deref().or((!common.json).then_some(Path::new(DEFAULT)));
    let target = path.map(|path| prepare(path, "report")).transpose()?;
    let answer = Answer::Report(Box::new(halfshaft::report(&line, watch)?));
    if target.is_none() {
        return super::deliver(&answer, None, common, watch);
    }
    watch.finish();
    watch.heed();
    if let Some(target) = &target {
        let written = write(&answer, target, watch)?;
        if !common.quiet && !common.json {
            console::say(&present::summary::text(&answer))?;
        }
        if !common.quiet {
            let names: Vec<String> =
                written.iter().map(|path| path.display().to_string()).collect();
            console::note(&format!("wrote {}", names.join(", ")));
        }
    }
    if common.json {
        return super::deliver(&answer, None, common, watch);
    }
    super::conclude(answer.header())
}
