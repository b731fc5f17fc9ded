//! Where in the file each element and key stands, kept only while errors can be found.

use std::ops::Range;

use crate::format::CheckedTable;

/// Checked tables of the elements, in the order of the line's element lists, and how far what
/// is unsound in them lets the rest be judged.
pub(crate) struct Places<'d> {
    document: &'d CheckedTable,
}

/// Lists of the file in the order of [`super::Driveline::element_names`].
const LISTS: [&str; 6] = ["inertia", "gear", "shaft", "torque", "damper", "engine"];
/// Lists that bring nodes, with the keys that name them.
const NODES: [(&str, &[&str]); 4] = [
    ("inertia", &["name"]),
    ("gear", &["input", "output"]),
    ("shaft", &["from", "to"]),
    ("damper", &["name", "on"]),
];

impl<'d> Places<'d> {
    pub(crate) fn new(document: &'d CheckedTable) -> Self {
        Self { document }
    }

    /// Elements of one list, one for each of its tables.
    pub(crate) fn read<T>(&self, list: &'static str, read: impl Fn(&CheckedTable) -> T) -> Vec<T> {
        self.document.tables(list).iter().map(read).collect()
    }

    /// Place of `key` of an element, or of the element where the key is not written.
    pub(crate) fn key(&self, list: &str, index: usize, key: &str) -> Range<usize> {
        let table = self.table(list, index);
        table.map_or_else(|| self.document.span.clone(), |table| table.span_of(key))
    }

    /// Place of a key in an entry of a list of tables of an element, or of the list itself.
    pub(crate) fn nested(
        &self,
        list: &str,
        index: usize,
        key: &str,
        entry: Option<(usize, &str)>,
    ) -> Range<usize> {
        let inside = entry.and_then(|(number, inner)| {
            let entries = self.table(list, index)?.tables(key);
            entries.get(number).map(|table| table.span_of(inner))
        });
        inside.unwrap_or_else(|| self.key(list, index, key))
    }

    /// Whether the element has a sound `key`.
    pub(crate) fn has(&self, list: &str, index: usize, key: &str) -> bool {
        self.table(list, index).is_some_and(|table| table.entry(key).is_some())
    }

    /// Whether all of the element is sound.
    pub(crate) fn is_sound(&self, list: &str, index: usize) -> bool {
        self.table(list, index).is_some_and(CheckedTable::is_sound)
    }

    /// The same by the element's place among all elements.
    pub(crate) fn is_sound_at(&self, place: usize) -> bool {
        let mut tables = LISTS.iter().flat_map(|list| self.document.tables(list));
        tables.nth(place).is_some_and(CheckedTable::is_sound)
    }

    /// Whether every element of the list is sound, and none is missing.
    pub(crate) fn all_sound(&self, list: &str) -> bool {
        !self.document.lacks_any_of(&[list])
            && self.document.tables(list).iter().all(CheckedTable::is_sound)
    }

    /// Whether the names of all elements are known.
    pub(crate) fn names_known(&self) -> bool {
        !self.document.lacks_any_of(&LISTS)
            && LISTS.iter().all(|list| self.all_have(list, &["name"]))
    }

    /// Whether all nodes are known, and which gears and shafts join them.
    pub(crate) fn nodes_known(&self) -> bool {
        let lists = NODES.map(|(list, _)| list);
        !self.document.lacks_any_of(&lists)
            && self.document.mentions("inertia")
            && NODES.iter().all(|(list, keys)| self.all_have(list, keys))
    }

    fn all_have(&self, list: &str, keys: &[&str]) -> bool {
        let mut tables = self.document.tables(list).iter();
        tables.all(|table| keys.iter().all(|key| table.entry(key).is_some()))
    }

    fn table(&self, list: &str, index: usize) -> Option<&CheckedTable> {
        self.document.tables(list).get(index)
    }
}
