//! Values that have passed their specification, by key.

use std::ops::Range;

/// A value that has passed its specification.
#[derive(Clone, Debug)]
pub(crate) enum Checked {
    Text(String),
    Number(f64),
    Word(&'static str),
    Numbers(Vec<f64>),
    Range(f64, f64),
    Flag(bool),
    Texts(Vec<Entry>),
    Table(CheckedTable),
    Tables(Vec<CheckedTable>),
}

/// A checked value and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) span: Range<usize>,
    pub(crate) value: Checked,
}

/// A table whose known and sound keys have been checked; unsound ones are missing here
/// and present in the diagnostics.
#[derive(Clone, Debug)]
pub(crate) struct CheckedTable {
    pub(crate) span: Range<usize>,
    pub(super) entries: Vec<(&'static str, Entry)>,
    /// Keys that were present but unsound, so that "missing" is not said of them.
    pub(super) unsound: Vec<&'static str>,
}

impl CheckedTable {
    pub(crate) fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|(name, _)| *name == key).map(|(_, entry)| entry)
    }

    /// Where `key` stands, or the table itself where it does not.
    pub(crate) fn span_of(&self, key: &str) -> Range<usize> {
        self.entry(key).map_or_else(|| self.span.clone(), |entry| entry.span.clone())
    }

    /// Whether the key was written, soundly or not.
    pub(crate) fn mentions(&self, key: &str) -> bool {
        self.entry(key).is_some() || self.unsound.contains(&key)
    }

    pub(crate) fn text(&self, key: &str) -> Option<&str> {
        match &self.entry(key)?.value {
            Checked::Text(text) => Some(text),
            Checked::Word(word) => Some(word),
            _ => None,
        }
    }

    pub(crate) fn number(&self, key: &str) -> Option<f64> {
        match self.entry(key)?.value {
            Checked::Number(value) => Some(value),
            _ => None,
        }
    }

    pub(crate) fn number_or(&self, key: &str, default: f64) -> f64 {
        self.number(key).unwrap_or(default)
    }

    pub(crate) fn word(&self, key: &str) -> Option<&'static str> {
        match self.entry(key)?.value {
            Checked::Word(word) => Some(word),
            _ => None,
        }
    }

    pub(crate) fn numbers(&self, key: &str) -> &[f64] {
        match self.entry(key).map(|entry| &entry.value) {
            Some(Checked::Numbers(values)) => values,
            _ => &[],
        }
    }

    pub(crate) fn range(&self, key: &str) -> Option<(f64, f64)> {
        match self.entry(key)?.value {
            Checked::Range(from, to) => Some((from, to)),
            _ => None,
        }
    }

    pub(crate) fn flag(&self, key: &str) -> bool {
        matches!(self.entry(key).map(|entry| &entry.value), Some(Checked::Flag(true)))
    }

    pub(crate) fn texts(&self, key: &str) -> &[Entry] {
        match self.entry(key).map(|entry| &entry.value) {
            Some(Checked::Texts(texts)) => texts,
            _ => &[],
        }
    }

    pub(crate) fn table(&self, key: &str) -> Option<&Self> {
        match &self.entry(key)?.value {
            Checked::Table(table) => Some(table),
            _ => None,
        }
    }

    pub(crate) fn tables(&self, key: &str) -> &[Self] {
        match self.entry(key).map(|entry| &entry.value) {
            Some(Checked::Tables(tables)) => tables,
            _ => &[],
        }
    }
}
