//! Walks through an XML document of strangers: shows every opening tag with its place, and what its attributes say.

use super::decode::decode;
use super::error::{DEPTH, DescriptionError};
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// An opening tag.
pub struct Element<'a>(BytesStart<'a>);

impl Element<'_> {
    /// Its name without prefix.
    pub fn name(&self) -> &str {
        self.0.local_name().into_inner()
    }

    /// The value of an attribute without prefix. What is wrong with the others does not matter; an entity of the document's
    /// own stays as it is written.
    pub fn attribute(&self, name: &str) -> Option<String> {
        let found = self.0.attributes().with_checks(false).flatten().find(|a| a.key.into_inner() == name)?;
        let value = found.normalized_value(XmlVersion::Implicit1_0);
        let value = value.map_or_else(|_| found.value.to_string(), |value| value.into_owned());
        // Names are of the type normalizedString, in which a line ends nowhere, however it is written.
        Some(if value.contains(['\n', '\r', '\t']) { value.replace(['\n', '\r', '\t'], " ") } else { value })
    }

    /// An attribute as a number, with blanks around it or not.
    pub fn number<T: std::str::FromStr>(&self, name: &str) -> Option<T> {
        self.attribute(name).and_then(|text| text.trim().parse().ok())
    }

    /// Whether an attribute is there and true.
    pub fn flag(&self, name: &str) -> bool {
        self.attribute(name).is_some_and(|text| matches!(text.trim(), "true" | "1"))
    }
}

/// Shows every opening tag of a document, in whatever of the usual encodings it is, with the names of the elements around
/// it.
///
/// Entities a document defines itself are never expanded, so that they cannot explode.
///
/// # Errors
/// No XML, cut short, nested too deep, or what `visit` says.
pub fn walk(
    bytes: &[u8],
    mut visit: impl FnMut(&[String], &Element) -> Result<(), DescriptionError>,
) -> Result<(), DescriptionError> {
    let text = decode(bytes);
    let mut xml = Reader::from_str(&text);
    let mut path: Vec<String> = Vec::new();
    let mut seen_root = false;
    loop {
        let event = xml.read_event();
        match event.map_err(|e| DescriptionError::NotXml { position: xml.error_position(), message: e.to_string() })? {
            Event::Start(element) => {
                let element = Element(element);
                visit(&path, &element)?;
                path.push(element.name().to_string());
                seen_root = true;
                if path.len() > DEPTH {
                    return Err(DescriptionError::TooDeep);
                }
            }
            Event::Empty(element) => {
                seen_root = true;
                visit(&path, &Element(element))?;
            }
            Event::End(_) => drop(path.pop()),
            Event::Eof if path.is_empty() && seen_root => return Ok(()),
            Event::Eof => return Err(DescriptionError::Unfinished),
            _ => {}
        }
    }
}
