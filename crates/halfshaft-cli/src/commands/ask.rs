//! The questions: check, static, modes, simulate, shock, resonance, folds.

use halfshaft::model::question;

use super::{deliver, load_line, target};
use crate::args::Ask;
use crate::failure::Failure;
use crate::watch::Watch;

/// Answers a question about a line.
pub fn run(ask: &Ask, watch: &Watch) -> Result<(), Failure> {
    let (verb, model, text) = ask.question();
    let line = load_line(model)?;
    let question = question::read(verb, &text, &line).map_err(Failure::Options)?;
    let target = target(&model.common, verb.name())?;
    let answer = halfshaft::ask(&line, &question, watch)?;
    deliver(&answer, target.as_ref(), &model.common, watch)
}
