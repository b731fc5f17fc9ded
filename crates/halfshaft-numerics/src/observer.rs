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
