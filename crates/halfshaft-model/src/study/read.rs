//! From the text of a study to its questions, all errors at once.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use super::keys::STUDY;
use super::{Comparison, CurveStyle, Pick, Printed, Study, StudyFigure, StudyQuestion};
use crate::diagnostic::{Diagnostic, Diagnostics, Source, did_you_mean};
use crate::driveline::Driveline;
use crate::embedded;
use crate::format::{
    Checked, CheckedTable, FileError, OtherFile, SetFlag, read_document, read_file, read_model,
};
use crate::question::{self, OptionError, QuestionText, Verb};

/// A model in the place of a study.
static A_MODEL: OtherFile = OtherFile {
    lists: &["inertia", "gear", "shaft", "torque"],
    message: "this is a model file, not a study file",
    command: "halfshaft check",
};

/// Why a study cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The study itself cannot be read as text.
    #[error(transparent)]
    File(#[from] FileError),
    /// Mistakes in the study or in a model that it names.
    #[error("the study has mistakes")]
    Diagnostics(Diagnostics),
}

/// Reads a study and every model that it names.
///
/// # Errors
/// [`StudyError`] with all mistakes at once.
pub fn read_study(path: &Path) -> Result<Study, StudyError> {
    let source = read_file(path)?;
    let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
    read_study_text(source, folder).map_err(StudyError::Diagnostics)
}

/// Reads the text of a study and every model that it names, relative to `folder`.
///
/// # Errors
/// All mistakes at once.
pub fn read_study_text(source: Source, folder: impl Into<PathBuf>) -> Result<Study, Diagnostics> {
    let mut found = Diagnostics::about(source);
    let text = found.sources[0].text.clone();
    let Some(document) = read_document(&text, &STUDY, &A_MODEL, &mut found) else {
        return Err(found);
    };
    let mut reader = Reader {
        folder: folder.into(),
        document: &document,
        found,
        models: HashMap::new(),
        adopted: HashSet::new(),
    };
    let study = reader.study();
    if reader.found.has_errors() { Err(reader.found) } else { Ok(study) }
}

struct Reader<'d> {
    folder: PathBuf,
    document: &'d CheckedTable,
    found: Diagnostics,
    /// Texts of the models by name, so that each file is opened once.
    models: HashMap<String, Option<Source>>,
    /// Findings of models that have been told.
    adopted: HashSet<Diagnostic>,
}

impl Reader<'_> {
    fn study(&mut self) -> Study {
        let document = self.document;
        let mut study = Study {
            name: document.text("name").unwrap_or_default().to_owned(),
            description: document.text("description").unwrap_or_default().to_owned(),
            questions: Vec::new(),
            figures: Vec::new(),
        };
        for table in document.tables("question") {
            study.questions.extend(self.question(table, None));
        }
        for table in document.tables("figure") {
            self.figure(table, &mut study);
        }
        if !document.mentions("question") && !document.mentions("figure") {
            self.found.push(
                Diagnostic::error(document.span.clone(), "the study asks nothing")
                    .hint("add a [[question]] with name and ask, or a [[figure]]"),
            );
        }
        study
    }

    fn figure(&mut self, table: &CheckedTable, study: &mut Study) {
        let name = table.text("name").unwrap_or_default().to_owned();
        let allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        if !name.chars().all(allowed) || name.starts_with('.') {
            self.found.push(
                Diagnostic::error(table.span_of("name"), "the figure's name is a file name")
                    .hint("use letters, digits, - and _"),
            );
        }
        if study.figures.iter().any(|other| other.name == name) {
            let message = format!("two figures are named \"{name}\"");
            self.found.push(Diagnostic::error(table.span_of("name"), message));
        }
        let index = study.figures.len();
        let first = study.questions.len();
        for question in table.tables("question") {
            study.questions.extend(self.question(question, Some(index)));
        }
        self.check_unique(table);
        let comparisons = table
            .tables("compare")
            .iter()
            .filter_map(|compare| self.comparison(compare, table, (index, first), study))
            .collect();
        study.figures.push(StudyFigure {
            name,
            title: table.text("title").unwrap_or_default().to_owned(),
            caption: table.text("caption").unwrap_or_default().to_owned(),
            x: table.text("x").unwrap_or_default().to_owned(),
            y: table.text("y").unwrap_or_default().to_owned(),
            x_range: table.range("x_range"),
            y_range: table.range("y_range"),
            comparisons,
        });
    }

    fn check_unique(&mut self, figure: &CheckedTable) {
        let questions = figure.tables("question");
        for (index, question) in questions.iter().enumerate() {
            let Some(name) = question.text("name") else { continue };
            if questions[..index].iter().any(|other| other.text("name") == Some(name)) {
                let message = format!("two questions are named \"{name}\"");
                self.found.push(Diagnostic::error(question.span_of("name"), message));
            }
        }
    }

    fn question(&mut self, table: &CheckedTable, figure: Option<usize>) -> Option<StudyQuestion> {
        let ask = table.word("ask")?;
        let (_, verb) = Verb::ALL.into_iter().find(|(name, _)| *name == ask)?;
        let line = self.line(table)?;
        let text = question_text(table);
        match question::read(verb, &text, &line) {
            Ok(question) => Some(StudyQuestion {
                name: table.text("name")?.to_owned(),
                figure,
                question,
                line,
                style: match table.word("style") {
                    Some("second") => CurveStyle::Second,
                    Some("hidden") => CurveStyle::Hidden,
                    _ => CurveStyle::Line,
                },
            }),
            Err(errors) => {
                for error in errors {
                    self.found.push(option_diagnostic(&error, table));
                }
                None
            }
        }
    }

    /// The line that a question is about, with its settings.
    fn line(&mut self, table: &CheckedTable) -> Option<Driveline> {
        let document = self.document;
        let (owner, name) = match table.text("model") {
            Some(name) => (table, Some(name)),
            None => (document, document.text("model")),
        };
        let source = self.model_source(name, owner)?;
        let settings: Vec<SetFlag> = texts(table, "set").into_iter().map(SetFlag).collect();
        match read_model(source, &settings) {
            Ok((line, _)) => Some(line),
            Err(errors) => {
                self.adopt(errors);
                None
            }
        }
    }

    fn model_source(&mut self, name: Option<&str>, owner: &CheckedTable) -> Option<Source> {
        let Some(name) = name else { return Some(embedded::example()) };
        if let Some(known) = self.models.get(name) {
            return known.clone();
        }
        let source = match read_file(&self.folder.join(name)) {
            Ok(source) => Some(source),
            Err(error) => {
                self.found.push(Diagnostic::error(owner.span_of("model"), error.to_string()));
                None
            }
        };
        self.models.insert(name.to_owned(), source.clone());
        source
    }

    /// Takes over the findings of a model. What several questions run into is told once.
    fn adopt(&mut self, other: Diagnostics) {
        let sources = &mut self.found.sources;
        let places: Vec<usize> = other
            .sources
            .into_iter()
            .map(|source| {
                sources.iter().position(|known| *known == source).unwrap_or_else(|| {
                    sources.push(source);
                    sources.len() - 1
                })
            })
            .collect();
        for mut item in other.items {
            item.source = places.get(item.source).copied().unwrap_or_default();
            if self.adopted.insert(item.clone()) {
                self.found.items.push(item);
            }
        }
    }

    fn comparison(
        &mut self,
        table: &CheckedTable,
        figure: &CheckedTable,
        (index, first): (usize, usize),
        study: &Study,
    ) -> Option<Comparison> {
        let ways = ["pointer", "at", "special", "ranking"];
        if !ways.iter().any(|way| table.mentions(way)) {
            self.found.push(
                Diagnostic::error(table.span.clone(), "this comparison picks no value")
                    .hint("add pointer, at, special or ranking"),
            );
        }
        let pick = if let Some(pointer) = table.text("ranking") {
            Pick::Ranking { figure: index, pointer: pointer.to_owned() }
        } else {
            let question = self.asked(table, figure, &study.questions[first..])?;
            pick(table, first + question)?
        };
        let printed = match (table.number("printed"), table.texts("printed_order")) {
            (Some(number), _) => Printed::Number(number),
            (None, []) => Printed::Text(table.text("printed_text").unwrap_or("").to_owned()),
            (None, _) => Printed::Order(texts(table, "printed_order")),
        };
        Some(Comparison {
            what: table.text("what")?.to_owned(),
            pick,
            printed,
            remark: table.text("remark").unwrap_or_default().to_owned(),
        })
    }

    /// Index, among the figure's sound questions, of the one that `of` names or of the only one.
    /// That a question is unsound has been told where it stands.
    fn asked(
        &mut self,
        table: &CheckedTable,
        figure: &CheckedTable,
        sound: &[StudyQuestion],
    ) -> Option<usize> {
        let names: Vec<&str> =
            figure.tables("question").iter().filter_map(|question| question.text("name")).collect();
        let name = match table.text("of") {
            Some(name) => name,
            None if names.len() == 1 => names[0],
            None => {
                if !table.mentions("of") {
                    self.found.push(
                        Diagnostic::error(table.span.clone(), "of which question?")
                            .hint("add of = \"name of the question\""),
                    );
                }
                return None;
            }
        };
        if !names.contains(&name) {
            let hint = did_you_mean(name, names.iter().copied());
            let message = format!("no question of this figure is named \"{name}\"");
            self.found.push(Diagnostic::error(table.span_of("of"), message).maybe_hint(hint));
        }
        sound.iter().position(|question| question.name == name)
    }
}

fn pick(table: &CheckedTable, question: usize) -> Option<Pick> {
    if let Some(pointer) = table.text("pointer") {
        return Some(Pick::Pointer { question, pointer: pointer.to_owned() });
    }
    if let Some(at) = table.table("at") {
        let column = at.text("column")?.to_owned();
        return Some(Pick::At { question, column, x: at.number("x")? });
    }
    let special = table.table("special")?;
    let kind = special.text("kind")?.to_owned();
    let Some(column) = special.text("column") else {
        return Some(Pick::Count { question, kind });
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1000")]
    let number = special.number_or("number", 1.0) as usize;
    Some(Pick::Special { question, kind, number, column: column.to_owned() })
}

fn texts(table: &CheckedTable, key: &str) -> Vec<String> {
    let entries = table.texts(key).iter();
    entries
        .filter_map(|entry| match &entry.value {
            Checked::Text(text) => Some(text.clone()),
            _ => None,
        })
        .collect()
}

fn question_text(table: &CheckedTable) -> QuestionText {
    let option = |key: &str| table.text(key).map(str::to_owned);
    QuestionText {
        duration: option("duration"),
        initial: texts(table, "initial"),
        start: option("start"),
        frequency: option("frequency"),
        step: option("step"),
        tolerance: option("tolerance"),
        record: option("record"),
        method: option("method"),
        order: option("order"),
        equation: option("equation"),
        printed_velocity: table.flag("printed-velocity"),
        compare: table.flag("compare"),
        mode: option("mode"),
        points: option("points"),
        verify: table.flag("verify"),
        parameter: option("parameter"),
        equilibrium: option("equilibrium"),
        harmonics: option("harmonics"),
        stability: option("stability"),
        backbone: table.flag("backbone"),
        grid: option("grid"),
        window: option("window"),
        shaft: option("shaft"),
        periods: option("periods"),
        shock: option("shock"),
        rate: option("rate"),
        friction: option("friction"),
        orders: option("orders"),
        integrator: option("integrator"),
        steps: option("steps"),
        transient: option("transient"),
        direction: option("direction"),
        no_branches: table.flag("no-branches"),
        count: option("count"),
        operating: option("operating"),
        node: option("node"),
        this_gear: table.flag("this-gear"),
    }
}

fn option_diagnostic(error: &OptionError, table: &CheckedTable) -> Diagnostic {
    let hint = Some(error.hint.clone()).filter(|hint| !hint.is_empty());
    let message = format!("{}: {}", error.option, error.message);
    Diagnostic::error(table.span_of(error.option), message).maybe_hint(hint)
}
