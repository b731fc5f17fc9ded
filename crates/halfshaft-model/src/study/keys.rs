//! The keys of a study file.

use crate::format::{KeySpec, TableSpec, ValueSpec, words};
use crate::question::Verb;
use crate::units::{QuantityKind, Sign};

const VERBS: [&str; Verb::ALL.len()] = words(&Verb::ALL);

const fn option(name: &'static str, doc: &'static str) -> KeySpec {
    KeySpec::new(name, ValueSpec::Text, doc)
}

/// Keys of a question; options have the names and meanings of the command's flags.
pub static QUESTION: TableSpec = TableSpec {
    name: "question",
    doc: "One question; options are those of the command of the same name.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name, unique in its figure; also in the legend.")
            .required(),
        KeySpec::new("ask", ValueSpec::Choice(&VERBS), "What is asked.").required(),
        option("model", "Model file, relative to the study. Default: the study's."),
        KeySpec::new("set", ValueSpec::Texts, "Settings \"ADDRESS=VALUE\"."),
        KeySpec::new("initial", ValueSpec::Texts, "Initial values \"CHANNEL=VALUE\"."),
        option("duration", "As --duration."),
        option("start", "As --start."),
        option("frequency", "As --frequency."),
        option("step", "As --step."),
        option("tolerance", "As --tolerance."),
        option("record", "As --record."),
        option("method", "As --method."),
        option("order", "As --order."),
        option("equation", "As --equation."),
        option("mode", "As --mode."),
        option("points", "As --points."),
        option("parameter", "As --parameter."),
        option("equilibrium", "As --equilibrium."),
        option("harmonics", "As --harmonics."),
        option("stability", "As --stability."),
        option("grid", "As --grid."),
        option("window", "As --window."),
        option("shaft", "As --shaft."),
        option("periods", "As --periods."),
        option("shock", "As --shock."),
        option("rate", "As --rate."),
        option("friction", "As --friction."),
        option("orders", "As --orders."),
        option("integrator", "As --integrator."),
        option("steps", "As --steps."),
        option("transient", "As --transient."),
        option("direction", "As --direction."),
        option("count", "As --count."),
        option("operating", "As --operating."),
        option("node", "As --node."),
        KeySpec::new("no-branches", ValueSpec::Flag, "As --no-branches."),
        KeySpec::new("this-gear", ValueSpec::Flag, "As --this-gear."),
        KeySpec::new("backbone", ValueSpec::Flag, "As --backbone."),
        KeySpec::new("printed-velocity", ValueSpec::Flag, "As --printed-velocity."),
        KeySpec::new("verify", ValueSpec::Flag, "As --verify."),
        KeySpec::new("compare", ValueSpec::Flag, "As --compare."),
        KeySpec::new(
            "style",
            ValueSpec::Choice(&["line", "second", "hidden"]),
            "How its curve is drawn. Default line.",
        ),
    ],
};

static SPECIAL: TableSpec = TableSpec {
    name: "special point",
    doc: "A special point of an answer.",
    keys: &[
        KeySpec::new("kind", ValueSpec::Text, "Kind, e.g. fold or cusp.").required(),
        KeySpec::new("number", ValueSpec::Count(1, 1000), "Which of that kind. Default 1."),
        KeySpec::new("column", ValueSpec::Text, "Column to read; left out to count the points."),
    ],
};

static AT: TableSpec = TableSpec {
    name: "table value",
    doc: "A column of the answer's table where its first column has a value.",
    keys: &[
        KeySpec::new("column", ValueSpec::Text, "Column to read.").required(),
        KeySpec::new(
            "x",
            ValueSpec::Quantity(QuantityKind::Number, Sign::Any),
            "Value of the first column, in SI.",
        )
        .required(),
    ],
};

/// Keys of a comparison.
pub static COMPARISON: TableSpec = TableSpec {
    name: "comparison",
    doc: "A printed number beside the recomputed one.",
    keys: &[
        KeySpec::new("what", ValueSpec::Text, "What is compared.").required(),
        KeySpec::new("of", ValueSpec::Text, "Name of the question in this figure."),
        KeySpec::new("pointer", ValueSpec::Text, "JSON pointer into the answer."),
        KeySpec::new("at", ValueSpec::Table(&AT), "Value in the answer's table."),
        KeySpec::new("special", ValueSpec::Table(&SPECIAL), "Special point of the answer."),
        KeySpec::new(
            "ranking",
            ValueSpec::Text,
            "JSON pointer whose magnitude ranks all questions of the figure.",
        ),
        KeySpec::new(
            "printed",
            ValueSpec::Quantity(QuantityKind::Number, Sign::Any),
            "The printed number, in SI.",
        ),
        KeySpec::new("printed_order", ValueSpec::Texts, "Question names, largest value first."),
        KeySpec::new("printed_text", ValueSpec::Text, "What is printed, in words."),
        KeySpec::new("remark", ValueSpec::Text, "What to make of the difference."),
    ],
};

static FIGURE: TableSpec = TableSpec {
    name: "figure",
    doc: "A figure drawn from the answers of its questions.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name, also of its files.").required(),
        KeySpec::new("title", ValueSpec::Text, "Title above it.").required(),
        KeySpec::new("caption", ValueSpec::Text, "Explanation under it."),
        KeySpec::new("x", ValueSpec::Text, "Column on the horizontal axis.").required(),
        KeySpec::new("y", ValueSpec::Text, "Column on the vertical axis.").required(),
        KeySpec::new(
            "x_range",
            ValueSpec::Range(QuantityKind::Number),
            "Range of the horizontal axis, in SI.",
        ),
        KeySpec::new(
            "y_range",
            ValueSpec::Range(QuantityKind::Number),
            "Range of the vertical axis, in SI.",
        ),
        KeySpec::new("question", ValueSpec::Tables(&QUESTION), "Its questions.").required(),
        KeySpec::new("compare", ValueSpec::Tables(&COMPARISON), "Its comparisons."),
    ],
};

/// The whole study file.
pub static STUDY: TableSpec = TableSpec {
    name: "",
    doc: "A list of questions about a driveline, with figures and comparisons.",
    keys: &[
        KeySpec::new("format", ValueSpec::Count(1, 1), "Version of this file format: 1.")
            .required(),
        KeySpec::new("name", ValueSpec::Text, "Name of the study.").required(),
        KeySpec::new("description", ValueSpec::Text, "What it is about."),
        KeySpec::new(
            "model",
            ValueSpec::Text,
            "Model file, relative to the study. Default: the embedded example.",
        ),
        KeySpec::new("question", ValueSpec::Tables(&QUESTION), "Questions without a figure."),
        KeySpec::new("figure", ValueSpec::Tables(&FIGURE), "Figures with their questions."),
    ],
};
