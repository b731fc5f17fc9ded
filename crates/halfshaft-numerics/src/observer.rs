//! How a long computation tells of its progress and learns that it should end.

/// Watches a long computation from outside, possibly from several threads at once.
///
/// The library never prints; whoever asks for a computation decides what to do with its progress.
pub trait Observer: Sync {
    /// Called now and then with the finished share of the work, from 0 to 1.
    fn progress(&self, _fraction: f64) {}

    /// Asked between pieces of work; `true` ends the computation at the next safe place.
    fn cancelled(&self) -> bool {
        false
    }
}

/// The observer that shows nothing and never cancels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Silent;

impl Observer for Silent {}

#[cfg(test)]
mod tests {
    use super::{Observer, Silent};
    use std::sync::atomic::{AtomicBool, Ordering};

    struct Button(AtomicBool);

    impl Observer for Button {
        fn cancelled(&self) -> bool {
            self.0.load(Ordering::Relaxed)
        }
    }

    /// Source of truth: the contract in the trait's documentation.
    #[test]
    fn an_observer_cancels_only_when_it_says_so() {
        let button = Button(AtomicBool::new(false));
        let watchers: [&dyn Observer; 2] = [&Silent, &button];
        watchers.iter().for_each(|watcher| watcher.progress(0.5));
        assert!(watchers.iter().all(|watcher| !watcher.cancelled()));
        button.0.store(true, Ordering::Relaxed);
        assert!(watchers[1].cancelled());
    }
}

/// A part of some work: its own progress from 0 to 1 is told as a share of the whole.
#[derive(Clone, Copy)]
pub struct Part<'o> {
    whole: &'o dyn Observer,
    from: f64,
    width: f64,
}

impl<'o> Part<'o> {
    /// Part number `index` of `count` equal parts of what `whole` observes.
    #[expect(clippy::cast_precision_loss, reason = "counts of parts are small")]
    pub fn of(whole: &'o dyn Observer, index: usize, count: usize) -> Self {
        let width = 1.0 / count.max(1) as f64;
        Self { whole, from: index as f64 * width, width }
    }
}

impl Observer for Part<'_> {
    fn progress(&self, fraction: f64) {
        self.whole.progress(self.from + self.width * fraction.clamp(0.0, 1.0));
    }

    fn cancelled(&self) -> bool {
        self.whole.cancelled()
    }
}
