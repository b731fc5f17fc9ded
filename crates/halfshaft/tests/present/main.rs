//! What is shown of real answers: pages, figures, findings, summaries, sketches.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod awkward;
mod common;
mod figures;
mod findings;
mod folds;
mod html;
mod levels;
mod made;
mod names;
mod periodic;
mod sketch;
mod summary;
