//! From the question to the diagram.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{BifurcationQuestion, Question};
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_results::{BifurcationResult, Column, Reason, StrobedBranch, Table, Termination};

use super::jumps::jumps;
use super::overlay;
use super::stroboscope::{Ended, Look, Stroboscope};
use super::sweep::{Family, Row, sweep, values};
use super::visit::Visit;
use crate::error::AnalysisError;
use crate::harmonic_balance::Prepared;
use crate::header::header;

pub(crate) fn solve(
    line: &Driveline,
    question: &BifurcationQuestion,
    observer: &dyn Observer,
) -> Result<BifurcationResult, AnalysisError> {
    let equations = Rc::new(EquationsOfMotion::new(line)?);
    let prepared = Prepared::new(&equations, question.frequency)?;
    let shaft = question.shaft.clone().unwrap_or_else(|| prepared.shaft.clone());
    let look = look(&equations, &prepared, &shaft, question.tolerance)?;
    let family = Family::new(line, Rc::clone(&equations), question, prepared.range, look)?;
    let parts = 1 + usize::from(question.branches);
    let mut rows = sweep(&family, question, &Part::of(observer, 0, parts))?;
    let mut result = BifurcationResult {
        header: header(line, &Question::Bifurcation(question.clone())),
        swept: question.parameter.as_ref().map_or("frequency", |range| &range.address).to_owned(),
        frequency: question.parameter.is_some().then_some(prepared.range.0),
        shaft,
        integrator: format!(
            "Taylor series of degree 20, from kink to kink of the laws, errors of a step below {:e} of the \
             motion",
            question.tolerance
        ),
        columns: Vec::new(),
        values: Table::default(),
        jumps: jumps(&rows),
        branches: Vec::new(),
    };
    let whole = rows.len() == values(question, prepared.range).len();
    if question.branches && whole {
        let part = Part::of(observer, 1, parts);
        result.branches = overlaid(line, question, &family, &mut rows, &mut result, &part)?;
    }
    write(&mut result, &family, &rows);
    tell(&mut result, &rows, whole);
    Ok(result)
}

/// What is looked at, and by which measure.
fn look(
    equations: &EquationsOfMotion,
    prepared: &Prepared,
    shaft: &str,
    tolerance: f64,
) -> Result<Look, AnalysisError> {
    let named = |index: usize| equations.connections[index].name == shaft;
    let tree = &equations.network.tree;
    let Some(place) = tree.iter().position(|edge| named(edge.shaft)) else {
        let others: Vec<&str> =
            tree.iter().map(|edge| equations.connections[edge.shaft].name.as_str()).collect();
        return Err(AnalysisError::MethodDoesNotFit {
            method: "bifurcation",
            reason: format!(
                "{shaft} closes a loop, so that its twist follows from the others; take --shaft {}",
                others.join(", ")
            ),
        });
    };
    let middle = f64::midpoint(prepared.range.0, prepared.range.1);
    let (base, connection) = (prepared.base, tree[place].shaft);
    Ok(Look { base, reference: base * middle, tolerance, connection, place })
}

/// The branches of `resonance`, each motion that repeats assigned to one; none with a warning where they
/// cannot be had.
fn overlaid(
    line: &Driveline,
    question: &BifurcationQuestion,
    family: &Family<'_>,
    rows: &mut [Row],
    result: &mut BifurcationResult,
    observer: &dyn Observer,
) -> Result<Vec<StrobedBranch>, AnalysisError> {
    let found = match overlay::branches(line, question, family, observer) {
        Ok(found) => found,
        Err(error) => {
            let warning = format!("the branches of resonance are left out: {error}");
            result.header.warnings.push(warning);
            return Ok(Vec::new());
        }
    };
    overlay::assign(rows, &found, family)?;
    let strobe = Stroboscope::new(&family.equations, family.look, family.speeds.0);
    let swept = (result.swept.as_str(), unit(family));
    let point = |state: &[f64]| strobe.point(state);
    Ok(found.iter().map(|branch| overlay::told(branch, swept, &result.shaft, point)).collect())
}

fn unit(family: &Family<'_>) -> &'static str {
    family.parameter.as_ref().map_or("rad/s", halfshaft_model::Parameter::unit)
}

/// Points and values as tables.
fn write(result: &mut BifurcationResult, family: &Family<'_>, rows: &[Row]) {
    let (swept, unit) = (result.swept.clone(), unit(family));
    let points = || rows.iter().flat_map(|row| row.points.iter().map(move |point| (row, point)));
    result.columns = vec![
        Column::new(&swept, unit, points().map(|(row, _)| row.value).collect()),
        Column::new("direction", "1", points().map(|(row, _)| row.direction).collect()),
        Column::new(result.twist(), "rad", points().map(|(_, point)| point[0]).collect()),
        Column::new(
            format!("{}.twist_rate", result.shaft),
            "rad/s",
            points().map(|(_, point)| point[1]).collect(),
        ),
    ];
    let all = |of: &dyn Fn(&Row) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    let seen = |of: fn(&Visit) -> f64| all(&|row| row.seen.as_ref().map_or(f64::NAN, of));
    let escaped = |row: &Row| f64::from(u8::from(matches!(row.seen, Err(Ended::Escaped))));
    let branch = |row: &Row| row.branch.map_or(f64::NAN, |index| index as f64);
    result.values = Table::new(vec![
        Column::new(&swept, unit, all(&|row| row.value)),
        Column::new("direction", "1", all(&|row| row.direction)),
        Column::new("period", "1", seen(|visit| visit.period.unwrap_or(0) as f64)),
        Column::new("lyapunov_exponent", "1/s", seen(|visit| visit.exponents.0)),
        Column::new("lyapunov_sum", "1/s", seen(|visit| visit.exponents.1)),
        Column::new("amplitude", "rad", seen(|visit| visit.amplitude)),
        Column::new("matches_branch", "1", all(&branch)),
        Column::new("escaped", "1", all(&escaped)),
        Column::new("periods_followed", "1", seen(|visit| visit.followed as f64)),
    ]);
}

/// What the reader must know of the answer.
fn tell(result: &mut BifurcationResult, rows: &[Row], whole: bool) {
    result.header.assumptions.push(
        "each motion goes on from the end of that at the value before; the first begins at rest, and so \
         does the one after a motion that ran away"
            .to_owned(),
    );
    let count = |of: &dyn Fn(&Row) -> bool| rows.iter().filter(|row| of(row)).count();
    let mut warn = |count: usize, text: String| {
        if count > 0 {
            result.header.warnings.push(format!("at {count} values {text}"));
        }
    };
    let ended = |ended: Ended| count(&|row| matches!(row.seen, Err(other) if other == ended));
    warn(ended(Ended::Escaped), "the motion ran away: the shaft does not carry it".to_owned());
    warn(
        ended(Ended::Chattering),
        "a contact opens and closes too often for the motion to be followed".to_owned(),
    );
    let creeping = count(&|row| row.seen.as_ref().is_ok_and(|seen| seen.settling));
    if creeping > 0 {
        result.header.warnings.push(format!(
            "at {creeping} values the motion was still settling after all its periods, though neighbouring \
             motions come together; try more --transient"
        ));
    }
    if !whole {
        let detail = match rows.last() {
            Some(row) => format!("stopped after {} = {:.6}", result.swept, row.value),
            None => "stopped before the first value was reached".to_owned(),
        };
        result.header.termination = Termination::early(Reason::Cancelled, detail);
    }
}
