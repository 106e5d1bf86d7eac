//! An FMU file: unpacked, described, its library loaded.

use super::description::ModelDescription;
use super::error::FmuError;
use super::instance::FmuInstance;
use super::library::Functions;
use super::reader::read_description;
use super::unpack::unpack;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// An FMU ready to be instantiated. Instances keep what they need of it alive.
pub struct Fmu {
    description: Arc<ModelDescription>,
    loaded: Arc<Loaded>,
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
        let fmu = || path.to_path_buf();
        let folder = unpack(path).map_err(|source| FmuError::Unpack { fmu: fmu(), source })?;
        let xml = std::fs::read(folder.path().join("modelDescription.xml"));
        let description = xml.map_err(Into::into).and_then(|xml| read_description(&xml));
        let description = description.map_err(|source| FmuError::Description { fmu: fmu(), source })?;
        let functions = Functions::load(folder.path(), &description.co_simulation.model_identifier);
        let functions = functions.map_err(|source| FmuError::Library { fmu: fmu(), source })?;
        Ok(Self {
            description: Arc::new(description),
            loaded: Arc::new(Loaded { functions, folder: Folder::Ours(folder) }),
        })
    }

    /// What the FMU says of itself.
    pub fn description(&self) -> &ModelDescription {
        &self.description
    }

    /// The folder the FMU is unpacked in.
    pub fn folder(&self) -> &Path {
        self.loaded.folder.path()
    }

    /// A new instance; `logging` asks the FMU for its debug messages too.
    ///
    /// # Errors
    /// The FMU gives none.
    pub fn instantiate(&self, name: &str, logging: bool) -> Result<FmuInstance, FmuError> {
        FmuInstance::local(name, self.description.clone(), self.loaded.clone(), logging)
    }
}

/// `file:///…` of a folder, percent-encoded.
pub(super) fn file_uri(folder: &Path) -> String {
    let mut uri = String::from("file://");
    for byte in folder.as_os_str().as_encoded_bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' => uri.push(char::from(*byte)),
            _ => uri += &format!("%{byte:02X}"),
        }
    }
    uri
}
