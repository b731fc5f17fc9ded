//! Whether the response jumps, and how far that is.

use halfshaft_results::{FoldsResult, ModeScaling, ReportResult, ResonanceResult};

use super::{COMFORTABLE, Finding, Standing};
use crate::account::folds::cusp_points;
use crate::account::resonance;
use crate::words::{number, percent, plain, quantity};

/// The jumps, or the distance to them in excitation and in damping.
pub(super) fn jumps(report: &ReportResult) -> Option<Finding> {
    let result = report.resonance.as_ref()?;
    if let Some(finding) = gives_way_first(report, result) {
        return Some(finding);
    }
    if !result.jumps.is_empty() {
        let mut sentences = vec!["The response jumps.".to_owned()];
        sentences.extend(resonance::jumps(result));
        sentences.extend(way_out(report, result.scaling.first()));
        return Some(Finding::new(Standing::Unsafe, "Jumps", sentences.join(" ")));
    }
    let nearest = result.scaling.iter().min_by(|a, b| factor(a).total_cmp(&factor(b)))?;
    let grows = factor(nearest);
    if grows.is_infinite() {
        let text = "The response cannot jump, whatever the excitation.".to_owned();
        return Some(Finding::new(Standing::Safe, "Jumps", text));
    }
    let damping = damping_plane(report, nearest).and_then(|plane| {
        let (own, cusp) = own_and_cusp(plane)?;
        (own > cusp).then(|| {
            format!(
                ", or the damping of the {} to fall from {} to {} ({})",
                plain(&nearest.shaft),
                number(own, 4),
                quantity(cusp, 4, &plain(&plane.parameter_unit)),
                percent(cusp / own, 3)
            )
        })
    });
    let text = format!(
        "No jump: the excitation would have to be {}\u{a0}times larger{}.",
        number(grows, 4),
        damping.unwrap_or_default()
    );
    // A threshold below 1 without a jump in the range shown lies outside of it.
    let standing = if grows < COMFORTABLE { Standing::Watch } else { Standing::Safe };
    Some(Finding::new(standing, "Jumps", text))
}

/// Where the jumps lie past the limit of the shaft's law.
fn gives_way_first(report: &ReportResult, result: &ResonanceResult) -> Option<Finding> {
    let first = result.jumps.iter().map(|jump| jump.before).reduce(f64::min)?;
    let shaft = &result.scaling.first()?.shaft;
    let room = super::vibration::room(report.statics.as_ref(), shaft)?;
    let text = format!(
        "Before it could jump the {} gives way: the jumps begin at a swing of ±{}, and only {} are \
         left to the limit of its law.",
        plain(shaft),
        quantity(first, 4, "rad"),
        quantity(room, 4, "rad")
    );
    (first > room).then(|| Finding::new(Standing::Unsafe, "Jumps", text))
}

fn factor(scaling: &ModeScaling) -> f64 {
    scaling.fold_threshold_factor.filter(|factor| !factor.is_nan()).unwrap_or(f64::INFINITY)
}

/// The fold plane over the damping of the shaft that measures the mode.
fn damping_plane<'r>(report: &'r ReportResult, scaling: &ModeScaling) -> Option<&'r FoldsResult> {
    let address = format!("{}.damping", scaling.shaft);
    report.folds.iter().find(|plane| plane.parameter == address)
}

fn own_and_cusp(plane: &FoldsResult) -> Option<(f64, f64)> {
    let cusp = cusp_points(plane).find_map(|point| point.value(&plane.parameter))?;
    Some((plane.parameter_value?, cusp))
}

/// What would end the jumps.
fn way_out(report: &ReportResult, scaling: Option<&ModeScaling>) -> Option<String> {
    let scaling = scaling?;
    let mut ways = Vec::new();
    if let Some(factor) = scaling.fold_threshold_factor.filter(|factor| *factor < 1.0) {
        ways.push(format!("an excitation below {} of this one", percent(factor, 4)));
    }
    if let Some((own, cusp)) = damping_plane(report, scaling).and_then(own_and_cusp)
        && own < cusp
    {
        let factor = number(cusp / own, 4);
        ways.push(format!("{factor}\u{a0}times the damping of the {}", plain(&scaling.shaft)));
    }
    (!ways.is_empty()).then(|| format!("It ends with {}.", ways.join(", or with ")))
}
