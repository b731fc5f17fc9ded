//! First harmonic: all responses of a line with one nonlinear connection.
//!
//! The rest of the line is linear, so that it acts on the nonlinear shaft through one complex
//! stiffness and one torque at each frequency ([`limbs`], and [`meshed`] where shafts form loops). The
//! amplitude of the shaft's twist then satisfies one real equation ([`problem`]), of which *all*
//! roots are found: as those of a polynomial ([`amplitude_polynomial`]), or on certified cells of the
//! law's first harmonic ([`sheets`], [`bracketed`]). Branches are followed through a grid of
//! frequencies at which everything is known ([`curve`]), so that detached ones are found as well.

mod amplitude_polynomial;
mod answer;
#[allow(dead_code, reason = "starting points for harmonic balance")]
mod api;
mod backbone;
mod births;
mod bracketed;
mod channels;
mod count;
mod curve;
mod drive;
mod enclosure;
mod family;
mod fold_answer;
mod fold_curves;
mod fold_path;
mod grid;
mod jet;
mod limbs;
mod locate;
mod meshed;
mod path;
mod problem;
mod responses;
mod rest;
mod setting;
mod shaft_law;
mod sheets;
mod told;

pub(crate) use answer::solve;
#[allow(unused_imports, reason = "starting points for harmonic balance")]
pub(crate) use api::{FirstHarmonicResponse, Seeder, responses_at};
pub(crate) use fold_answer::{response_count, solve as solve_folds};
