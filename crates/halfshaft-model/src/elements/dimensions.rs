//! A shaft given by its dimensions: a round bar.

use std::f64::consts::PI;

use serde::Serialize;

use super::shaft::is_zero;
use crate::format::{CheckedTable, KeySpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// A round bar, solid or hollow, cut into pieces of equal length with consistent inertia.
///
/// With the polar moment of area `I = π (D⁴ - d⁴) / 32` its stiffness is `G I / L` and its inertia
/// `ρ I L`. A piece of length `l` has the inertia matrix `ρ I l / 6 · [2 1; 1 2]` of linear shape
/// functions (Friswell, Penny, Garvey, Lees, *Dynamics of Rotating Machines*, 2010, section 9.5).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dimensions {
    /// Length `L`, m.
    pub length_m: f64,
    /// Outer diameter `D`, m.
    pub outer_diameter_m: f64,
    /// Inner diameter `d`, m.
    #[serde(skip_serializing_if = "is_zero")]
    pub inner_diameter_m: f64,
    /// Shear modulus `G`, Pa.
    pub shear_modulus_pa: f64,
    /// Density `ρ`, kg/m³; 0 for a bar without inertia.
    #[serde(skip_serializing_if = "is_zero")]
    pub density_kg_m3: f64,
    /// Number of pieces.
    pub elements: usize,
}

/// Most pieces of one bar.
const MOST_ELEMENTS: u32 = 10_000;

/// The keys among those of `[[shaft]]`.
pub(super) const DIMENSIONS: [KeySpec; 6] = [
    KeySpec::of_quantity(
        "length",
        QuantityKind::Length,
        Sign::Positive,
        "Length L of a round bar in place of a law: stiffness G I / L and inertia ρ I L with \
         I = π (D⁴ - d⁴) / 32. Goes with outer_diameter and shear_modulus.",
    ),
    KeySpec::of_quantity(
        "outer_diameter",
        QuantityKind::Length,
        Sign::Positive,
        "Outer diameter D of the bar.",
    ),
    KeySpec::of_quantity(
        "inner_diameter",
        QuantityKind::Length,
        Sign::NonNegative,
        "Inner diameter d of a hollow bar. Default 0.",
    ),
    KeySpec::of_quantity(
        "shear_modulus",
        QuantityKind::Pressure,
        Sign::Positive,
        "Shear modulus G of the bar.",
    ),
    KeySpec::of_quantity(
        "density",
        QuantityKind::Density,
        Sign::NonNegative,
        "Density ρ of the bar. `modes`, `campbell` and `forced` take the inertia matrix \
         ρ I l / 6 · [2 1; 1 2] of each piece of length l; everything else half of the piece's \
         inertia at each of its ends. Default 0: a bar without inertia.",
    ),
    KeySpec::new(
        "elements",
        ValueSpec::Count(1, MOST_ELEMENTS),
        "Number of pieces into which the bar is cut; more than one are shafts of their own, named \
         `<name>.1`, `<name>.2` and so on. Default 1.",
    ),
];

/// Keys without which a bar is none.
pub(super) const NEEDED: [(&str, &str); 3] =
    [("length", "m"), ("outer_diameter", "mm"), ("shear_modulus", "GPa")];

impl Dimensions {
    pub(super) fn read(table: &CheckedTable) -> Self {
        let elements = table.number_or("elements", 1.0);
        Self {
            length_m: table.number_or_stand_in("length"),
            outer_diameter_m: table.number_or_stand_in("outer_diameter"),
            inner_diameter_m: table.number_or("inner_diameter", 0.0),
            shear_modulus_pa: table.number_or_stand_in("shear_modulus"),
            density_kg_m3: table.number_or("density", 0.0),
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
            elements: elements as usize,
        }
    }

    /// Polar moment of area, m⁴.
    fn polar_moment(&self) -> f64 {
        let (outer, inner) = (self.outer_diameter_m.powi(2), self.inner_diameter_m.powi(2));
        // A difference of squares keeps the digits of thin walls.
        PI / 32.0 * (outer - inner) * (outer + inner)
    }

    /// Stiffness of the whole bar, N·m/rad.
    pub fn stiffness(&self) -> f64 {
        self.shear_modulus_pa * self.polar_moment() / self.length_m
    }

    /// Inertia of the whole bar, kg·m².
    pub fn inertia(&self) -> f64 {
        self.density_kg_m3 * self.polar_moment() * self.length_m
    }

    /// Number of pieces that make a difference: without inertia there is nothing between them.
    pub fn pieces(&self) -> usize {
        if self.density_kg_m3 == 0.0 { 1 } else { self.elements.max(1) }
    }

    pub(super) fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "length" => Some(&mut self.length_m),
            "outer_diameter" => Some(&mut self.outer_diameter_m),
            "inner_diameter" => Some(&mut self.inner_diameter_m),
            "shear_modulus" => Some(&mut self.shear_modulus_pa),
            "density" => Some(&mut self.density_kg_m3),
            _ => None,
        }
    }
}
