//! `basins`: which response each of many initial states leads to, at one excitation speed.
//!
//! The responses that `resonance` knows are made exact by shooting; each stable one gets a
//! neighbourhood from which everything tried comes back to it. Then all initial states of the grid run
//! side by side until such a neighbourhood catches them. What else they settle to is found by motions
//! that repeat, and joins the list. Source of the idea of cells that lead to known attractors:
//! C. S. Hsu, *Cell-to-Cell Mapping* (1987); here no cell stands for another, every state is followed.
//!
//! | file | task |
//! |---|---|
//! | `answer` | question to result |
//! | `frame` | states of the line and their distance |
//! | `settling` | one motion until it is caught, repeats or runs away |
//! | `shocks`, `border` | the smallest impulse from one response to another: where, and how small |
//! | `search` | attractors, their neighbourhoods, where many states lead to |
//! | `window` | the initial states |

mod answer;
mod border;
mod frame;
mod search;
mod settling;
mod shocks;
mod window;

pub(crate) use answer::solve;
