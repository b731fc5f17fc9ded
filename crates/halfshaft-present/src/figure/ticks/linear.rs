//! Marks at multiples of 1, 2 or 5 times a power of ten.
//!
//! All values are kept as whole multiples of the step, so labels come from integers and are never
//! spoilt by rounding, even for an axis from 1.0001 to 1.0002.

use super::number::{decimal, magnitude, scaled};
use super::{Reading, Room, Tick, Ticks};

/// Labels with more significant digits than this are written relative to a base.
const MOST_DIGITS: i32 = 7;

/// The marks of a linear axis from `low` to `high`, both finite and `low < high`.
pub(crate) fn ticks(low: f64, high: f64, room: Room) -> Ticks {
    let calm = room.calm_distance() / room.length.max(1.0);
    let mut step = Step::at_least((high - low) * calm.min(0.5));
    let share = |value: f64| (value - low) / (high - low);
    let mut chosen = with_step(low, high, step);
    for _ in 0..6 {
        if room.fits(&chosen.majors, share) {
            break;
        }
        step = step.coarser();
        let next = with_step(low, high, step);
        // A crowded axis can be read; one with a single mark cannot.
        if next.majors.len() < 2 {
            break;
        }
        chosen = next;
    }
    let parts = step.parts(room.length * share(low + step.size()));
    let minor = |count: f64| scaled(count * step.mantissa / parts, step.exponent);
    let (first, last) = multiples(low, high, step.size() / parts);
    if parts > 1.0 && last - first < 500.0 {
        let count = (last - first) as usize + 1;
        chosen.minors = (0..count)
            .map(|i| first + i as f64)
            .filter(|multiple| multiple % parts != 0.0)
            .map(minor)
            .collect();
    }
    chosen
}

fn with_step(low: f64, high: f64, step: Step) -> Ticks {
    let reading = Offset::choose(low, high, step);
    let (first, last) = multiples(low, high, step.size());
    let count = if last >= first { ((last - first) as usize).min(1000) + 1 } else { 0 };
    let tick = |index: usize| {
        let digits = (first + index as f64) * step.mantissa;
        let shown = digits - scaled(reading.base, reading.power - step.exponent);
        let label = decimal(shown, step.exponent - reading.exponent);
        Tick { value: scaled(digits, step.exponent), label: super::Rich::plain(&label) }
    };
    Ticks { majors: (0..count).map(tick).collect(), minors: Vec::new(), reading: reading.reading() }
}

/// The first and last whole multiples of `size` in the interval; rounding errors do not lose ends.
fn multiples(low: f64, high: f64, size: f64) -> (f64, f64) {
    const SLACK: f64 = 1e-6;
    ((low / size - SLACK).ceil(), (high / size + SLACK).floor())
}

/// `mantissa * 10^exponent` with a mantissa of 1, 2 or 5.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    mantissa: f64,
    exponent: i32,
}

impl Step {
    fn at_least(size: f64) -> Self {
        let exponent = size.log10().floor() as i32;
        let mut step = Self { mantissa: 1.0, exponent };
        while step.size() < size * (1.0 - 1e-9) {
            step = step.coarser();
        }
        step
    }

    fn size(self) -> f64 {
        scaled(self.mantissa, self.exponent)
    }

    fn coarser(self) -> Self {
        match self.mantissa {
            m if m < 1.5 => Self { mantissa: 2.0, ..self },
            m if m < 3.0 => Self { mantissa: 5.0, ..self },
            _ => Self { mantissa: 1.0, exponent: self.exponent + 1 },
        }
    }

    /// Into how many parts minor marks divide a step that takes this many points.
    fn parts(self, length: f64) -> f64 {
        const CLOSEST: f64 = 5.0;
        let usual = if self.mantissa == 2.0 { 4.0 } else { 5.0 };
        if length >= CLOSEST * usual {
            usual
        } else if self.mantissa == 2.0 && length >= 2.0 * CLOSEST {
            2.0
        } else {
            1.0
        }
    }
}

/// What the labels leave out: `base * 10^power` is subtracted, then `10^exponent` divided out.
struct Offset {
    base: f64,
    power: i32,
    exponent: i32,
}

impl Offset {
    fn choose(low: f64, high: f64, step: Step) -> Self {
        let order = low.abs().max(high.abs()).log10().floor() as i32;
        if order - step.exponent < MOST_DIGITS {
            return Self { base: 0.0, power: step.exponent, exponent: multiplier(order) };
        }
        let power = (high - low).log10().floor() as i32 + 1;
        let base = (high / scaled(1.0, power)).round();
        let (below, above) = (low - scaled(base, power), high - scaled(base, power));
        let order = below.abs().max(above.abs()).log10().floor() as i32;
        Self { base, power, exponent: multiplier(order) }
    }

    fn reading(&self) -> Reading {
        let base = (self.base != 0.0).then(|| (magnitude(self.base, self.power), self.base < 0.0));
        Reading { exponent: self.exponent, base }
    }
}

/// The power of ten that an axis states once, for numbers up to `10^(order + 1)`.
fn multiplier(order: i32) -> i32 {
    if (-2..5).contains(&order) { 0 } else { order.div_euclid(3) * 3 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{prop_assert, prop_assume, proptest};

    const ROOM: Room = Room { length: 380.0, along: true, size: 8.5 };

    fn labels(ticks: &Ticks) -> Vec<String> {
        ticks.majors.iter().map(|tick| tick.label.text()).collect()
    }

    fn number(label: &str) -> f64 {
        label.replace('−', "-").parse().unwrap()
    }

    /// Oracle: by hand.
    #[test]
    fn common_axes() {
        let plain = ticks(-0.42, 0.42, ROOM);
        assert_eq!(
            labels(&plain),
            ["−0.4", "−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3", "0.4"]
        );
        let narrow = ticks(1.0001, 1.0002, ROOM);
        assert_eq!(labels(&narrow)[..2], ["1.00010", "1.00012"]);
        let small = ticks(0.0, 5.2e-6, ROOM);
        assert_eq!((labels(&small)[1].as_str(), small.reading.exponent), ("0.5", -6));
        let far = ticks(1e6, 1e6 + 0.01, ROOM);
        let (base, negative) = far.reading.base.clone().unwrap();
        assert_eq!((base.text().as_str(), negative, far.reading.exponent), ("1000000", false, 0));
    }

    proptest! {
        /// Oracle: the definition. Marks lie inside, at least two, evenly spaced by 1, 2 or 5 times
        /// a power of ten; the label read back with base and multiplier gives the value.
        #[test]
        fn marks_are_nice_and_labels_are_true(
            mantissa in -9.9..9.9_f64, order in -280..280_i32, share in -11.0..1.0_f64,
        ) {
            let low = scaled(mantissa, order);
            let high = low + low.abs() * 10f64.powf(share);
            prop_assume!(high > low);
            let found = ticks(low, high, ROOM);
            let span = high - low;
            prop_assert!(found.majors.len() >= 2 && found.majors.len() <= 14);
            let step = found.majors[1].value - found.majors[0].value;
            for tick in &found.majors {
                prop_assert!(tick.value >= low - 1e-5 * step && tick.value <= high + 1e-5 * step);
            }
            let normal = step / 10f64.powf(step.log10().floor());
            let nice = [1.0, 2.0, 5.0, 10.0].iter().any(|n| (normal / n - 1.0).abs() < 2e-3);
            prop_assert!(nice, "step {step}");
            if found.reading.base.is_none() {
                for tick in &found.majors {
                    let read = number(&tick.label.text()) * 10f64.powi(found.reading.exponent);
                    prop_assert!((read - tick.value).abs() <= 1e-9 * span.max(tick.value.abs()));
                }
            }
            let differences = found.majors.windows(2).map(|pair| {
                let labels = number(&pair[1].label.text()) - number(&pair[0].label.text());
                labels * 10f64.powi(found.reading.exponent)
            });
            for difference in differences {
                prop_assert!((difference / step - 1.0).abs() < 2e-3);
            }
        }
    }
}
