//! XML as a tree of elements, every one with its place: small enough documents, nothing expanded, nothing fetched.

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use crate::problem::Report;

/// Nesting of a structure and its vendors' annotations stays far below.
const DEPTH: usize = 100;
/// Bytes and elements of a document: 10,000 supports are some 10 MB and 200,000 elements.
const BYTES: usize = 64 << 20;
const ELEMENTS: usize = 500_000;
/// Bytes of a place, whatever names a hostile document makes up.
const PLACE: usize = 400;

/// An element; names are without their prefixes.
#[derive(Clone, Debug, Default)]
pub struct Element {
    pub name: String,
    pub prefix: String,
    pub attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    /// Place in the document, in the manner of XPath.
    pub place: String,
}

impl Element {
    /// The value of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    /// The first child of that name.
    pub fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name == name)
    }

    /// The children of the first child of that name.
    pub fn children_of(&self, name: &str) -> &[Self] {
        self.child(name).map_or(&[], |child| &child.children)
    }
}

/// Reads a document; what hinders that is reported, and then there is no tree.
pub fn tree(bytes: &[u8], report: &mut Report) -> Option<Element> {
    if bytes.len() > BYTES {
        report.problem("", format!("is larger than {BYTES} bytes"));
        return None;
    }
    let Ok(text) = std::str::from_utf8(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)) else {
        report.problem("", "is not encoded in UTF-8, as SSP wants it");
        return None;
    };
    let mut xml = Reader::from_str(text);
    // The document itself is the element around the root.
    let mut open = vec![Element::default()];
    let mut elements = 0;
    loop {
        let event = match xml.read_event() {
            Ok(event) => event,
            Err(error) => {
                report.problem("", format!("is not well-formed near byte {}: {error}", xml.error_position()));
                return None;
            }
        };
        elements += usize::from(matches!(event, Event::Start(_) | Event::Empty(_)));
        if elements > ELEMENTS {
            report.problem("", format!("has more than {ELEMENTS} elements"));
            return None;
        }
        match event {
            Event::Start(start) => {
                open.push(element(&start, &open, report));
                if open.len() > DEPTH {
                    report.problem("", format!("has elements nested more than {DEPTH} deep"));
                    return None;
                }
            }
            Event::Empty(start) => {
                let child = element(&start, &open, report);
                open.last_mut()?.children.push(child);
            }
            Event::End(_) => {
                let child = open.pop()?;
                open.last_mut()?.children.push(child);
            }
            Event::DocType(_) => {
                report.problem("", "has a document type declaration: entities of its own are refused");
                return None;
            }
            Event::Eof => break,
            _ => {}
        }
    }
    let mut roots = open.pop()?.children;
    if !open.is_empty() || roots.is_empty() {
        report.problem("", "ends before its last element is closed");
        return None;
    }
    Some(roots.swap_remove(0))
}

/// An opening tag below the open elements.
fn element(start: &BytesStart, open: &[Element], report: &mut Report) -> Element {
    let name = start.local_name().into_inner().to_string();
    let prefix = start.name().prefix().map_or_else(String::new, |prefix| prefix.into_inner().to_string());
    let mut element = Element { name, prefix, ..Element::default() };
    let mut unreadable = Vec::new();
    for attribute in start.attributes() {
        match attribute {
            Ok(attribute) => {
                let key = attribute.key.into_inner().to_string();
                match attribute.normalized_value(XmlVersion::Implicit1_0) {
                    Ok(value) => element.attributes.push((key, value.into_owned())),
                    Err(error) => unreadable.push(format!("the attribute {key} cannot be read: {error}")),
                }
            }
            Err(error) => unreadable.push(format!("an attribute cannot be read: {error}")),
        }
    }
    element.place = place(&element, open.last());
    unreadable.into_iter().for_each(|message| report.problem(&element.place, message));
    element
}

/// Elements with a name are found by it, annotations by their type, connections and the like by their number.
fn place(element: &Element, parent: Option<&Element>) -> String {
    let Some(parent) = parent.filter(|parent| parent.place.len() < PLACE) else { return "…".into() };
    let step = match (element.attribute("name"), element.name.as_str()) {
        (Some(name), _) if !parent.place.is_empty() => format!("[@name='{name}']"),
        (_, "Annotation") => element.attribute("type").map_or_else(String::new, |kind| format!("[@type='{kind}']")),
        (_, "Connection" | "ParameterBinding" | "MappingEntry" | "MapEntry") => {
            format!("[{}]", parent.children.len() + 1)
        }
        _ => String::new(),
    };
    let step: String = format!("{}{step}", element.name).chars().take(PLACE).collect();
    format!("{}/{step}", parent.place)
}
