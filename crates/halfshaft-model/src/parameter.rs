//! Parameter addresses: `<element name>.<key>` for every numeric key of a line.
//!
//! `half-shaft.cubic`, `engine torque.amplitude`, `engine torque.pulse.peak`,
//! `engine torque.harmonics.1.amplitude` (the first entry of `harmonics`), `gearbox.ratios.1`,
//! `clutch.stages.1.until`, `clutch.table.torque.1`.
//! Element names may contain dots; the longest name that fits is meant.

use crate::diagnostic::did_you_mean;
use crate::driveline::Driveline;
use crate::elements::{
    CRANK_PRESSURE, CRANK_TORQUE, DAMPER, ENGAGEMENT, ENGINE, Engine, GEAR, HARMONIC, Harmonic,
    INERTIA, MEASURED, MeanTorque, PULSE, SHAFT, STAGE, Shaft, TORQUE, TORQUE_TABLE, Torque,
    WHOLE_LINE, WHOLE_LINE_NAME,
};
use crate::format::{TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Which list of the line an element stands in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum List {
    Inertia,
    Gear,
    Shaft,
    Torque,
    Damper,
    Engine,
    WholeLine,
}

/// One numeric key of one element, found by its address.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// The address as written.
    pub address: String,
    /// What the number means.
    pub kind: QuantityKind,
    /// Which signs it may have.
    pub sign: Sign,
    list: List,
    index: usize,
    key: String,
}

/// Why an address leads nowhere.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AddressError {
    /// There is no dot in it.
    #[error("\"{address}\" is no parameter address")]
    NoDot {
        /// The address as written.
        address: String,
    },
    /// No element has that name.
    #[error("no element is named \"{name}\"")]
    NoElement {
        /// The name as written.
        name: String,
    },
    /// The element has no such numeric key.
    #[error("\"{element}\" has no number \"{key}\"")]
    NoKey {
        /// Name of the element.
        element: String,
        /// The key as written.
        key: String,
        /// The numeric keys that it has.
        known: Vec<String>,
    },
}

impl AddressError {
    /// What to write instead.
    pub fn hint(&self, line: &Driveline) -> String {
        match self {
            Self::NoDot { .. } => {
                "an address is <element name>.<key>, e.g. half-shaft.cubic".to_owned()
            }
            Self::NoElement { name } => {
                did_you_mean(name, line.element_names()).unwrap_or_else(|| {
                    let names: Vec<_> = line.element_names().collect();
                    format!("elements of this line are {}", names.join(", "))
                })
            }
            Self::NoKey { element, key, known } => {
                // A number of a table inside the element is often asked for without that table.
                let nested = known.iter().find(|known| known.rsplit('.').next() == Some(key));
                if let Some(nested) = nested {
                    return format!("did you mean \"{element}.{nested}\"?");
                }
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                did_you_mean(key, known.iter().copied())
                    .unwrap_or_else(|| format!("it has {}", known.join(", ")))
            }
        }
    }
}

/// Finds the parameter at `address`.
///
/// A key that the file leaves at its default has its address too.
///
/// # Errors
/// [`AddressError`] where there is no such element or numeric key.
pub fn resolve(line: &Driveline, address: &str) -> Result<Parameter, AddressError> {
    let address = address.trim();
    let mut owner: Option<(List, usize, &str)> = None;
    for (list, index, name) in elements(line) {
        let fits = address.strip_prefix(name).is_some_and(|rest| rest.starts_with('.'));
        if fits && owner.is_none_or(|(.., longest)| name.len() > longest.len()) {
            owner = Some((list, index, name));
        }
    }
    let Some((list, index, name)) = owner else {
        let (name, _) = address
            .split_once('.')
            .ok_or_else(|| AddressError::NoDot { address: address.to_owned() })?;
        return Err(AddressError::NoElement { name: name.to_owned() });
    };
    let key = &address[name.len() + 1..];
    let numbers = numbers(line, list, index);
    let Some(Number { kind, sign, .. }) = numbers.iter().find(|number| number.key == key) else {
        let (element, key) = (name.to_owned(), key.to_owned());
        let known = numbers.into_iter().map(|number| number.key).collect();
        return Err(AddressError::NoKey { element, key, known });
    };
    let (kind, sign) = (*kind, *sign);
    Ok(Parameter { address: address.to_owned(), kind, sign, list, index, key: key.to_owned() })
}

fn elements(line: &Driveline) -> impl Iterator<Item = (List, usize, &str)> {
    fn named<'l, T>(
        list: List,
        items: &'l [T],
        name: impl Fn(&'l T) -> &'l str + 'l,
    ) -> impl Iterator<Item = (List, usize, &'l str)> {
        items.iter().enumerate().map(move |(index, item)| (list, index, name(item)))
    }
    named(List::Inertia, &line.inertias, |e| &e.name)
        .chain(named(List::Gear, &line.gears, |e| &e.name))
        .chain(named(List::Shaft, &line.shafts, |e| &e.name))
        .chain(named(List::Torque, &line.torques, |e| &e.name))
        .chain(named(List::Damper, &line.dampers, |e| &e.name))
        .chain(named(List::Engine, &line.engines, |e| &e.name))
        .chain([(List::WholeLine, 0, WHOLE_LINE_NAME)])
}

fn table_of(list: List) -> &'static TableSpec {
    match list {
        List::Inertia => &INERTIA,
        List::Gear => &GEAR,
        List::Shaft => &SHAFT,
        List::Torque => &TORQUE,
        List::Damper => &DAMPER,
        List::Engine => &ENGINE,
        List::WholeLine => &WHOLE_LINE,
    }
}

/// A number of an element: its key, possibly nested, and what it means.
struct Number {
    key: String,
    kind: QuantityKind,
    sign: Sign,
}

/// All numbers of an element, with those of the tables and lists that it has.
fn numbers(line: &Driveline, list: List, index: usize) -> Vec<Number> {
    let mut numbers = numbers_of(table_of(list), "");
    match list {
        List::Inertia | List::Damper | List::WholeLine => {}
        List::Engine => {
            if let Some(engine) = line.engines.get(index) {
                numbers.extend(numbers_of_engine(engine));
                let mut engine = engine.clone();
                numbers.retain(|number| engine.parameter_mut(&number.key).is_some());
            }
        }
        List::Gear => {
            if let Some(gear) = line.gears.get(index) {
                numbers.extend(listed(&GEAR, "ratios", "ratios", gear.ratios.len()));
                // Asking for the stiffness makes a mesh elastic, so each key asks a gear of its own.
                numbers.retain(|number| gear.clone().parameter_mut(&number.key).is_some());
            }
        }
        List::Shaft => {
            if let Some(shaft) = line.shafts.get(index) {
                numbers.extend(numbers_of_law(shaft));
                let mut shaft = shaft.clone();
                numbers.retain(|number| shaft.parameter_mut(&number.key).is_some());
            }
        }
        List::Torque => {
            if let Some(torque) = line.torques.get(index) {
                numbers.extend(numbers_of_torque(torque));
                let mut torque = torque.clone();
                numbers.retain(|number| torque.parameter_mut(&number.key).is_some());
            }
        }
    }
    numbers
}

/// The numbers of a list of `count` numbers that stands at `key` of a table.
fn listed(table: &TableSpec, key: &str, prefix: &str, count: usize) -> Vec<Number> {
    let Some(ValueSpec::Quantities(kind, sign)) = table.key(key).map(|key| key.value) else {
        return Vec::new();
    };
    let keys = (1..=count).map(|number| format!("{prefix}.{number}"));
    keys.map(|key| Number { key, kind, sign }).collect()
}

/// The numbers of stages and points.
fn numbers_of_law(shaft: &Shaft) -> Vec<Number> {
    let mut numbers = Vec::new();
    for (list, stages) in [("stages", &shaft.stages), ("coast_stages", &shaft.coast_stages)] {
        for number in 1..=stages.len() {
            numbers.extend(numbers_of(&STAGE, &format!("{list}.{number}.")));
        }
    }
    if let Some(table) = &shaft.table {
        numbers.extend(listed(&MEASURED, "twist", "table.twist", table.twist_rad.len()));
        numbers.extend(listed(&MEASURED, "torque", "table.torque", table.torque_nm.len()));
    }
    if shaft.engagement.is_some() {
        numbers.extend(numbers_of(&ENGAGEMENT, "engagement."));
    }
    numbers
}

/// The numbers of a pulse and of further harmonics. An impulse has no peak, and no other shape an
/// impulse; both are left out later.
fn numbers_of_torque(torque: &Torque) -> Vec<Number> {
    let mut numbers = Vec::new();
    if torque.pulse.is_some() {
        numbers.extend(numbers_of(&PULSE, "pulse."));
    }
    if let Some(table) = &torque.table {
        numbers.extend(listed(&TORQUE_TABLE, "torque", "table.torque", table.torque_nm.len()));
    }
    // Entry 0 is that of the torque's own keys.
    for number in 1..torque.harmonics.len() {
        numbers.extend(numbers_of(&HARMONIC, &format!("harmonics.{number}.")));
    }
    numbers
}

/// The numbers of firing angles and points.
fn numbers_of_engine(engine: &Engine) -> Vec<Number> {
    let cylinders = engine.firing_rad.len();
    let mut numbers = listed(&ENGINE, "firing_angles", "firing_angles", cylinders);
    if let Some(table) = &engine.pressure {
        let count = table.values.len();
        numbers.extend(listed(&CRANK_PRESSURE, "pressure", "pressure.pressure", count));
    }
    if let Some(table) = &engine.torque {
        numbers.extend(listed(&CRANK_TORQUE, "torque", "torque.torque", table.values.len()));
    }
    numbers
}

/// The numbers of a table.
fn numbers_of(table: &TableSpec, prefix: &str) -> Vec<Number> {
    table
        .keys
        .iter()
        .filter_map(|spec| {
            let (kind, sign) = spec.quantity()?;
            Some(Number { key: format!("{prefix}{}", spec.name), kind, sign })
        })
        .collect()
}

impl Parameter {
    /// The parameter's value in `line`, in SI; `None` for a balancing mean torque and for the mesh
    /// stiffness of a rigid gear.
    pub fn value(&self, line: &Driveline) -> Option<f64> {
        if self.is_mesh_stiffness() {
            return line.gears.get(self.index)?.stiffness_nm_per_rad;
        }
        if self.takes_balance() {
            return match line.torques.get(self.index)?.mean {
                MeanTorque::Value(value) => Some(value),
                MeanTorque::Balance => None,
            };
        }
        // Each element knows its keys in one place, which lends them mutably.
        let (index, key) = (self.index, self.key.as_str());
        match self.list {
            List::Inertia => line.inertias.get(index)?.clone().parameter_mut(key).copied(),
            List::Gear => line.gears.get(index)?.clone().parameter_mut(key).copied(),
            List::Shaft => line.shafts.get(index)?.clone().parameter_mut(key).copied(),
            List::Torque => line.torques.get(index)?.clone().parameter_mut(key).copied(),
            List::Damper => line.dampers.get(index)?.clone().parameter_mut(key).copied(),
            List::Engine => line.engines.get(index)?.clone().parameter_mut(key).copied(),
            List::WholeLine => line.whole.clone().parameter_mut(key).copied(),
        }
    }

    /// Symbol of the SI unit of the value.
    pub fn unit(&self) -> &'static str {
        self.kind.si_unit()
    }

    /// Whether another value makes other gear ratios, or a rigid gear elastic.
    pub(crate) fn changes_gears(&self) -> bool {
        self.list == List::Gear && !self.is_listed_ratio()
    }

    fn is_mesh_stiffness(&self) -> bool {
        self.list == List::Gear && self.key == "stiffness"
    }

    /// The shaft that it belongs to, if any.
    pub(crate) fn shaft<'l>(&self, line: &'l Driveline) -> Option<&'l Shaft> {
        line.shafts.get(self.index).filter(|_| self.list == List::Shaft)
    }

    /// Whether it is one of the ratios that a gearbox could be switched to.
    pub(crate) fn is_listed_ratio(&self) -> bool {
        self.list == List::Gear && self.key.starts_with("ratios.")
    }

    /// The key within its element, e.g. `pulse.peak`.
    pub(crate) fn key(&self) -> &str {
        &self.key
    }

    /// The torque that it belongs to, if any.
    pub(crate) fn torque<'l>(&self, line: &'l Driveline) -> Option<&'l Torque> {
        line.torques.get(self.index).filter(|_| self.list == List::Torque)
    }

    /// The harmonic of a torque that it belongs to, if any, and its key within that.
    pub(crate) fn harmonic<'l>(&self, line: &'l Driveline) -> Option<(&'l Harmonic, &str)> {
        self.torque(line)?.harmonic(&self.key)
    }

    /// Whether the word "balance" may stand here.
    pub(crate) fn takes_balance(&self) -> bool {
        self.list == List::Torque && self.key == "mean"
    }

    pub(crate) fn set_balance(&self, line: &mut Driveline) {
        if let Some(torque) = line.torques.get_mut(self.index) {
            torque.mean = MeanTorque::Balance;
        }
    }

    /// Writes `value` (SI) into `line`; says whether there was a place for it.
    pub(crate) fn set(&self, line: &mut Driveline, value: f64) -> bool {
        match self.slot(line) {
            Some(slot) => {
                *slot = value;
                true
            }
            None => false,
        }
    }

    fn slot<'l>(&self, line: &'l mut Driveline) -> Option<&'l mut f64> {
        match self.list {
            List::Inertia => line.inertias.get_mut(self.index)?.parameter_mut(&self.key),
            List::Gear => line.gears.get_mut(self.index)?.parameter_mut(&self.key),
            List::Shaft => line.shafts.get_mut(self.index)?.parameter_mut(&self.key),
            List::Torque => line.torques.get_mut(self.index)?.parameter_mut(&self.key),
            List::Damper => line.dampers.get_mut(self.index)?.parameter_mut(&self.key),
            List::Engine => line.engines.get_mut(self.index)?.parameter_mut(&self.key),
            List::WholeLine => line.whole.parameter_mut(&self.key),
        }
    }
}
