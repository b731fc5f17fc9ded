//! What the reader must know of an answer by the first harmonic.

use halfshaft_results::Header;

use super::amplitude_polynomial::AmplitudePolynomial;
use super::curve::{Curve, Kind};
use super::problem::Problem;
use crate::equilibrium::{self, RunningState};

/// Assumptions and warnings of a response.
pub(super) fn resonance(problem: &Problem, curve: &Curve, chosen: bool, header: &mut Header) {
    common(problem, chosen, header);
    header.assumptions.push(if AmplitudePolynomial::of(&problem.law).is_some() {
        "at each listed speed all responses are roots of one polynomial, found with proof; detached \
         responses between two listed speeds are looked for, but not with proof"
            .to_owned()
    } else {
        "at each listed speed all responses with a mean that the law holds are found, by bounds on \
         the law; detached responses that live between two listed speeds may be missed"
            .to_owned()
    });
    if curve.open > 0 {
        header.warnings.push(format!(
            "at {} of the listed speeds two responses could not be told apart or from none",
            curve.open
        ));
    }
    if curve.unmatched > 0 {
        header.warnings.push(format!(
            "{} responses at listed speeds do not lie on the branches that were followed past them: \
             ask for more points or a narrower range",
            curve.unmatched
        ));
    }
    for piece in curve.pieces.iter().filter(|piece| !piece.ends.is_empty()) {
        header.warnings.push(format!("a branch ends inside the range: {}", piece.ends));
    }
    let samples = || curve.pieces.iter().flat_map(|piece| &piece.samples);
    if samples().any(|sample| !sample.response.damped) {
        header.warnings.push(
            "without damping the response has no bound and is never asymptotically stable"
                .to_owned(),
        );
    }
    past_limit(problem, samples().map(|s| (s.response.amplitude(), s.kind)), header);
}

/// What holds for any answer by this method.
pub(super) fn common(problem: &Problem, chosen: bool, header: &mut Header) {
    header.assumptions.push(format!(
        "first harmonic: the twist of the {} is taken as a mean and one harmonic of order {}, and so \
         is its torque; the rest of the line is linear and exact",
        problem.equations.connections[problem.shaft].name, problem.order
    ));
    header.assumptions.push(
        "stable means that the response does not depart along itself: quasi-periodic motion and \
         responses of twice the period are not seen by one harmonic"
            .to_owned(),
    );
    let orders = problem.equations.excitation.orders();
    if orders.len() > 1 {
        let others: Vec<String> =
            orders.iter().filter(|order| **order != problem.order).map(f64::to_string).collect();
        let why = if chosen { ", the one that drives the shaft most," } else { "" };
        header.assumptions.push(format!(
            "order {}{why} acts alone; left out: order {}",
            problem.order,
            others.join(", ")
        ));
    }
    let running = RunningState::of(&problem.equations);
    if running.kind == halfshaft_results::RunningKind::Accelerating {
        header.assumptions.push(
            "the mean torques accelerate the line: the mean twists are those of uniform acceleration"
                .to_owned(),
        );
    }
}

/// Warns where the shaft swings past the limit of its law.
fn past_limit(problem: &Problem, samples: impl Iterator<Item = (f64, Kind)>, header: &mut Header) {
    let Ok(states) = equilibrium::find_stable(&problem.equations) else { return };
    let Some(rest) = states.primary() else { return };
    let room = equilibrium::room(&problem.equations, problem.shaft, &rest.twists);
    let (mut largest, mut fold) = (0.0_f64, f64::INFINITY);
    for (amplitude, kind) in samples {
        largest = largest.max(amplitude);
        if kind == Kind::Fold {
            fold = fold.min(amplitude);
        }
    }
    let name = &problem.equations.connections[problem.shaft].name;
    if largest > room {
        header.warnings.push(format!(
            "at its largest the {name} swings by {largest:.4} rad, past the {room:.4} rad that are \
             left to the limit of its law: the line would give way there, which one harmonic does \
             not see"
        ));
    }
    if fold.is_finite() && fold > room {
        header.warnings.push(format!(
            "the jumps begin at a swing of {fold:.4} rad, past the {room:.4} rad that are left to the \
             limit of the law of the {name}: the shaft would give way before it jumps"
        ));
    }
}
