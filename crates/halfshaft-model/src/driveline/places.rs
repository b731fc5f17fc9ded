//! Where in the file each element and key stands, kept only while errors can be found.

use std::ops::Range;

use crate::format::CheckedTable;

/// Checked tables of the elements, in the order of the line's element lists.
pub(crate) struct Places {
    lists: Vec<(&'static str, Vec<CheckedTable>)>,
    document: Range<usize>,
}

impl Places {
    pub(crate) fn new(document: &CheckedTable) -> Self {
        Self { lists: Vec::new(), document: document.span.clone() }
    }

    /// Elements of one list; an element whose table is unsound is left out, and so is its
    /// place.
    pub(crate) fn read<T>(
        &mut self,
        document: &CheckedTable,
        list: &'static str,
        read: impl Fn(&CheckedTable) -> Option<T>,
    ) -> Vec<T> {
        let (elements, tables) = document
            .tables(list)
            .iter()
            .filter_map(|table| Some((read(table)?, table.clone())))
            .unzip();
        self.lists.push((list, tables));
        elements
    }

    /// Place of `key` of an element, or of the element where the key is not written.
    pub(crate) fn key(&self, list: &str, index: usize, key: &str) -> Range<usize> {
        self.table(list, index).map_or_else(|| self.document.clone(), |table| table.span_of(key))
    }

    fn table(&self, list: &str, index: usize) -> Option<&CheckedTable> {
        let (_, tables) = self.lists.iter().find(|(name, _)| *name == list)?;
        tables.get(index)
    }
}
