//! A system structure, as far as a co-simulation of FMUs wants to know.

/// The document every archive has.
pub const STRUCTURE: &str = "SystemStructure.ssd";

/// The content of a SystemStructure.ssd.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Structure {
    /// Name of the structure.
    pub name: String,
    /// One line for people.
    pub description: Option<String>,
    /// Program that wrote it.
    pub tool: Option<String>,
    /// Components and connections.
    pub system: System,
    /// Units the connectors name.
    pub units: Vec<Unit>,
    /// Start and end of a run, and settings.
    pub experiment: Experiment,
}

/// The one system of a structure; systems within systems are not read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct System {
    /// Its name.
    pub name: String,
    /// One line for people.
    pub description: Option<String>,
    /// Its components, in the order of the document.
    pub components: Vec<Component>,
    /// Its connections, in the order of the document.
    pub connections: Vec<Connection>,
}

/// A component: a file and the variables of it that others may see.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Component {
    /// Name within the system.
    pub name: String,
    /// Path inside the archive, with slashes; relative, and never out of it.
    pub source: String,
    /// One line for people.
    pub description: Option<String>,
    /// Variables by their names in the file.
    pub connectors: Vec<Connector>,
    /// Lower left and upper right corner in a drawing: x1, y1, x2, y2.
    pub geometry: Option<[f64; 4]>,
    /// Where it stands in the document.
    pub place: String,
}

/// A variable that can be connected.
#[derive(Clone, Debug, PartialEq)]
pub struct Connector {
    /// Its name, the variable's.
    pub name: String,
    /// Whether values come in or go out.
    pub kind: Kind,
    /// Type; absent where the document leaves it to the component's file.
    pub kind_of_value: Option<Type>,
    /// Where it stands in the document.
    pub place: String,
}

/// Direction of a connector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Comes from another connector.
    Input,
    /// Goes to others.
    Output,
    /// Set before a run.
    Parameter,
    /// Follows from parameters.
    CalculatedParameter,
    /// Either an input or an output.
    InOut,
}

impl Kind {
    /// All of them by their names in a document.
    pub const NAMES: [(&'static str, Self); 5] = [
        ("input", Self::Input),
        ("output", Self::Output),
        ("parameter", Self::Parameter),
        ("calculatedParameter", Self::CalculatedParameter),
        ("inout", Self::InOut),
    ];
}

/// Type of a connector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    /// A number, in a unit if one is named.
    Real(Option<String>),
    /// Any other, by its name in a document.
    Other(String),
}

/// From an output to an input: `end = factor · start + offset`, after a change of units.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Component and connector it starts from; no component: the system's own connector.
    pub start: (Option<String>, String),
    /// Component and connector it ends in.
    pub end: (Option<String>, String),
    /// Factor of a linear transformation, otherwise 1.
    pub factor: f64,
    /// Offset of a linear transformation, otherwise 0.
    pub offset: f64,
    /// Units are left alone even where both are known.
    pub suppress_unit_conversion: bool,
    /// Where it stands in the document.
    pub place: String,
}

/// A unit in terms of SI: value in SI = factor · value + offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Its name.
    pub name: String,
    /// What it is.
    pub base: BaseUnit,
}

/// Powers of the base units, with factor and offset to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseUnit {
    /// Powers of kg, m, s, A, K, mol, cd, rad.
    pub powers: [i32; 8],
    /// Factor to the base units.
    pub factor: f64,
    /// Offset in the base units.
    pub offset: f64,
}

impl BaseUnit {
    /// Names of the powers, in their order.
    pub const NAMES: [&'static str; 8] = ["kg", "m", "s", "A", "K", "mol", "cd", "rad"];
}

/// The default experiment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Experiment {
    /// Start, s.
    pub start: Option<f64>,
    /// End, s.
    pub stop: Option<f64>,
    /// Settings of the tools that know them; when read, also those of the system and of the document.
    pub annotations: Vec<Annotation>,
}

/// An annotation: one element with attributes, and elements below it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Annotation {
    /// Reversed domain name of whom it belongs to.
    pub kind: String,
    /// Prefix of its elements' namespace.
    pub prefix: String,
    /// Their namespace; not read.
    pub namespace: String,
    /// Names of the elements, one in the other.
    pub elements: Vec<String>,
    /// Attributes of the innermost.
    pub attributes: Vec<(String, String)>,
    /// Where it stands in the document.
    pub place: String,
}
