//! What the FMU of a component says of itself; no code of it is run.

use std::path::Path;

use ttb_fmi::archive::unpack;
use ttb_fmi::description::ModelDescription;
use ttb_fmi2::import::{library_path, read_description};

/// The description of an FMU that could be run on this machine.
///
/// # Errors
/// It is no archive, has no description of FMI 2.0 for co-simulation, or no library for this machine.
pub fn describe(fmu: &Path) -> Result<ModelDescription, String> {
    let folder = unpack(fmu).map_err(|error| error.to_string())?;
    let xml = std::fs::read(folder.path().join("modelDescription.xml"));
    let xml = xml.map_err(|error| format!("modelDescription.xml: {error}"))?;
    let description = read_description(&xml).map_err(|error| format!("modelDescription.xml {error}"))?;
    if let Some(what) = description.ambiguity() {
        return Err(format!("modelDescription.xml is ambiguous: {what}"));
    }
    library_path(folder.path(), &description.co_simulation.model_identifier).map_err(|error| error.to_string())?;
    Ok(description)
}
