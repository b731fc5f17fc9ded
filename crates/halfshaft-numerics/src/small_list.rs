//! A list that lives on the stack while it is short.

/// Up to `N` entries in place, more of them on the heap.
///
/// Polynomials of the usual degrees and their lists of roots then cost no allocation.
#[derive(Debug, Clone)]
pub(crate) enum SmallList<T, const N: usize> {
    /// The entries before the second field's count.
    Inline([T; N], usize),
    /// All entries.
    Heap(Vec<T>),
}

impl<T: Copy + Default, const N: usize> SmallList<T, N> {
    pub(crate) fn new() -> Self {
        Self::Inline([T::default(); N], 0)
    }

    /// A list of `length` default entries.
    pub(crate) fn filled(length: usize) -> Self {
        if length <= N {
            Self::Inline([T::default(); N], length)
        } else {
            Self::Heap(vec![T::default(); length])
        }
    }

    pub(crate) fn from_slice(entries: &[T]) -> Self {
        let mut list = Self::filled(entries.len());
        list.as_mut_slice().copy_from_slice(entries);
        list
    }

    #[inline]
    pub(crate) fn as_slice(&self) -> &[T] {
        match self {
            Self::Inline(entries, length) => &entries[..*length],
            Self::Heap(entries) => entries,
        }
    }

    #[inline]
    pub(crate) fn as_mut_slice(&mut self) -> &mut [T] {
        match self {
            Self::Inline(entries, length) => &mut entries[..*length],
            Self::Heap(entries) => entries,
        }
    }

    #[inline]
    pub(crate) fn push(&mut self, entry: T) {
        match self {
            Self::Inline(entries, length) if *length < N => {
                entries[*length] = entry;
                *length += 1;
            }
            Self::Inline(entries, _) => {
                let mut all = entries.to_vec();
                all.push(entry);
                *self = Self::Heap(all);
            }
            Self::Heap(entries) => entries.push(entry),
        }
    }

    #[inline]
    pub(crate) fn clear(&mut self) {
        match self {
            Self::Inline(_, length) => *length = 0,
            Self::Heap(entries) => entries.clear(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::SmallList;

    /// Source of truth: the same pushes on a `Vec`.
    #[test]
    fn spilling_to_the_heap_keeps_the_entries() {
        let mut list = SmallList::<u32, 3>::new();
        let mut vector = Vec::new();
        for entry in 0..10 {
            list.push(entry);
            vector.push(entry);
            assert_eq!(list.as_slice(), vector);
        }
        list.clear();
        assert!(list.as_slice().is_empty());
        assert_eq!(SmallList::<u32, 2>::from_slice(&[5, 6, 7]).as_slice(), [5, 6, 7]);
    }
}
