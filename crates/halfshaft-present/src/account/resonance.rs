//! What is told of a resonance.

use halfshaft_results::{Branch, ModeScaling, ResonanceResult, SpecialKind, SpecialPoint};

use super::{Account, Grid, check::minus, periodic, verification};
use crate::words::{capital, frequency_words, number, plain, quantity};

/// The whole account.
pub(crate) fn account(result: &ResonanceResult) -> Account {
    if result.scaling.is_empty() {
        return periodic::account(result);
    }
    let mut account = Account::default();
    for (index, scaling) in result.scaling.iter().enumerate() {
        account.text([peak(result, index), threshold(scaling)]);
    }
    account.text(super::jumps::told(result));
    for (index, scaling) in result.scaling.iter().enumerate() {
        account.figure(crate::figures::resonance::id(result, index));
        account.text([format!("Scaling: {}.", statement(scaling))]);
    }
    account.grid(coefficients(result));
    let folds = folds(result);
    if folds.rows() > 0 {
        account.note(
            "A fold is where two responses meet and vanish: a slow sweep jumps there. The backbone \
             is where the peaks lie as the excitation grows. Between the folds three responses \
             exist, and the middle one is never seen, because it is not stable.",
        );
    }
    account.grid(folds);
    account.append(verification::account(result));
    account
}

/// The scaling in the program's own words, with a true minus.
pub(crate) fn statement(scaling: &ModeScaling) -> String {
    capital(minus(&plain(&scaling.statement)).trim_end_matches('.'))
}

/// Where the response is largest and how large it is there.
pub(crate) fn peak(result: &ResonanceResult, index: usize) -> String {
    let (Some(scaling), Some(peak)) = (result.scaling.get(index), result.peaks.get(index)) else {
        return "The response has no peak.".to_owned();
    };
    let value = |name: &str| peak.get(name).copied();
    let Some(frequency) = value("frequency") else { return String::new() };
    let shaft = plain(&scaling.shaft);
    let order = match scaling.order {
        1.0 => String::new(),
        order => format!(" of order {}", number(order, 4)),
    };
    let range = range(result);
    if frequency < range.0 || frequency > range.1 {
        return outside(result, scaling, frequency);
    }
    let mut text =
        format!("Excitation{order} drives the {shaft} most at {}", frequency_words(frequency));
    if let Some(rho) = value("rho") {
        text += &format!(": its twist swings by ±{}", crate::words::angle(rho));
    }
    if let Some(torque) = value(&format!("{}.torque.harmonic1", scaling.shaft)) {
        text += &format!(", its torque by ±{}", quantity(torque, 5, "N·m"));
    }
    format!("{text}.")
}

/// The excitation speeds of the answer, rad/s.
fn range(result: &ResonanceResult) -> (f64, f64) {
    let speeds = result.branches.iter().flat_map(|branch| branch.values("frequency"));
    speeds.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), speed| {
        (least.min(*speed), most.max(*speed))
    })
}

/// What is said of a mode whose peak lies outside the range asked for.
fn outside(result: &ResonanceResult, scaling: &ModeScaling, peak: f64) -> String {
    let rows = result.branches.iter().flat_map(|branch| {
        branch.values("rho").iter().copied().zip(branch.values("frequency").iter().copied())
    });
    // A bend that reaches speed zero has left what averaging can speak of.
    let itself = if peak > 0.0 {
        format!("the resonance itself lies outside it, at {}", frequency_words(peak))
    } else {
        "the bend goes on past what the closed form can speak of".to_owned()
    };
    match rows.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((rho, speed)) => format!(
            "In the range computed, the twist of the {} swings by at most ±{}, at {}; {itself}.",
            plain(&scaling.shaft),
            crate::words::angle(rho),
            frequency_words(speed)
        ),
        None => format!("There is no response in the range computed; {itself}."),
    }
}

/// How far the response is from folding.
pub(crate) fn threshold(scaling: &ModeScaling) -> String {
    let Some(threshold) = scaling.fold_threshold_f else {
        return "This response cannot fold, whatever the excitation.".to_owned();
    };
    let from = quantity(threshold, 5, "rad/s²");
    let model = quantity(scaling.f, 5, "rad/s²");
    match scaling.fold_threshold_factor {
        Some(0.0) => {
            "Without damping nothing holds the peak back: it folds under any excitation.".to_owned()
        }
        Some(factor) if factor > 1.0 => format!(
            "It does not jump: the excitation would have to be {} larger (folds begin at f = {from}; \
             the model has f = {model}).",
            times_exactly(factor)
        ),
        Some(factor) => format!(
            "It folds: folds begin at f = {from}, and the model has f = {model}, {} that.",
            times_exactly(1.0 / factor)
        ),
        None => format!("Folds would begin at f = {from}."),
    }
}

fn times_exactly(factor: f64) -> String {
    format!("{}\u{a0}times", number(factor, 4))
}

/// The coefficients of the oscillator that each exciting order sees.
fn coefficients(result: &ResonanceResult) -> Grid {
    let rows = &result.scaling;
    let values = |of: fn(&ModeScaling) -> f64| rows.iter().map(move |scaling| Some(of(scaling)));
    let title = "The mode as an oscillator: x'' + ω₁² x + α x³ + β x' = f cos(ω t)";
    Grid::new(title)
        .words("order", rows.iter().map(|scaling| number(scaling.order, 4)))
        .words("x is the twist of", rows.iter().map(|scaling| &scaling.shaft))
        .numbers("modal inertia", "kg·m²", 6, values(|s| s.modal_inertia))
        .numbers("ω₁", "rad/s", 6, values(|s| s.omega_1))
        .numbers("α", "1/(rad² s²)", 6, values(|s| s.alpha))
        .numbers("β", "1/s", 6, values(|s| s.beta))
        .numbers("f", "rad/s²", 6, values(|s| s.f))
        .numbers("f to fold", "rad/s²", 6, rows.iter().map(|s| s.fold_threshold_f))
        .without_empty_columns()
}

/// All folds of all branches, by frequency.
pub(crate) fn fold_points(branches: &[Branch]) -> Vec<&SpecialPoint> {
    let all = branches.iter().flat_map(|branch| &branch.special_points);
    all.filter(|point| point.kind == SpecialKind::Fold).collect()
}

fn folds(result: &ResonanceResult) -> Grid {
    let points = fold_points(&result.branches);
    let of = |name: &'static str| points.iter().map(move |point| point.value(name));
    let torque = |point: &SpecialPoint| {
        let scaling = result.scaling.first()?;
        point.value(&format!("{}.torque.harmonic1", scaling.shaft))
    };
    let status = |point: &&SpecialPoint| match point.status {
        halfshaft_results::Status::Located => "located",
        halfshaft_results::Status::Bracketed => "between two samples",
    };
    Grid::new("Folds")
        .words("no.", (1..=points.len()).map(|number| number.to_string()))
        .numbers("excitation speed", "rad/s", 7, of("frequency"))
        .numbers("excitation speed", "rpm", 6, points.iter().map(|p| rpm(p.value("frequency"))))
        .numbers("detuning σ", "rad/s", 6, of("sigma"))
        .numbers("amplitude ρ", "rad", 6, of("rho"))
        .numbers("torque, first harmonic", "N·m", 5, points.iter().map(|point| torque(point)))
        .words("", points.iter().map(status))
        .without_empty_columns()
}

fn rpm(frequency: Option<f64>) -> Option<f64> {
    frequency.map(|frequency| frequency * 30.0 / std::f64::consts::PI)
}
