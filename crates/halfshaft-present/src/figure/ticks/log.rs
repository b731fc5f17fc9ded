//! Marks of a logarithmic axis: powers of ten, with digits between them where there is room.

use super::number::{decimal, scaled, signed};
use super::{Reading, Room, Tick, Ticks, linear};
use crate::figure::typeset::{Level, Rich};
use crate::figure::view::View;

/// Labelled digits of a decade, from many to one.
const DIGITS: [&[i32]; 3] = [&[1, 2, 3, 4, 5, 6, 7, 8, 9], &[1, 2, 5], &[1]];
/// Every how many powers of ten are labelled, if not every one can be.
const STRIDES: [i32; 7] = [2, 3, 5, 10, 20, 50, 100];
const ALL_DIGITS: [i32; 9] = [1, 2, 3, 4, 5, 6, 7, 8, 9];

/// The marks of a logarithmic axis whose view is positive.
pub(crate) fn ticks(view: &View, room: Room) -> Ticks {
    let (first, last) = (order(view.low), order(view.high));
    let fits = |majors: &[Tick]| majors.len() >= 2 && room.fits(majors, |v| view.share(v));
    for digits in DIGITS {
        let majors = labelled(view, first..=last, digits, 1);
        // Over several decades every digit is too much, and so are two and five with an exponent.
        let most = if last - first < 2 {
            9
        } else if is_short(first, last) {
            3
        } else {
            1
        };
        if digits.len() <= most && fits(&majors) {
            return finished(view, majors, room);
        }
    }
    for stride in STRIDES {
        let majors = labelled(view, first..=last, &[1], stride);
        if fits(&majors) {
            return finished(view, majors, room);
        }
    }
    // Less than one decade, or too short for any choice: as on a linear axis.
    linear::ticks(view.low, view.high, room)
}

fn order(value: f64) -> i32 {
    value.log10().floor() as i32
}

/// Whether all labels of these decades are short without an exponent.
fn is_short(first: i32, last: i32) -> bool {
    first >= -4 && last <= 4
}

fn labelled(
    view: &View,
    orders: std::ops::RangeInclusive<i32>,
    digits: &[i32],
    stride: i32,
) -> Vec<Tick> {
    let short = is_short(*orders.start(), *orders.end());
    let mut majors = Vec::new();
    for order in orders.filter(|order| order.rem_euclid(stride) == 0) {
        for &digit in digits {
            let value = scaled(f64::from(digit), order);
            if view.shows(value) {
                majors.push(Tick { value, label: label(digit, order, short) });
            }
        }
    }
    majors
}

fn label(digit: i32, order: i32, short: bool) -> Rich {
    if short {
        return Rich::plain(&decimal(f64::from(digit), order));
    }
    let mut label = Rich::default();
    if digit != 1 {
        label.push_str(&format!("{digit}·"), Level::Base);
    }
    label.push_str("10", Level::Base);
    label.push_str(&signed(order), Level::Super);
    label
}

fn finished(view: &View, majors: Vec<Tick>, room: Room) -> Ticks {
    let decade = room.length * (view.share(10.0 * view.low) - view.share(view.low));
    let digits: &[i32] = if decade > 25.0 { &ALL_DIGITS } else { &[1] };
    let mut minors = Vec::new();
    if decade > 3.0 {
        for order in order(view.low)..=order(view.high) {
            let values = digits.iter().map(|&digit| scaled(f64::from(digit), order));
            minors.extend(values.filter(|&v| view.shows(v) && majors.iter().all(|t| t.value != v)));
        }
    }
    Ticks { majors, minors, reading: Reading::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::axis::Scale;
    use proptest::prelude::{prop_assert, proptest};

    const ROOM: Room = Room { length: 380.0, along: true, size: 8.5 };

    fn labels(low: f64, high: f64) -> Vec<String> {
        let view = View { low, high, scale: Scale::Log };
        ticks(&view, ROOM).majors.iter().map(|tick| tick.label.text()).collect()
    }

    /// Oracle: by hand.
    #[test]
    fn common_axes() {
        assert_eq!(labels(0.09, 12.0), ["0.1", "0.2", "0.5", "1", "2", "5", "10"]);
        assert_eq!(labels(1e-9, 1.5e-6), ["10−9", "10−8", "10−7", "10−6"]);
        assert_eq!(labels(20.0, 30.0)[0], "20");
    }

    proptest! {
        /// Oracle: the definition: two marks or more, inside, increasing, apart from each other.
        #[test]
        fn marks_are_inside_and_apart(low in -290.0..290.0_f64, decades in 0.001..560.0_f64) {
            let (low, high) = (10f64.powf(low), 10f64.powf((low + decades).min(299.0)));
            let view = View { low, high, scale: Scale::Log };
            let found = ticks(&view, ROOM);
            prop_assert!(found.majors.len() >= 2);
            for pair in found.majors.windows(2) {
                prop_assert!(pair[0].value < pair[1].value);
            }
            for tick in &found.majors {
                prop_assert!((-1e-6..=1.0 + 1e-6).contains(&view.share(tick.value)));
            }
        }
    }
}
