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

/// Stands for a number that is missing or unsound, so that names and nodes can be judged all the
/// same. No line with one ever leaves this crate: its finding is an error.
const STAND_IN: f64 = 1.0;

/// A table whose known and sound keys have been checked; unsound ones are missing here
/// and present in the diagnostics.
#[derive(Clone, Debug, Default)]
pub(crate) struct CheckedTable {
    pub(crate) span: Range<usize>,
    pub(super) entries: Vec<(&'static str, Entry)>,
    /// Keys that were present but unsound, so that "missing" is not said of them.
    pub(super) unsound: Vec<&'static str>,
    /// Whether there is something in here, other than plain values, that could not be read as
    /// any key.
    pub(super) strays: bool,
    /// Whether there is nothing wrong in here, however deep.
    pub(super) sound: bool,
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

    pub(crate) fn is_sound(&self) -> bool {
        self.sound
    }

    /// Whether something may be missing here because it could not be read: of these lists of
    /// tables or of what nobody can tell.
    pub(crate) fn lacks_any_of(&self, lists: &[&str]) -> bool {
        self.strays || self.unsound.iter().any(|key| lists.contains(key))
    }

    /// The text, empty where it is missing or unsound.
    pub(crate) fn text_or_empty(&self, key: &str) -> String {
        self.text(key).unwrap_or_default().to_owned()
    }

    /// The number of a required key.
    pub(crate) fn number_or_stand_in(&self, key: &str) -> f64 {
        self.number_or(key, STAND_IN)
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

    /// The texts of a list, empty where it is missing or unsound.
    pub(crate) fn text_list(&self, key: &str) -> Vec<String> {
        let text = |entry: &Entry| match &entry.value {
            Checked::Text(text) => text.clone(),
            _ => String::new(),
        };
        self.texts(key).iter().map(text).collect()
    }

    /// A sound table of lists of numbers, all of which stand at `span`.
    pub(super) fn of_numbers(span: Range<usize>, lists: Vec<(&'static str, Vec<f64>)>) -> Self {
        let entry = |(key, numbers): (&'static str, Vec<f64>)| {
            (key, Entry { span: span.clone(), value: Checked::Numbers(numbers) })
        };
        let entries = lists.into_iter().map(entry).collect();
        Self { span, entries, sound: true, ..Self::default() }
    }

    /// Puts another value in the place of one.
    pub(super) fn replace(&mut self, key: &str, value: Checked) {
        if let Some((_, entry)) = self.entries.iter_mut().find(|(name, _)| *name == key) {
            entry.value = value;
        }
    }

    /// Makes a key unsound that turned out to be so.
    pub(super) fn spoil(&mut self, key: &str) {
        if let Some(at) = self.entries.iter().position(|(name, _)| *name == key) {
            self.unsound.push(self.entries.remove(at).0);
            self.sound = false;
        }
    }

    pub(super) fn tables_mut(&mut self, key: &str) -> &mut [Self] {
        let entry = self.entries.iter_mut().find(|(name, _)| *name == key);
        match entry.map(|(_, entry)| &mut entry.value) {
            Some(Checked::Tables(tables)) => tables,
            _ => &mut [],
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
