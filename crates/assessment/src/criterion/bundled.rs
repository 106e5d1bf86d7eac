//! The limits files that come with the program, as texts.

/// Names and texts, one file a code and edition.
const FILES: &[(&str, &str)] = &[
    ("en1990-2002", include_str!("../../data/en1990-2002.json")),
    ("en1991-2-2003", include_str!("../../data/en1991-2-2003.json")),
    ("en14363-2016", include_str!("../../data/en14363-2016.json")),
    ("en12299-2009", include_str!("../../data/en12299-2009.json")),
    ("iso2631-1-1997", include_str!("../../data/iso2631-1-1997.json")),
    ("gbt5599-2019", include_str!("../../data/gbt5599-2019.json")),
    ("tb10621-2014", include_str!("../../data/tb10621-2014.json")),
    ("cfr49-299", include_str!("../../data/cfr49-299.json")),
];

/// The files that judge when none is named.
pub const DEFAULT: &[&str] = &["en1990-2002", "en1991-2-2003", "en14363-2016", "en12299-2009", "iso2631-1-1997"];

/// Their names.
pub fn names() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(name, _)| *name)
}

/// The text of a file.
pub fn text(name: &str) -> Option<&'static str> {
    FILES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
