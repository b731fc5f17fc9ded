//! The initial states.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::question::BasinsQuestion;

use super::frame::Frame;
use crate::error::AnalysisError;
use crate::harmonic_balance::{AtSpeed, Response};

/// States at time 0: the twist and the rate of one shaft vary, everything else is at rest.
pub(super) struct Window {
    pub(super) shaft: String,
    pub(super) twists: Vec<f64>,
    pub(super) rates: Vec<f64>,
    /// Place of the shaft among the tree's.
    pub(super) place: usize,
    coordinates: usize,
    rest: Vec<f64>,
}

/// The window reaches this far beyond what the responses reach.
const BEYOND: f64 = 1.5;

impl Window {
    pub(super) fn new(
        at: &AtSpeed,
        question: &BasinsQuestion,
        responses: &[Response],
        frame: &Frame,
    ) -> Result<Self, AnalysisError> {
        let equations = at.equations();
        let shaft = question.shaft.as_deref().unwrap_or(at.reference()).to_owned();
        let tree = &equations.network.tree;
        let named = |edge: &usize| equations.connections[*edge].name == shaft;
        let place = tree.iter().position(|edge| named(&edge.shaft)).ok_or_else(|| {
            let others: Vec<&str> =
                tree.iter().map(|edge| equations.connections[edge.shaft].name.as_str()).collect();
            AnalysisError::MethodDoesNotFit {
                method: "basins",
                reason: format!(
                    "{shaft} closes a loop, so that its twist follows from the others; take --shaft {}",
                    others.join(", ")
                ),
            }
        })?;
        let rest = resting(at, equations, frame);
        let [twist, rate] =
            question.window.unwrap_or_else(|| reached(&shaft, responses, rest[place]));
        Ok(Self {
            twists: spread(twist, question.grid.0),
            rates: spread(rate, question.grid.1),
            coordinates: equations.groups(),
            shaft,
            place,
            rest,
        })
    }

    /// Number of initial states.
    pub(super) fn count(&self) -> usize {
        self.twists.len() * self.rates.len()
    }

    /// State of a number: twists run first.
    pub(super) fn state(&self, number: usize) -> Vec<f64> {
        let twist = self.twists[number % self.twists.len()];
        self.at(twist, self.rates[number / self.twists.len()])
    }

    fn at(&self, twist: f64, rate: f64) -> Vec<f64> {
        let mut state = self.rest.clone();
        state[self.place] = twist;
        state[self.coordinates + self.place] = rate;
        state
    }

    /// One of `side` by `side` states in the middles of as many parts of the window.
    pub(super) fn coarse(&self, number: usize, side: usize) -> Vec<f64> {
        let inside = |values: &[f64], at: usize| {
            let (low, high) = (values[0], values[values.len() - 1]);
            low + (high - low) * (at as f64 + 0.5) / side as f64
        };
        self.at(inside(&self.twists, number % side), inside(&self.rates, number / side))
    }
}

/// The line at rest, the whole running steadily.
fn resting(at: &AtSpeed, equations: &EquationsOfMotion, frame: &Frame) -> Vec<f64> {
    let mut state = vec![0.0; at.coordinates().dimension()];
    for (x, edge) in state.iter_mut().zip(&equations.network.tree) {
        *x = at.rest()[edge.shaft];
    }
    frame.lanes(&state)
}

/// A window somewhat wider than what the stable responses reach.
fn reached(shaft: &str, responses: &[Response], rest: f64) -> [(f64, f64); 2] {
    let stable = responses.iter().filter(|response| response.stability.is_stable());
    let (mut twist, mut rate) = (0.0_f64, 0.0_f64);
    for response in stable {
        let of =
            |name: &str| response.values.get(&format!("{shaft}.{name}")).copied().unwrap_or(0.0);
        twist = twist.max((of("twist.mean") - rest).abs() + of("twist.amplitude"));
        rate = rate.max(of("twist_rate.amplitude"));
    }
    let (twist, rate) =
        (if twist > 0.0 { twist } else { 1.0 }, if rate > 0.0 { rate } else { 1.0 });
    [(rest - BEYOND * twist, rest + BEYOND * twist), (-BEYOND * rate, BEYOND * rate)]
}

fn spread((low, high): (f64, f64), count: usize) -> Vec<f64> {
    let part = |k: usize| k as f64 / (count - 1) as f64;
    (0..count).map(|k| low + (high - low) * part(k)).collect()
}
