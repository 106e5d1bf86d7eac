//! Files that are whole or not there: written beside, under a name of their own, and renamed.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use crate::error::Error;

/// Ending of a file that is being written.
pub const PART: &str = ".part";

/// Writes a file, or leaves what was there before.
pub fn write(path: &Path, content: &[u8]) -> Result<(), Error> {
    let mut name = path.as_os_str().to_os_string();
    name.push(PART);
    let part = Path::new(&name);
    let written =
        fs::File::create(part).and_then(|mut file| file.write_all(content)).and_then(|()| fs::rename(part, path));
    if written.is_err() {
        // A disk that is full gets its space back; nothing more can be done if that fails, too.
        let _ = fs::remove_file(part);
    }
    written.map_err(Error::io(path))
}

/// Writes a value as JSON with line breaks.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Error> {
    let text = serde_json::to_string_pretty(value).map_err(|e| io::Error::other(e.to_string()));
    write(path, (text.map_err(Error::io(path))? + "\n").as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_cannot_be_written_leaves_no_part_of_it_and_the_one_of_before() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        write(&path, b"before").unwrap();
        // The name of the part is taken by a folder.
        fs::create_dir(folder.path().join("a.json.part")).unwrap();
        assert!(write(&path, b"after").is_err());
        assert_eq!(fs::read(&path).unwrap(), b"before");
        fs::remove_dir(folder.path().join("a.json.part")).unwrap();
        write_json(&path, &[1, 2]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "[\n  1,\n  2\n]\n");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
