//! Answers of other methods in the variables of the closed form.
//!
//! Printed figures stand over the detuning σ and the amplitude ρ of one mode. Harmonic balance knows
//! neither; beside a closed form its speeds and swings are shown in them.

use std::borrow::Cow;

use halfshaft_results::{Answer, Column, ModeScaling, Named};

/// The scaling of a closed form, where an answer has one.
pub(super) fn scaling(answer: &Answer) -> Option<&ModeScaling> {
    match answer {
        Answer::Resonance(result) => result.scaling.first(),
        Answer::Folds(result) => result.scaling.as_ref(),
        _ => None,
    }
}

/// The answer with columns `sigma` and `rho` where it has none of its own.
pub(super) fn completed<'a>(answer: &'a Answer, scaling: Option<&ModeScaling>) -> Cow<'a, Answer> {
    let Some(scaling) = scaling else { return Cow::Borrowed(answer) };
    let mut whole = answer.clone();
    match &mut whole {
        Answer::Resonance(result) if result.scaling.is_empty() => {
            for branch in &mut result.branches {
                complete(&mut branch.columns, scaling);
                branch.special_points.iter_mut().for_each(|p| locate(&mut p.values, scaling));
            }
        }
        Answer::Folds(result) if result.scaling.is_none() => {
            result.curves.iter_mut().for_each(|table| complete(&mut table.columns, scaling));
            result.special_points.iter_mut().for_each(|p| locate(&mut p.values, scaling));
        }
        _ => return Cow::Borrowed(answer),
    }
    Cow::Owned(whole)
}

fn swing(scaling: &ModeScaling) -> String {
    format!("{}.twist.harmonic1", scaling.shaft)
}

fn detuning(speed: f64, scaling: &ModeScaling) -> f64 {
    scaling.order * speed - scaling.omega_1
}

fn complete(columns: &mut Vec<Column>, scaling: &ModeScaling) {
    let values = |columns: &[Column], name: &str| {
        columns.iter().find(|column| column.name == name).map(|column| column.values.clone())
    };
    if let Some(speeds) = values(columns, "frequency") {
        let sigma = speeds.into_iter().map(|speed| detuning(speed, scaling)).collect();
        columns.push(Column::new("sigma", "rad/s", sigma));
    }
    if let Some(rho) = values(columns, &swing(scaling)) {
        columns.push(Column::new("rho", "rad", rho));
    }
}

fn locate(values: &mut Named<f64>, scaling: &ModeScaling) {
    if let Some(speed) = values.get("frequency").copied() {
        values.insert("sigma".to_owned(), detuning(speed, scaling));
    }
    if let Some(rho) = values.get(&swing(scaling)).copied() {
        values.insert("rho".to_owned(), rho);
    }
}
