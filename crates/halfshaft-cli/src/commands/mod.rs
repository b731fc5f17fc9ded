//! One file a command.

pub mod ask;
pub mod author;
mod manual;
pub mod report;
pub mod run;

use std::path::Path;

use halfshaft::results::Header;
use halfshaft::{Answer, Driveline, SetFlag, Target, load, load_embedded, present, write};

use crate::args::{Common, Model};
use crate::console;
use crate::diagnostics;
use crate::failure::Failure;
use crate::watch::Watch;

/// The line that a command is about, with the settings of the command.
pub fn load_line(model: &Model) -> Result<Driveline, Failure> {
    let common = &model.common;
    let settings: Vec<SetFlag> = common.settings.iter().cloned().map(SetFlag).collect();
    let loaded = match &model.model {
        Some(path) => load(path, &settings)?,
        None => load_embedded(&settings)?,
    };
    if !loaded.warnings.items.is_empty() && !common.quiet {
        console::note(&diagnostics::render(&loaded.warnings));
    }
    Ok(loaded.line)
}

/// Where the answer goes, tried before any work is done.
pub fn target(common: &Common, analysis: &str) -> Result<Option<Target>, Failure> {
    common.out.as_deref().map(|path| prepare(path, analysis)).transpose()
}

/// A target that a path means for the answer of an analysis.
pub fn prepare(path: &Path, analysis: &str) -> Result<Target, Failure> {
    Target::prepare(path, analysis).map_err(|error| Failure::bad_target(&error))
}

/// Prints and writes an answer, and says whether it ended early.
pub fn deliver(
    answer: &Answer,
    target: Option<&Target>,
    common: &Common,
    watch: &Watch,
) -> Result<(), Failure> {
    watch.finish();
    let header = answer.header();
    // Ctrl-C has ended the computation; what was reached is still written.
    watch.heed();
    if let Some(target) = target {
        let written = write(answer, target, watch)?;
        if !common.quiet {
            let names: Vec<String> =
                written.iter().map(|path| path.display().to_string()).collect();
            console::note(&format!("wrote {}", names.join(", ")));
        }
    }
    if common.json {
        if !common.quiet {
            header.warnings.iter().for_each(|warning| console::warn(warning));
        }
        let text = halfshaft::results::io::to_json(answer, true)
            .map_err(|error| Failure::Output { message: error.to_string(), advice: None })?;
        console::say(&format!("{text}\n"))?;
    } else if !common.quiet && target.is_none() {
        console::say(&present::summary::text(answer))?;
    } else if !common.quiet {
        header.warnings.iter().for_each(|warning| console::warn(warning));
    }
    conclude(header)
}

/// Whether an answer is all that was asked for; where not, that is what the program ends with.
fn conclude(header: &Header) -> Result<(), Failure> {
    if header.termination.is_complete() {
        return Ok(());
    }
    let detail = header.termination.detail.clone().unwrap_or_default();
    let message = format!("{} ended early: {detail}", header.analysis);
    Err(Failure::Analysis { message, advice: None })
}
