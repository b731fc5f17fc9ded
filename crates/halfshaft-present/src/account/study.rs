//! What is told of a study.

use halfshaft_results::{StudyFigureSpec, StudyResult};

use super::{Account, Grid};
use crate::words::{counted, plain};

/// The whole account: what was asked, and all comparisons. Each figure has an account of its own.
pub(crate) fn account(study: &StudyResult) -> Account {
    let mut account = opening(study);
    account.grid(comparisons(study, None));
    account
}

/// What the study is and how much of it there is.
pub(crate) fn opening(study: &StudyResult) -> Account {
    let mut account = Account::default();
    account.text([plain(&study.description)]);
    account.text([format!(
        "{}, {}, {}.",
        crate::words::capital(&counted(study.items.len(), "question", "questions")),
        counted(study.figures.len(), "figure", "figures"),
        counted(study.comparisons.len(), "comparison with print", "comparisons with print"),
    )]);
    account.list(failures(study));
    account
}

/// One figure with its comparisons.
pub(crate) fn figure(study: &StudyResult, spec: &StudyFigureSpec) -> Account {
    let mut account = Account::default();
    account.figure(crate::figures::study::id(&spec.name));
    account.grid(comparisons(study, Some(spec)));
    account
}

/// Questions that could not be answered.
fn failures(study: &StudyResult) -> Vec<String> {
    let failed = study.items.iter().filter_map(|item| {
        let failure = item.failure.as_ref()?;
        Some(format!("no answer to \"{}\": {}", plain(&item.question), plain(failure)))
    });
    failed.collect()
}

/// Printed beside recomputed, of one figure or of all.
pub(crate) fn comparisons(study: &StudyResult, figure: Option<&StudyFigureSpec>) -> Grid {
    let rows: Vec<_> = study
        .comparisons
        .iter()
        .filter(|row| figure.is_none_or(|spec| spec.name == row.figure))
        .collect();
    let mut grid = Grid::new("Printed and recomputed");
    if figure.is_none() {
        grid = grid.words("figure", rows.iter().map(|row| &row.figure));
    }
    grid.words("what", rows.iter().map(|row| &row.what))
        .words("printed", rows.iter().map(|row| super::check::minus(&row.printed)))
        .words("recomputed", rows.iter().map(|row| super::check::minus(&row.recomputed)))
        .words("difference", rows.iter().map(|row| super::check::minus(&row.difference)))
        .words("remark", rows.iter().map(|row| &row.remark))
        .without_empty_columns()
}
