//! Periodic responses of the full equations, to hold against closed forms.
//!
//! From the predicted state the full line is integrated over one period with its variational
//! equation, and Newton's method on the stroboscopic map ([`halfshaft_numerics::ode::periodic`])
//! closes the orbit. So unstable responses can be checked too, and the Floquet multipliers
//! come with the orbit.

mod elastic_motion;
mod orbits;

#[cfg(test)]
pub(crate) use elastic_motion::ElasticMotion;
pub(crate) use orbits::{choose, common_order, periodic};
