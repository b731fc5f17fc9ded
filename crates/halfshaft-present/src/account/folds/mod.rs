//! What is told of fold curves.

use halfshaft_results::{FoldsResult, Reason, SpecialKind, SpecialPoint};

use super::{Account, Grid};
use crate::reading::bounds;
use crate::words::{capital, column_label, counted, list, plain, quantity, special_words};

mod verdict;

/// The whole account.
pub(crate) fn account(result: &FoldsResult) -> Account {
    let mut account = plane(result, true);
    if let Some(scaling) = &result.scaling {
        account.text([format!("Scaling: {}.", super::resonance::statement(scaling))]);
    }
    account
}

/// The account of one plane among others; terms are explained where it is the first.
pub(crate) fn plane(result: &FoldsResult, explain: bool) -> Account {
    let mut account = Account::default();
    if result.header.termination.reason == Reason::Completed {
        account.text(thresholds(result));
        account.text(detached(result));
    } else {
        account.text([
            "The search was ended early, so that folds are missing here and nothing is said of \
             what is safe."
                .to_owned(),
        ]);
    }
    if explain && !result.curves.is_empty() {
        account.note(
            "Between the two folds three responses exist, and a slow sweep jumps where it crosses \
             the second of them. A cusp is where the folds meet and vanish: the threshold of the \
             jump.",
        );
    }
    account.figure(crate::figures::folds::id(result));
    account.grid(points(result));
    account
}

/// What the closed form says of a plane that another method leads.
pub(crate) fn beside(closed: Option<&FoldsResult>) -> Account {
    let mut account = Account::default();
    if let Some(plane) = closed {
        let told = thresholds(plane).into_iter().next().unwrap_or_default();
        account.text([format!("By the closed form of one mode: {told}")]);
    }
    account
}

/// Name of the parameter in words.
pub(crate) fn parameter(result: &FoldsResult) -> String {
    column_label(&result.parameter)
}

/// The cusps, in the order of the answer.
pub(crate) fn cusp_points(result: &FoldsResult) -> impl Iterator<Item = &SpecialPoint> {
    result.special_points.iter().filter(|point| point.kind == SpecialKind::Cusp)
}

/// On which side of a cusp the folds lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// At larger values of the parameter.
    Above,
    /// At smaller values.
    Below,
}

/// On which side of the value of a special point the curve through it lies; `None` where there is no
/// curve.
pub(crate) fn side(result: &FoldsResult, point: &SpecialPoint) -> Option<Side> {
    let (speed, value) = (point.value("frequency")?, point.value(&result.parameter)?);
    let spread = |name: &str| {
        let all = result.curves.iter().flat_map(|curve| curve.values(name)).copied();
        bounds(all).map_or(1.0, |(low, high)| high - low).max(f64::MIN_POSITIVE)
    };
    let (wide, high) = (spread("frequency"), spread(&result.parameter));
    let mut best: Option<(f64, f64)> = None;
    for curve in &result.curves {
        let (x, y) = (curve.values("frequency"), curve.values(&result.parameter));
        for (at, (x, own)) in x.iter().zip(y).enumerate() {
            let apart = ((x - speed) / wide).hypot((own - value) / high);
            if apart.is_finite() && best.is_none_or(|(least, _)| apart < least) {
                let around = &y[at.saturating_sub(2)..(at + 3).min(y.len())];
                best = Some((apart, around.iter().map(|y| y - value).sum()));
            }
        }
    }
    best.map(|(_, beyond)| if beyond >= 0.0 { Side::Above } else { Side::Below })
}

/// Where folds begin, against the model's own value.
pub(crate) fn thresholds(result: &FoldsResult) -> Vec<String> {
    let name = parameter(result);
    let unit = plain(&result.parameter_unit);
    let own =
        result.parameter_value.map(|value| format!("the model has {}", quantity(value, 5, &unit)));
    let mut sentences: Vec<String> = cusp_points(result)
        .filter_map(|point| {
            let value = point.value(&result.parameter)?;
            let place = match side(result, point) {
                Some(Side::Above) => "above",
                Some(Side::Below) => "below",
                None => "from",
            };
            let at = point.value("frequency").map_or_else(String::new, |frequency| {
                let rpm = quantity(frequency * 30.0 / std::f64::consts::PI, 5, "rpm");
                format!(" (cusp at {}, {rpm})", quantity(frequency, 5, "rad/s"))
            });
            Some(format!("folds appear {place} {}{at}", quantity(value, 7, &unit)))
        })
        .collect();
    if sentences.is_empty() {
        return vec![without_cusp(result, &name, own)];
    }
    let places = list(&std::mem::take(&mut sentences));
    let tail = own.map_or_else(String::new, |own| format!("; {own}"));
    let mut told = vec![format!("{}: {places}{tail}.", capital(&name))];
    told.extend(verdict::told(result));
    told
}

fn without_cusp(result: &FoldsResult, name: &str, own: Option<String>) -> String {
    let tail = own.map_or_else(String::new, |own| format!("; {own}"));
    let asked = result.header.settings.get("frequency").is_some_and(|range| !range.is_null());
    let speeds = if asked { " at the excitation speeds asked for" } else { "" };
    if result.curves.is_empty() {
        format!("No response folds{speeds} in the range of the {name}{tail}.")
    } else if asked {
        format!("The response folds{speeds}; no cusp lies there{tail}.")
    } else {
        format!("The response folds over the whole range of the {name}, without a cusp{tail}.")
    }
}

/// Cusps, births and mergers.
fn points(result: &FoldsResult) -> Grid {
    let points = &result.special_points;
    let of = |name: &str| points.iter().map(|point| point.value(name)).collect::<Vec<_>>();
    let to_rpm = |value: Option<f64>| value.map(|value| value * 30.0 / std::f64::consts::PI);
    let grid = if points.iter().all(|point| point.kind == SpecialKind::Cusp) {
        Grid::new("Cusps")
    } else {
        let kinds = points.iter().map(|point| special_words(point.kind));
        Grid::new("Special points of the plane").words("kind", kinds)
    };
    grid.numbers(&parameter(result), &result.parameter_unit, 7, of(&result.parameter))
        .numbers("excitation speed", "rad/s", 7, of("frequency"))
        .numbers("excitation speed", "rpm", 6, of("frequency").into_iter().map(to_rpm))
        .numbers("detuning σ", "rad/s", 6, of("sigma"))
        .numbers("amplitude ρ", "rad", 6, of("rho"))
        .without_empty_columns()
}

/// Where detached responses are born and where they join others, and how many responses there are
/// at most.
fn detached(result: &FoldsResult) -> Vec<String> {
    let name = parameter(result);
    let unit = plain(&result.parameter_unit);
    let told = |point: &SpecialPoint| {
        let what = match point.kind {
            SpecialKind::IsolaBirth => "A detached response is born",
            SpecialKind::IsolaMerger => "A detached response joins another one",
            _ => return None,
        };
        let value = quantity(point.value(&result.parameter)?, 7, &unit);
        let at = point.value("frequency").map_or_else(String::new, |speed| {
            format!(", at {}", crate::words::frequency_words(speed))
        });
        Some(format!("{what} where the {name} is {value}{at}."))
    };
    let mut sentences: Vec<String> = result.special_points.iter().filter_map(told).collect();
    if !sentences.is_empty() {
        let slow = "A slow sweep at a fixed value never shows it, but a shock can throw the line onto \
                    it.";
        sentences.push(slow.to_owned());
    }
    let counts = result.responses.iter().flat_map(|responses| &responses.count).flatten();
    if let Some(most) = counts.max().filter(|most| **most > 1) {
        let many = counted(*most as usize, "response", "responses");
        sentences.push(format!("Up to {many} exist side by side in this plane."));
    }
    sentences
}
