//! What a mode is, in words.

/// A plain label from the shares of strain and kinetic energy: "half-shaft twist, 97 % of
/// strain energy; engine moves most".
pub(crate) fn label(strain: &[(&str, f64)], kinetic: &[(&str, f64)]) -> String {
    let mut shares: Vec<(&str, f64)> = strain.to_vec();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut told: Vec<(&str, f64)> = Vec::new();
    let mut sum = 0.0;
    for (name, share) in shares {
        if sum >= 0.75 || told.len() == 3 {
            break;
        }
        sum += share;
        told.push((name, share));
    }
    let names: Vec<&str> = told.iter().map(|(name, _)| *name).collect();
    let percents: Vec<String> =
        told.iter().map(|(_, share)| format!("{:.0} %", 100.0 * share)).collect();
    let most = kinetic.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let moves = most.map_or_else(String::new, |(name, share)| {
        format!("; {name} moves most ({:.0} % of kinetic energy)", 100.0 * share)
    });
    format!("{} twist, {} of strain energy{moves}", list(&names), list(&percents))
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
        assert_eq!(
            label(&[("half-shaft", 0.97), ("clutch", 0.03)], &[("engine", 0.9), ("car", 0.1)]),
            "half-shaft twist, 97 % of strain energy; engine moves most (90 % of kinetic energy)"
        );
        assert_eq!(
            label(&[("a", 0.4), ("b", 0.6)], &[]),
            "b and a twist, 60 % and 40 % of strain energy"
        );
    }
}
