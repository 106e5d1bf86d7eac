//! Opens the files that a structure names: archives are unpacked once, with the limits that hold for FMUs.

use std::collections::HashMap;
use std::io::Read;
use std::path::{Path, PathBuf};

use ttb_fmi::archive::{UnpackError, unpack};
use ttb_fmi::temporary::Temporary;
use ttb_ssp::{Base, Files, STRUCTURE};

use crate::error::Error;

/// A document is no longer than this, bytes: pipes and devices have no end.
const LONGEST: u64 = 64 << 20;

/// Files on this computer, and the folders of the archives among them.
#[derive(Default)]
pub struct Opener {
    unpacked: HashMap<PathBuf, Temporary>,
}

impl Files for Opener {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, String> {
        let failed = |error: std::io::Error| format!("{}: {error}", path.display());
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(failed)?;
        file.take(LONGEST + 1).read_to_end(&mut bytes).map_err(failed)?;
        if bytes.len() as u64 > LONGEST {
            return Err(format!("{}: is longer than {LONGEST} bytes", path.display()));
        }
        Ok(bytes)
    }

    fn unpack(&mut self, path: &Path) -> Result<PathBuf, String> {
        if !self.unpacked.contains_key(path) {
            let folder = unpack(path).map_err(|error| match error {
                UnpackError::Archive(error) => format!("{}: is no readable zip archive: {error}", path.display()),
                other => format!("{}: {other}", path.display()),
            })?;
            self.unpacked.insert(path.to_path_buf(), folder);
        }
        Ok(self.unpacked.get(path).map(|folder| folder.path().to_path_buf()).unwrap_or_default())
    }
}

impl Opener {
    /// The document of a system structure, what its relative paths start from, and what messages call it: of an archive
    /// (.ssp), or of a document by itself (.ssd).
    pub fn document(&mut self, path: &Path) -> Result<(Vec<u8>, Base, String), Error> {
        let refused = |why: String| Error::Input(why);
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ssd")) {
            let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
            let name = format!(
                "the folder {}",
                if folder.as_os_str().is_empty() { ".".into() } else { folder.display().to_string() }
            );
            let bytes = self.read(path).map_err(refused)?;
            return Ok((bytes, Base { folder, archive: None, name }, path.display().to_string()));
        }
        let folder = unpack(path).map_err(|error| match error {
            UnpackError::Archive(error) => {
                refused(format!("{}: is no readable system structure (zip archive): {error}", path.display()))
            }
            other => refused(format!("{}: {other}", path.display())),
        })?;
        let top = folder.path().to_path_buf();
        self.unpacked.insert(path.to_path_buf(), folder);
        let document = top.join(STRUCTURE);
        if !document.is_file() {
            return Err(refused(format!("{}: has no {STRUCTURE} at its top{}", path.display(), instead(&top))));
        }
        let bytes = self.read(&document).map_err(refused)?;
        let base = Base { folder: top.clone(), archive: Some(top), name: "the archive".into() };
        Ok((bytes, base, format!("{}/{STRUCTURE}", path.display())))
    }
}

/// What an archive has where the document should be.
fn instead(top: &Path) -> String {
    let names = |folder: &Path| -> Vec<(String, PathBuf)> {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        entries.filter_map(|entry| Some((entry.file_name().into_string().ok()?, entry.path()))).collect()
    };
    for (name, path) in names(top) {
        if name.eq_ignore_ascii_case(STRUCTURE) {
            return format!(", but {name}: capitals count");
        }
        if name == "OspSystemStructure.xml" {
            return ", but OspSystemStructure.xml: this is another format, not SSP".into();
        }
        if path.join(STRUCTURE).is_file() {
            return format!(", but {name}/{STRUCTURE}: pack what is in the folder {name}, not the folder");
        }
    }
    String::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_where_the_document_should_be_is_named() {
        for (entry, said) in
            [("systemstructure.ssd", "capitals"), ("a/SystemStructure.ssd", "pack what is in the folder a")]
        {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join(entry);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, "").unwrap();
            assert!(instead(folder.path()).contains(said), "{entry}");
        }
    }
}
