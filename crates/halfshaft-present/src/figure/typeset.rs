//! Light typesetting: subscripts, superscripts, and everything else as it stands.
//!
//! | written | shown |
//! |---|---|
//! | `δ_1`, `M_{max}` | the 1, or max, lowered and smaller |
//! | `x^2`, `s^{-1}` | the 2, or -1, raised and smaller |
//! | `\_`, `\^`, `\{`, `\}`, `\\` | the second character itself |
//!
//! A `_` or `^` with nothing to act on (the end, a space, an open brace that is never closed) stands
//! for itself. White space becomes single spaces, so that all back ends set the same line.

use super::font::{self, Weight};

/// Size of sub- and superscripts compared with the text that they belong to.
pub(crate) const SCRIPT_SIZE: f64 = 0.7;

/// Height of a run above or below the base line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// On the base line.
    Base,
    /// Lowered and smaller.
    Sub,
    /// Raised and smaller.
    Super,
}

impl Level {
    /// Font size of the run for a text of this size.
    #[must_use]
    pub fn size(self, text_size: f64) -> f64 {
        if self == Self::Base { text_size } else { SCRIPT_SIZE * text_size }
    }

    /// How far the run lies above the base line for a text of this size.
    #[must_use]
    pub fn rise(self, text_size: f64) -> f64 {
        match self {
            Self::Base => 0.0,
            Self::Sub => -0.16 * text_size,
            Self::Super => 0.34 * text_size,
        }
    }
}

/// A piece of text on one level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// The characters.
    pub text: String,
    /// Their level.
    pub level: Level,
}

/// A line of text with levels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rich {
    /// The pieces from left to right; neighbours differ in level.
    pub runs: Vec<Run>,
}

/// Protects a name given by a user, so that it is shown letter by letter.
///
/// ```
/// assert_eq!(halfshaft_present::figure::escape("gear_box"), r"gear\_box");
/// ```
#[must_use]
pub fn escape(name: &str) -> String {
    let mut escaped = String::with_capacity(name.len());
    for c in name.chars() {
        if is_special(c) {
            escaped.push('\\');
        }
        escaped.push(c);
    }
    escaped
}

fn is_special(c: char) -> bool {
    matches!(c, '_' | '^' | '{' | '}' | '\\')
}

impl Rich {
    /// Reads a text with marks.
    pub(crate) fn parse(text: &str) -> Self {
        let chars: Vec<char> = text.chars().collect();
        let mut rich = Self::default();
        let mut at = 0;
        while at < chars.len() {
            let level = match chars[at] {
                '_' => Level::Sub,
                '^' => Level::Super,
                _ => Level::Base,
            };
            at = match script(&chars, at, level) {
                Some((script, next)) => {
                    script.chars().for_each(|c| rich.push(c, level));
                    next
                }
                None => {
                    let (c, next) = literal(&chars, at);
                    rich.push(c, Level::Base);
                    next
                }
            };
        }
        rich.trimmed()
    }

    /// A text without marks on the base line.
    pub(crate) fn plain(text: &str) -> Self {
        let mut rich = Self::default();
        text.chars().for_each(|c| rich.push(c, Level::Base));
        rich.trimmed()
    }

    /// Appends a character.
    pub(crate) fn push(&mut self, c: char, level: Level) {
        let c = if is_foldable(c) { ' ' } else { c };
        let c = if is_forbidden_in_xml(c) { char::REPLACEMENT_CHARACTER } else { c };
        match self.runs.last_mut() {
            Some(run) if c == ' ' && run.text.ends_with(' ') => {}
            Some(run) if run.level == level => run.text.push(c),
            _ => self.runs.push(Run { text: c.to_string(), level }),
        }
    }

    /// Appends a text on one level.
    pub(crate) fn push_str(&mut self, text: &str, level: Level) {
        text.chars().for_each(|c| self.push(c, level));
    }

    /// Appends all runs of another text.
    pub(crate) fn append(&mut self, other: &Self) {
        for run in &other.runs {
            self.push_str(&run.text, run.level);
        }
    }

    /// Whether there is nothing to show.
    pub(crate) fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// The characters without levels.
    pub(crate) fn text(&self) -> String {
        self.runs.iter().map(|run| run.text.as_str()).collect()
    }

    /// Width in points at a font size, by the embedded font.
    pub(crate) fn width(&self, size: f64, weight: Weight) -> f64 {
        let run_width = |run: &Run| {
            let em: f64 = run.text.chars().map(|c| font::advance(c, weight)).sum();
            em * run.level.size(size)
        };
        self.runs.iter().map(run_width).sum()
    }

    fn trimmed(mut self) -> Self {
        if let Some(first) = self.runs.first_mut() {
            first.text = first.text.trim_start().to_owned();
        }
        if let Some(last) = self.runs.last_mut() {
            last.text = last.text.trim_end().to_owned();
        }
        self.runs.retain(|run| !run.text.is_empty());
        self
    }
}

/// The script that the mark at `at` introduces, and where the text goes on.
fn script(chars: &[char], at: usize, level: Level) -> Option<(String, usize)> {
    let next = *chars.get(at + 1)?;
    if level == Level::Base || next.is_whitespace() {
        return None;
    }
    if next != '{' {
        let (c, end) = literal(chars, at + 1);
        return Some((c.to_string(), end));
    }
    let mut content = String::new();
    let mut inside = at + 2;
    while inside < chars.len() {
        if chars[inside] == '}' {
            return Some((content, inside + 1));
        }
        let (c, end) = literal(chars, inside);
        content.push(c);
        inside = end;
    }
    None
}

/// The character at `at`, which a backslash may protect, and where the text goes on.
fn literal(chars: &[char], at: usize) -> (char, usize) {
    match chars.get(at + 1) {
        Some(&protected) if chars[at] == '\\' && is_special(protected) => (protected, at + 2),
        _ => (chars[at], at + 1),
    }
}

/// White space that XML viewers fold; spaces of a stated width or meaning are kept.
fn is_foldable(c: char) -> bool {
    c.is_whitespace() && !matches!(c, '\u{a0}' | '\u{2000}'..='\u{200a}' | '\u{202f}')
}

/// Characters that XML 1.0 does not allow even as references.
fn is_forbidden_in_xml(c: char) -> bool {
    c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}')
}

/// A text for XML and HTML, in content and in quoted attributes.
pub(crate) fn xml_escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            // As a number, because plotly knows few entities by name.
            '"' => escaped.push_str("&#34;"),
            '\'' => escaped.push_str("&#39;"),
            '\n' | '\r' | '\t' => escaped.push(' '),
            c if is_forbidden_in_xml(c) => escaped.push(char::REPLACEMENT_CHARACTER),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{any, prop_assert, prop_assert_eq, proptest};

    fn shown(text: &str) -> Vec<(String, Level)> {
        Rich::parse(text).runs.into_iter().map(|run| (run.text, run.level)).collect()
    }

    /// Oracle: the table at the head of this file.
    #[test]
    fn marks_raise_and_lower() {
        let base = |t: &str| (t.to_owned(), Level::Base);
        let sub = |t: &str| (t.to_owned(), Level::Sub);
        let sup = |t: &str| (t.to_owned(), Level::Super);
        assert_eq!(shown("δ_1"), [base("δ"), sub("1")]);
        assert_eq!(
            shown("M_{max} (s^{-1})"),
            [base("M"), sub("max"), base(" (s"), sup("-1"), base(")")]
        );
        assert_eq!(shown(r"a\_b\\"), [base(r"a_b\")]);
        assert_eq!(shown("a_ b_"), [base("a_ b_")]);
        assert_eq!(shown("a_{b"), [base("a_{b")]);
        assert_eq!(shown("  a \n\t b  "), [base("a b")]);
    }

    proptest! {
        /// Oracle: the contract of `escape`, for any text (white space is folded on both sides).
        #[test]
        fn escaped_text_is_shown_as_it_is(text in any::<String>()) {
            let rich = Rich::parse(&escape(&text));
            prop_assert!(rich.runs.iter().all(|run| run.level == Level::Base));
            prop_assert_eq!(rich, Rich::plain(&text));
        }
    }
}
