//! The FMUs' shared libraries inside this program.

use ttb_model_description::Libraries;

use crate::error::Error;

/// What was put into the program when it was compiled ([`ttb_inside`]).
#[allow(dead_code)] // how it is compiled decides which of them there is
enum Inside {
    /// An archive with libraries for one system or several, compressed.
    Archive(&'static [u8]),
    /// Model identifiers with the libraries for the system that the program runs on.
    Here(&'static [(&'static str, &'static [u8])]),
    /// Nothing: the program was only checked.
    Nothing,
}

const INSIDE: Inside = ttb_inside::libraries!();

/// The libraries of an FMU.
pub fn of(identifier: &str) -> Result<Libraries<'static>, Error> {
    let found = match &INSIDE {
        Inside::Archive(bytes) => Some(Libraries::Archive(bytes)),
        Inside::Here(all) => all.iter().find(|(name, _)| *name == identifier).map(|(_, bytes)| Libraries::Bytes(bytes)),
        Inside::Nothing => None,
    };
    found
        .ok_or_else(|| Error::Pack(format!("this program was compiled without the shared library of {identifier}.fmu")))
}
