//! Why the program ends with another status than 0.

use halfshaft::model::FileError;
use halfshaft::model::question::OptionError;
use halfshaft::model::study::StudyError;
use halfshaft::{AnalysisError, Diagnostics, LoadError, OutputError};

/// Why the program ends with another status than 0.
#[derive(Debug)]
pub enum Failure {
    /// Bad input or usage: status 2.
    Input {
        /// What is wrong.
        message: String,
        /// What to do.
        advice: Option<String>,
    },
    /// Mistakes in a model or study file: status 2.
    Diagnostics(Diagnostics),
    /// Mistakes in options: status 2.
    Options(Vec<OptionError>),
    /// The analysis could not be carried out: status 1.
    Analysis {
        /// Why.
        message: String,
        /// What to try.
        advice: Option<String>,
    },
    /// Writing the answer failed: status 1.
    Output {
        /// What went wrong.
        message: String,
        /// What to do.
        advice: Option<String>,
    },
    /// The reader of our output has gone: no complaint, status 0.
    ReaderGone,
}

impl Failure {
    /// The exit status of the contract.
    pub fn exit_status(&self) -> u8 {
        match self {
            Self::Input { .. } | Self::Diagnostics(_) | Self::Options(_) => 2,
            Self::Analysis { .. } | Self::Output { .. } => 1,
            Self::ReaderGone => 0,
        }
    }

    /// Output that must be stopped before any work: status 2, for the path is bad input.
    pub fn bad_target(error: &OutputError) -> Self {
        let advice = error.advice().map(str::to_owned);
        Self::Input { message: error.to_string(), advice }
    }
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        match error {
            LoadError::Diagnostics(diagnostics) => Self::Diagnostics(diagnostics),
            LoadError::File(error) => {
                let advice = match &error {
                    FileError::Unreadable { path, source }
                        if source.kind() == std::io::ErrorKind::NotFound =>
                    {
                        Some(format!("`halfshaft new {path}` writes a model to start from"))
                    }
                    _ => None,
                };
                Self::Input { message: error.to_string(), advice }
            }
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Diagnostics(diagnostics) => Self::Diagnostics(diagnostics),
            StudyError::File(error) => Self::Input { message: error.to_string(), advice: None },
        }
    }
}

impl From<AnalysisError> for Failure {
    /// What asks for something that the line does not have is bad usage, although only the
    /// analysis could find out.
    fn from(error: AnalysisError) -> Self {
        let (message, advice) = (error.to_string(), error.advice());
        match error {
            AnalysisError::InitialValues { .. }
            | AnalysisError::NoSuchMode { .. }
            | AnalysisError::NoSuchEquilibrium { .. } => Self::Input { message, advice },
            _ => Self::Analysis { message, advice },
        }
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        let advice = error.advice().map(str::to_owned);
        let message = error.to_string();
        match error {
            OutputError::Write(_)
            | OutputError::Folder { .. }
            | OutputError::ParquetWriter { .. }
            | OutputError::Picture { .. } => Self::Output { message, advice },
            _ => Self::Input { message, advice },
        }
    }
}
