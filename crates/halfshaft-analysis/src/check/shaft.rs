//! A shaft in the words of `check`.

use halfshaft_dynamics::{Connection, TorqueLaw};
use halfshaft_model::elements::{Dimensions, Shaft, Stage};
use halfshaft_results::{CheckedBar, CheckedShaft, NonlinearTerm};

/// What the program understands by a shaft, and as what the file has it.
pub(super) fn shaft(
    shaft: &Shaft,
    written: Option<&Shaft>,
    connection: &Connection,
) -> CheckedShaft {
    // Stages and tables have no one stiffness.
    let stiffness = match &connection.law {
        TorqueLaw::PiecewiseLinear(_) | TorqueLaw::Table(_) | TorqueLaw::Function(_) => {
            connection.law.stiffness(0.0)
        }
        _ if shaft.stages.is_empty() && shaft.table.is_none() && shaft.function.is_none() => {
            shaft.stiffness_nm_per_rad
        }
        law => law.stiffness(0.0),
    };
    let mut terms = polynomial_terms(shaft);
    terms.extend(free_play(shaft));
    terms.extend(stages("stages", &shaft.stages));
    terms.extend(stages("coast stages", &shaft.coast_stages));
    terms.extend(table(shaft));
    terms.extend(function(shaft));
    terms.extend(others(shaft));
    CheckedShaft {
        name: shaft.name.clone(),
        from: shaft.from.clone(),
        to: shaft.to.clone(),
        stiffness,
        damping: shaft.damping_nm_s_per_rad,
        nonlinear_terms: terms,
        // A damper without stiffness has nothing to lose.
        loss_factor: if stiffness == 0.0 { 0.0 } else { connection.loss_factor },
        bar: written.and_then(|written| written.dimensions.as_ref()).map(bar),
    }
}

fn bar(bar: &Dimensions) -> CheckedBar {
    CheckedBar {
        length: bar.length_m,
        outer_diameter: bar.outer_diameter_m,
        inner_diameter: bar.inner_diameter_m,
        shear_modulus: bar.shear_modulus_pa,
        density: bar.density_kg_m3,
        elements: bar.pieces(),
        inertia: bar.inertia(),
    }
}

fn term(key: &str, coefficient: f64, unit: &str, effect: impl Into<String>) -> NonlinearTerm {
    let (key, unit) = (key.to_owned(), unit.to_owned());
    NonlinearTerm { key, coefficient, unit, effect: effect.into() }
}

fn polynomial_terms(shaft: &Shaft) -> Vec<NonlinearTerm> {
    let effect = |key: &str, coefficient: f64| match (key, coefficient > 0.0) {
        ("quadratic", true) => "stiffer to the positive side, softer to the negative",
        ("quadratic", false) => "softer to the positive side, stiffer to the negative",
        (_, true) => "hardening",
        (_, false) => "softening: limits the torque that the shaft carries",
    };
    [
        ("quadratic", shaft.quadratic_nm_per_rad2, "N·m/rad²"),
        ("cubic", shaft.cubic_nm_per_rad3, "N·m/rad³"),
        ("quintic", shaft.quintic_nm_per_rad5, "N·m/rad⁵"),
        ("septic", shaft.septic_nm_per_rad7, "N·m/rad⁷"),
    ]
    .into_iter()
    .filter(|(_, coefficient, _)| *coefficient != 0.0)
    .map(|(key, coefficient, unit)| term(key, coefficient, unit, effect(key, coefficient)))
    .collect()
}

fn free_play(shaft: &Shaft) -> Option<NonlinearTerm> {
    let damping = if shaft.damping_nm_s_per_rad == 0.0 {
        ""
    } else if shaft.damps_in_gap {
        ", but for the damping"
    } else {
        " at all"
    };
    if let Some(contact) = shaft.contact_rad {
        let effect = format!("a stop on one side: no torque before it{damping}");
        return Some(term("contact", contact, "rad", effect));
    }
    let clearance = shaft.clearance_rad.filter(|clearance| *clearance > 0.0)?;
    let effect = format!("free play: no torque within half of it on either side{damping}");
    Some(term("clearance", clearance, "rad", effect))
}

fn stages(key: &str, stages: &[Stage]) -> Option<NonlinearTerm> {
    if stages.len() < 2 {
        return None;
    }
    let told: Vec<String> = stages
        .iter()
        .map(|stage| match stage.until_rad {
            Some(until) => format!("{} N·m/rad up to {until:.5} rad", stage.stiffness_nm_per_rad),
            None => format!("then {} N·m/rad", stage.stiffness_nm_per_rad),
        })
        .collect();
    #[expect(clippy::cast_precision_loss, reason = "a few stages")]
    let count = stages.len() as f64;
    Some(term(key, count, "stiffnesses", told.join(", ")))
}

fn table(shaft: &Shaft) -> Option<NonlinearTerm> {
    let table = shaft.table.as_ref()?;
    let (first, last) = (table.twist_rad.first()?, table.twist_rad.last()?);
    #[expect(clippy::cast_precision_loss, reason = "bounded by the file format")]
    let count = table.twist_rad.len() as f64;
    let effect =
        format!("measured from {first:.5} to {last:.5} rad, straight with the slope there beyond");
    Some(term("table", count, "points", effect))
}

fn function(shaft: &Shaft) -> Option<NonlinearTerm> {
    let law = shaft.function.as_ref()?;
    let (first, last) = law.range_rad();
    #[expect(clippy::cast_precision_loss, reason = "a few hundred at most")]
    let count = (law.pieces().len() - 2) as f64;
    let effect =
        format!("sampled from {first:.5} to {last:.5} rad, straight with the slope there beyond");
    let unit = if count == 1.0 { "polynomial" } else { "polynomials" };
    Some(term("function", count, unit, effect))
}

fn others(shaft: &Shaft) -> impl Iterator<Item = NonlinearTerm> {
    let preload = (shaft.preload_nm != 0.0)
        .then(|| term("preload", shaft.preload_nm, "N·m", "the torque at zero twist"));
    let friction = (shaft.friction_nm > 0.0).then(|| {
        let effect =
            format!("dry, smoothed by tanh(rate of twist / {} rad/s)", shaft.friction_speed_rad_s);
        term("friction", shaft.friction_nm, "N·m", effect)
    });
    preload.into_iter().chain(friction)
}
