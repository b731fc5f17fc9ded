//! Progress on the terminal and the user's Ctrl-C.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::time::{Duration, Instant};

use halfshaft::Observer;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Watches the work: draws a bar after a moment, asks it to end on Ctrl-C.
///
/// The first Ctrl-C ends the computation, and what was reached is written; where it comes while
/// writing, it leaves the file unwritten. The second one ends the program, whatever that is doing.
pub struct Watch {
    bar: ProgressBar,
    started: Instant,
    interrupts: Arc<Interrupts>,
}

/// Interrupts by the user.
#[derive(Debug, Default)]
struct Interrupts {
    all: AtomicU32,
    /// Those that have been heeded already.
    heeded: AtomicU32,
    /// Whether files are being written.
    writing: AtomicBool,
}

/// What an interrupt does at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Effect {
    /// Nothing: who works sees it when looking for it.
    Asks,
    /// Ends the program after so long.
    Ends(Duration),
}

impl Interrupts {
    /// Notes one more interrupt.
    fn add(&self) -> Effect {
        match self.all.fetch_add(1, Ordering::SeqCst) {
            0 => Effect::Asks,
            _ if self.writing.load(Ordering::SeqCst) => Effect::Ends(CLEARING),
            _ => Effect::Ends(Duration::ZERO),
        }
    }

    fn heed(&self) {
        self.heeded.store(self.all.load(Ordering::SeqCst), Ordering::SeqCst);
        self.writing.store(true, Ordering::SeqCst);
    }

    fn pending(&self) -> bool {
        self.all.load(Ordering::SeqCst) > self.heeded.load(Ordering::SeqCst)
    }
}

/// Time for the writer of a file to see the interrupt and take its temporary file away.
const CLEARING: Duration = Duration::from_millis(300);
/// Exit status of a program that was interrupted.
const INTERRUPTED: i32 = 130;

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(400);
const LENGTH: u64 = 1000;

impl Watch {
    /// Begins to watch.
    pub fn start(quiet: bool) -> Self {
        let bar = if quiet || !std::io::stderr().is_terminal() {
            ProgressBar::hidden()
        } else {
            ProgressBar::with_draw_target(Some(LENGTH), ProgressDrawTarget::stderr_with_hz(10))
        };
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed}") {
            bar.set_style(style);
        }
        let interrupts = Arc::new(Interrupts::default());
        let counter = Arc::clone(&interrupts);
        // The handler has a thread of its own, so it ends also what never looks at the observer.
        // Without a handler Ctrl-C ends the program at once, which leaves no half file either.
        let _ = ctrlc::set_handler(move || {
            if let Effect::Ends(after) = counter.add() {
                std::thread::sleep(after);
                std::process::exit(INTERRUPTED);
            }
        });
        Self { bar, started: Instant::now(), interrupts }
    }

    /// Takes note of interrupts so far, before writing: that is only stopped by a further one.
    pub fn heed(&self) {
        self.interrupts.heed();
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for Watch {
    fn progress(&self, fraction: f64) {
        if self.started.elapsed() > PATIENCE {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "a share of a thousand"
            )]
            self.bar.set_position((fraction.clamp(0.0, 1.0) * LENGTH as f64) as u64);
        }
    }

    fn cancelled(&self) -> bool {
        self.interrupts.pending()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_interrupt_asks_and_the_second_ends() {
        let interrupts = Interrupts::default();
        assert!(!interrupts.pending());
        assert_eq!(interrupts.add(), Effect::Asks);
        assert!(interrupts.pending());
        assert_eq!(interrupts.add(), Effect::Ends(Duration::ZERO));
    }

    #[test]
    fn while_writing_the_second_interrupt_leaves_time_to_clear_up() {
        let interrupts = Interrupts::default();
        assert_eq!(interrupts.add(), Effect::Asks);
        interrupts.heed();
        assert!(!interrupts.pending());
        assert_eq!(interrupts.add(), Effect::Ends(CLEARING));
        assert!(interrupts.pending());
    }
}
