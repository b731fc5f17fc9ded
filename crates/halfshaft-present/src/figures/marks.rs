//! Special points: every kind with a look of its own.

use halfshaft_results::{SpecialKind, SpecialPoint};

use crate::figure::{Colour, Marker, Points};
use crate::words::{number, special_words};

/// Points of one kind that are named at most; more of them would cover each other.
const MOST_NAMED: usize = 6;

/// The kinds in the order of the legend. Ends are not marked: the curve shows them.
const KINDS: [SpecialKind; 8] = [
    SpecialKind::Fold,
    SpecialKind::PeriodDoubling,
    SpecialKind::NeimarkSacker,
    SpecialKind::BranchPoint,
    SpecialKind::GrazingContact,
    SpecialKind::Cusp,
    SpecialKind::IsolaBirth,
    SpecialKind::IsolaMerger,
];

/// How points of a kind are drawn: shape, colour, diameter.
pub(super) fn look(kind: SpecialKind) -> (Marker, Colour, f64) {
    match kind {
        SpecialKind::Fold => (Marker::Circle, Colour::DANGER, 6.0),
        SpecialKind::PeriodDoubling => (Marker::Diamond, Colour::Purple, 7.5),
        SpecialKind::NeimarkSacker => (Marker::Triangle, Colour::DANGER, 8.0),
        SpecialKind::BranchPoint => (Marker::Square, Colour::Black, 6.0),
        SpecialKind::GrazingContact => (Marker::Plus, Colour::Black, 7.0),
        SpecialKind::Cusp => (Marker::Star, Colour::DANGER, 8.0),
        SpecialKind::IsolaBirth => (Marker::Triangle, Colour::Purple, 8.0),
        SpecialKind::IsolaMerger => (Marker::TriangleDown, Colour::Purple, 8.0),
        SpecialKind::End => (Marker::Circle, Colour::AUXILIARY, 4.0),
    }
}

/// Points of every kind at two of their values, each kind under its own name; `told` says what
/// stands beside a point of a kind at a place.
pub(super) fn marked(
    points: &[&SpecialPoint],
    (x, y): (&str, &str),
    told: impl Fn(SpecialKind, (f64, f64)) -> String,
) -> Vec<Points> {
    let of = |kind: SpecialKind| {
        let own = points.iter().filter(|point| point.kind == kind);
        let places: Vec<(f64, f64)> =
            own.filter_map(|point| Some((point.value(x)?, point.value(y)?))).collect();
        if places.is_empty() {
            return None;
        }
        let named = if places.len() > MOST_NAMED { &[][..] } else { &places[..] };
        let labels = named.iter().map(|place| told(kind, *place)).collect();
        let (xs, ys) = places.iter().copied().unzip();
        let (marker, colour, size) = look(kind);
        let points = Points::new(special_words(kind), xs, ys, colour).with_marker(marker);
        Some(Points { size, ..points.with_labels(labels) })
    };
    KINDS.into_iter().filter_map(of).collect()
}

/// The kind in few words, as there is room for beside a point.
pub(super) fn short(kind: SpecialKind) -> &'static str {
    match kind {
        SpecialKind::NeimarkSacker => "Neimark-Sacker",
        SpecialKind::IsolaBirth => "birth",
        SpecialKind::IsolaMerger => "merger",
        _ => special_words(kind),
    }
}

/// What stands beside a special point of a response curve: its kind and where it
/// lies.
pub(super) fn beside(kind: SpecialKind, x: f64, unit: &str) -> String {
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    match kind {
        // Contact begins and ends often; the shape is enough.
        SpecialKind::GrazingContact | SpecialKind::End => String::new(),
        _ => format!("{} {}{unit}", short(kind), number(x, 6)),
    }
}
