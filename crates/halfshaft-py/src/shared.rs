//! What a computation and its caller share.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use halfshaft::Observer;

/// Progress on the way out, the wish to end on the way in.
#[derive(Debug, Default)]
pub struct Watch {
    stop: AtomicBool,
    /// Bits of the finished share.
    share: AtomicU64,
}

impl Watch {
    /// Asks the computation to end at the next safe place.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::SeqCst);
    }

    /// The finished share, from 0 to 1.
    pub fn share(&self) -> f64 {
        f64::from_bits(self.share.load(Ordering::Relaxed))
    }
}

impl Observer for Watch {
    fn progress(&self, fraction: f64) {
        self.share.store(fraction.clamp(0.0, 1.0).to_bits(), Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}
