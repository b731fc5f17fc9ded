//! Answer of `run`: the answers of a study and its comparisons.

use serde::{Deserialize, Serialize};

use crate::{Answer, Header};

/// One question of a study and its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyItem {
    /// Figure that it belongs to, if any.
    pub figure: Option<String>,
    /// Name of the question.
    pub question: String,
    /// How its curve is drawn.
    pub style: ItemStyle,
    /// The answer, or `None` where it could not be had.
    pub answer: Option<Answer>,
    /// Why it could not be had.
    pub failure: Option<String>,
}

/// How the curve of an answer is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ItemStyle {
    /// A line; dashed where unstable.
    #[default]
    Line,
    /// A dash-dot line, for a second method.
    Second,
    /// Not drawn.
    Hidden,
}

/// What a figure of a study shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyFigureSpec {
    /// Name, also of its files.
    pub name: String,
    /// Title above it.
    pub title: String,
    /// Explanation under it.
    pub caption: String,
    /// Column on the horizontal axis.
    pub x: String,
    /// Column on the vertical axis.
    pub y: String,
    /// Range of the horizontal axis.
    #[serde(deserialize_with = "crate::number::read")]
    pub x_range: Option<(f64, f64)>,
    /// Range of the vertical axis.
    #[serde(deserialize_with = "crate::number::read")]
    pub y_range: Option<(f64, f64)>,
}

/// A printed value beside the recomputed one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparisonRow {
    /// Figure that it belongs to.
    pub figure: String,
    /// What is compared.
    pub what: String,
    /// As printed.
    pub printed: String,
    /// As recomputed.
    pub recomputed: String,
    /// The difference, in words or as a number.
    pub difference: String,
    /// The printed number, where it is one.
    pub printed_value: Option<f64>,
    /// The recomputed number, where it is one.
    pub recomputed_value: Option<f64>,
    /// What to make of it.
    pub remark: String,
}

/// Answer of `run`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// Free text about the study.
    pub description: String,
    /// Questions with their answers, in file order.
    pub items: Vec<StudyItem>,
    /// Figures in file order.
    pub figures: Vec<StudyFigureSpec>,
    /// Printed beside recomputed.
    pub comparisons: Vec<ComparisonRow>,
}
