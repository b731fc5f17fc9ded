//! A torsional connection between two nodes.

use serde::Serialize;

use super::dimensions::{DIMENSIONS, Dimensions};
use super::engagement::{ENGAGEMENT, Engagement};
use super::measured::{MEASURED, MeasuredLaw};
use super::sampled::SampledLaw;
use super::stage::{STAGE, Stage};
use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Speed within which dry friction is smoothed where the file does not say, rad/s.
///
/// A tenth of an rpm: small against the rates of twist of any vibration worth computing (1 mrad at
/// 10 Hz has 0.06 rad/s), large enough to integrate.
pub const FRICTION_SPEED_RAD_S: f64 = 0.01;

/// A massless torsional spring with viscous damping and dry friction in parallel,
/// `x = angle(from) - angle(to)`.
///
/// The spring is one of: a polynomial `k1 x + k2 x² + k3 x³ + k5 x⁵ + k7 x⁷`; the same of the
/// penetration beyond a clearance or a contact; stages; a measured table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shaft {
    /// Name of the element; its channels are `<name>.twist` and so on.
    pub name: String,
    /// Node whose angle counts positive in the twist.
    pub from: String,
    /// Node whose angle counts negative in the twist; may be ground.
    pub to: String,
    /// Linear stiffness `k1`, N·m/rad; 0 where stages or a table give the torque.
    pub stiffness_nm_per_rad: f64,
    /// `k2`, N·m/rad²: makes drive and coast side differ.
    pub quadratic_nm_per_rad2: f64,
    /// `k3`, N·m/rad³: hardening above zero, softening below.
    pub cubic_nm_per_rad3: f64,
    /// `k5`, N·m/rad⁵.
    pub quintic_nm_per_rad5: f64,
    /// `k7`, N·m/rad⁷.
    pub septic_nm_per_rad7: f64,
    /// Viscous damping `c`, N·m·s/rad.
    pub damping_nm_s_per_rad: f64,
    /// Whether the damping acts at every twist, or only in contact beyond a clearance.
    #[serde(skip_serializing_if = "is_true")]
    pub damps_in_gap: bool,
    /// Torque at zero twist beside the law, N·m.
    #[serde(skip_serializing_if = "is_zero")]
    pub preload_nm: f64,
    /// Total clearance, rad: the polynomial is then of the penetration beyond half of it, on both
    /// sides alike.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance_rad: Option<f64>,
    /// Twist at which a stop touches, rad: the polynomial is then of the penetration beyond it, and
    /// there is no torque before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_rad: Option<f64>,
    /// Stages from zero twist outwards, for positive twist and, without `coast_stages`, for negative.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<Stage>,
    /// Stages for negative twist, where they differ.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub coast_stages: Vec<Stage>,
    /// Measured points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<MeasuredLaw>,
    /// Law that a function gave, in place of one of the model file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub function: Option<SampledLaw>,
    /// Dry friction torque, N·m.
    #[serde(skip_serializing_if = "is_zero")]
    pub friction_nm: f64,
    /// Speed within which the friction is smoothed, rad/s.
    #[serde(skip_serializing_if = "is_default_speed")]
    pub friction_speed_rad_s: f64,
    /// When the friction comes to bear, for motions in time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub engagement: Option<Engagement>,
    /// Loss factor η of hysteretic damping, for linear vibrations: stiffness `k (1 + i η)`.
    /// `None` for that of the line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loss_factor: Option<f64>,
    /// Round bar of which the stiffness and the inertia are those, in place of a law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dimensions: Option<Dimensions>,
    /// Torque over the relative acceleration of the ends, kg·m²: what the consistent inertia of a
    /// piece of a bar differs by from its halves at the ends. Only where
    /// [`Driveline::expanded`](crate::Driveline::expanded) has made the shaft from a bar.
    #[serde(skip_serializing_if = "is_zero")]
    pub inertance_kg_m2: f64,
}

// The digest of a line is made from what is serialised; a key at its default must not change it.
pub(super) fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

pub(super) fn is_true(value: &bool) -> bool {
    *value
}

fn is_default_speed(value: &f64) -> bool {
    (*value - FRICTION_SPEED_RAD_S).abs() == 0.0
}

const fn stiffness(name: &'static str, degree: u8, doc: &'static str) -> KeySpec {
    KeySpec::new(name, ValueSpec::Quantity(QuantityKind::Stiffness(degree), Sign::Any), doc)
}

/// Where damping acts: at every twist, or only in contact.
const DAMPING_WORDS: [&str; 2] = ["always", IN_CONTACT];
/// Damping that acts in contact only.
pub(super) const IN_CONTACT: &str = "in contact";

pub(super) const DAMPING_ACTS: KeySpec = KeySpec::new(
    "damping_acts",
    ValueSpec::Choice(&DAMPING_WORDS),
    "Where the damping acts: \"always\", inside a clearance or before a contact too, or only \
     \"in contact\", so that there is no torque at all in free play. Default \"always\".",
);

/// Keys of `[[shaft]]`.
pub static SHAFT: TableSpec = TableSpec {
    name: "shaft",
    doc: "A torsional connection between two nodes; \"ground\" is the fixed node. \
          torque = p(x) + c x' + friction with x = angle(from) - angle(to). The law p is one of: \
          k1 x + k2 x² + k3 x³ + k5 x⁵ + k7 x⁷; the same of the penetration beyond a clearance or a \
          contact; stages; a table; or that of a round bar given by its dimensions. From a node to \
          \"ground\" it is a grounded spring with its damper; with stiffness = 0 a damper alone.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name of the element.").required(),
        KeySpec::new(
            "from",
            ValueSpec::Node { ground: true },
            "Node whose angle counts positive in the twist.",
        )
        .required(),
        KeySpec::new(
            "to",
            ValueSpec::Node { ground: true },
            "Node whose angle counts negative in the twist.",
        )
        .required(),
        KeySpec::of_quantity(
            "stiffness",
            QuantityKind::Stiffness(1),
            Sign::NonNegative,
            "Linear stiffness k1. Required, unless stages or a table give the torque.",
        ),
        KeySpec::of_quantity(
            "damping",
            QuantityKind::Damping,
            Sign::NonNegative,
            "Viscous damping c in parallel. Default 0.",
        ),
        DAMPING_ACTS,
        stiffness("quadratic", 2, "k2: makes drive and coast side differ. Default 0."),
        stiffness("cubic", 3, "k3: hardening above zero, softening below. Default 0."),
        stiffness("quintic", 5, "k5. Default 0."),
        stiffness("septic", 7, "k7. Default 0."),
        KeySpec::of_quantity(
            "clearance",
            QuantityKind::Angle,
            Sign::NonNegative,
            "Total backlash: no torque while the twist is less than half of it to either side; beyond, \
             the polynomial acts on the penetration, with the sign of the twist. A mean torque moves \
             the working point onto a flank by itself. Optional.",
        ),
        KeySpec::of_quantity(
            "contact",
            QuantityKind::Angle,
            Sign::Any,
            "A stop on one side: no torque while x is less than this; above, the polynomial acts on \
             x - contact. For a stop on the other side exchange from and to. Optional.",
        ),
        KeySpec::new(
            "stages",
            ValueSpec::Tables(&STAGE),
            "Stages of constant stiffness in place of the polynomial, from zero twist outwards; the \
             same on both sides unless there are coast_stages.",
        ),
        KeySpec::new(
            "coast_stages",
            ValueSpec::Tables(&STAGE),
            "Stages for negative twist where they differ; their twists are written without a sign.",
        ),
        KeySpec::new(
            "table",
            ValueSpec::TableOrText(&MEASURED),
            "Measured law in place of the polynomial: points, or the path of a CSV file.",
        ),
        KeySpec::of_quantity(
            "preload",
            QuantityKind::Torque,
            Sign::Any,
            "Torque at zero twist, added to any law. Default 0.",
        ),
        KeySpec::of_quantity(
            "friction",
            QuantityKind::Torque,
            Sign::NonNegative,
            "Dry friction torque in parallel: friction · tanh(x' / friction_speed). Default 0.",
        ),
        KeySpec::of_quantity(
            "friction_speed",
            QuantityKind::Speed,
            Sign::Positive,
            "Speed within which the friction is smoothed: a shaft that sticks creeps with less than \
             about this. Default 0.01 rad/s. `simulate` and `shock` let it stick exactly and need none.",
        ),
        KeySpec::new(
            "engagement",
            ValueSpec::Table(&ENGAGEMENT),
            "A clutch that engages: how the friction comes to bear over time. Optional.",
        ),
        KeySpec::of_quantity(
            "loss_factor",
            QuantityKind::Number,
            Sign::NonNegative,
            "Loss factor of hysteretic damping: stiffness · (1 + i loss_factor) in `forced`, and half of it \
             as damping ratio of a mode that only this shaft twists in. Default that of the line.",
        ),
        DIMENSIONS[0],
        DIMENSIONS[1],
        DIMENSIONS[2],
        DIMENSIONS[3],
        DIMENSIONS[4],
        DIMENSIONS[5],
    ],
};

impl Shaft {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        // A stiffness that is missing has been told, unless the torque comes from elsewhere.
        let other_law = ["stages", "table", "length"].iter().any(|key| table.mentions(key));
        let stiffness = if other_law {
            table.number_or("stiffness", 0.0)
        } else {
            table.number_or_stand_in("stiffness")
        };
        let stages = |key| table.tables(key).iter().map(Stage::read).collect();
        Self {
            name: table.text_or_empty("name"),
            from: table.text_or_empty("from"),
            to: table.text_or_empty("to"),
            stiffness_nm_per_rad: stiffness,
            quadratic_nm_per_rad2: table.number_or("quadratic", 0.0),
            cubic_nm_per_rad3: table.number_or("cubic", 0.0),
            quintic_nm_per_rad5: table.number_or("quintic", 0.0),
            septic_nm_per_rad7: table.number_or("septic", 0.0),
            damping_nm_s_per_rad: table.number_or("damping", 0.0),
            damps_in_gap: table.word("damping_acts") != Some(IN_CONTACT),
            preload_nm: table.number_or("preload", 0.0),
            clearance_rad: table.number("clearance"),
            contact_rad: table.number("contact"),
            stages: stages("stages"),
            coast_stages: stages("coast_stages"),
            table: table.table("table").map(MeasuredLaw::read),
            function: None,
            friction_nm: table.number_or("friction", 0.0),
            friction_speed_rad_s: table.number_or("friction_speed", FRICTION_SPEED_RAD_S),
            engagement: table.table("engagement").map(Engagement::read),
            loss_factor: table.number("loss_factor"),
            dimensions: table.mentions("length").then(|| Dimensions::read(table)),
            inertance_kg_m2: 0.0,
        }
    }

    /// A straight law between two nodes.
    pub(crate) fn linear(name: String, [from, to]: [String; 2], stiffness_nm_per_rad: f64) -> Self {
        Self {
            name,
            from,
            to,
            stiffness_nm_per_rad,
            quadratic_nm_per_rad2: 0.0,
            cubic_nm_per_rad3: 0.0,
            quintic_nm_per_rad5: 0.0,
            septic_nm_per_rad7: 0.0,
            damping_nm_s_per_rad: 0.0,
            damps_in_gap: true,
            preload_nm: 0.0,
            clearance_rad: None,
            contact_rad: None,
            stages: Vec::new(),
            coast_stages: Vec::new(),
            table: None,
            function: None,
            friction_nm: 0.0,
            friction_speed_rad_s: FRICTION_SPEED_RAD_S,
            engagement: None,
            loss_factor: None,
            dimensions: None,
            inertance_kg_m2: 0.0,
        }
    }

    /// Coefficients of the polynomial, ascending from the constant (always zero; see
    /// [`Shaft::preload_nm`]).
    pub fn polynomial(&self) -> [f64; 8] {
        [
            0.0,
            self.linear_stiffness(),
            self.quadratic_nm_per_rad2,
            self.cubic_nm_per_rad3,
            0.0,
            self.quintic_nm_per_rad5,
            0.0,
            self.septic_nm_per_rad7,
        ]
    }

    /// Stiffness at zero twist of a polynomial or a bar, N·m/rad.
    pub fn linear_stiffness(&self) -> f64 {
        self.dimensions.as_ref().map_or(self.stiffness_nm_per_rad, Dimensions::stiffness)
    }

    /// Whether the torque is a polynomial, of the twist or of a penetration.
    fn has_polynomial(&self) -> bool {
        self.stages.is_empty()
            && self.coast_stages.is_empty()
            && self.table.is_none()
            && self.function.is_none()
            && self.dimensions.is_none()
    }

    /// Whether the shaft never carries any torque.
    pub(crate) fn is_silent(&self) -> bool {
        let flat = |stages: &[Stage]| stages.iter().all(|stage| stage.stiffness_nm_per_rad == 0.0);
        let table = self.table.as_ref().map_or(&[][..], |table| &table.torque_nm);
        self.polynomial().iter().all(|k| *k == 0.0)
            && flat(&self.stages)
            && flat(&self.coast_stages)
            && table.iter().all(|torque| *torque == 0.0)
            && self.function.as_ref().is_none_or(SampledLaw::is_silent)
            && [self.damping_nm_s_per_rad, self.friction_nm, self.preload_nm] == [0.0; 3]
    }

    /// The shaft with its law replaced by that of a function; damping, friction and preload stay.
    pub(crate) fn with_function(self, law: SampledLaw) -> Self {
        let ends = [self.from.clone(), self.to.clone()];
        Self {
            damping_nm_s_per_rad: self.damping_nm_s_per_rad,
            preload_nm: self.preload_nm,
            function: Some(law),
            friction_nm: self.friction_nm,
            friction_speed_rad_s: self.friction_speed_rad_s,
            engagement: self.engagement,
            loss_factor: self.loss_factor,
            ..Self::linear(self.name, ends, 0.0)
        }
    }

    /// The numeric value behind a key of this element; keys of another law than the shaft's have
    /// none.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        let polynomial = self.has_polynomial();
        match key {
            "damping" => Some(&mut self.damping_nm_s_per_rad),
            "preload" => Some(&mut self.preload_nm),
            "loss_factor" => Some(self.loss_factor.get_or_insert(0.0)),
            "friction" => Some(&mut self.friction_nm).filter(|_| self.dimensions.is_none()),
            "friction_speed" => Some(&mut self.friction_speed_rad_s),
            "contact" => self.contact_rad.as_mut(),
            "stiffness" => Some(&mut self.stiffness_nm_per_rad).filter(|_| polynomial),
            "quadratic" => Some(&mut self.quadratic_nm_per_rad2).filter(|_| polynomial),
            "cubic" => Some(&mut self.cubic_nm_per_rad3).filter(|_| polynomial),
            "quintic" => Some(&mut self.quintic_nm_per_rad5).filter(|_| polynomial),
            "septic" => Some(&mut self.septic_nm_per_rad7).filter(|_| polynomial),
            "clearance" if polynomial && self.contact_rad.is_none() => {
                Some(self.clearance_rad.get_or_insert(0.0))
            }
            _ => self.nested_parameter_mut(key),
        }
    }

    /// The numeric value behind `stages.1.until`, `table.torque.1` and the like.
    fn nested_parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        let Some((list, rest)) = key.split_once('.') else {
            return self.dimensions.as_mut()?.parameter_mut(key);
        };
        if list == "engagement" {
            return self.engagement.as_mut()?.parameter_mut(rest);
        }
        let stages = match list {
            "table" => return self.table.as_mut()?.parameter_mut(rest),
            "stages" => &mut self.stages,
            "coast_stages" => &mut self.coast_stages,
            _ => return None,
        };
        let (number, key) = rest.split_once('.')?;
        let index = number.parse::<usize>().ok()?.checked_sub(1)?;
        stages.get_mut(index)?.parameter_mut(key)
    }
}
