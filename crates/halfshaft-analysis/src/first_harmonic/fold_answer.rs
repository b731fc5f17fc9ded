//! From a line to the answer of `folds --method first-harmonic`.

use halfshaft_model::Driveline;
use halfshaft_model::question::{FoldsQuestion, Question};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Column, FoldsResult, Header, Reason, ResponseCount, SpecialPoint, Status, Table, Termination,
};

use super::channels;
use super::count::count;
use super::family::{Family, Spot};
use super::fold_curves::{FoldCurves, Plane};
use super::fold_path::Fold;
use super::problem::Problem;
use super::responses::{Finder, Response, response};
use super::setting::{even, no_resonance};
use super::told;
use crate::error::AnalysisError;
use crate::header::header;

/// Range of circular frequencies looked at where none is asked for, over the natural one.
const BROAD: (f64, f64) = (0.05, 3.0);
/// Speeds and values of the parameter at which responses are counted: where signs decide, and where
/// they have to be found.
const QUICK_GRID: (usize, usize) = (241, 161);
const SLOW_GRID: (usize, usize) = (101, 61);

/// Answers `folds` by the first harmonic.
pub(crate) fn solve(
    line: &Driveline,
    question: &FoldsQuestion,
    observer: &dyn Observer,
) -> Result<FoldsResult, AnalysisError> {
    let family = Family::new(line, question)?;
    let range = (question.parameter.from, question.parameter.to);
    let window = window(&family, question)?;
    let plane = Plane { family: &family, window, range, points: question.points };
    let traced = plane.curves(observer);
    let mut header = header(line, &Question::Folds(question.clone()));
    let inside = family.at(range.0 + 0.618 * (range.1 - range.0));
    let Some(sample) = inside else {
        return Err(AnalysisError::NoExcitation {
            reason: format!("no line can be had with {}", question.parameter.address),
        });
    };
    told::common(&sample, question.order.is_none(), &mut header);
    tell(&family, question, &traced, &mut header);
    let curves = traced
        .curves
        .iter()
        .filter_map(|curve| table(&family, &question.parameter.address, &curve.folds));
    let curves: Vec<Table> = curves.collect();
    let responses = (!traced.cancelled).then(|| map(&family, question, &traced, window, &sample));
    observer.progress(1.0);
    Ok(FoldsResult {
        header,
        special_points: specials(&family, &question.parameter.address, &traced),
        curves,
        parameter: question.parameter.address.clone(),
        parameter_unit: family.unit().to_owned(),
        parameter_value: family.own_value(),
        scaling: None,
        responses,
    })
}

/// Numbers of responses over given speeds (rad/s) and values of the parameter of a question.
pub(crate) fn response_count(
    line: &Driveline,
    question: &FoldsQuestion,
    speeds: &[f64],
    parameters: &[f64],
) -> Result<ResponseCount, AnalysisError> {
    Ok(count(&Family::new(line, question)?, speeds, parameters))
}

/// Range of circular frequencies: what is asked for, or broadly about the resonance.
fn window(family: &Family<'_>, question: &FoldsQuestion) -> Result<(f64, f64), AnalysisError> {
    if let Some((from, to)) = question.frequency {
        return Ok((family.order * from.max(1e-6 * to), family.order * to));
    }
    let resonance = family.resonance.as_ref().ok_or_else(no_resonance)?;
    Ok((BROAD.0 * resonance.omega, BROAD.1 * resonance.omega))
}

/// The response at a fold.
fn at_spot(family: &Family<'_>, spot: &Spot) -> Option<(std::rc::Rc<Problem>, Response)> {
    let problem = family.at(spot.parameter)?;
    let point = problem.value(spot.nu)?;
    let a = spot.u.exp();
    let at = problem.law.balanced(a, spot.mean)?;
    let response = response(&problem, &point, a, &at);
    Some((problem, response))
}

/// `frequency`, the parameter and the first harmonics at a fold.
fn row(family: &Family<'_>, spot: &Spot) -> Option<Vec<f64>> {
    let (problem, response) = at_spot(family, spot)?;
    let mut row = vec![spot.nu / family.order, spot.parameter];
    row.extend(channels::harmonics(&problem, &response));
    Some(row)
}

fn names(family: &Family<'_>, address: &str, spot: &Spot) -> Vec<(String, String)> {
    let mut names = vec![
        ("frequency".to_owned(), "rad/s".to_owned()),
        (address.to_owned(), family.unit().to_owned()),
    ];
    if let Some(problem) = family.at(spot.parameter) {
        let channels = channels::names(&problem).into_iter();
        names.extend(channels.map(|(name, unit)| (format!("{name}.harmonic1"), unit.to_owned())));
    }
    names
}

fn table(family: &Family<'_>, address: &str, folds: &[Fold]) -> Option<Table> {
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(folds.len());
    for fold in folds {
        let mut row = row(family, &fold.spot)?;
        let r = &fold.residual;
        // Near the fold g = by_nu dν + by_u_u du²/2.
        row.push(if r.by_nu * r.by_u_u < 0.0 { 1.0 } else { -1.0 });
        row.push(if r.by_u_u.is_finite() { 0.0 } else { f64::NAN });
        rows.push(row);
    }
    let mut names = names(family, address, &folds.first()?.spot);
    names.push(("opens".to_owned(), "1".to_owned()));
    names.push(("unstable_dimension".to_owned(), "1".to_owned()));
    let columns = names.into_iter().enumerate().map(|(index, (name, unit))| {
        Column::new(name, unit, rows.iter().map(|row| row[index]).collect())
    });
    Some(Table::new(columns.collect()))
}

fn specials(family: &Family<'_>, address: &str, traced: &FoldCurves) -> Vec<SpecialPoint> {
    let told = traced.specials.iter().filter_map(|special| {
        let names = names(family, address, &special.spot);
        let values = row(family, &special.spot)?;
        let mut named: halfshaft_results::Named<f64> =
            names.into_iter().map(|(name, _)| name).zip(values).collect();
        if let Some(precision) = special.precision {
            named.insert("precision".to_owned(), precision);
        }
        let status = if special.precision.is_some() { Status::Located } else { Status::Bracketed };
        Some(SpecialPoint::new(special.kind, status, named))
    });
    told.collect()
}

/// The plane with the number of responses: as asked for, or what the curves span and a little more.
fn map(
    family: &Family<'_>,
    question: &FoldsQuestion,
    traced: &FoldCurves,
    window: (f64, f64),
    sample: &Problem,
) -> ResponseCount {
    let spots = traced.curves.iter().flat_map(|curve| &curve.folds).map(|fold| fold.spot.nu);
    let (low, high) =
        spots.fold((f64::INFINITY, 0.0_f64), |(low, high), nu| (low.min(nu), high.max(nu)));
    let shown = if question.frequency.is_none() && low < high {
        let margin = 0.15 * (high - low);
        ((low - margin).max(window.0), (high + margin).min(window.1))
    } else {
        window
    };
    let quick = matches!(Finder::new(sample), Finder::Polynomial(_));
    let (columns, rows) = if quick { QUICK_GRID } else { SLOW_GRID };
    let speeds = even(shown.0 / family.order, shown.1 / family.order, columns);
    let parameters = even(question.parameter.from, question.parameter.to, rows);
    count(family, &speeds, &parameters)
}

fn tell(family: &Family<'_>, question: &FoldsQuestion, traced: &FoldCurves, header: &mut Header) {
    let address = &question.parameter.address;
    header.assumptions.push(
        "all folds are found at 25 values of the parameter and followed from there: a closed fold \
         curve between two of them may be missed"
            .to_owned(),
    );
    if traced.cancelled {
        let detail = "not the whole plane was gone through".to_owned();
        header.termination = Termination::early(Reason::Cancelled, detail);
    }
    if traced.gaps > 0 {
        header.warnings.push(format!(
            "at {} of the sampled values of {address} the line cannot be had",
            traced.gaps
        ));
    }
    if traced.unmatched > 0 {
        header.warnings.push(format!(
            "{} folds met on the way do not agree with those found at fixed values of {address}",
            traced.unmatched
        ));
    }
    for curve in traced.curves.iter().filter(|curve| !curve.ends.is_empty()) {
        header.warnings.push(format!("a fold curve ends inside the plane: {}", curve.ends));
    }
    if traced.curves.is_empty() && !traced.cancelled {
        let unit = match family.unit() {
            "1" => String::new(),
            unit => format!(" {unit}"),
        };
        let speeds = question
            .frequency
            .map_or_else(String::new, |(from, to)| format!(" between {from:.6} and {to:.6} rad/s"));
        header.warnings.push(format!(
            "no fold{speeds} for {address} from {} to {}{unit}",
            question.parameter.from, question.parameter.to
        ));
    }
}
