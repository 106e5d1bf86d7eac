//! Parameter sets and parameter mappings: what a binding consists of.

use crate::source::Source;
use crate::transform::Transformation;
use crate::unit::BaseUnit;

/// Values for the variables of a component, or for all that is in a system by hierarchical names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Binding {
    /// The values.
    pub values: Values,
    /// Put before the names of all of them.
    pub prefix: String,
    /// Other names for them; only what it names is then applied.
    pub mapping: Option<Mapping>,
    /// Where it stands in the document.
    pub place: String,
}

/// Where the values of a binding are.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// In the document.
    Inline(ParameterSet),
    /// In a file.
    File(Source),
}

/// Where a mapping is.
#[derive(Clone, Debug, PartialEq)]
pub enum Mapping {
    /// In the document.
    Inline(Vec<Entry>),
    /// In a file.
    File(Source),
}

/// Named values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterSet {
    /// Its name.
    pub name: String,
    /// The values.
    pub parameters: Vec<Parameter>,
}

/// A named value.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in the set.
    pub name: String,
    /// The value.
    pub value: Value,
    /// The file it stands in, as messages call it.
    pub file: String,
    /// Where in it.
    pub place: String,
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, in a unit if one is named.
    Real(f64, Option<NamedUnit>),
    /// A whole number.
    Integer(i64),
    /// True or false.
    Boolean(bool),
    /// A text.
    Text(String),
    /// An item of an enumeration by its name, and its number where the set defines the enumeration.
    Item(String, Option<i64>),
    /// Something that no variable of FMI 2.0 can have: an array, binary data.
    Other(String),
}

/// A unit by its name, and what it is where that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedUnit {
    /// Its name.
    pub name: String,
    /// What it is.
    pub base: Option<BaseUnit>,
}

/// An enumeration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Enumeration {
    /// Its name.
    pub name: String,
    /// Items and their numbers.
    pub items: Vec<(String, i64)>,
}

/// An entry of a mapping: the value of one name goes to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Name in the set.
    pub source: String,
    /// Name of what gets the value.
    pub target: String,
    /// Units are left alone even where both are known.
    pub suppress_unit_conversion: bool,
    /// What happens to the value, after a change of units.
    pub transformation: Option<Transformation>,
    /// The file it stands in, as messages call it.
    pub file: String,
    /// Where in it.
    pub place: String,
}

impl Default for Values {
    fn default() -> Self {
        Self::Inline(ParameterSet::default())
    }
}
