//! Study files: a list of questions as data, with figures and comparisons drawn from the
//! answers.
//!
//! A study names a model, asks questions of it (each as a command would), draws figures from
//! the answers, and compares numbers with printed ones.

mod keys;
mod read;

pub use keys::STUDY;
pub use read::{StudyError, read_study, read_study_text};

use crate::driveline::Driveline;
use crate::question::Question;

/// A study that has been read and checked, with every question's line.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// Name of the study.
    pub name: String,
    /// What it is about; free text.
    pub description: String,
    /// All questions of all figures and those of no figure, in file order.
    pub questions: Vec<StudyQuestion>,
    /// Figures in file order.
    pub figures: Vec<StudyFigure>,
}

/// One question of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyQuestion {
    /// Name by which figures and comparisons refer to it; unique within its figure.
    pub name: String,
    /// Figure that it belongs to, by index.
    pub figure: Option<usize>,
    /// The question.
    pub question: Question,
    /// The line it is asked of, with its settings applied.
    pub line: Driveline,
    /// How its curve is drawn.
    pub style: CurveStyle,
}

/// How the curve of a question is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CurveStyle {
    /// A line; dashed where unstable.
    #[default]
    Line,
    /// A dash-dot line, for a second method.
    Second,
    /// Not drawn: the question only serves comparisons.
    Hidden,
}

/// One figure of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyFigure {
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
    pub x_range: Option<(f64, f64)>,
    /// Range of the vertical axis.
    pub y_range: Option<(f64, f64)>,
    /// Numbers to hold against printed ones.
    pub comparisons: Vec<Comparison>,
}

/// A number or an order, printed and recomputed.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// What is compared, in words.
    pub what: String,
    /// How the recomputed value is found.
    pub pick: Pick,
    /// What is printed.
    pub printed: Printed,
    /// What to make of the difference.
    pub remark: String,
}

/// What a publication printed.
#[derive(Clone, Debug, PartialEq)]
pub enum Printed {
    /// A number.
    Number(f64),
    /// Names of questions, the one with the largest value first.
    Order(Vec<String>),
    /// A word or statement.
    Text(String),
}

/// How a value is found in answers.
#[derive(Clone, Debug, PartialEq)]
pub enum Pick {
    /// The value at a JSON pointer into the answer of a question.
    Pointer {
        /// Index of the question in the study.
        question: usize,
        /// JSON pointer (RFC 6901), e.g. `/metrics/half-shaft/first_peak`.
        pointer: String,
    },
    /// A column of the answer's table where its first column has a given value.
    At {
        /// Index of the question in the study.
        question: usize,
        /// Column.
        column: String,
        /// Value of the first column.
        x: f64,
    },
    /// A column of a special point.
    Special {
        /// Index of the question in the study.
        question: usize,
        /// Kind, e.g. `fold`.
        kind: String,
        /// Which of that kind, from 1 in the order of the answer.
        number: usize,
        /// Column.
        column: String,
    },
    /// The number of special points of a kind.
    Count {
        /// Index of the question in the study.
        question: usize,
        /// Kind, e.g. `fold`.
        kind: String,
    },
    /// Names of all the figure's questions, the one with the largest value first.
    Ranking {
        /// Index of the figure.
        figure: usize,
        /// JSON pointer into each answer; magnitudes are ranked.
        pointer: String,
    },
}
