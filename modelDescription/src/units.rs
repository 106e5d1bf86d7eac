//! SI units of our interfaces, as powers of the base units.

/// A unit's name and its powers of SI base units, written as the attributes of `BaseUnit`.
pub type Unit = (&'static str, &'static [(&'static str, &'static str)]);

/// Every unit an interface may use; `1` (no unit) is left out of the XML.
pub const UNITS: [Unit; 15] = [
    ("m", &[("m", "1")]),
    ("m/s", &[("m", "1"), ("s", "-1")]),
    ("m/s2", &[("m", "1"), ("s", "-2")]),
    ("N", &[("kg", "1"), ("m", "1"), ("s", "-2")]),
    ("N.m", &[("kg", "1"), ("m", "2"), ("s", "-2")]),
    ("J", &[("kg", "1"), ("m", "2"), ("s", "-2")]),
    ("N/m", &[("kg", "1"), ("s", "-2")]),
    ("N.s/m", &[("kg", "1"), ("s", "-1")]),
    ("kg", &[("kg", "1")]),
    ("kg/m", &[("kg", "1"), ("m", "-1")]),
    ("s", &[("s", "1")]),
    ("Hz", &[("s", "-1")]),
    ("rad", &[("rad", "1")]),
    ("rad/s", &[("rad", "1"), ("s", "-1")]),
    ("rad/s2", &[("rad", "1"), ("s", "-2")]),
];

/// The unit with this name, if an interface may use it.
pub fn find(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|(known, _)| *known == name)
}
