//! A shared library as a file, before the loader sees it.

use elf::ElfStream;
use elf::abi::{ELFMAGIC, PT_LOAD};
use elf::endian::AnyEndian;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// What keeps a library from being loaded safely. The loader maps a file that is cut off and dies by SIGBUS when it reads
/// behind its end. Whatever else is wrong, the loader says itself.
pub fn damage(path: &Path) -> Option<String> {
    let file = File::open(path).ok()?;
    let length = file.metadata().ok()?.len();
    if length == 0 {
        return Some("it is an empty file".into());
    }
    let image = match ElfStream::<AnyEndian, _>::open_stream(file) {
        Ok(image) => image,
        Err(_) if !is_elf(path) => return None,
        Err(error) => return Some(format!("it is cut off or damaged: {error}")),
    };
    let parts = image.segments().iter().filter(|part| part.p_type == PT_LOAD);
    let needed = parts.map(|part| part.p_offset.saturating_add(part.p_filesz)).max()?;
    (needed > length).then(|| format!("it is cut off: it has {length} bytes of at least {needed}"))
}

/// Whether a file begins as such a library does.
fn is_elf(path: &Path) -> bool {
    let mut begin = [0; 4];
    File::open(path).and_then(|mut file| file.read_exact(&mut begin)).is_ok() && begin == ELFMAGIC
}

#[cfg(test)]
mod tests {
    use super::damage;

    #[test]
    fn a_library_that_ends_too_early_is_seen_wherever_it_ends_and_a_whole_one_is_not() {
        let whole = std::fs::read(std::env::current_exe().unwrap()).unwrap();
        let file = tempfile::NamedTempFile::new().unwrap();
        for (part, found) in [(0, true), (1, true), (40, true), (50, true), (99, true), (100, false)] {
            std::fs::write(file.path(), &whole[..whole.len() * part / 100]).unwrap();
            // What comes last, names of functions, is not mapped.
            let seen = damage(file.path()).is_some();
            assert!(seen == found || part == 99, "{part} %");
        }
        // What is no library at all, the loader says.
        std::fs::write(file.path(), "#!/bin/sh").unwrap();
        assert_eq!(damage(file.path()), None);
    }
}
