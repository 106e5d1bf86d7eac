//! An FMU file: unpacked, described, its library loaded.

use super::description::ModelDescription;
use super::error::FmuError;
use super::instance::FmuInstance;
use super::library::Functions;
use super::reader::{DescriptionError, read_description};
use super::unpack::unpack;
#[cfg(target_os = "linux")]
use crate::import::messages::Sink;
#[cfg(target_os = "linux")]
use crate::isolate::Remote;
use crate::isolate::{self, Isolation};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// An FMU ready to be instantiated. Instances keep what they need of it alive.
pub struct Fmu {
    description: Arc<ModelDescription>,
    home: Home,
}

/// Where instances will live.
enum Home {
    /// In this process.
    Here(Arc<Loaded>),
    /// Each in a process of its own, which loads the library.
    Apart { fmu: PathBuf, folder: Arc<TempDir>, isolation: Isolation },
}

/// What an instance needs to stay: first the library is closed, then its folder removed.
pub(crate) struct Loaded {
    pub functions: Functions,
    pub folder: Folder,
}

/// Where an FMU is unpacked.
pub(crate) enum Folder {
    /// Removed with this.
    Ours(TempDir),
    /// Another process looks after it.
    Theirs(PathBuf),
}

impl Folder {
    pub fn path(&self) -> &Path {
        match self {
            Self::Ours(folder) => folder.path(),
            Self::Theirs(folder) => folder,
        }
    }
}

impl Fmu {
    /// Unpacks, reads, loads.
    ///
    /// # Errors
    /// No usable FMI 2.0 co-simulation FMU for this machine; the error says what is wrong with it.
    pub fn open(path: &Path) -> Result<Self, FmuError> {
        let (folder, description) = unpacked(path)?;
        let functions = Functions::load(folder.path(), &description.co_simulation.model_identifier);
        let functions = functions.map_err(|source| FmuError::Library { fmu: path.to_path_buf(), source })?;
        let loaded = Arc::new(Loaded { functions, folder: Folder::Ours(folder) });
        Ok(Self { description: Arc::new(description), home: Home::Here(loaded) })
    }

    /// Unpacks and reads; every instance is going to have a process of its own, which loads the library then.
    ///
    /// # Errors
    /// No FMI 2.0 co-simulation FMU, or this system has no isolation.
    pub fn open_isolated(path: &Path, isolation: &Isolation) -> Result<Self, FmuError> {
        if !isolate::AVAILABLE {
            let (instance, what) = (path.display().to_string(), "FMUs can be isolated on Linux only".to_string());
            return Err(FmuError::Impossible { instance, what });
        }
        let (folder, description) = unpacked(path)?;
        let (fmu, folder, isolation) = (path.to_path_buf(), Arc::new(folder), isolation.clone());
        Ok(Self { description: Arc::new(description), home: Home::Apart { fmu, folder, isolation } })
    }

    /// What the FMU says of itself.
    pub fn description(&self) -> &ModelDescription {
        &self.description
    }

    /// The folder the FMU is unpacked in.
    pub fn folder(&self) -> &Path {
        match &self.home {
            Home::Here(loaded) => loaded.folder.path(),
            Home::Apart { folder, .. } => folder.path(),
        }
    }

    /// A new instance; `logging` asks the FMU for its debug messages too.
    ///
    /// # Errors
    /// The FMU gives none.
    pub fn instantiate(&self, name: &str, logging: bool) -> Result<FmuInstance, FmuError> {
        let description = Arc::clone(&self.description);
        match &self.home {
            Home::Here(loaded) => FmuInstance::local(name, description, Arc::clone(loaded), logging),
            #[cfg(target_os = "linux")]
            Home::Apart { fmu, folder, isolation } => {
                let (sink, folder) = (Sink::new(), Arc::clone(folder));
                let started = Remote::start(name, fmu, &description, folder, isolation, logging, &sink);
                started.map(|(slave, time)| FmuInstance::new(name, description, Box::new(slave), time, sink))
            }
            #[cfg(not(target_os = "linux"))]
            Home::Apart { fmu, isolation, .. } => Self::open_isolated(fmu, isolation)?.instantiate(name, logging),
        }
    }
}

fn unpacked(path: &Path) -> Result<(TempDir, ModelDescription), FmuError> {
    let fmu = || path.to_path_buf();
    let folder = unpack(path).map_err(|source| FmuError::Unpack { fmu: fmu(), source })?;
    let xml = std::fs::read(folder.path().join("modelDescription.xml"));
    let description = xml.map_err(Into::into).and_then(|xml| read_description(&xml));
    let description = description.and_then(|d: ModelDescription| match d.ambiguity() {
        None => Ok(d),
        Some(what) => Err(DescriptionError::Ambiguous(what)),
    });
    let description = description.map_err(|source| FmuError::Description { fmu: fmu(), source })?;
    Ok((folder, description))
}

/// `file:///…` of a folder, percent-encoded.
pub fn file_uri(folder: &Path) -> String {
    let mut uri = String::from("file://");
    for byte in folder.as_os_str().as_encoded_bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' => uri.push(char::from(*byte)),
            _ => uri += &format!("%{byte:02X}"),
        }
    }
    uri
}
