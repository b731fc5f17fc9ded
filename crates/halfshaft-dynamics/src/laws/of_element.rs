//! The law of a shaft or of the mesh of a gear.

use halfshaft_model::elements::{Gear, Shaft};

use super::{
    ClearanceLaw, FunctionLaw, OneSidedContact, PiecewiseLinearLaw, PolynomialLaw, Stage, TableLaw,
    TorqueLaw,
};

/// The law that a shaft's keys describe. What is a straight line is told as a polynomial, whatever
/// its keys, so that a sweep through a clearance of zero meets no other kind of law.
pub(crate) fn law_of_shaft(shaft: &Shaft) -> TorqueLaw {
    let polynomial = PolynomialLaw::new(shaft.polynomial());
    let preload = shaft.preload_nm;
    let table = shaft.table.as_ref().and_then(|table| {
        let points: Vec<(f64, f64)> = table.points().collect();
        TableLaw::new(&points, preload)
    });
    let law = if let Some(sampled) = &shaft.function {
        TorqueLaw::Function(FunctionLaw::new(sampled, preload))
    } else if let Some(table) = table {
        TorqueLaw::Table(table)
    } else if !shaft.stages.is_empty() {
        let coast = if shaft.coast_stages.is_empty() { &shaft.stages } else { &shaft.coast_stages };
        let law = PiecewiseLinearLaw::new(&stages(&shaft.stages), &stages(coast), preload);
        TorqueLaw::PiecewiseLinear(law)
    } else if let Some(contact) = shaft.contact_rad {
        TorqueLaw::OneSided(OneSidedContact::new(contact, &polynomial, preload))
    } else if let Some(clearance) = shaft.clearance_rad {
        gap(clearance, &polynomial, preload)
    } else {
        with_preload(&polynomial, preload)
    };
    straightened(law)
}

/// The law of the elastic mesh of a gear, at the output.
pub(crate) fn law_of_mesh(gear: &Gear) -> TorqueLaw {
    let [stiffness, _, clearance] = gear.mesh_at_output().unwrap_or_default();
    let linear = PolynomialLaw::new([0.0, stiffness, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    straightened(gap(clearance, &linear, 0.0))
}

/// A clearance; one of zero is the polynomial itself where that is odd.
fn gap(clearance: f64, contact: &PolynomialLaw, preload: f64) -> TorqueLaw {
    if clearance == 0.0 && contact.is_odd() {
        return with_preload(contact, preload);
    }
    TorqueLaw::Clearance(ClearanceLaw::new(clearance, contact, preload))
}

fn with_preload(polynomial: &PolynomialLaw, preload: f64) -> TorqueLaw {
    let mut coefficients = *polynomial.coefficients();
    coefficients[0] += preload;
    TorqueLaw::Polynomial(PolynomialLaw::new(coefficients))
}

fn straightened(law: TorqueLaw) -> TorqueLaw {
    if law.polynomial().is_some() || !law.is_linear() {
        return law;
    }
    let line = [law.torque(0.0), law.stiffness(0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    TorqueLaw::Polynomial(PolynomialLaw::new(line))
}

fn stages(stages: &[halfshaft_model::elements::Stage]) -> Vec<Stage> {
    let stage = |stage: &halfshaft_model::elements::Stage| Stage {
        until: stage.until_rad.unwrap_or(f64::INFINITY),
        stiffness: stage.stiffness_nm_per_rad,
    };
    stages.iter().map(stage).collect()
}
