//! The file format as data: which tables there are, which keys they take, what they mean.
//!
//! One list serves four ends, so that they cannot disagree: reading with all errors at
//! once, parameter addresses, the JSON schema for editors, and the reference page.

use crate::units::{QuantityKind, Sign};

/// What a key holds.
#[derive(Clone, Copy, Debug)]
pub enum ValueSpec {
    /// Free text.
    Text,
    /// The name of a node; `ground` where the flag is set.
    Node {
        /// Whether the fixed node may stand here.
        ground: bool,
    },
    /// A number with a unit; a bare number is in SI.
    Quantity(QuantityKind, Sign),
    /// A number with a unit, or one of some words.
    QuantityOr(QuantityKind, Sign, &'static [&'static str]),
    /// A list of numbers with units.
    Quantities(QuantityKind, Sign),
    /// A range `A..B` of a quantity, as text.
    Range(QuantityKind),
    /// A whole number from the first to the second, both included.
    Count(u32, u32),
    /// Yes or no.
    Flag,
    /// One of some words.
    Choice(&'static [&'static str]),
    /// A list of texts.
    Texts,
    /// A table inside this one.
    Table(&'static TableSpec),
    /// A table inside this one, or a text that says where to find it.
    TableOrText(&'static TableSpec),
    /// A list of tables.
    Tables(&'static TableSpec),
}

/// The words of some choices, for [`ValueSpec::Choice`].
pub(crate) const fn words<T: Copy, const N: usize>(
    choices: &[(&'static str, T); N],
) -> [&'static str; N] {
    let mut words = [""; N];
    let mut at = 0;
    while at < N {
        words[at] = choices[at].0;
        at += 1;
    }
    words
}

/// One key of a table.
#[derive(Clone, Copy, Debug)]
pub struct KeySpec {
    /// The key as written.
    pub name: &'static str,
    /// What it holds.
    pub value: ValueSpec,
    /// Whether the table is wrong without it.
    pub required: bool,
    /// Meaning, with formula and default; one sentence or two.
    pub doc: &'static str,
}

impl KeySpec {
    /// An optional key.
    pub const fn new(name: &'static str, value: ValueSpec, doc: &'static str) -> Self {
        Self { name, value, required: false, doc }
    }

    /// An optional key that holds a number with a unit.
    pub const fn of_quantity(
        name: &'static str,
        kind: QuantityKind,
        sign: Sign,
        doc: &'static str,
    ) -> Self {
        Self::new(name, ValueSpec::Quantity(kind, sign), doc)
    }

    /// The same, required.
    #[must_use]
    pub const fn required(self) -> Self {
        Self { required: true, ..self }
    }

    /// The kind of quantity, where the key holds one.
    pub fn quantity(&self) -> Option<(QuantityKind, Sign)> {
        match self.value {
            ValueSpec::Quantity(kind, sign) | ValueSpec::QuantityOr(kind, sign, _) => {
                Some((kind, sign))
            }
            _ => None,
        }
    }
}

/// One table of the file.
#[derive(Clone, Copy, Debug)]
pub struct TableSpec {
    /// Name as written between brackets.
    pub name: &'static str,
    /// What the table describes.
    pub doc: &'static str,
    /// Its keys in the order of the reference page.
    pub keys: &'static [KeySpec],
}

impl TableSpec {
    /// The key of that name.
    pub fn key(&self, name: &str) -> Option<&'static KeySpec> {
        self.keys.iter().find(|key| key.name == name)
    }
}
