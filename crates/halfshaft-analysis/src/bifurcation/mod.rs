//! What the line settles to along a stepwise sweep, by letting it run.
//!
//! At each value of the excitation speed, or of a number of the line, the motion goes on from where it was
//! at the value before, first until it repeats or its time for settling is over, then for a while that is
//! recorded. It is followed by Taylor series from kink to kink ([`crate::shooting`]), one period of the
//! excitation at a time, and looked at when a period begins (the section of Poincaré for forced motion:
//! T. S. Parker, L. O. Chua, *Practical Numerical Algorithms for Chaotic Systems* (1989), chapter 2).
//!
//! | file | task |
//! |---|---|
//! | `stroboscope` | the motion over one period |
//! | `repetition` | whether states come to repeat |
//! | `exponents` | Lyapunov exponents from the variations of each period |
//! | `visit` | the motion at one value |
//! | `sweep` | value after value, up and down |
//! | `overlay` | continued branches, and which of them a motion is on |
//! | `jumps` | where the amplitude jumps |
//! | `answer` | all of it |

mod answer;
mod exponents;
mod jumps;
mod overlay;
mod repetition;
mod stroboscope;
mod sweep;
mod visit;

pub(crate) use answer::solve;
