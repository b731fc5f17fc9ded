//! Systems of equal blocks on a graph, bordered by a few dense rows and columns.
//!
//! ```text
//! [ A  B ] [x]   [r]        A: one m by m block for each node and each edge of a graph,
//! [ C  D ] [y] = [s]        B, C, D: k columns, k rows and their corner
//! ```
//!
//! Nodes are eliminated in an order of least degree, which makes no fill on a tree, so the work
//! grows as `nodes · m³` there. The border is carried along and solved with the last node, pivoted as
//! one dense block, so that a singular `A` (a fold) does no harm as long as the whole is regular: no
//! separate bordering algorithm is needed. Compare W. Govaerts, *Numerical Methods for Bifurcations
//! of Dynamical Equilibria* (2000), chapter 3.

mod fixed;
mod kernel;
mod large;
mod pattern;
mod sized;
mod symmetric;
mod system;

pub use pattern::Pattern;
pub use symmetric::{Scalar, SymmetricSystem};
pub use system::{BlockSystem, Factors};
