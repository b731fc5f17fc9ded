//! The head of every result.

use halfshaft_model::Driveline;
use halfshaft_model::elements::Shaft;
use halfshaft_model::question::{DryFriction, Question, ShockMethod};
use halfshaft_results::{Header, ModelIdentity, Termination};

/// The head of an answer to `question` about `line` that was answered in full.
pub(crate) fn header(line: &Driveline, question: &Question) -> Header {
    Header {
        analysis: question.verb().name().to_owned(),
        model: ModelIdentity { name: line.name().to_owned(), digest: line.digest() },
        settings: settings(question),
        termination: Termination::completed(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        warnings: Vec::new(),
        assumptions: friction(line, question),
    }
}

/// How dry friction is taken.
fn friction(line: &Driveline, question: &Question) -> Vec<String> {
    let exact = match question {
        Question::Simulate(simulate) => simulate.friction == DryFriction::Exact,
        Question::Shock(shock) => shock.method == ShockMethod::Full,
        _ => false,
    };
    let rough = line.shafts().iter().filter(|shaft| shaft.friction_nm > 0.0);
    let sentence = |shaft: &Shaft| {
        if exact {
            return format!(
                "the dry friction of {} is exact: it slides with {} N·m or sticks",
                shaft.name, shaft.friction_nm
            );
        }
        format!(
            "the dry friction of {} is smoothed: {} N·m · tanh(rate of twist / {} rad/s); at rest it \
             carries nothing, and a shaft that sticks creeps",
            shaft.name, shaft.friction_nm, shaft.friction_speed_rad_s
        )
    };
    rough.map(sentence).collect()
}

/// The settings of a question as JSON, without the name of the question around them.
fn settings(question: &Question) -> serde_json::Value {
    // Questions are plain data, which JSON can always hold.
    match serde_json::to_value(question) {
        Ok(serde_json::Value::Object(object)) => {
            object.into_iter().next().map_or(serde_json::Value::Null, |(_, inner)| inner)
        }
        _ => serde_json::json!({}),
    }
}
