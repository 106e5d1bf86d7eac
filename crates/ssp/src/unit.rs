//! Units of documents.

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
