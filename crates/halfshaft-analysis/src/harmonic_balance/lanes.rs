//! Rows of a few numbers that lie in memory as the widest registers want them.

use std::ops::{Deref, DerefMut};

/// Numbers in a line of the cache: a row that begins elsewhere takes two accesses.
const LINE: usize = 8;

/// Rows of `W` numbers, the first at the beginning of a line of the cache.
pub(super) struct Rows<const W: usize> {
    numbers: Vec<f64>,
    from: usize,
    count: usize,
}

impl<const W: usize> Rows<W> {
    /// Rows of zeros.
    pub(super) fn zeros(count: usize) -> Self {
        let numbers = vec![0.0_f64; count * W + LINE - 1];
        let from = numbers.as_ptr().align_offset(LINE * size_of::<f64>());
        // An offset that cannot be had is told by a huge one.
        let from = if from < LINE { from } else { 0 };
        Self { numbers, from, count }
    }
}

impl<const W: usize> Deref for Rows<W> {
    type Target = [[f64; W]];

    #[inline(always)]
    fn deref(&self) -> &Self::Target {
        self.numbers[self.from..self.from + self.count * W].as_chunks().0
    }
}

impl<const W: usize> DerefMut for Rows<W> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Self::Target {
        self.numbers[self.from..self.from + self.count * W].as_chunks_mut().0
    }
}
