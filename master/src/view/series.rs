//! Grids one after the other in time, in a PVD file, which names them and their times.

use std::path::Path;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::error::Error;

/// Writes the list: time, part (grids of one time with other parts are shown together), file beside it.
///
/// # Errors
/// The file cannot be written.
pub fn write(path: &Path, grids: &[(f64, usize, String)]) -> Result<(), Error> {
    let mut text = Vec::new();
    let mut writer = Writer::new_with_indent(&mut text, b' ', 1);
    let written = writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None))).and_then(|()| {
        let file = writer.create_element("VTKFile").with_attributes([("type", "Collection"), ("version", "0.1")]);
        file.write_inner_content(|writer| {
            writer.create_element("Collection").write_inner_content(|writer| {
                for (time, part, file) in grids {
                    let (time, part) = (time.to_string(), part.to_string());
                    let attributes = [("timestep", time.as_str()), ("part", part.as_str()), ("file", file.as_str())];
                    writer.create_element("DataSet").with_attributes(attributes).write_empty()?;
                }
                Ok(())
            })?;
            Ok(())
        })?;
        Ok(())
    });
    written.and_then(|()| std::fs::write(path, &text)).map_err(Error::io(path))
}
