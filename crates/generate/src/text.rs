//! A model as text: a line for every node, element and section.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};
use ttb_scenario::types::Model;

/// The text of a model file.
#[must_use]
pub fn text(model: &Model) -> String {
    let mut bytes = Vec::new();
    // neither writing into memory nor a model of numbers and names can fail; nothing is better than half a file
    if model.serialize(&mut Serializer::with_formatter(&mut bytes, Lines::default())).is_err() {
        return String::new();
    }
    bytes.push(b'\n');
    String::from_utf8(bytes).unwrap_or_default()
}

/// Breaks the line before every list or object inside a list, and before every field of the outermost object.
#[derive(Default)]
struct Lines {
    /// For every list or object around: is it a list?
    around: Vec<bool>,
}

impl Lines {
    fn open<W: ?Sized + Write>(&mut self, writer: &mut W, list: bool) -> io::Result<()> {
        if self.around.last() == Some(&true) {
            writer.write_all(b"\n ")?;
        }
        self.around.push(list);
        writer.write_all(if list { b"[" } else { b"{" })
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.around.pop();
        if self.around.is_empty() {
            writer.write_all(b"\n")?;
        }
        writer.write_all(bracket)
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, true)
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, false)
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if !first {
            writer.write_all(b",")?;
        }
        if self.around.len() == 1 { writer.write_all(b"\n") } else { Ok(()) }
    }
}
