//! How far a line is from its first fold, by planes of fold curves.

use halfshaft_results::{FoldsResult, ReportResult, SpecialKind};

use crate::account::folds::{Side, side};

/// The threshold of folding over one parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Threshold<'r> {
    pub(super) plane: &'r FoldsResult,
    /// The model's own value.
    pub(super) own: f64,
    /// The value at which folds begin.
    pub(super) begins: f64,
}

impl Threshold<'_> {
    /// Threshold over the model's own value.
    pub(super) fn factor(&self) -> f64 {
        self.begins / self.own
    }
}

/// The threshold over the amplitude of the torque that excites.
pub(super) fn excitation(report: &ReportResult) -> Option<Threshold<'_>> {
    let planes = report.folds.iter().chain(&report.closed_folds);
    let plane = planes.into_iter().find(|plane| plane.parameter.ends_with(".amplitude"))?;
    threshold(plane, Side::Above)
}

/// The threshold over the damping of a shaft.
pub(super) fn damping<'r>(report: &'r ReportResult, shaft: &str) -> Option<Threshold<'r>> {
    threshold(report.best_folds(&format!("{shaft}.damping"))?, Side::Below)
}

/// Where the first fold appears: the outermost cusp or birth with folds on the given side of it.
fn threshold(plane: &FoldsResult, folds: Side) -> Option<Threshold<'_>> {
    let own = plane.parameter_value?;
    let points = plane.special_points.iter().filter(|point| {
        let kinds = [SpecialKind::Cusp, SpecialKind::IsolaBirth, SpecialKind::IsolaMerger];
        kinds.contains(&point.kind)
    });
    let points = points.filter(|point| side(plane, point) == Some(folds));
    let values = points.filter_map(|point| point.value(&plane.parameter));
    let begins = match folds {
        Side::Above => values.reduce(f64::min),
        Side::Below => values.reduce(f64::max),
    }?;
    Some(Threshold { plane, own, begins })
}
