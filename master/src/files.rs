//! Files that are whole or not there: written beside, under a name of their own, and renamed.

use std::fs;
use std::io::{self, Read, Write};
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::error::Error;
use crate::parts::Part;

/// Writes a file, or leaves what was there before.
pub fn write(path: &Path, content: &[u8]) -> Result<(), Error> {
    whole(path, |part| fs::File::create(part).and_then(|mut file| file.write_all(content)))
}

/// Copies a file, whole or not at all.
pub fn copy(from: &Path, to: &Path) -> Result<(), Error> {
    whole(to, |part| fs::copy(from, part).map(drop))
}

/// A file made by `make` under another name and renamed; what is left of it is removed if that fails.
pub fn whole(path: &Path, make: impl FnOnce(&Path) -> io::Result<()>) -> Result<(), Error> {
    let part = Part::of(path);
    let made = make(part.path()).and_then(|()| fs::rename(part.path(), path));
    if made.is_err() {
        // A disk that is full gets its space back; nothing more can be done if that fails, too.
        let _ = fs::remove_file(part.path());
    }
    made.map_err(Error::io(path))
}

/// Puts one text in the place of a longer or shorter one in a small file, without asking the disk for more room; what follows
/// gives way by the spaces after it. For a disk that is full: that it fails, too, is no news.
pub fn overwrite(path: &Path, from: &str, to: &str) {
    let Ok(text) = fs::read_to_string(path) else { return };
    let mut new = text.replacen(from, to, 1).trim_end().to_string();
    if new != text.trim_end() && new.len() <= text.len() {
        new += &" ".repeat(text.len() - new.len());
        let _ = fs::OpenOptions::new().write(true).open(path).and_then(|mut file| file.write_all(new.as_bytes()));
    }
}

/// Writes a value as JSON with line breaks.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Error> {
    write(path, (json(path, value)? + "\n").as_bytes())
}

/// A value as JSON with line breaks; `path` is for the message.
pub fn json(path: &Path, value: &impl serde::Serialize) -> Result<String, Error> {
    serde_json::to_string_pretty(value).map_err(|e| io::Error::other(e.to_string())).map_err(Error::io(path))
}

/// SHA-256 of a file's content, hexadecimal.
pub fn sha256(path: &Path) -> Result<String, Error> {
    let mut file = fs::File::open(path).map_err(Error::io(path))?;
    let (mut digest, mut buffer) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        let read = file.read(&mut buffer).map_err(Error::io(path))?;
        if read == 0 {
            return Ok(hexadecimal(&digest.finalize()));
        }
        digest.update(&buffer[..read]);
    }
}

/// Bytes as text, two digits each.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
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
        // It is begun, and its maker fails.
        let other = folder.path().join("b.fmu");
        assert!(whole(&other, |part| fs::write(part, "half").and(Err(io::Error::other("no library")))).is_err());
        assert_eq!(fs::read(&path).unwrap(), b"before");
        fs::remove_dir(folder.path().join("a.json.part")).unwrap();
        write_json(&path, &[1, 2]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "[\n  1,\n  2\n]\n");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
