//! The options of a question as Python gives them.

use halfshaft::model::question;
use halfshaft::{Driveline, Question, QuestionText, Verb};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors;

/// The question that a verb and its options in words ask about a line. Options are named as the
/// command's flags with underscores; values are texts, `True` for flags, a list of texts for `initial`.
///
/// # Errors
/// `QuestionError` with every mistake.
pub fn question(verb: &str, options: &Bound<'_, PyDict>, line: &Driveline) -> PyResult<Question> {
    let py = options.py();
    let Some((_, verb)) = Verb::ALL.iter().find(|(name, _)| *name == verb) else {
        return Err(errors::option(py, verb, "there is no such question"));
    };
    let text = words(options)?;
    question::read(*verb, &text, line).map_err(|found| errors::options(py, &found))
}

fn words(options: &Bound<'_, PyDict>) -> PyResult<QuestionText> {
    let mut text = QuestionText::default();
    for (name, value) in options {
        let name: String = name.extract()?;
        if name == "initial" {
            text.initial = value.extract()?;
        } else if let Some(flag) = flag(&mut text, &name) {
            *flag = value.extract()?;
        } else if let Some(word) = word(&mut text, &name) {
            *word = Some(value.extract()?);
        } else {
            return Err(errors::option(options.py(), &name, "there is no such option"));
        }
    }
    Ok(text)
}

fn flag<'t>(text: &'t mut QuestionText, name: &str) -> Option<&'t mut bool> {
    Some(match name {
        "printed_velocity" => &mut text.printed_velocity,
        "compare" => &mut text.compare,
        "verify" => &mut text.verify,
        "backbone" => &mut text.backbone,
        "no_branches" => &mut text.no_branches,
        "this_gear" => &mut text.this_gear,
        _ => return None,
    })
}

/// The place of an option by the name of its field.
macro_rules! named {
    ($text:ident, $name:ident: $($field:ident)*) => {
        match $name {
            $(stringify!($field) => Some(&mut $text.$field),)*
            _ => None,
        }
    };
}

fn word<'t>(text: &'t mut QuestionText, name: &str) -> Option<&'t mut Option<String>> {
    named!(text, name: duration start frequency step tolerance record method order equation mode
        points parameter equilibrium harmonics stability grid window shaft periods shock rate
        integrator orders friction steps transient direction count operating node)
}
