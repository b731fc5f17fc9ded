//! Averaging (multiple scales) of one mode: the whole response in closed form.
//!
//! [`ModeEquation`] reduces the line to `x'' + ω1² x + a2 x² + ... + a7 x⁷ + β x' = f cos ω t`
//! for the twist `x` of one shaft beyond its equilibrium. The slow flow (theory 4, (43)-(45)) turns
//! that into one polynomial in `z = ρ²`, so that [`responses`] finds *all* responses at a
//! frequency and all folds; [`curve`] joins them to branches; [`fold_curves`] follows the
//! folds over a parameter through their cusps.

mod answer;
mod columns;
mod curve;
mod fold_answer;
mod fold_curves;
mod mode_equation;
mod responses;
mod scaling;

pub(crate) use answer::{default_window, solve};
pub(crate) use columns::phase_lag;
pub(crate) use fold_answer::solve as solve_folds;
pub(crate) use mode_equation::ModeEquation;
pub(crate) use responses::Response;
