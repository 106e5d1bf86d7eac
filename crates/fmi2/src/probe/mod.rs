//! Bare calls into an FMU, for `ttb check`.
//!
//! [`ttb_fmi::FmuInstance`] protects a run from an FMU: it turns answers into errors, keeps order, cleans up. A checker wants
//! the opposite: any GUID and any resource URI, the status as it came, freeing at the wrong moment. So a [`Probe`]
//! adds nothing to the calls but an announcement before each, from which the checker knows what was going on when a
//! process died. Whatever is called here may crash or never return: call it in a process that may be lost.

mod instance;
mod log;
mod symbols;

pub use crate::logger::ODDITIES;
pub use instance::{Instantiation, Probed, State};
pub use log::LogEntry;
pub use symbols::{Symbols, symbols};

use crate::import::functions::Functions;
use std::cell::Cell;
use std::path::Path;
use ttb_fmi::description::ModelDescription;
use ttb_fmi::library::LibraryError;

/// A loaded FMU.
pub struct Probe {
    functions: Functions,
    announce: Box<dyn Fn(&str)>,
    /// Instances made and freed so far.
    made: Cell<usize>,
    freed: Cell<usize>,
}

impl Probe {
    /// Loads the library of an FMU unpacked in `folder`; `announce` hears of every call before it is made.
    ///
    /// # Errors
    /// No library, or not one of FMI 2.0.
    pub fn open(
        folder: &Path,
        description: &ModelDescription,
        announce: impl Fn(&str) + 'static,
    ) -> Result<Self, LibraryError> {
        announce("loading the library");
        let functions = Functions::load(folder, &description.co_simulation.model_identifier)?;
        Ok(Self { functions, announce: Box::new(announce), made: Cell::new(0), freed: Cell::new(0) })
    }

    /// What the next instance is, if it is not the first: `, a second instance in its process after the first was freed,`.
    fn situation(&self) -> String {
        let (made, freed) = (self.made.get(), self.freed.get());
        let which = if made == 1 { "second".into() } else { format!("{}th", made + 1) };
        let others = match (made, freed) {
            (0, _) => return String::new(),
            (1, 1) => "after the first was freed".to_string(),
            (1, _) => "beside the first".to_string(),
            _ if freed == made => format!("after the {made} before were freed"),
            _ => format!("beside {}", made - freed),
        };
        format!(", a {which} instance in its process {others},")
    }

    /// Whether there are functions to get, set and free states.
    pub fn has_states(&self) -> bool {
        let f = &self.functions;
        f.get_state.is_some() && f.set_state.is_some() && f.free_state.is_some()
    }

    /// Whether there are functions to make states bytes and back.
    pub fn has_serialization(&self) -> bool {
        let f = &self.functions;
        f.serialized_size.is_some() && f.serialize_state.is_some() && f.deserialize_state.is_some()
    }

    /// Whether there are directional derivatives.
    pub fn has_derivatives(&self) -> bool {
        self.functions.directional_derivative.is_some()
    }
}

/// Unloads the library: a crash then is a finding too.
impl Drop for Probe {
    fn drop(&mut self) {
        // SAFETY: the instances borrow the probe, so that none is left to call a function.
        unsafe { self.functions.unload() };
    }
}
