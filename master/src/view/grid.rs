//! A grid of points and cells with vectors on its points, written as VTU.

use std::io::{self, Write};
use std::path::Path;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use crate::error::Error;

/// VTK's numbers of cells with 1, 2, 3 and 4 points: vertex, line, triangle, quadrilateral.
const CELL_TYPES: [u8; 4] = [1, 3, 5, 9];
/// VTK's number of a cell of any number of points in a row, for what has more of them.
const POLY_LINE: u8 = 4;

/// Points, cells, and fields on the points.
pub struct Grid<'a> {
    /// m.
    pub points: &'a [[f64; 3]],
    /// Points of each cell by position.
    pub cells: &'a [Vec<u32>],
    /// Vectors on every point, by name.
    pub vectors: Vec<(String, &'a [[f64; 3]])>,
}

impl Grid<'_> {
    /// Writes it to a file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let mut text = Vec::new();
        self.to(&mut text).and_then(|()| std::fs::write(path, text)).map_err(Error::io(path))
    }

    fn to(&self, out: &mut Vec<u8>) -> io::Result<()> {
        let mut writer = Writer::new_with_indent(out, b' ', 1);
        writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        let file = writer.create_element("VTKFile").with_attributes([("type", "UnstructuredGrid"), ("version", "0.1")]);
        file.write_inner_content(|writer| {
            writer.create_element("UnstructuredGrid").write_inner_content(|writer| self.piece(writer))?;
            Ok(())
        })?;
        Ok(())
    }

    fn piece(&self, writer: &mut Writer<&mut Vec<u8>>) -> io::Result<()> {
        let (points, cells) = (self.points.len().to_string(), self.cells.len().to_string());
        let piece = writer
            .create_element("Piece")
            .with_attributes([("NumberOfPoints", points.as_str()), ("NumberOfCells", cells.as_str())]);
        piece.write_inner_content(|writer| {
            writer.create_element("PointData").write_inner_content(|writer| {
                self.vectors.iter().try_for_each(|(name, vectors)| triples(writer, name, vectors))
            })?;
            writer.create_element("Points").write_inner_content(|writer| triples(writer, "points", self.points))?;
            writer.create_element("Cells").write_inner_content(|writer| {
                let ends = self.cells.iter().scan(0, |end, cell| {
                    *end += cell.len();
                    Some(*end)
                });
                let kind = |cell: &Vec<u32>| CELL_TYPES.get(cell.len().wrapping_sub(1)).unwrap_or(&POLY_LINE);
                array(writer, "connectivity", "Int64", "1", self.cells.iter().flatten())?;
                array(writer, "offsets", "Int64", "1", ends)?;
                array(writer, "types", "UInt8", "1", self.cells.iter().map(kind))
            })?;
            Ok(())
        })?;
        Ok(())
    }
}

fn triples(writer: &mut Writer<&mut Vec<u8>>, name: &str, vectors: &[[f64; 3]]) -> io::Result<()> {
    array(writer, name, "Float64", "3", vectors.iter().flatten())
}

fn array(
    writer: &mut Writer<&mut Vec<u8>>,
    name: &str,
    kind: &str,
    components: &str,
    numbers: impl Iterator<Item = impl std::fmt::Display>,
) -> io::Result<()> {
    let mut text = Vec::new();
    for number in numbers {
        write!(text, "{number} ")?;
    }
    let attributes = [("type", kind), ("Name", name), ("NumberOfComponents", components), ("format", "ascii")];
    let text = String::from_utf8_lossy(&text);
    writer
        .create_element("DataArray")
        .with_attributes(attributes)
        .write_text_content(BytesText::new(text.trim_end()))?;
    Ok(())
}
