//! Models that the program carries within it.

use crate::diagnostic::Source;

/// The two-mass driveline of the theory with a softening half-shaft, in direct gear.
pub fn example() -> Source {
    Source::new(
        "two-mass-driveline.toml (built in)",
        include_str!("../models/two-mass-driveline.toml"),
    )
}

/// The scaled oscillator behind the manuscript's resonance figures.
pub fn scaled() -> Source {
    Source::new(
        "scaled-oscillator.toml (built in)",
        include_str!("../models/scaled-oscillator.toml"),
    )
}

/// What `halfshaft new` writes: a line to change, with every common key explained.
pub fn starter() -> &'static str {
    include_str!("../models/starter.toml")
}
