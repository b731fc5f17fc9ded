//! Running a study: its questions, its comparisons.

use halfshaft_analysis::ask;
use halfshaft_model::study::{Comparison, CurveStyle, Pick, Printed, Study, StudyFigure};
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_results::{
    Answer, ComparisonRow, Header, ItemStyle, ModelIdentity, Reason, StudyFigureSpec, StudyItem,
    StudyResult, Termination,
};
use halfshaft_results::{SpecialPoint, Table};

/// Asks all questions of a study and makes its comparisons.
pub fn run_study(study: &Study, observer: &dyn Observer) -> StudyResult {
    let mut items: Vec<StudyItem> = Vec::with_capacity(study.questions.len());
    for (index, question) in study.questions.iter().enumerate() {
        if observer.cancelled() {
            break;
        }
        let part = Part::of(observer, index, study.questions.len());
        part.progress(0.0);
        let (answer, failure) = match ask(&question.line, &question.question, &part) {
            Ok(answer) => (Some(answer), None),
            Err(error) => (None, Some(error.to_string())),
        };
        items.push(StudyItem {
            figure: question.figure.map(|index| study.figures[index].name.clone()),
            question: question.name.clone(),
            style: match question.style {
                CurveStyle::Line => ItemStyle::Line,
                CurveStyle::Second => ItemStyle::Second,
                CurveStyle::Hidden => ItemStyle::Hidden,
            },
            answer,
            failure,
        });
    }
    let comparisons = study
        .figures
        .iter()
        .flat_map(|figure| figure.comparisons.iter().map(move |c| (figure, c)))
        .map(|(figure, comparison)| row(study, figure, comparison, &items))
        .collect();
    let unknown = unknown_columns(study, &items);
    let termination = termination(study, &items, observer.cancelled(), unknown.len());
    StudyResult {
        header: header(study, &items, termination, unknown),
        description: study.description.clone(),
        figures: study.figures.iter().map(figure_spec).collect(),
        items,
        comparisons,
    }
}

/// How the study ended: a question that was stopped or has no answer leaves it incomplete.
fn termination(study: &Study, items: &[StudyItem], cancelled: bool, unknown: usize) -> Termination {
    let complete = |item: &&StudyItem| {
        item.answer.as_ref().is_some_and(|answer| answer.header().termination.is_complete())
    };
    let answered = items.iter().filter(complete).count();
    let detail = format!("{answered} of {} questions were answered in full", study.questions.len());
    if cancelled {
        Termination::early(Reason::Cancelled, detail)
    } else if answered < study.questions.len() {
        Termination::early(Reason::Unanswered, detail)
    } else if unknown > 0 {
        let detail = "a figure asks for a column that no answer has".to_owned();
        Termination::early(Reason::Unanswered, detail)
    } else {
        Termination::completed()
    }
}

/// Axes of figures that no answer has a column for, each with the columns there are.
fn unknown_columns(study: &Study, items: &[StudyItem]) -> Vec<String> {
    let mut unknown = Vec::new();
    for figure in &study.figures {
        let answers = items.iter().filter(|item| item.figure.as_ref() == Some(&figure.name));
        let names: Vec<String> = answers
            .filter_map(|item| item.answer.as_ref())
            .flat_map(Answer::tables)
            .flat_map(|(_, table)| table.columns)
            .map(|column| column.name)
            .collect();
        if names.is_empty() {
            continue; // without an answer its failure is told
        }
        for axis in [&figure.x, &figure.y] {
            if !axis.is_empty() && !names.contains(axis) {
                let mut known = names.clone();
                known.sort();
                known.dedup();
                unknown.push(format!(
                    "figure \"{}\": no answer has a column \"{axis}\"; there are {}",
                    figure.name,
                    known.join(", ")
                ));
            }
        }
    }
    unknown
}

fn header(
    study: &Study,
    items: &[StudyItem],
    termination: Termination,
    unknown: Vec<String>,
) -> Header {
    let failed = items.iter().filter_map(|item| {
        let failure = item.failure.as_ref()?;
        Some(format!("{}: {failure}", item.question))
    });
    let digests: Vec<String> = study.questions.iter().map(|q| q.line.digest()).collect();
    let mut distinct = digests.clone();
    distinct.sort();
    distinct.dedup();
    Header {
        analysis: "run".to_owned(),
        model: ModelIdentity {
            name: study.name.clone(),
            digest: digests.first().cloned().unwrap_or_default(),
        },
        settings: Default::default(),
        termination,
        version: crate::VERSION.to_owned(),
        warnings: failed.chain(unknown).collect(),
        assumptions: vec![format!(
            "{} questions about {} lines; each answer names its own line by digest",
            items.len(),
            distinct.len()
        )],
    }
}

fn figure_spec(figure: &StudyFigure) -> StudyFigureSpec {
    StudyFigureSpec {
        name: figure.name.clone(),
        title: figure.title.clone(),
        caption: figure.caption.clone(),
        x: figure.x.clone(),
        y: figure.y.clone(),
        x_range: figure.x_range,
        y_range: figure.y_range,
    }
}

/// What was picked from the answers.
enum Picked {
    Number(f64),
    Order(Vec<String>),
    Nothing(String),
}

fn row(
    study: &Study,
    figure: &StudyFigure,
    comparison: &Comparison,
    items: &[StudyItem],
) -> ComparisonRow {
    let picked = pick(study, &comparison.pick, items);
    let (printed, printed_value) = match &comparison.printed {
        Printed::Number(value) => (value.to_string(), Some(*value)),
        Printed::Order(names) => (names.join(" > "), None),
        Printed::Text(text) => (text.clone(), None),
    };
    let (recomputed, recomputed_value) = match &picked {
        Picked::Number(value) => (significant(*value, digits_of(&printed)), Some(*value)),
        Picked::Order(names) => (names.join(" > "), None),
        Picked::Nothing(reason) => (reason.clone(), None),
    };
    let difference = match (printed_value, recomputed_value, &comparison.printed) {
        (Some(printed), Some(recomputed), _) => relative(printed, recomputed),
        (_, _, Printed::Order(_)) if printed == recomputed => "same order".to_owned(),
        (_, _, Printed::Order(_)) if matches!(picked, Picked::Order(_)) => {
            "another order".to_owned()
        }
        _ => "–".to_owned(),
    };
    ComparisonRow {
        figure: figure.name.clone(),
        what: comparison.what.clone(),
        printed,
        recomputed,
        difference,
        printed_value,
        recomputed_value,
        remark: comparison.remark.clone(),
    }
}

/// Difference of the printed number from the recomputed one, as a part of the latter.
fn relative(printed: f64, recomputed: f64) -> String {
    if printed == recomputed {
        return "0".to_owned();
    }
    if recomputed == 0.0 {
        return format!("{:+.1e}", printed - recomputed);
    }
    let part = (printed - recomputed) / recomputed;
    if part.abs() < 1e-10 {
        // What is below is rounding, another one on every machine.
        return "< 1e-10".to_owned();
    }
    if part.abs() >= 1e-3 { format!("{:+.2} %", 100.0 * part) } else { format!("{part:+.1e}") }
}

/// Digits with which a number is shown beside a printed one: as many as that has, eight at least, and
/// no more than every machine computes alike.
fn digits_of(printed: &str) -> i32 {
    let digits = printed.chars().filter(char::is_ascii_digit).skip_while(|digit| *digit == '0');
    i32::try_from(digits.count()).unwrap_or(0).clamp(8, 11)
}

/// A number with so many significant digits, without needless zeros.
fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if value.abs() < 1e-6 {
        return format!("{value:.2e}");
    }
    #[expect(clippy::cast_possible_truncation, reason = "exponents are small")]
    let places = (digits - 1 - value.abs().log10().floor() as i32).clamp(0, 17);
    let text = format!("{value:.*}", usize::try_from(places).unwrap_or(0));
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

fn pick(study: &Study, pick: &Pick, items: &[StudyItem]) -> Picked {
    let answer = |question: usize| items.get(question).and_then(|item| item.answer.as_ref());
    let found = match pick {
        Pick::Pointer { question, pointer } => {
            answer(*question).and_then(|a| at_pointer(a, pointer))
        }
        Pick::At { question, column, x } => answer(*question).and_then(|answer| {
            let tables = answer.tables();
            tables.iter().find_map(|(_, table): &(String, Table)| table.interpolate(column, *x))
        }),
        Pick::Special { question, kind, number, column } => answer(*question).and_then(|answer| {
            special_points(answer, kind).nth(number - 1).and_then(|point| point.value(column))
        }),
        #[expect(clippy::cast_precision_loss, reason = "counts of points are small")]
        Pick::Count { question, kind } => {
            answer(*question).map(|answer| special_points(answer, kind).count() as f64)
        }
        Pick::Ranking { figure, pointer } => return ranking(study, *figure, pointer, items),
    };
    found.map_or_else(|| Picked::Nothing("not found in the answer".to_owned()), Picked::Number)
}

fn at_pointer(answer: &Answer, pointer: &str) -> Option<f64> {
    let value = serde_json::to_value(answer).ok()?;
    value.pointer(pointer)?.as_f64()
}

/// Special points of a kind, in the order of the answer.
fn special_points<'a>(
    answer: &'a Answer,
    kind: &'a str,
) -> impl Iterator<Item = &'a SpecialPoint> + 'a {
    let points: Vec<&SpecialPoint> = match answer {
        Answer::Resonance(result) => {
            result.branches.iter().flat_map(|branch| &branch.special_points).collect()
        }
        Answer::Folds(result) => result.special_points.iter().collect(),
        _ => Vec::new(),
    };
    points.into_iter().filter(move |point| {
        serde_json::to_value(point.kind).is_ok_and(|name| name.as_str() == Some(kind))
    })
}

/// Names of the figure's questions by falling magnitude of a number in their answers.
fn ranking(study: &Study, figure: usize, pointer: &str, items: &[StudyItem]) -> Picked {
    let mut values: Vec<(String, f64)> = Vec::new();
    for (question, item) in study.questions.iter().zip(items) {
        if question.figure != Some(figure) {
            continue;
        }
        let value = item.answer.as_ref().and_then(|answer| at_pointer(answer, pointer));
        let Some(value) = value else {
            return Picked::Nothing(format!("\"{}\" has no such number", item.question));
        };
        values.push((item.question.clone(), value.abs()));
    }
    values.sort_by(|a, b| b.1.total_cmp(&a.1));
    Picked::Order(values.into_iter().map(|(name, _)| name).collect())
}
