//! An FMU file: unpacked, described, its library loaded.

use crate::archive::unpack;
use crate::description::{DescriptionError, ModelDescription};
use crate::error::FmuError;
use crate::guard;
use crate::instance::FmuInstance;
use crate::isolate::{self, Isolation};
use crate::log::Sink;
use crate::slave::Call;
use crate::temporary::Temporary;
use crate::version::{Library, Version};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// An FMU ready to be instantiated. Instances keep what they need of it.
pub struct Fmu {
    version: &'static Version,
    description: Arc<ModelDescription>,
    folder: Arc<Temporary>,
    home: Home,
}

/// Where instances will live.
enum Home {
    /// In this process.
    Here(Arc<dyn Library>),
    /// Each in a process of its own, which loads the library.
    Apart { fmu: PathBuf, isolation: Isolation },
}

impl Fmu {
    /// Unpacks, reads, loads.
    ///
    /// # Errors
    /// No usable co-simulation FMU of this version for this machine; the error says what is wrong with it.
    pub fn open(path: &Path, version: &'static Version) -> Result<Self, FmuError> {
        let (folder, description) = unpacked(path, version)?;
        let library = (version.load)(folder.path(), &description.co_simulation.model_identifier);
        let library = library.map_err(|source| FmuError::Library { fmu: path.to_path_buf(), source })?;
        Ok(Self { version, description, folder, home: Home::Here(library) })
    }

    /// Unpacks and reads; every instance is going to have a process of its own, which loads the library then.
    ///
    /// # Errors
    /// No co-simulation FMU of this version, or this system has no isolation.
    pub fn open_isolated(path: &Path, version: &'static Version, isolation: &Isolation) -> Result<Self, FmuError> {
        if !isolate::AVAILABLE {
            let (instance, what) =
                (path.display().to_string(), "FMUs can be isolated on Linux and Windows only".to_string());
            return Err(FmuError::Impossible { instance, what });
        }
        let (folder, description) = unpacked(path, version)?;
        let (fmu, isolation) = (path.to_path_buf(), isolation.clone());
        Ok(Self { version, description, folder, home: Home::Apart { fmu, isolation } })
    }

    /// What the FMU says of itself.
    pub fn description(&self) -> &ModelDescription {
        &self.description
    }

    /// The folder the FMU is unpacked in.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// A new instance; `logging` asks the FMU for its debug messages too.
    ///
    /// # Errors
    /// The FMU gives none.
    pub fn instantiate(&self, name: &str, logging: bool) -> Result<FmuInstance, FmuError> {
        let (sink, description) = (Arc::new(Sink::default()), Arc::clone(&self.description));
        let (slave, time) = match &self.home {
            Home::Here(library) => {
                let (log, folder) = (Arc::clone(&sink), self.folder.path());
                let (slave, time) = Arc::clone(library).instantiate(name, &description.guid, folder, log, logging);
                let (instance, call) = (name.to_string(), (self.version.symbol)(Call::Instantiate));
                let none = || match guard::ended() {
                    Some(how) => FmuError::Gone { instance, call: call.into(), how, messages: sink.take() },
                    None => FmuError::NoInstance { instance, call, messages: sink.take() },
                };
                (slave.ok_or_else(none)?, time)
            }
            Home::Apart { fmu, isolation } => isolate::start(
                &isolate::Instantiation { name, fmu, description: &description, folder: self.folder.path(), logging },
                self.version,
                isolation,
                &sink,
            )?,
        };
        Ok(FmuInstance::new(name, self.version, description, slave, time, sink, Arc::clone(&self.folder)))
    }
}

fn unpacked(path: &Path, version: &Version) -> Result<(Arc<Temporary>, Arc<ModelDescription>), FmuError> {
    let fmu = || path.to_path_buf();
    let folder = unpack(path).map_err(|source| FmuError::Unpack { fmu: fmu(), source })?;
    let xml = std::fs::read(folder.path().join("modelDescription.xml"));
    let description = xml.map_err(Into::into).and_then(|xml| (version.read)(&xml));
    let description = description.and_then(|d: ModelDescription| match d.ambiguity() {
        None => Ok(d),
        Some(what) => Err(DescriptionError::Ambiguous(what)),
    });
    let description = description.map_err(|source| FmuError::Description { fmu: fmu(), source })?;
    Ok((Arc::new(folder), Arc::new(description)))
}

/// `file:///…` of a folder, percent-encoded; on Windows `file:///C:/…`.
pub fn file_uri(folder: &Path) -> String {
    let mut uri = String::from(if cfg!(windows) { "file:///" } else { "file://" });
    for byte in folder.as_os_str().as_encoded_bytes() {
        match byte {
            b'\\' if cfg!(windows) => uri.push('/'),
            b':' if cfg!(windows) => uri.push(':'),
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' => uri.push(char::from(*byte)),
            _ => uri += &format!("%{byte:02X}"),
        }
    }
    uri
}
