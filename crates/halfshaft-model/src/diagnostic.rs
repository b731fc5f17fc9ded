//! What is wrong with a text, where, and what to write instead.
//!
//! Reading never stops at the first mistake: every stage adds to one [`Diagnostics`] list.
//! How a diagnostic looks is the face's business; [`Diagnostics::plain`] is a form without
//! colours for logs and other languages.

use std::fmt::Write as _;
use std::ops::Range;

/// A text that diagnostics point into: a file, or the value of a flag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Path of the file as the user gave it, or the name of the flag.
    pub name: String,
    /// The whole text.
    pub text: String,
}

impl Source {
    /// A source of the given name.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// Line and column, both from 1 and the column in characters, of a byte offset.
    ///
    /// Reads the text from its start; for many places see [`Source::lines`].
    pub fn position(&self, offset: usize) -> (usize, usize) {
        self.lines().position(offset)
    }

    /// The lines of the text, to find many places.
    pub fn lines(&self) -> Lines<'_> {
        let ends = self.text.match_indices('\n').map(|(at, _)| at + 1);
        Lines { text: &self.text, starts: std::iter::once(0).chain(ends).collect() }
    }

    /// The text at `span`, cut at the first line end.
    pub fn excerpt(&self, span: &Range<usize>) -> &str {
        self.text.get(span.clone()).and_then(|text| text.lines().next()).unwrap_or("")
    }
}

/// Where the lines of a text begin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lines<'s> {
    text: &'s str,
    starts: Vec<usize>,
}

impl Lines<'_> {
    /// Line and column, both from 1 and the column in characters, of a byte offset.
    pub fn position(&self, offset: usize) -> (usize, usize) {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.starts.partition_point(|start| *start <= offset);
        let start = line.checked_sub(1).and_then(|line| self.starts.get(line));
        let before = &self.text[start.copied().unwrap_or(0)..offset];
        (line, before.chars().count() + 1)
    }
}

/// Whether a diagnostic forbids to go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Severity {
    /// The model cannot be used.
    Error,
    /// The model can be used, but probably does not say what was meant.
    Warning,
}

/// A second place that belongs to a diagnostic.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Related {
    /// Bytes in the same source.
    pub span: Range<usize>,
    /// What is there.
    pub label: String,
}

/// One finding with its place.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Diagnostic {
    /// Whether it forbids to go on.
    pub severity: Severity,
    /// What is wrong, as a sentence without a full stop.
    pub message: String,
    /// Index into [`Diagnostics::sources`].
    pub source: usize,
    /// Bytes of the offending text; empty for "the whole file".
    pub span: Range<usize>,
    /// Other places that take part.
    pub related: Vec<Related>,
    /// What to write instead.
    pub hint: Option<String>,
}

impl Diagnostic {
    /// An error at `span` of source 0.
    pub fn error(span: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            message: message.into(),
            source: 0,
            span,
            related: Vec::new(),
            hint: None,
        }
    }

    /// A warning at `span` of source 0.
    pub fn warning(span: Range<usize>, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(span, message) }
    }

    /// The same with a hint.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The same with a hint where there is one.
    #[must_use]
    pub fn maybe_hint(mut self, hint: Option<String>) -> Self {
        self.hint = hint.or(self.hint);
        self
    }

    /// The same with a second place.
    #[must_use]
    pub fn related(mut self, span: Range<usize>, label: impl Into<String>) -> Self {
        self.related.push(Related { span, label: label.into() });
        self
    }

    /// The same in another source.
    #[must_use]
    pub fn in_source(mut self, source: usize) -> Self {
        self.source = source;
        self
    }
}

/// Most findings that are shown of one text.
const MOST_SHOWN: usize = 50;

/// All findings about one or more texts, with the texts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnostics {
    /// The texts; a diagnostic names one by its index.
    pub sources: Vec<Source>,
    /// The findings in the order in which they were made.
    pub items: Vec<Diagnostic>,
}

impl Diagnostics {
    /// An empty list about one text.
    pub fn about(source: Source) -> Self {
        Self { sources: vec![source], items: Vec::new() }
    }

    /// Adds a finding.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.items.push(diagnostic);
    }

    /// Whether anything forbids to go on.
    pub fn has_errors(&self) -> bool {
        self.items.iter().any(|item| item.severity == Severity::Error)
    }

    /// The findings that forbid to go on.
    pub fn errors(&self) -> impl Iterator<Item = &Diagnostic> {
        self.items.iter().filter(|item| item.severity == Severity::Error)
    }

    /// The findings that are worth showing, and how many more there are: nobody mends hundreds
    /// before trying again.
    pub fn shown(&self) -> (&[Diagnostic], usize) {
        let shown = self.items.len().min(MOST_SHOWN);
        (&self.items[..shown], self.items.len() - shown)
    }

    /// One paragraph a finding, `file:line:column: message`, without colours; of many the first
    /// ones, see [`Diagnostics::shown`].
    pub fn plain(&self) -> String {
        let lines: Vec<Lines<'_>> = self.sources.iter().map(Source::lines).collect();
        let (shown, more) = self.shown();
        let mut text = String::new();
        for item in shown {
            let Some(source) = self.sources.get(item.source) else { continue };
            let (line, column) = lines[item.source].position(item.span.start);
            let word = match item.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
            };
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{}:{line}:{column}: {word}: {}", source.name, item.message);
            let excerpt = source.excerpt(&item.span);
            if !excerpt.is_empty() {
                let _ = writeln!(text, "  here: {excerpt}");
            }
            if let Some(hint) = &item.hint {
                let _ = writeln!(text, "  hint: {hint}");
            }
        }
        if more > 0 {
            let _ = writeln!(text, "and {more} more");
        }
        text
    }
}

/// Longest text that is looked up among names: the comparison takes memory for each pair of letters.
const LONGEST_NAME: usize = 1000;

/// The name in `known` that is nearest to `text`, where one is near enough to be meant.
pub fn nearest<'k>(text: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let folded = text.to_lowercase();
    let length = folded.chars().count();
    if length > LONGEST_NAME {
        return None;
    }
    let near = known.into_iter().filter_map(|name| {
        let limit = 1.max(name.chars().count() / 3);
        let other = name.to_lowercase();
        // No less than the difference of the lengths has to change.
        if other.chars().count().abs_diff(length) > limit {
            return None;
        }
        let distance = strsim::damerau_levenshtein(&folded, &other);
        (distance <= limit).then_some((distance, name))
    });
    near.min_by_key(|(distance, _)| *distance).map(|(_, name)| name)
}

/// The [`nearest`] name as a question.
pub fn did_you_mean<'k>(text: &str, known: impl IntoIterator<Item = &'k str>) -> Option<String> {
    nearest(text, known).map(|name| format!("did you mean \"{name}\"?"))
}

/// A noun with "a" or "an" before it.
pub(crate) fn with_article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o']) { "an" } else { "a" };
    format!("{article} {noun}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_lines_and_characters_from_one() {
        let source = Source::new("line.toml", "a = \"µ\"\nfriction = 1\n");
        assert_eq!(source.position(0), (1, 1));
        assert_eq!(source.position(7), (1, 7)); // µ has two bytes and one character
        assert_eq!(source.position(source.text.find("fric").expect("is there")), (2, 1));
        assert_eq!(source.position(10_000), (3, 1));
    }

    // Source: two paths to one thing: the lines of the text as the standard library splits them.
    #[test]
    fn lines_give_the_same_places_as_splitting_the_text() {
        let source = Source::new("line.toml", "\na = \"µ\"\r\n\nb\n");
        let lines = source.lines();
        let mut offset = 0;
        for (number, line) in source.text.split('\n').enumerate() {
            for (column, (at, _)) in line.char_indices().enumerate() {
                assert_eq!(lines.position(offset + at), (number + 1, column + 1));
            }
            offset += line.len() + 1;
        }
    }

    #[test]
    fn of_many_findings_the_first_are_shown() {
        let mut found = Diagnostics::about(Source::new("line.toml", "a"));
        found.items.extend((0..60).map(|number| Diagnostic::error(0..1, format!("no {number}."))));
        let text = found.plain();
        assert!(
            text.contains("no 49.") && !text.contains("no 50.") && text.ends_with("and 10 more\n")
        );
    }

    #[test]
    fn near_names_are_offered_and_far_ones_are_not() {
        assert_eq!(
            did_you_mean("stifness", ["stiffness", "damping"]).as_deref(),
            Some("did you mean \"stiffness\"?")
        );
        assert_eq!(did_you_mean("colour", ["stiffness", "damping"]), None);
    }
}
