//! The validated line: its elements, which nodes turn rigidly together, its digest.

mod connection;
mod digest;
mod expanded;
mod network;
mod places;
mod topology;
mod validate;

use std::borrow::Cow;

use serde::Serialize;

use crate::diagnostic::did_you_mean;
use crate::elements::{Damper, Engine, Gear, Inertia, SampledLaw, Shaft, Torque, WholeLine};
use crate::parameter::{AddressError, Parameter, resolve};

pub use network::{End, LockedLoop, Network, TreeShaft};
pub(crate) use places::Places;
pub use topology::{Group, Node, Topology, TopologyError};
pub(crate) use validate::validate;

/// A driveline that has passed validation and never changes; [`Driveline::with`] makes
/// another one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Driveline {
    pub(crate) name: String,
    pub(crate) description: String,
    pub(crate) inertias: Vec<Inertia>,
    pub(crate) gears: Vec<Gear>,
    pub(crate) shafts: Vec<Shaft>,
    pub(crate) torques: Vec<Torque>,
    // The digest of a line is made from what is serialised; lists that are empty do not change it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) dampers: Vec<Damper>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) engines: Vec<Engine>,
    #[serde(skip_serializing_if = "WholeLine::is_plain")]
    pub(crate) whole: WholeLine,
}

/// Why a line cannot be had with another value of a parameter.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChangeError {
    /// The address leads nowhere.
    #[error(transparent)]
    Address(#[from] AddressError),
    /// The value has a sign that the key forbids, or is not finite.
    #[error("{address} = {value} is not allowed: it must {rule}")]
    Value {
        /// The parameter.
        address: String,
        /// The value in SI.
        value: f64,
        /// What it must be.
        rule: &'static str,
    },
    /// The element has no place for the value (a peak of a pulse that is an impulse).
    #[error("{address} has no value to set")]
    NoPlace {
        /// The parameter.
        address: String,
    },
    /// With this value the stages or points of a law do not ascend.
    #[error("with {address} = {value}: {reason}")]
    Law {
        /// The parameter.
        address: String,
        /// The value in SI.
        value: f64,
        /// What is wrong.
        reason: String,
    },
    /// With this value the gears contradict each other.
    #[error("with {address} = {value}: {reason}")]
    Gears {
        /// The parameter.
        address: String,
        /// The value in SI.
        value: f64,
        /// What contradicts.
        reason: Box<TopologyError>,
    },
    /// With this value a loop of shafts cannot turn.
    #[error("with {address} = {value}: {reason}")]
    Loop {
        /// The parameter.
        address: String,
        /// The value in SI.
        value: f64,
        /// The loop.
        reason: Box<LockedLoop>,
    },
}

/// Why a shaft cannot have a law from a function.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FunctionError {
    /// No shaft has that name.
    #[error("no shaft is named \"{name}\": {hint}")]
    NoShaft {
        /// The name as given.
        name: String,
        /// A name like it, or those that there are.
        hint: String,
    },
    /// The shaft is a bar, whose pieces twist one by one.
    #[error("\"{name}\" is given by its dimensions, which are its law: leave them out")]
    Bar {
        /// Name of the shaft.
        name: String,
    },
}

impl Driveline {
    /// Name of the line.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Free text about the line.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Inertias in file order.
    pub fn inertias(&self) -> &[Inertia] {
        &self.inertias
    }

    /// Gears in file order.
    pub fn gears(&self) -> &[Gear] {
        &self.gears
    }

    /// Shafts in file order.
    pub fn shafts(&self) -> &[Shaft] {
        &self.shafts
    }

    /// Torques in file order.
    pub fn torques(&self) -> &[Torque] {
        &self.torques
    }

    /// Torsional vibration dampers in file order.
    pub fn dampers(&self) -> &[Damper] {
        &self.dampers
    }

    /// Piston engines in file order.
    pub fn engines(&self) -> &[Engine] {
        &self.engines
    }

    /// What holds for the line as a whole.
    pub fn whole(&self) -> &WholeLine {
        &self.whole
    }

    /// The line with its bars cut into pieces and its dampers as an inertia and a shaft each, which is
    /// what analyses work on. Inertias, shafts and gears keep their places in the lists; a piece of a
    /// bar that has inertia takes half of it to each end, and has what consistent inertia differs by
    /// as [`Shaft::inertance_kg_m2`].
    pub fn expanded(&self) -> Cow<'_, Self> {
        expanded::of(self, usize::MAX)
    }

    /// The same with every bar in one piece, for drawings and tables.
    pub fn with_whole_bars(&self) -> Cow<'_, Self> {
        expanded::of(self, 1)
    }

    /// Gears with an elastic mesh, in file order.
    pub fn meshes(&self) -> impl Iterator<Item = &Gear> + Clone {
        self.gears.iter().filter(|gear| gear.is_elastic())
    }

    /// Names of the connections with a twist: shafts, then elastic meshes, in file order; of the
    /// [expanded](Self::expanded) line those that analyses know.
    pub fn connection_names(&self) -> impl Iterator<Item = &str> + Clone {
        let shafts = self.shafts.iter().map(|shaft| shaft.name.as_str());
        shafts.chain(self.meshes().map(|gear| gear.name.as_str()))
    }

    /// Names of all elements, which are unique.
    pub fn element_names(&self) -> impl Iterator<Item = &str> + Clone {
        let inertias = self.inertias.iter().map(|e| e.name.as_str());
        let gears = self.gears.iter().map(|e| e.name.as_str());
        let shafts = self.shafts.iter().map(|e| e.name.as_str());
        let torques = self.torques.iter().map(|e| e.name.as_str());
        let dampers = self.dampers.iter().map(|e| e.name.as_str());
        let engines = self.engines.iter().map(|e| e.name.as_str());
        inertias.chain(gears).chain(shafts).chain(torques).chain(dampers).chain(engines)
    }

    /// The parameter at an address such as `half-shaft.cubic`.
    ///
    /// # Errors
    /// [`AddressError`] where there is no such element or numeric key.
    pub fn parameter(&self, address: &str) -> Result<Parameter, AddressError> {
        resolve(self, address)
    }

    /// The same line with one number changed (SI).
    ///
    /// # Errors
    /// [`ChangeError`] where the value is not allowed there.
    pub fn with(&self, parameter: &Parameter, value: f64) -> Result<Self, ChangeError> {
        if !value.is_finite() || !parameter.sign.allows(value) {
            return Err(ChangeError::Value {
                address: parameter.address.clone(),
                value,
                rule: if value.is_finite() { parameter.sign.rule() } else { "be finite" },
            });
        }
        let mut line = self.clone();
        if !parameter.set(&mut line, value) {
            return Err(ChangeError::NoPlace { address: parameter.address.clone() });
        }
        let faults = parameter.shaft(&line).map(Shaft::law_faults).unwrap_or_default();
        if let Some(fault) = faults.into_iter().next() {
            let address = parameter.address.clone();
            return Err(ChangeError::Law { address, value, reason: fault.message });
        }
        if parameter.changes_gears() {
            line.check_turning(parameter, value)?;
        }
        Ok(line)
    }

    /// The same line with the law of a shaft given by a function; its damping, friction and preload stay.
    ///
    /// # Errors
    /// [`FunctionError`] where there is no such shaft or it is a bar.
    pub fn with_function(&self, shaft: &str, law: SampledLaw) -> Result<Self, FunctionError> {
        let Some(index) = self.shafts.iter().position(|known| known.name == shaft) else {
            let names = || self.shafts.iter().map(|shaft| shaft.name.as_str());
            let all = || format!("there is {}", names().collect::<Vec<_>>().join(", "));
            let hint = did_you_mean(shaft, names()).unwrap_or_else(all);
            return Err(FunctionError::NoShaft { name: shaft.to_owned(), hint });
        };
        if self.shafts[index].dimensions.is_some() {
            return Err(FunctionError::Bar { name: shaft.to_owned() });
        }
        let mut line = self.clone();
        line.shafts[index] = line.shafts[index].clone().with_function(law);
        Ok(line)
    }

    /// Whether the gears still agree, among themselves and around loops of shafts; `value` is what
    /// the parameter has been set to.
    fn check_turning(&self, parameter: &Parameter, value: f64) -> Result<(), ChangeError> {
        let address = || parameter.address.clone();
        let whole = self.expanded();
        let topology = Topology::of(&whole).map_err(|reason| ChangeError::Gears {
            address: address(),
            value,
            reason: Box::new(reason),
        })?;
        let network = Network::of(&whole, &topology);
        match network.locked_loops(&whole, topology.groups.len()).into_iter().next() {
            Some(locked) => {
                Err(ChangeError::Loop { address: address(), value, reason: Box::new(locked) })
            }
            None => Ok(()),
        }
    }

    /// SHA-256 over every value of the line in SI, as hexadecimal text: two files that say
    /// the same line in different units or order of keys have the same digest.
    pub fn digest(&self) -> String {
        digest::of(self)
    }
}
