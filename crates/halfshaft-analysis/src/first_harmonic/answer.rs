//! From a line to the answer of `resonance --method first-harmonic`.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{DEFAULT_POINTS, Question, ResonanceQuestion};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Branch, Effort, Header, JumpSpeeds, Reason, ResonanceResult, SpecialKind, SpecialPoint, Status,
    Termination,
};

use super::births;
use super::channels;
use super::curve::{Curve, Kind, Piece, Sample, follow};
use super::grid::Grid;
use super::problem::{METHOD, Problem};
use super::responses::Finder;
use super::setting::{self, even};
use super::{backbone, told};
use crate::error::AnalysisError;
use crate::header::header;

/// Answers `resonance` by the first harmonic.
pub(crate) fn solve(
    line: &Driveline,
    question: &ResonanceQuestion,
    observer: &dyn Observer,
) -> Result<ResonanceResult, AnalysisError> {
    if question.parameter.is_some() {
        return Err(AnalysisError::MethodDoesNotFit {
            method: METHOD,
            reason: "it goes through excitation speeds only, not through a parameter".to_owned(),
        });
    }
    let equations = EquationsOfMotion::new(line)?;
    // Refuses a line that does not fit before anything else is worked out.
    let shaft = Problem::new(equations.clone(), 1.0)?.shaft;
    // The modes are only needed where the range of speeds is not given.
    let resonance = match question.frequency {
        Some(_) => None,
        None => Some(setting::resonance(&equations, shaft, question.mode)?),
    };
    let middle = question.frequency.map(|(from, to)| f64::midpoint(from, to));
    let nu = resonance.as_ref().map_or(middle, |resonance| Some(resonance.omega));
    let order = setting::order(&equations, question.order, nu)?;
    let problem = Problem::new(equations, order)?;
    let finder = Finder::new(&problem);
    let window = match (question.frequency, &resonance) {
        (Some((from, to)), _) => (order * from.max(1e-6 * to), order * to),
        (None, Some(resonance)) => setting::window(&problem, &finder, resonance),
        (None, None) => return Err(setting::no_resonance()),
    };
    let problem = setting::shaft(problem, window);
    let finder = Finder::new(&problem);
    setting::reaches(&problem, window)?;
    let points = question.points.unwrap_or(DEFAULT_POINTS);
    let nus = births::with_births(&problem, &finder, even(window.0, window.1, points));
    observer.progress(0.1);
    let grid = Grid::new(&problem, &finder, nus.clone(), &|| observer.cancelled());
    observer.progress(0.4);
    let curve = follow(&problem, grid, &|| observer.cancelled());
    observer.progress(0.8);
    let mut header = header(line, &Question::Resonance(question.clone()));
    told::resonance(&problem, &curve, question.order.is_none(), &mut header);
    if curve.cancelled || observer.cancelled() {
        let detail = "not all responses were followed".to_owned();
        header.termination = Termination::early(Reason::Cancelled, detail);
    }
    Ok(result(&problem, &finder, &curve, &nus, header))
}

fn result(
    problem: &Problem,
    finder: &Finder,
    curve: &Curve,
    nus: &[f64],
    header: Header,
) -> ResonanceResult {
    let samples = || curve.pieces.iter().flat_map(|piece| &piece.samples);
    let largest =
        samples().max_by(|a, b| a.response.amplitude().total_cmp(&b.response.amplitude()));
    let window = (nus.first().copied().unwrap_or(0.0), nus.last().copied().unwrap_or(0.0));
    let backbones = largest.map_or_else(Vec::new, |sample| {
        let highest = 1.1 * sample.response.amplitude();
        backbone::all(problem, setting::rest_twist(problem), highest, window, nus)
    });
    ResonanceResult {
        header,
        branches: curve.pieces.iter().map(|piece| branch(problem, piece, window)).collect(),
        scaling: Vec::new(),
        peaks: largest
            .map(|sample| channels::named(problem, &sample.response))
            .into_iter()
            .collect(),
        backbones,
        jumps: curve.pieces.iter().flat_map(|piece| jumps(problem, finder, piece)).collect(),
        effort: Some(Effort {
            samples: samples().count(),
            steps: curve.steps,
            iterations: curve.iterations,
            seeds: curve.seeds,
        }),
        verification: Vec::new(),
    }
}

fn branch(problem: &Problem, piece: &Piece, window: (f64, f64)) -> Branch {
    let responses: Vec<_> = piece.samples.iter().map(|sample| &sample.response).collect();
    let mut special_points = Vec::new();
    for (index, sample) in piece.samples.iter().enumerate() {
        let kind = match sample.kind {
            Kind::Fold => SpecialKind::Fold,
            Kind::End => SpecialKind::End,
            Kind::Regular | Kind::Peak => continue,
        };
        let values = channels::named(problem, &sample.response);
        let mut point = SpecialPoint::new(kind, Status::Located, values);
        if kind == SpecialKind::Fold {
            point.unstable_dimension_change = dimension_change(piece, index);
        }
        let at_border = sample.response.nu <= window.0 || sample.response.nu >= window.1;
        if kind == SpecialKind::End && !at_border && !piece.ends.is_empty() {
            point.note = Some(piece.ends.clone());
        }
        special_points.push(point);
    }
    let mut branch = Branch::plain(channels::columns(problem, &responses), special_points);
    branch.closed = piece.closed;
    let found_at = piece.found_at / problem.order;
    branch.origin = if piece.found_at <= window.0 {
        "low end of the range".to_owned()
    } else if piece.found_at >= window.1 {
        "high end of the range".to_owned()
    } else {
        format!("all responses at {found_at:.6} rad/s")
    };
    branch.ends = if !piece.ends.is_empty() {
        piece.ends.clone()
    } else if piece.closed {
        "where it began".to_owned()
    } else {
        "at the borders of the range".to_owned()
    };
    branch
}

/// Change of the unstable dimension across a sample, in the direction of the branch.
fn dimension_change(piece: &Piece, index: usize) -> Option<i32> {
    let before = piece.samples.get(index.checked_sub(1)?)?;
    let after = piece.samples.get(index + 1)?;
    let dimension = |sample: &Sample| i32::from(sample.response.unstable_dimension());
    Some(dimension(after) - dimension(before))
}

/// Jumps of slow sweeps: at each fold at which a stable part of the branch ends.
fn jumps(problem: &Problem, finder: &Finder, piece: &Piece) -> Vec<JumpSpeeds> {
    let mut jumps = Vec::new();
    for window in piece.samples.windows(3) {
        let [before, fold, after] = window else { continue };
        if fold.kind != Kind::Fold || !(before.response.is_stable() || after.response.is_stable()) {
            continue;
        }
        let (nu, here) = (fold.response.nu, &fold.response);
        let sweep = if before.response.nu < nu { "up" } else { "down" };
        let far = |twist: halfshaft_numerics::Complex| {
            (twist - here.twist).modulus() > 1e-4 * here.amplitude()
        };
        let others = finder.all(problem, nu).list.into_iter();
        let distance = |amplitude: f64| (amplitude - here.amplitude()).abs();
        let landing = others
            .filter(|response| response.is_stable() && far(response.twist))
            .min_by(|a, b| distance(a.amplitude()).total_cmp(&distance(b.amplitude())));
        let frequency = nu / problem.order;
        jumps.push(JumpSpeeds {
            sweep: sweep.to_owned(),
            frequency,
            rpm: frequency * 30.0 / std::f64::consts::PI,
            channel: format!("{}.twist", problem.equations.connections[problem.shaft].name),
            before: here.amplitude(),
            after: landing.map(|response| response.amplitude()),
        });
    }
    jumps
}
