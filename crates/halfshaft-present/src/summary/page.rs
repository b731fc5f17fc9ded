//! Lines of text put together.

use super::WIDTH;
use super::wrap::{columns, wrapped};

/// How much farther a line that was kept is set in where it goes on.
const FURTHER: usize = 4;

/// A text while it is written.
#[derive(Debug, Default)]
pub(super) struct Page {
    lines: Vec<String>,
}

impl Page {
    /// An empty line, unless there is one or nothing stands above it.
    pub(super) fn gap(&mut self) {
        if self.lines.last().is_some_and(|line| !line.is_empty()) {
            self.lines.push(String::new());
        }
    }

    pub(super) fn line(&mut self, line: &str) {
        self.lines.push(line.trim_end().to_owned());
    }

    /// A line that keeps its spaces; where it is too wide it goes on below, set in farther.
    pub(super) fn kept(&mut self, line: &str) {
        if columns(line) <= WIDTH {
            return self.line(line);
        }
        let text = line.trim_start_matches(' ');
        let indent = (line.len() - text.len()).min(WIDTH / 2);
        for (index, part) in wrapped(text, WIDTH - indent - FURTHER).iter().enumerate() {
            let further = if index == 0 { 0 } else { FURTHER };
            self.line(&format!("{}{part}", " ".repeat(indent + further)));
        }
    }

    pub(super) fn lines(&mut self, lines: &[String]) {
        lines.iter().for_each(|line| self.line(line));
    }

    /// The heading of the whole text.
    pub(super) fn title(&mut self, text: &str) {
        let lines = wrapped(text, WIDTH);
        let longest = lines.iter().map(|line| columns(line)).max().unwrap_or(0);
        self.lines.extend(lines);
        self.lines.push("=".repeat(longest));
    }

    /// A heading within the text.
    pub(super) fn heading(&mut self, text: &str) {
        self.gap();
        self.lines(&wrapped(text, WIDTH));
        let longest = self.lines.last().map_or(0, |line| columns(line));
        self.lines.push("-".repeat(longest));
    }

    /// A paragraph whose later lines are set in as far as its mark is wide.
    pub(super) fn paragraph(&mut self, mark: &str, text: &str) {
        let indent = mark.chars().count();
        let lines = wrapped(text, WIDTH - indent);
        for (index, line) in lines.iter().enumerate() {
            let start = if index == 0 { mark.to_owned() } else { " ".repeat(indent) };
            self.line(&format!("{start}{line}"));
        }
    }

    pub(super) fn list(&mut self, items: &[String]) {
        items.iter().for_each(|item| self.paragraph("- ", item));
    }

    pub(super) fn finish(self) -> String {
        let mut text = self.lines.join("\n");
        text.push('\n');
        text
    }
}
