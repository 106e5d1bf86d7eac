//! The interface list of a subsystem: one source for value references, modelDescription.xml and GUID.

/// What a variable is to the outside (FMI 2.0, section 2.2.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    /// Set by the environment before every step; interpolated over the step when derivatives are set.
    Input,
    /// Computed; valid at the end of the last step, or in static equilibrium during initialization.
    Output,
    /// Fixed; settable until the end of initialization mode.
    Parameter,
}

/// FMI type of a variable. All values are stored as `f64`.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// fmi2Real with an SI unit (`"1"` for none).
    Real {
        /// Name of the unit, one of `m`, `m/s`, `m/s2`, `N`, `N.m`, `J`, `kg`, `s`, `rad`, `rad/s`, `rad/s2`, `1`.
        unit: &'static str,
    },
    /// fmi2Boolean, stored as 0 or 1.
    Boolean,
    /// fmi2Integer with its least and greatest value.
    Integer {
        /// Least value.
        min: i32,
        /// Greatest value.
        max: i32,
    },
    /// Enumeration, stored as the 1-based item number; items are (name, description).
    Enumeration(&'static [(&'static str, &'static str)]),
}

impl Kind {
    /// Whether a variable of this kind can have a value.
    pub fn allows(&self, value: f64) -> bool {
        let whole_from = |least: f64, most: f64| (least..=most).contains(&value) && value.fract() == 0.0;
        match self {
            Self::Real { .. } => value.is_finite(),
            Self::Boolean => value == 0.0 || value == 1.0,
            Self::Integer { min, max } => whole_from(f64::from(*min), f64::from(*max)),
            Self::Enumeration(items) => whole_from(1.0, items.len() as f64),
        }
    }
}

/// One scalar variable. Its value reference is its position in the [`Interface`].
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Unique name, such as `support[12].force`; never contains a comma.
    pub name: String,
    /// One line for the reader of the XML.
    pub description: String,
    /// Input, output or parameter.
    pub causality: Causality,
    /// Type and unit.
    pub kind: Kind,
    /// Value before initialization.
    pub start: f64,
    /// For an output: whether it depends on inputs *at the same instant* (direct feed-through).
    pub feed_through: bool,
}

impl Variable {
    fn real(name: String, description: &str, causality: Causality, unit: &'static str, start: f64) -> Self {
        let description = description.to_string();
        Self { name, description, causality, kind: Kind::Real { unit }, start, feed_through: false }
    }
    /// A Real input, zero at the start.
    pub fn input(name: impl Into<String>, unit: &'static str, description: &str) -> Self {
        Self::real(name.into(), description, Causality::Input, unit, 0.0)
    }
    /// A Real output without direct feed-through.
    pub fn output(name: impl Into<String>, unit: &'static str, description: &str) -> Self {
        Self::real(name.into(), description, Causality::Output, unit, 0.0)
    }
    /// A Real parameter.
    pub fn parameter(name: impl Into<String>, unit: &'static str, start: f64, description: &str) -> Self {
        Self::real(name.into(), description, Causality::Parameter, unit, start)
    }
    /// A parameter of another kind.
    pub fn parameter_of(name: impl Into<String>, kind: Kind, start: f64, description: &str) -> Self {
        Self { kind, ..Self::real(name.into(), description, Causality::Parameter, "1", start) }
    }
}

/// The ordered variables of a subsystem; the position is the FMI value reference.
///
/// Inputs come first, then outputs, then parameters, so that each group is one contiguous run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interface {
    variables: Vec<Variable>,
    inputs: usize,
    outputs: usize,
}

impl Interface {
    /// Joins the three groups in their order.
    ///
    /// # Panics
    /// When a variable stands in the wrong group: a programming error, caught by every test.
    pub fn new(inputs: Vec<Variable>, outputs: Vec<Variable>, parameters: Vec<Variable>) -> Self {
        let (n, m) = (inputs.len(), outputs.len());
        assert!(inputs.iter().all(|v| v.causality == Causality::Input));
        assert!(outputs.iter().all(|v| v.causality == Causality::Output));
        assert!(parameters.iter().all(|v| v.causality == Causality::Parameter));
        let variables = inputs.into_iter().chain(outputs).chain(parameters).collect();
        Self { variables, inputs: n, outputs: m }
    }
    /// All variables in value-reference order.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }
    /// Value references of the inputs.
    pub fn inputs(&self) -> std::ops::Range<usize> {
        0..self.inputs
    }
    /// Value references of the outputs.
    pub fn outputs(&self) -> std::ops::Range<usize> {
        self.inputs..self.inputs + self.outputs
    }
    /// Value references of the parameters.
    pub fn parameters(&self) -> std::ops::Range<usize> {
        self.inputs + self.outputs..self.variables.len()
    }
    /// Value reference of a name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.variables.iter().position(|v| v.name == name)
    }
}
