//! Whether an explicit method is held back by stability (Hairer & Wanner II, section IV.2).

/// Without suspicion, only every so many steps are looked at: looking costs about as much as an
/// evaluation of a small system.
const PERIOD: u32 = 8;
/// So many steps at the limit of stability are a finding,
const ENOUGH: u32 = 15;
/// unless so many in a row in between were within it.
const INNOCENT: u32 = 6;

/// The record of suspicion.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stiffness {
    steps: u32,
    suspicious: u32,
    innocent: u32,
    found: bool,
}

impl Stiffness {
    /// Whether the present step should be looked at.
    #[inline]
    pub(super) fn is_due(&mut self) -> bool {
        self.steps = self.steps.wrapping_add(1);
        !self.found && (self.suspicious > 0 || self.steps.is_multiple_of(PERIOD))
    }

    /// Takes note of a step that was at the limit of stability or not.
    pub(super) fn note(&mut self, at_limit: bool) {
        if at_limit {
            self.innocent = 0;
            self.suspicious += 1;
            self.found |= self.suspicious >= ENOUGH;
        } else {
            self.innocent += 1;
            if self.innocent >= INNOCENT {
                self.suspicious = 0;
            }
        }
    }

    pub(super) fn is_found(&self) -> bool {
        self.found
    }
}
