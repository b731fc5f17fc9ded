//! Linear vibration over the excitation speed, order by order.
//!
//! Order `n` at speed `Ω` moves the line by `D(nΩ) q = T_n` with the dynamic stiffness
//! `D(ω) = K (1 + i η) + i ω C - ω² M`; the sources of an order add up with their phases. In time all
//! orders together are `Re Σ q_n exp(i n Ω t)`, and half of its range over a period is what a gauge
//! would show: not the sum of the magnitudes.
//!
//! [`system`] solves for one speed and order, [`channels`] says what is told of it, [`synthesis`] adds
//! orders up in time, [`sweep`] goes through the speeds.

mod answer;
mod channels;
mod dampers;
mod engines;
mod modal_damping;
mod speeds;
mod sweep;
mod synthesis;
mod system;

pub(crate) use answer::solve;
