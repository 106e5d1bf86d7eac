//! Bridges of other programs: FMUs in the place of the scenario's bridge, as a request names them and as a plan keeps them.
//!
//! ```text
//! results depend on    bytes of every FMU (SHA-256), text of its map        in every run's id
//! found again by       its path from the campaign's folder                  in no id: a folder may be moved
//! ```

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::paths::{joined, relative};

/// Name of the file beside the tables that has what runs over FMUs told: facts, what could not be made, remarks.
pub const NOTICED: &str = "assessment.json";

/// A bridge FMU as a request names it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Named {
    /// The FMU.
    pub fmu: PathBuf,
    /// Its map, a file; none: its variables have our names.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<PathBuf>,
}

/// A bridge FMU as a plan keeps it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Foreign {
    /// The FMU, from the campaign's folder.
    pub fmu: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// Name and text of its map; none: its variables have our names.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<[String; 2]>,
}

impl Foreign {
    /// Of a file and the name and text of its map, for a plan in the folder `beside`.
    ///
    /// # Errors
    /// The FMU cannot be read, a sentence.
    pub fn new(fmu: &Path, map: Option<[String; 2]>, beside: &Path) -> Result<Self, String> {
        Ok(Self { fmu: relative(fmu, beside), sha256: sha256(fmu)?, map })
    }

    /// The FMU of a plan in a folder, if its bytes are those of the plan.
    ///
    /// # Errors
    /// It cannot be read or has changed, a sentence.
    pub fn file(&self, folder: &Path) -> Result<PathBuf, String> {
        let path = joined(folder, &self.fmu);
        let now = sha256(&path)?;
        if now == self.sha256 {
            return Ok(path);
        }
        let [before, now] = [&self.sha256, &now].map(|hash| short(hash));
        Err(format!(
            "{}: the bridge FMU has changed since the plan was made (SHA-256 {before}…, now {now}…). Either put it back as it \
             was, or make the plan anew, with another folder or with --restart",
            path.display()
        ))
    }

    /// File name, hash and map for people.
    pub(crate) fn title(&self) -> String {
        let map = self
            .map
            .as_ref()
            .map_or_else(String::new, |[name, text]| format!(", map {name} SHA-256 {}…", short(&of_text(text))));
        format!("{} SHA-256 {}…{map}", self.fmu, short(&self.sha256))
    }

    /// What of it decides results.
    pub(crate) fn decides(&self) -> (&str, Option<&str>) {
        (&self.sha256, self.map.as_ref().map(|[_, text]| text.as_str()))
    }
}

/// The first digits of a hash.
pub(crate) fn short(hash: &str) -> String {
    hash.chars().take(12).collect()
}

fn sha256(path: &Path) -> Result<String, String> {
    let bytes = std::fs::read(path);
    let bytes = bytes.map_err(|error| format!("{}: the bridge FMU cannot be read: {error}", path.display()))?;
    Ok(hexadecimal(&Sha256::digest(bytes)))
}

/// SHA-256 of a text, hexadecimal.
#[must_use]
pub fn of_text(text: &str) -> String {
    hexadecimal(&Sha256::digest(text))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The FMUs of a request, for a plan in the folder `beside`.
///
/// # Errors
/// FMUs or maps that cannot be read, a line each.
pub fn read(named: &[Named], beside: &Path) -> Result<Vec<Foreign>, String> {
    let one = |one: &Named| {
        let map = one.map.as_ref().map(|path| {
            let text = ttb_scenario::read_text(path);
            let text = text.map_err(|error| format!("{}: the map cannot be read: {error}", path.display()))?;
            Ok::<_, String>([path.display().to_string(), text])
        });
        Foreign::new(&one.fmu, map.transpose()?, beside)
    };
    let (mut read, mut problems) = (Vec::new(), Vec::new());
    for found in named.iter().map(one) {
        match found {
            Ok(found) => read.push(found),
            Err(problem) => problems.push(problem),
        }
    }
    if problems.is_empty() { Ok(read) } else { Err(problems.join("\n")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_fmu_is_found_again_as_long_as_its_bytes_are_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let (fmu, map, out) = (folder.path().join("a.fmu"), folder.path().join("map.json"), folder.path().join("out"));
        std::fs::write(&fmu, "abc").unwrap();
        std::fs::write(&map, "{}").unwrap();
        let named = |fmu: &Path, map: &Path| Named { fmu: fmu.into(), map: Some(map.into()) };
        let read_ = read(&[named(&fmu, &map)], &out).unwrap();
        assert_eq!(read_[0].fmu, Path::new("..").join("a.fmu").display().to_string());
        // FIPS 180-2, B.1
        assert_eq!(read_[0].sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        assert_eq!(read_[0].map.as_ref().unwrap()[1], "{}");
        // Whether the folder is there yet or not.
        assert_eq!(std::fs::read(read_[0].file(&out).unwrap()).unwrap(), b"abc");
        std::fs::write(&fmu, "abd").unwrap();
        assert!(read_[0].file(&out).unwrap_err().contains("has changed"));
        // Both problems at once.
        let gone = folder.path().join("gone");
        let problems = read(&[named(&gone, &map), named(&fmu, &gone)], &out).unwrap_err();
        assert_eq!(problems.lines().count(), 2, "{problems}");
    }
}
