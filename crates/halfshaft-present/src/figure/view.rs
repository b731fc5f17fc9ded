//! The shown interval of an axis and the way from values to the page.

use super::axis::{Axis, Scale};
use super::item::{Direction, Item};

/// Values beyond this are shown at the edge of the axis at most: room for arithmetic.
const LARGEST: f64 = 1e300;

/// The shown interval: finite, `low < high`, positive on a logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    pub low: f64,
    pub high: f64,
    pub scale: Scale,
}

/// Which of the two axes of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    X,
    Y,
}

impl View {
    /// The interval of an axis that shows these items.
    pub(crate) fn fit<'a>(
        axis: &Axis,
        side: Side,
        items: impl IntoIterator<Item = &'a Item>,
    ) -> Self {
        let scale = axis.scale;
        let given = axis.range.map(|(from, to)| (from.min(to), from.max(to)));
        let usable = |&(low, high): &(f64, f64)| {
            low.is_finite()
                && high.is_finite()
                && low < high
                && (scale == Scale::Linear || low > 0.0)
        };
        let (low, high) = given
            .filter(usable)
            .unwrap_or_else(|| Extent::of(items, side, scale).interval(side, scale));
        match scale {
            Scale::Linear => Self::linear(low, high),
            Scale::Log => Self::log(low, high),
        }
    }

    /// A linear interval, widened if it is too short to be told from a point.
    pub(crate) fn linear(low: f64, high: f64) -> Self {
        let (mut low, mut high) = (low.clamp(-LARGEST, LARGEST), high.clamp(-LARGEST, LARGEST));
        let size = low.abs().max(high.abs());
        if high - low <= 1e-11 * size || high - low < 1e-280 {
            let half = if size < 1e-270 { 1.0 } else { 0.05 * size };
            let middle = 0.5 * low + 0.5 * high;
            (low, high) = (middle - half, middle + half);
        }
        Self { low, high, scale: Scale::Linear }
    }

    /// A logarithmic interval, widened if it is too short to be told from a point.
    pub(crate) fn log(low: f64, high: f64) -> Self {
        let (mut low, mut high) = (low.clamp(1e-300, LARGEST), high.clamp(1e-300, LARGEST));
        if high / low < 1.0 + 1e-9 {
            (low, high) = (low / 2.0, high * 2.0);
        }
        Self { low, high, scale: Scale::Log }
    }

    /// Where a value lies: 0 at the low end, 1 at the high end. Not finite if it has no place.
    pub(crate) fn share(&self, value: f64) -> f64 {
        match self.scale {
            // Halves, because the difference of two large numbers may overflow.
            Scale::Linear => (0.5 * value - 0.5 * self.low) / (0.5 * self.high - 0.5 * self.low),
            Scale::Log => {
                (value.log10() - self.low.log10()) / (self.high.log10() - self.low.log10())
            }
        }
    }

    /// Whether a value lies in the interval, up to rounding.
    pub(crate) fn shows(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.share(value))
    }
}

/// Smallest and largest of the values seen.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: f64,
    high: f64,
}

impl Bounds {
    const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    fn include(&mut self, value: f64) {
        // Comparisons with a value that is not a number are false and leave the bounds alone.
        if value.abs() <= LARGEST {
            self.low = self.low.min(value);
            self.high = self.high.max(value);
        }
    }

    fn padded(&self, by: f64) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }
}

/// What the data of a panel span in one direction, on the scale of the axis.
struct Extent {
    /// Curves and areas, which may touch the frame.
    lines: Bounds,
    /// Points, texts and reference lines, which should keep clear of it.
    marks: Bounds,
}

impl Extent {
    fn of<'a>(items: impl IntoIterator<Item = &'a Item>, side: Side, scale: Scale) -> Self {
        let mut extent = Self { lines: Bounds::NONE, marks: Bounds::NONE };
        for item in items {
            match item {
                Item::Curve(c) => include_places(&mut extent.lines, &c.x, &c.y, side, scale),
                Item::Region(r) => include_places(&mut extent.lines, &r.x, &r.y, side, scale),
                Item::Points(p) => include_places(&mut extent.marks, &p.x, &p.y, side, scale),
                Item::Label(l) => include_places(&mut extent.marks, &[l.x], &[l.y], side, scale),
                Item::Reference(r) if (r.axis == Direction::Vertical) == (side == Side::X) => {
                    extent.marks.include(on_scale(r.value, scale));
                }
                Item::Reference(_) => {}
            }
        }
        extent
    }

    /// The interval with its margins, in values.
    fn interval(&self, side: Side, scale: Scale) -> (f64, f64) {
        let low = self.lines.low.min(self.marks.low);
        let high = self.lines.high.max(self.marks.high);
        if low > high {
            return if scale == Scale::Log { (1.0, 10.0) } else { (0.0, 1.0) };
        }
        let span = high - low;
        let (of_lines, of_marks) = match side {
            Side::X => (0.0, 0.04 * span),
            Side::Y => (0.05 * span, 0.07 * span),
        };
        let (lines, marks) = (self.lines.padded(of_lines), self.marks.padded(of_marks));
        let padded = (lines.low.min(marks.low), lines.high.max(marks.high));
        match scale {
            Scale::Linear => held_at_zero((low, high), padded, side),
            Scale::Log => (10f64.powf(padded.0), 10f64.powf(padded.1)),
        }
    }
}

/// A margin should not suggest a sign that the data do not have; and a vertical axis that nearly
/// reaches zero is easier to read if it does.
fn held_at_zero(data: (f64, f64), padded: (f64, f64), side: Side) -> (f64, f64) {
    let near = if side == Side::Y { 0.25 } else { 0.0 };
    let (mut low, mut high) = padded;
    if data.0 >= 0.0 && data.1 > 0.0 && (low < 0.0 || data.0 < near * data.1) {
        low = 0.0;
    }
    if data.1 <= 0.0 && data.0 < 0.0 && (high > 0.0 || data.1 > near * data.0) {
        high = 0.0;
    }
    (low, high)
}

fn include_places(bounds: &mut Bounds, x: &[f64], y: &[f64], side: Side, scale: Scale) {
    for (&x, &y) in x.iter().zip(y) {
        // A point that is not drawn must not stretch the axis.
        if x.is_finite() && y.is_finite() {
            bounds.include(on_scale(if side == Side::X { x } else { y }, scale));
        }
    }
}

fn on_scale(value: f64, scale: Scale) -> f64 {
    match scale {
        Scale::Linear => value,
        // The logarithm of what is not positive is not finite and is left out.
        Scale::Log => value.log10(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::colour::Colour;
    use crate::figure::item::{Curve, Points, Reference};
    use proptest::prelude::{any, prop_assert, proptest};

    fn curve(x: &[f64], y: &[f64]) -> Item {
        Curve::new("c", x.to_vec(), y.to_vec(), Colour::Blue).into()
    }

    fn fitted(axis: &Axis, side: Side, items: &[Item]) -> (f64, f64) {
        let view = View::fit(axis, side, items);
        (view.low, view.high)
    }

    /// Oracle: the stated rules, by hand.
    #[test]
    fn intervals_follow_the_data() {
        let axis = Axis::default();
        let items = [curve(&[0.0, 10.0], &[0.1, 1.0])];
        assert_eq!(fitted(&axis, Side::X, &items), (0.0, 10.0));
        assert_eq!(fitted(&axis, Side::Y, &items), (0.0, 1.045));
        let points: Item = Points::new("p", vec![10.0], vec![0.5], Colour::Blue).into();
        assert_eq!(fitted(&axis, Side::X, &[items[0].clone(), points]), (0.0, 10.4));
        let limit: Item = Reference::horizontal(2.0, "limit", Colour::DANGER).into();
        assert!(fitted(&axis, Side::Y, &[items[0].clone(), limit]).1 > 2.0);
        assert_eq!(fitted(&axis, Side::X, &[]), (0.0, 1.0));
        assert_eq!(fitted(&axis.clone().with_range(3.0, 2.0), Side::X, &items), (2.0, 3.0));
    }

    proptest! {
        /// Oracle: the contract of `View`, for any bits whatever.
        #[test]
        fn every_input_gives_a_proper_interval(
            a in any::<f64>(), b in any::<f64>(), c in any::<f64>(), d in any::<f64>(),
            log in any::<bool>(), given in any::<bool>(),
        ) {
            let axis = Axis {
                range: given.then_some((c, d)),
                scale: if log { Scale::Log } else { Scale::Linear },
                ..Axis::default()
            };
            let view = View::fit(&axis, Side::X, &[curve(&[a, b], &[1.0, 2.0])]);
            prop_assert!(view.low.is_finite() && view.high.is_finite() && view.low < view.high);
            prop_assert!(view.share(view.low).abs() < 1e-9);
            prop_assert!((view.share(view.high) - 1.0).abs() < 1e-9);
            prop_assert!(!log || view.low > 0.0);
        }
    }
}
