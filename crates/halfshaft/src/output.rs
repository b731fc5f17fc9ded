//! Writing answers to files: one form by its ending, or all forms into a folder.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::parquet;
use halfshaft_numerics::observer::Observer;
use halfshaft_present::figure::svg::SvgOptions;
use halfshaft_present::figure::{Figure, FigureError, png, svg};
use halfshaft_present::{figures, html, sketch};
use halfshaft_results::io::{
    WriteError, comparison_csv, comparison_markdown, csv, write_atomically,
};
use halfshaft_results::{Answer, CheckResult, StudyResult};

/// A form that an answer can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Everything, as JSON.
    Json,
    /// The tables, as comma-separated values.
    Csv,
    /// Everything, as a Parquet file whose columns are the tables.
    Parquet,
    /// Figures, as vector graphics.
    Svg,
    /// Figures, as pixels.
    Png,
    /// A page with figures.
    Html,
}

/// Why an answer could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The ending is none that this version writes.
    #[error("\"{}\" ends in no form that halfshaft writes", path.display())]
    UnknownEnding {
        /// The path as given.
        path: PathBuf,
    },
    /// The Parquet writer, a program of its own, is not there.
    #[error("the Parquet writer halfshaft-parquet was not found beside halfshaft nor in the PATH")]
    NoParquet,
    /// The folder cannot be made or written in.
    #[error("cannot write in {}: {source}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The answer has nothing of that form.
    #[error("the answer of `{analysis}` has no {what} to write")]
    Nothing {
        /// Name of the analysis.
        analysis: String,
        /// What it lacks.
        what: &'static str,
    },
    /// Writing failed; no half-written file stands under the name.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A picture could not be drawn.
    #[error("cannot draw {}: {reason}", path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
}

impl OutputError {
    /// What to do about it.
    pub fn advice(&self) -> Option<&'static str> {
        match self {
            Self::UnknownEnding { .. } => Some(
                "end in .json, .csv, .parquet, .svg, .png or .html, or name a folder for all of them",
            ),
            Self::NoParquet => Some(
                "build it with `cargo build --release` (or `cargo install --path \
                 crates/halfshaft-parquet`), or write .json or .csv",
            ),
            Self::Nothing { .. } => Some("--out answer.json holds everything"),
            Self::Folder { .. } => Some("name a folder that you may write in"),
            Self::Write(_) | Self::Picture { .. } => None,
        }
    }
}

/// Where answers go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// One form into one file (and numbered neighbours where there are several figures).
    File(PathBuf, Format),
    /// All forms into a folder.
    Folder(PathBuf),
}

impl Target {
    /// The target that a path means: a file by its ending, a folder without one.
    ///
    /// Tries to write there, so that a long computation does not end at a closed door.
    ///
    /// # Errors
    /// [`OutputError`] where the ending is unknown or the folder cannot be written in.
    pub fn prepare(path: &Path) -> Result<Self, OutputError> {
        let unwritable = |folder: &Path| {
            let folder = folder.to_path_buf();
            move |source| OutputError::Folder { folder, source }
        };
        let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase);
        if path.is_dir() || ending.is_none() {
            std::fs::create_dir_all(path).map_err(unwritable(path))?;
            try_writing(path).map_err(unwritable(path))?;
            return Ok(Self::Folder(path.to_path_buf()));
        }
        let format = match ending.as_deref() {
            Some("json") => Format::Json,
            Some("csv") => Format::Csv,
            Some("parquet") => match parquet::writer() {
                Some(_) => Format::Parquet,
                None => return Err(OutputError::NoParquet),
            },
            Some("svg") => Format::Svg,
            Some("png") => Format::Png,
            Some("html" | "htm") => Format::Html,
            _ => return Err(OutputError::UnknownEnding { path: path.to_path_buf() }),
        };
        let folder = folder_of(path);
        try_writing(&folder).map_err(unwritable(&folder))?;
        Ok(Self::File(path.to_path_buf(), format))
    }
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

/// Makes and removes a file in the folder.
fn try_writing(folder: &Path) -> std::io::Result<()> {
    let probe = folder.join(format!(".halfshaft-probe-{}.tmp", std::process::id()));
    std::fs::File::create(&probe)?;
    std::fs::remove_file(&probe)
}

/// Writes an answer; returns the files written, in order.
///
/// Every file is written under a temporary name and renamed. The observer can interrupt: what
/// was finished stays, what was not does not appear.
///
/// # Errors
/// [`OutputError`].
pub fn write(
    answer: &Answer,
    target: &Target,
    observer: &dyn Observer,
) -> Result<Vec<PathBuf>, OutputError> {
    match target {
        Target::File(path, format) => Writer { observer }.form(answer, path, *format),
        Target::Folder(folder) => Writer { observer }.folder(answer, folder),
    }
}

struct Writer<'o> {
    observer: &'o dyn Observer,
}

impl Writer<'_> {
    fn form(
        &self,
        answer: &Answer,
        path: &Path,
        format: Format,
    ) -> Result<Vec<PathBuf>, OutputError> {
        let nothing =
            |what| OutputError::Nothing { analysis: answer.header().analysis.clone(), what };
        match format {
            Format::Json => {
                self.stream(path, |file| halfshaft_results::io::write_json(answer, file))?;
            }
            Format::Csv => {
                let text = match answer {
                    Answer::Study(study) => Some(comparison_csv(study)),
                    _ => csv(answer),
                };
                self.text(path, &text.ok_or_else(|| nothing("table"))?)?;
            }
            Format::Parquet => self.parquet(answer, path)?,
            Format::Html => self.text(path, &html::page(answer))?,
            Format::Svg | Format::Png => return self.pictures(answer, path, format),
        }
        Ok(vec![path.to_path_buf()])
    }

    fn parquet(&self, answer: &Answer, path: &Path) -> Result<(), OutputError> {
        let writer = parquet::writer().ok_or(OutputError::NoParquet)?;
        if self.observer.cancelled() {
            let source = std::io::Error::other("interrupted by the user");
            return Err(WriteError::Content { path: path.to_path_buf(), source }.into());
        }
        parquet::write(&writer, answer, path)
            .map_err(|source| WriteError::Content { path: path.to_path_buf(), source }.into())
    }

    /// All figures of an answer: the first under the name, the others with their own beside it.
    fn pictures(
        &self,
        answer: &Answer,
        path: &Path,
        format: Format,
    ) -> Result<Vec<PathBuf>, OutputError> {
        if let Answer::Check(check) = answer {
            self.sketch(check, path, format)?;
            return Ok(vec![path.to_path_buf()]);
        }
        let figures = figures_of(answer);
        if figures.is_empty() {
            let analysis = answer.header().analysis.clone();
            return Err(OutputError::Nothing { analysis, what: "figure" });
        }
        let mut written = Vec::new();
        for (index, figure) in figures.iter().enumerate() {
            let path = if index == 0 { path.to_path_buf() } else { beside(path, &figure.id) };
            self.picture(figure, &path, format)?;
            written.push(path);
        }
        Ok(written)
    }

    fn picture(&self, figure: &Figure, path: &Path, format: Format) -> Result<(), OutputError> {
        if format == Format::Svg {
            return self.text(path, &svg::render(figure, &SvgOptions::default()));
        }
        self.pixels(path, png::render(figure, png::DEFAULT_SCALE))
    }

    fn sketch(&self, check: &CheckResult, path: &Path, format: Format) -> Result<(), OutputError> {
        if format == Format::Svg {
            return self.text(path, &sketch::sketch(check));
        }
        self.pixels(path, sketch::picture(check, png::DEFAULT_SCALE))
    }

    fn pixels(
        &self,
        path: &Path,
        picture: Result<Vec<u8>, FigureError>,
    ) -> Result<(), OutputError> {
        let bytes = picture.map_err(|error| {
            let reason = error.to_string();
            OutputError::Picture { path: path.to_path_buf(), reason }
        })?;
        self.stream(path, |file| file.write_all(&bytes))
    }

    /// Every form that the answer has.
    fn folder(&self, answer: &Answer, folder: &Path) -> Result<Vec<PathBuf>, OutputError> {
        if let Answer::Study(study) = answer {
            return self.study(answer, study, folder);
        }
        let name = answer.header().analysis.clone();
        let file = |ending: &str| folder.join(format!("{name}.{ending}"));
        let mut written = self.form(answer, &file("json"), Format::Json)?;
        written.extend(self.form(answer, &file("html"), Format::Html)?);
        if let Some(text) = csv(answer) {
            self.text(&file("csv"), &text)?;
            written.push(file("csv"));
        }
        if parquet::writer().is_some() && !answer.tables().is_empty() {
            written.extend(self.form(answer, &file("parquet"), Format::Parquet)?);
        }
        if matches!(answer, Answer::Check(_)) {
            for (ending, format) in [("svg", Format::Svg), ("png", Format::Png)] {
                written.extend(self.pictures(answer, &file(ending), format)?);
            }
        }
        for figure in figures_of(answer) {
            for (ending, format) in [("svg", Format::Svg), ("png", Format::Png)] {
                let path = folder.join(format!("{name}-{}.{ending}", figure.id));
                self.picture(&figure, &path, format)?;
                written.push(path);
            }
        }
        Ok(written)
    }

    /// A study: its page, its comparisons, its figures under their own names.
    fn study(
        &self,
        answer: &Answer,
        study: &StudyResult,
        folder: &Path,
    ) -> Result<Vec<PathBuf>, OutputError> {
        let file = |name: &str| folder.join(name);
        let mut written = vec![file("study.json"), file("study.html"), file("comparison.csv")];
        self.form(answer, &written[0], Format::Json)?;
        self.form(answer, &written[1], Format::Html)?;
        self.text(&written[2], &comparison_csv(study))?;
        self.text(&file("comparison.md"), &comparison_markdown(study))?;
        written.push(file("comparison.md"));
        for figure in figures::study_figures(study) {
            for (ending, format) in [("svg", Format::Svg), ("png", Format::Png)] {
                let path = folder.join(format!("{}.{ending}", figure.id));
                self.picture(&figure, &path, format)?;
                written.push(path);
            }
        }
        Ok(written)
    }

    fn text(&self, path: &Path, text: &str) -> Result<(), OutputError> {
        self.stream(path, |file| file.write_all(text.as_bytes()))
    }

    fn stream(
        &self,
        path: &Path,
        fill: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
    ) -> Result<(), OutputError> {
        write_atomically(path, |file| fill(&mut Interruptible { file, observer: self.observer }))?;
        Ok(())
    }
}

fn figures_of(answer: &Answer) -> Vec<Figure> {
    match answer {
        Answer::Study(study) => figures::study_figures(study),
        _ => figures::of(answer),
    }
}

/// `response.svg` with `shape` is `response-shape.svg`.
fn beside(path: &Path, name: &str) -> PathBuf {
    let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("figure");
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("svg");
    path.with_file_name(format!("{stem}-{name}.{ending}"))
}

/// A writer that stops when the user asks to.
struct Interruptible<'w> {
    file: &'w mut dyn Write,
    observer: &'w dyn Observer,
}

/// Bytes written between two looks at the observer.
const CHUNK: usize = 1 << 16;

impl Write for Interruptible<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if self.observer.cancelled() {
            // Not `ErrorKind::Interrupted`, which writers take as "try again".
            return Err(std::io::Error::other("interrupted by the user"));
        }
        self.file.write(&bytes[..bytes.len().min(CHUNK)])
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}
