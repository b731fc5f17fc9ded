//! Progress on the terminal and the user's Ctrl-C.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use halfshaft::Observer;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Watches the work: draws a bar after a moment, asks it to end on Ctrl-C.
///
/// The first Ctrl-C ends the computation, and what was reached is written; the next one, while
/// writing, leaves the file unwritten.
pub struct Watch {
    bar: ProgressBar,
    started: Instant,
    interrupts: Arc<AtomicU32>,
    /// Interrupts that have been heeded already.
    heeded: AtomicU32,
}

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
        let interrupts = Arc::new(AtomicU32::new(0));
        let counter = Arc::clone(&interrupts);
        // Without a handler Ctrl-C ends the program at once, which leaves no half file either.
        let _ = ctrlc::set_handler(move || {
            // Who asks a third time does not want to wait.
            if counter.fetch_add(1, Ordering::SeqCst) >= 2 {
                std::process::exit(130);
            }
        });
        Self { bar, started: Instant::now(), interrupts, heeded: AtomicU32::new(0) }
    }

    /// Takes note of interrupts so far: what follows is only stopped by a further one.
    pub fn heed(&self) {
        self.heeded.store(self.interrupts.load(Ordering::SeqCst), Ordering::SeqCst);
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
        self.interrupts.load(Ordering::SeqCst) > self.heeded.load(Ordering::SeqCst)
    }
}
