//! Writing answers to files: one form by its ending, or all forms into a folder.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::parquet;
use crate::target::{Format, OutputError, Target, is_here};
use halfshaft_numerics::observer::Observer;
use halfshaft_present::figure::svg::SvgOptions;
use halfshaft_present::figure::{Figure, FigureError, png, svg};
use halfshaft_present::{figures, html, sketch};
use halfshaft_results::io::{
    WriteError, comparison_csv, comparison_markdown, csv, tables_of, write_atomically,
};
use halfshaft_results::{Answer, CheckResult, StudyResult};

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
        Target::Folder(folder) => {
            let made = make_folder(folder)?;
            Writer { observer }.folder(answer, folder).inspect_err(|_| {
                // A folder that we made for nothing is not left behind; one with a file in it stays.
                made.iter().for_each(|folder| drop(std::fs::remove_dir(folder)));
            })
        }
    }
}

/// Makes a folder with all above it; returns those that were not there, the innermost first.
fn make_folder(folder: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let missing = folder.ancestors().take_while(|folder| !folder.exists() && !is_here(folder));
    let missing: Vec<PathBuf> = missing.map(Path::to_path_buf).collect();
    std::fs::create_dir_all(folder)
        .map_err(|source| OutputError::Folder { folder: folder.to_path_buf(), source })?;
    Ok(missing)
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
            .map_err(|complaint| OutputError::ParquetWriter { complaint })
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
            return Err(match nothing_found(answer) {
                Some(reason) => OutputError::NoFigure { analysis, reason },
                None => OutputError::Nothing { analysis, what: "figure" },
            });
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
        if parquet::writer().is_some() && !tables_of(answer).is_empty() {
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

/// Why there is nothing to draw, where the analysis found nothing.
fn nothing_found(answer: &Answer) -> Option<&'static str> {
    match answer {
        Answer::Resonance(result) if result.branches.is_empty() => {
            Some("no periodic response was found in the range")
        }
        _ => None,
    }
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

#[cfg(test)]
mod tests {
    use halfshaft_numerics::observer::Silent;
    use halfshaft_results::Answer;

    use super::write;
    use crate::target::{Format, Target};

    /// Source: a trial: an empty resonance has nothing to draw, and that is why.
    #[test]
    fn a_resonance_without_responses_says_why_it_has_no_figure() {
        let empty = serde_json::json!({
            "analysis": "resonance", "model": { "name": "m", "digest": "0" }, "settings": {},
            "termination": { "reason": "completed", "detail": "" }, "version": "0",
            "warnings": [], "assumptions": [], "branches": [], "scaling": [], "peaks": [],
            "backbones": [], "jumps": [], "verification": [],
        });
        let answer: Answer = halfshaft_results::io::from_json(&empty.to_string()).unwrap();
        let target = Target::File("nowhere.png".into(), Format::Png);
        let told = write(&answer, &target, &Silent).unwrap_err().to_string();
        assert!(told.ends_with("no periodic response was found in the range"), "{told}");
    }
}
