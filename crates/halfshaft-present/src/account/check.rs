//! What is told of a line.

use halfshaft_results::{
    CheckResult, CheckedHarmonic, CheckedLine, CheckedMesh, CheckedPulse, CheckedShaft,
    CheckedTorque, MassElasticSheet, ReducedInertia,
};

use super::{Account, Grid, chain};
use crate::words::{MISSING, RPM, counted, list, number, percent, plain, quantity};

/// The whole account.
pub(crate) fn account(check: &CheckResult) -> Account {
    let mut account = Account::default();
    if !check.description.trim().is_empty() {
        account.text([plain(&check.description)]);
    }
    account.text([format!("The model is sound: {}.", makeup(check))]);
    account.lines(chain::lines(check));
    account.figure("sketch");
    account.text([nonlinearities(check)]);
    account.text(check.line.iter().map(whole_line));
    account.append(elements(check));
    account
}

/// What holds for the line as a whole.
fn whole_line(line: &CheckedLine) -> String {
    let mut told = Vec::new();
    if line.modal_damping > 0.0 {
        let damping = percent(line.modal_damping, 4);
        told.push(format!("modal damping of {damping} in every elastic mode"));
    }
    if line.loss_factor > 0.0 {
        let factor = number(line.loss_factor, 4);
        told.push(format!("a loss factor of {factor} in what has none of its own"));
    }
    if let Some((from, to)) = line.operating {
        let (from, to) = (number(from * RPM, 5), number(to * RPM, 5));
        told.push(format!("run from {from} to {to} rpm"));
    }
    format!("The line as a whole: {}.", told.join("; "))
}

/// The tables of the elements.
pub(crate) fn elements(check: &CheckResult) -> Account {
    let mut account = Account::default();
    account.grid(shafts(check));
    account.grid(torques(check));
    account.grid(gears(check));
    account.grid(inertias(check));
    account.grid(bars(check));
    if let Some(sheet) = &check.mass_elastic {
        account.grid(sheet_inertias(sheet));
        account.grid(sheet_connections(sheet));
    }
    account
}

/// Bars by their dimensions.
fn bars(check: &CheckResult) -> Grid {
    let bars = || check.shafts.iter().filter_map(|shaft| Some((shaft, shaft.bar.as_ref()?)));
    Grid::new("Bars")
        .words("name", bars().map(|(shaft, _)| &shaft.name))
        .numbers("length", "m", 5, bars().map(|(_, bar)| Some(bar.length)))
        .numbers("outer diameter", "mm", 5, bars().map(|(_, bar)| Some(1e3 * bar.outer_diameter)))
        .numbers("inner diameter", "mm", 5, bars().map(|(_, bar)| Some(1e3 * bar.inner_diameter)))
        .numbers("shear modulus", "GPa", 4, bars().map(|(_, bar)| Some(1e-9 * bar.shear_modulus)))
        .numbers("density", "kg/m³", 5, bars().map(|(_, bar)| Some(bar.density)))
        .words("pieces", bars().map(|(_, bar)| bar.elements.to_string()))
        .numbers("inertia", "kg·m²", 5, bars().map(|(_, bar)| Some(bar.inertia)))
        .without_empty_columns()
}

/// Rows of the sheet at most.
const SHEET_ROWS: usize = 200;

fn sheet_inertias(sheet: &MassElasticSheet) -> Grid {
    let rows = || sheet.inertias.iter().take(SHEET_ROWS);
    Grid::new(format!(
        "Mass-elastic sheet: inertias, reduced to the speed of {}",
        plain(&sheet.reference)
    ))
    .words("inertia", rows().map(|row| &row.name))
    .numbers("J", "kg·m²", 6, rows().map(|row| Some(row.inertia)))
    .numbers("speed ratio", "", 6, rows().map(|row| Some(row.ratio)))
    .numbers("J reduced", "kg·m²", 6, rows().map(|row| Some(row.reduced)))
}

fn sheet_connections(sheet: &MassElasticSheet) -> Grid {
    let rows = || sheet.connections.iter().take(SHEET_ROWS);
    Grid::new("Mass-elastic sheet: connections")
        .words("connection", rows().map(|row| &row.name))
        .words("from", rows().map(|row| &row.from))
        .words("to", rows().map(|row| &row.to))
        .numbers("k", "N·m/rad", 6, rows().map(|row| Some(row.stiffness)))
        .numbers("c", "N·m·s/rad", 5, rows().map(|row| Some(row.damping)))
        .numbers("speed ratio", "", 6, rows().map(|row| Some(row.ratio)))
        .numbers("k reduced", "N·m/rad", 6, rows().map(|row| Some(row.reduced_stiffness)))
        .numbers("c reduced", "N·m·s/rad", 5, rows().map(|row| Some(row.reduced_damping)))
}

/// How many of what there is.
pub(crate) fn makeup(check: &CheckResult) -> String {
    let members = || check.reduced_inertias.iter().flat_map(|group| &group.members);
    let bodies = members().filter(|member| member.inertia > 0.0).count();
    let parts = [
        counted(bodies, "inertia", "inertias"),
        counted(check.shafts.len(), "shaft", "shafts"),
        counted(check.gears.len(), "gear", "gears"),
        counted(check.torques.len(), "torque", "torques"),
    ];
    let freedom = counted(check.degrees_of_freedom, "degree of freedom", "degrees of freedom");
    let (kind, turning) = if check.grounded {
        ("a line held at ground", "")
    } else {
        ("a free line", ", one of them the turning of the whole line")
    };
    format!("{kind} of {}; {freedom}{turning}", list(&parts))
}

/// Which laws are nonlinear and what that does; shafts of one kind together.
pub(crate) fn nonlinearities(check: &CheckResult) -> String {
    let mut kinds: Vec<(String, Vec<String>)> = Vec::new();
    for shaft in check.shafts.iter().filter(|shaft| !shaft.nonlinear_terms.is_empty()) {
        let terms = shaft.nonlinear_terms.iter().map(|term| {
            let noun = if is_power(&term.key) { " term" } else { "" };
            format!("{}{noun}, {}", plain(&term.key), plain(&term.effect).replace(':', ";"))
        });
        let kind = list(&terms.collect::<Vec<_>>());
        match kinds.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, shafts)) => shafts.push(plain(&shaft.name)),
            None => kinds.push((kind, vec![plain(&shaft.name)])),
        }
    }
    let loose = check.gears.iter().filter(|gear| gear.mesh.is_some_and(|m| m.clearance > 0.0));
    let loose: Vec<String> = loose.map(|gear| plain(&gear.name)).collect();
    if !loose.is_empty() {
        kinds.push(("backlash of the mesh".to_owned(), loose));
    }
    if kinds.is_empty() {
        return "All shafts are linear: nothing here can fold or jump.".to_owned();
    }
    let told: Vec<String> =
        kinds.iter().map(|(kind, shafts)| format!("{} ({kind})", list(shafts))).collect();
    format!("Nonlinear: {}.", told.join("; "))
}

/// Whether a term of a law is a power of the twist.
fn is_power(key: &str) -> bool {
    ["quadratic", "cubic", "quintic", "septic"].contains(&key)
}

/// Where each reduced inertia comes from.
fn inertias(check: &CheckResult) -> Grid {
    let groups = &check.reduced_inertias;
    Grid::new("Inertias with the gears taken out")
        .words("reduced to", groups.iter().map(|group| &group.reference))
        .numbers("inertia", "kg·m²", 6, groups.iter().map(|group| Some(group.inertia)))
        .words("comes from", groups.iter().map(sources))
        .words("damping to ground", groups.iter().map(ground_damping))
        .without_empty_columns()
}

fn sources(group: &ReducedInertia) -> String {
    let bodies: Vec<String> = group
        .members
        .iter()
        .filter(|member| member.inertia > 0.0)
        .map(|member| {
            let ratio = member.ratio.abs();
            let factor =
                if ratio == 1.0 { String::new() } else { format!(" × {}²", number(ratio, 5)) };
            format!("{} {}{factor}", plain(&member.node), number(member.inertia, 6))
        })
        .collect();
    bodies.join(" + ")
}

fn ground_damping(group: &ReducedInertia) -> String {
    let damped: Vec<String> = group
        .members
        .iter()
        .filter(|member| member.damping != 0.0)
        .map(|member| {
            format!("{} {}", plain(&member.node), quantity(member.damping, 5, "N·m·s/rad"))
        })
        .collect();
    damped.join(", ")
}

fn gears(check: &CheckResult) -> Grid {
    let gears = &check.gears;
    let others = |ratios: &[f64]| {
        let texts: Vec<String> = ratios.iter().map(|ratio| number(*ratio, 5)).collect();
        texts.join(", ")
    };
    Grid::new("Gears")
        .words("name", gears.iter().map(|gear| &gear.name))
        .words("input", gears.iter().map(|gear| &gear.input))
        .words("output", gears.iter().map(|gear| &gear.output))
        .words("ratio (input over output speed)", gears.iter().map(|gear| number(gear.ratio, 5)))
        .words("ratios offered", gears.iter().map(|gear| others(&gear.ratios)))
        .words("mesh", gears.iter().map(|gear| gear.mesh.as_ref().map_or_else(String::new, mesh)))
        .without_empty_columns()
}

/// "6000 N·m/rad, 4 N·m·s/rad, backlash 0.02 rad".
fn mesh(mesh: &CheckedMesh) -> String {
    let mut parts = vec![quantity(mesh.stiffness, 6, "N·m/rad")];
    if mesh.damping != 0.0 {
        parts.push(quantity(mesh.damping, 5, "N·m·s/rad"));
    }
    if mesh.clearance != 0.0 {
        parts.push(format!("backlash {}", quantity(mesh.clearance, 5, "rad")));
    }
    parts.join(", ")
}

fn shafts(check: &CheckResult) -> Grid {
    let shafts = &check.shafts;
    Grid::new("Shafts")
        .words("name", shafts.iter().map(|shaft| &shaft.name))
        .words("from", shafts.iter().map(|shaft| &shaft.from))
        .words("to", shafts.iter().map(|shaft| &shaft.to))
        .numbers("stiffness", "N·m/rad", 6, shafts.iter().map(|shaft| Some(shaft.stiffness)))
        .numbers("damping", "N·m·s/rad", 5, shafts.iter().map(|shaft| Some(shaft.damping)))
        .numbers(
            "loss factor",
            "",
            4,
            shafts.iter().map(|shaft| Some(shaft.loss_factor).filter(|f| *f > 0.0)),
        )
        .words("nonlinear terms", shafts.iter().map(terms))
        .without_empty_columns()
}

fn terms(shaft: &CheckedShaft) -> String {
    let terms: Vec<String> = shaft
        .nonlinear_terms
        .iter()
        .map(|term| {
            format!("{} {}", plain(&term.key), quantity(term.coefficient, 6, &plain(&term.unit)))
        })
        .collect();
    terms.join(", ")
}

fn torques(check: &CheckResult) -> Grid {
    let torques = &check.torques;
    let mean = |torque: &CheckedTorque| match torque.mean {
        Some(mean) => quantity(mean, 6, "N·m"),
        None => "balances the others".to_owned(),
    };
    Grid::new("Torques")
        .words("name", torques.iter().map(|torque| &torque.name))
        .words("on", torques.iter().map(|torque| &torque.on))
        .words("mean", torques.iter().map(mean))
        .words("oscillating part", torques.iter().map(oscillation))
        .words(
            "pulse",
            torques
                .iter()
                .map(|torque| torque.pulse.as_ref().map_or_else(|| MISSING.to_owned(), pulse)),
        )
        .without_empty_columns()
}

/// Orders of a torque that are told one by one.
const MOST_ORDERS: usize = 4;

/// "40 N·m at order 2", several of them in a list.
pub(crate) fn oscillation(torque: &CheckedTorque) -> String {
    // Of the orders of an engine the strongest tell enough.
    let mut strongest: Vec<_> = torque.harmonics.iter().collect();
    let all = strongest.len();
    if all > MOST_ORDERS {
        strongest.sort_by(|a, b| b.amplitude.abs().total_cmp(&a.amplitude.abs()));
        strongest.truncate(MOST_ORDERS);
        strongest.sort_by(|a, b| a.order.total_cmp(&b.order));
    }
    let digits = if all > MOST_ORDERS { 4 } else { 6 };
    let part = |harmonic: &&CheckedHarmonic| {
        let amplitude = quantity(harmonic.amplitude, digits, "N·m");
        format!("{amplitude} at order {}", number(harmonic.order, 4))
    };
    let mut parts: Vec<String> = strongest.iter().map(part).collect();
    if all > MOST_ORDERS {
        parts.push(format!("{} more orders", all - MOST_ORDERS));
    }
    let told = list(&parts);
    match &torque.growth {
        Some(growth) if !parts.is_empty() => format!(
            "{told} at {}, growing with the speed to the power {}",
            quantity(growth.reference_speed, 5, "rad/s"),
            number(growth.power, 4)
        ),
        _ => told,
    }
}

/// "half-sine of 120 N·m from 0 s for 0.05 s (3.82 N·m·s)".
fn pulse(pulse: &CheckedPulse) -> String {
    let start = quantity(pulse.start, 6, "s");
    let impulse = quantity(pulse.angular_impulse, 6, "N·m·s");
    let Some(peak) = pulse.peak else { return format!("impulse of {impulse} at {start}") };
    let (shape, peak) = (plain(&pulse.shape), quantity(peak, 6, "N·m"));
    let duration = quantity(pulse.duration, 6, "s");
    let left = if shape == "ramp" { "which stays".to_owned() } else { impulse };
    format!("{shape} of {peak} from {start} for {duration} ({left})")
}

/// A text with a true minus before its numbers.
pub(crate) fn minus(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut before = ' ';
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        let starts_number = characters.peek().is_some_and(char::is_ascii_digit);
        let sign = c == '-' && starts_number && matches!(before, ' ' | '(' | '=');
        out.push(if sign { '−' } else { c });
        before = c;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::minus;

    /// Oracle: by hand.
    #[test]
    fn only_signs_of_numbers_become_minus() {
        assert_eq!(minus("half-sine of -12000 N·m (-3.5)"), "half-sine of −12000 N·m (−3.5)");
        assert_eq!(minus("a-1 b - 2"), "a-1 b - 2");
    }
}
