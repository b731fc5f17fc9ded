//! Where slow sweeps jump, in the measure in which the rest of the account tells how far a shaft
//! swings.

use halfshaft_results::{JumpSpeeds, ResonanceResult, SpecialKind};

use crate::reading::Reading;
use crate::words::{column_words, number, plain, quantity};

/// The jumps of slow sweeps, one sentence each.
pub(crate) fn told(result: &ResonanceResult) -> Vec<String> {
    let reading = Reading::of(result);
    result.jumps.iter().map(|jump| sentence(&reading, jump)).collect()
}

/// How far the twist swings before and after a jump.
struct Swings {
    before: f64,
    after: Option<f64>,
    measure: &'static str,
}

fn sentence(reading: &Reading<'_>, jump: &JumpSpeeds) -> String {
    let shaft = column_words(&jump.channel).map_or("line", |channel| channel.owner);
    let shaft = plain(shaft);
    let speed =
        format!("{} ({})", quantity(jump.rpm, 5, "rpm"), quantity(jump.frequency, 6, "rad/s"));
    let sweep = plain(&jump.sweep);
    let first_harmonic =
        Swings { before: jump.before, after: jump.after, measure: "first harmonic" };
    let Swings { before, after, measure } = half_swings(reading, jump).unwrap_or(first_harmonic);
    let before = number(before, 4);
    match after {
        Some(after) => format!(
            "Sweeping {sweep}, the twist of the {shaft} jumps at {speed} from ±{before} to ±{} rad \
             ({measure}).",
            number(after, 4)
        ),
        None => format!(
            "Sweeping {sweep}, the twist of the {shaft} leaves ±{before} rad ({measure}) at {speed}, \
             and no other periodic response is there to take over."
        ),
    }
}

/// Half of peak to peak before and after, where the branches tell it: at the fold, and on the stable
/// response whose first harmonic is the one that the jump ends at.
fn half_swings(reading: &Reading<'_>, jump: &JumpSpeeds) -> Option<Swings> {
    let (half, first) =
        (format!("{}.amplitude", jump.channel), format!("{}.harmonic1", jump.channel));
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b.abs();
    let points = reading.result.branches.iter().flat_map(|branch| &branch.special_points);
    let fold = points.filter(|point| point.kind == SpecialKind::Fold).find(|point| {
        let at = |name: &str, value: f64| point.value(name).is_some_and(|own| near(own, value));
        at("frequency", jump.frequency) && at(&first, jump.before)
    })?;
    let before = fold.value(&half)?;
    let after = match jump.after {
        None => None,
        Some(after) => Some(landing(reading, jump.frequency, (&first, &half), after)?),
    };
    Some(Swings { before, after, measure: "half of peak to peak" })
}

/// The second measure of the stable response at a speed whose first measure is nearest to `value`.
fn landing(
    reading: &Reading<'_>,
    speed: f64,
    (first, half): (&str, &str),
    value: f64,
) -> Option<f64> {
    let mut best: Option<(f64, f64)> = None;
    for branch in &reading.result.branches {
        let (x, stable) = (branch.values("frequency"), branch.values("stable"));
        let (a, b) = (branch.values(first), branch.values(half));
        let whole = [stable.len(), a.len(), b.len()].iter().all(|length| *length == x.len());
        for at in (0..x.len().saturating_sub(1)).filter(|_| whole) {
            let spans = (x[at] - speed) * (x[at + 1] - speed) <= 0.0 && x[at] != x[at + 1];
            if !spans || stable[at] == 0.0 || stable[at + 1] == 0.0 {
                continue;
            }
            let part = (speed - x[at]) / (x[at + 1] - x[at]);
            let mixed = |values: &[f64]| values[at] + part * (values[at + 1] - values[at]);
            let apart = (mixed(a) - value).abs();
            if best.is_none_or(|(least, _)| apart < least) {
                best = Some((apart, mixed(b)));
            }
        }
    }
    best.filter(|(apart, _)| *apart <= 0.02 * value.abs()).map(|(_, half)| half)
}

#[cfg(test)]
mod tests {
    use halfshaft_results::{JumpSpeeds, Named, SpecialKind, SpecialPoint, Status};

    use super::told;
    use crate::made;

    /// Oracle: by hand: the first harmonic is 0.9 of the swing; the upper stretch has 3 at 2 rad/s and
    /// 3.5 at 3 rad/s, so 3.15 at the fold at 2.3 rad/s.
    #[test]
    fn jumps_are_told_in_half_of_peak_to_peak() {
        let low = [(1.0, 0.5, true), (2.0, 1.0, true), (2.0, 1.5, false)];
        let high = [(2.0, 3.0, true), (3.0, 3.5, true)];
        let mut values = Named::default();
        values.insert("frequency".to_owned(), 2.3);
        values.insert("spring.twist.harmonic1".to_owned(), 1.08);
        values.insert("spring.twist.amplitude".to_owned(), 1.2);
        let fold = SpecialPoint::new(SpecialKind::Fold, Status::Located, values);
        let mut result = made::resonance(&[(&low, vec![fold]), (&high, Vec::new())]);
        result.jumps = vec![JumpSpeeds {
            sweep: "up".to_owned(),
            frequency: 2.3,
            rpm: 2.3 * 30.0 / std::f64::consts::PI,
            channel: "spring.twist".to_owned(),
            before: 1.08,
            after: Some(0.9 * 3.15),
        }];
        let text = told(&result).join(" ");
        assert!(text.contains("from ±1.2 to ±3.15 rad (half of peak to peak)"), "{text}");
        // Without that measure the first harmonic is named.
        result.branches[0].special_points.clear();
        let text = told(&result).join(" ");
        assert!(text.contains("from ±1.08 to ±2.835 rad (first harmonic)"), "{text}");
    }
}
