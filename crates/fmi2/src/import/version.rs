//! FMI 2.0 as the version-free part needs it.

use super::functions::Functions;
use super::local::Local;
use super::reader::read_description;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;
use ttb_fmi::isolate::Isolation;
use ttb_fmi::library::LibraryError;
use ttb_fmi::log::LogTarget;
use ttb_fmi::slave::{Call, Slave};
use ttb_fmi::version::{Library, Version};
use ttb_fmi::{Fmu, FmuError};

/// FMI 2.0 for co-simulation.
pub static VERSION: Version = Version { prefix: "fmi2", read: read_description, load, symbol };

/// Opens an FMU of FMI 2.0 for instances in this process.
///
/// # Errors
/// As [`Fmu::open`].
pub fn open(path: &Path) -> Result<Fmu, FmuError> {
    Fmu::open(path, &VERSION)
}

/// Opens an FMU of FMI 2.0 for instances in processes of their own.
///
/// # Errors
/// As [`Fmu::open_isolated`].
pub fn open_isolated(path: &Path, isolation: &Isolation) -> Result<Fmu, FmuError> {
    Fmu::open_isolated(path, &VERSION, isolation)
}

/// What the program does that [`Isolation`] names: serves one FMU of FMI 2.0.
///
/// # Errors
/// As [`ttb_fmi::isolate::host()`].
pub fn host() -> Result<(), String> {
    ttb_fmi::isolate::host(&VERSION)
}

struct Loaded(Arc<Functions>);

fn load(folder: &Path, model_identifier: &str) -> Result<Arc<dyn Library>, LibraryError> {
    Ok(Arc::new(Loaded(Arc::new(Functions::load(folder, model_identifier)?))))
}

impl Library for Loaded {
    fn optional(&self) -> u64 {
        self.0.optional
    }

    fn instantiate(
        self: Arc<Self>,
        name: &str,
        guid: &str,
        folder: &Path,
        log: Arc<dyn LogTarget>,
        logging: bool,
    ) -> (Option<Box<dyn Slave>>, Duration) {
        let (slave, time) = Local::new(name, guid, folder, Arc::clone(&self.0), log, logging);
        (slave.map(|slave| Box::new(slave) as Box<dyn Slave>), time)
    }

    fn unload(self: Arc<Self>) {
        let functions = Arc::into_inner(self).and_then(|loaded| Arc::into_inner(loaded.0));
        if let Some(mut functions) = functions {
            // SAFETY: nobody else has them, and they end here.
            unsafe { functions.unload() };
        }
    }
}

fn symbol(call: Call) -> &'static str {
    match call {
        Call::Instantiate => "fmi2Instantiate",
        Call::SetupExperiment => "fmi2SetupExperiment",
        Call::EnterInitialization => "fmi2EnterInitializationMode",
        Call::ExitInitialization => "fmi2ExitInitializationMode",
        Call::DoStep => "fmi2DoStep",
        Call::Terminate => "fmi2Terminate",
        Call::Reset => "fmi2Reset",
        Call::FreeInstance => "fmi2FreeInstance",
        Call::GetReal => "fmi2GetReal",
        Call::SetReal => "fmi2SetReal",
        Call::SetInputDerivatives => "fmi2SetRealInputDerivatives",
        Call::DirectionalDerivative => "fmi2GetDirectionalDerivative",
        Call::GetInteger => "fmi2GetInteger",
        Call::GetBoolean => "fmi2GetBoolean",
        Call::GetString => "fmi2GetString",
        Call::SetInteger => "fmi2SetInteger",
        Call::SetBoolean => "fmi2SetBoolean",
        Call::SetString => "fmi2SetString",
        Call::GetState => "fmi2GetFMUstate",
        Call::SetState => "fmi2SetFMUstate",
        Call::FreeState => "fmi2FreeFMUstate",
        Call::Serialize => "fmi2SerializeFMUstate",
        Call::Deserialize => "fmi2DeSerializeFMUstate",
    }
}
