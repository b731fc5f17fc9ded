//! What a mode is, in words.

/// A plain label from the shares of strain and kinetic energy, with what names their owners: "half-shaft
/// twist, 97 % of strain energy; engine moves most".
pub(crate) fn label<'n>(
    strain: &[f64],
    shaft: impl Fn(usize) -> &'n str,
    kinetic: &[f64],
    body: impl Fn(usize) -> &'n str,
) -> String {
    let (mut told, mut sum) = (Vec::new(), 0.0);
    for (index, share) in largest(strain) {
        if sum >= 0.75 {
            break;
        }
        sum += share;
        told.push((shaft(index), share));
    }
    let names: Vec<&str> = told.iter().map(|(name, _)| *name).collect();
    let percents: Vec<String> =
        told.iter().map(|(_, share)| format!("{:.0} %", 100.0 * share)).collect();
    let most = kinetic.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    let moves = most.map_or_else(String::new, |(index, share)| {
        format!("; {} moves most ({:.0} % of kinetic energy)", body(index), 100.0 * share)
    });
    format!("{} twist, {} of strain energy{moves}", list(&names), list(&percents))
}

/// How many shafts are named at most.
const NAMED: usize = 3;

/// The largest shares with their places, largest first, of equal ones the first.
fn largest(shares: &[f64]) -> Vec<(usize, f64)> {
    let mut largest: Vec<(usize, f64)> = Vec::with_capacity(NAMED + 1);
    for (index, share) in shares.iter().enumerate() {
        let place = largest.partition_point(|(_, other)| other >= share);
        if place < NAMED {
            largest.insert(place, (index, *share));
            largest.truncate(NAMED);
        }
    }
    largest
}

/// "a", "a and b", "a, b and c".
fn list<T: AsRef<str>>(items: &[T]) -> String {
    let items: Vec<&str> = items.iter().map(AsRef::as_ref).collect();
    match items.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::label;

    #[test]
    fn labels_name_the_shafts_that_hold_the_energy() {
        let shafts = |names: [&'static str; 4]| move |index: usize| names[index];
        let bodies = |index: usize| ["engine", "car"][index];
        assert_eq!(
            label(&[0.97, 0.03], shafts(["half-shaft", "clutch", "", ""]), &[0.9, 0.1], bodies),
            "half-shaft twist, 97 % of strain energy; engine moves most (90 % of kinetic energy)"
        );
        assert_eq!(
            label(&[0.4, 0.6], shafts(["a", "b", "", ""]), &[], bodies),
            "b and a twist, 60 % and 40 % of strain energy"
        );
        // Of equal shares the first are named, and no more than three.
        assert_eq!(
            label(&[0.1, 0.2, 0.2, 0.2], shafts(["a", "b", "c", "d"]), &[], bodies),
            "b, c and d twist, 20 %, 20 % and 20 % of strain energy"
        );
    }
}
