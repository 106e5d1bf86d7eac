//! Where the resources of an FMU are: the many ways importers say it.

use crate::platform::{NETWORK_PATHS, library_of, path};
use std::ffi::CStr;
use std::path::PathBuf;

/// The folder an importer means by its `fmuResourceLocation`.
///
/// Understood are `file:///p`, `file:/p`, `file:////p`, `file://localhost/p`, each percent-encoded or not, with and
/// without a trailing slash, and a plain path. A missing or empty location means the `resources` folder of the unpacked
/// FMU that the code at address `code` was loaded from. Whether the folder is any good, the model finds out.
pub fn resource_folder(location: Option<&CStr>, code: usize) -> PathBuf {
    let location = location.map_or(&b""[..], CStr::to_bytes).trim_ascii();
    if location.is_empty() {
        return beside_library(code);
    }
    let Some(rest) = strip_scheme(location) else {
        return path(location).into_owned();
    };
    let raw = local_path(rest);
    let decoded = percent_decode(&raw);
    // An importer that does not encode may pass a folder whose name merely looks encoded.
    let unencoded = !path(&decoded).exists() && path(&raw).exists();
    path(if unencoded { &raw } else { &decoded }).into_owned()
}

fn strip_scheme(location: &[u8]) -> Option<&[u8]> {
    let (scheme, rest) = location.split_at_checked(5)?;
    scheme.eq_ignore_ascii_case(b"file:").then_some(rest)
}

/// The path of a file URI without its scheme: an authority other than `localhost` can only be the first folder of a
/// URI with a slash too few, since the resources are on this machine; on Windows it may be that of a folder in the network.
fn local_path(rest: &[u8]) -> Vec<u8> {
    let host = rest.strip_prefix(b"//").and_then(|host| host.split(|b| *b == b'/').next()).unwrap_or_default();
    if NETWORK_PATHS && !host.is_empty() && host != b"localhost" && host.get(1) != Some(&b':') {
        return rest.to_vec();
    }
    let slashes = rest.iter().take_while(|b| **b == b'/').count();
    let path = &rest[slashes..];
    let path = match path.strip_prefix(b"localhost") {
        Some(after) if slashes == 2 && after.first() == Some(&b'/') => &after[1..],
        _ => path,
    };
    [b"/", path].concat()
}

/// `%20` → space; a `%` that no two hexadecimal digits follow stays as it is.
fn percent_decode(text: &[u8]) -> Vec<u8> {
    let digit = |i: usize| text.get(i).and_then(|b| char::from(*b).to_digit(16));
    let mut out = Vec::with_capacity(text.len());
    let mut i = 0;
    while let Some(&byte) = text.get(i) {
        match (byte, digit(i + 1), digit(i + 2)) {
            (b'%', Some(high), Some(low)) => {
                out.push((16 * high + low) as u8);
                i += 3;
            }
            _ => {
                out.push(byte);
                i += 1;
            }
        }
    }
    out
}

/// `<fmu>/binaries/<platform>/<library>` → `<fmu>/resources`; an empty path where the library's file is not known.
fn beside_library(code: usize) -> PathBuf {
    let library = library_of(code);
    let root = library.as_deref().and_then(|library| library.ancestors().nth(3));
    root.map(|root| root.join("resources")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn folder(location: &CStr) -> String {
        resource_folder(Some(location), 0).to_string_lossy().into_owned()
    }

    #[test]
    fn every_form_of_a_file_uri_leads_to_the_same_folder() {
        for uri in [
            c"file:///tmp/a",
            c"file:/tmp/a",
            c"file:////tmp/a",
            c"file://localhost/tmp/a",
            c"FILE:///tmp/a",
            c"file://tmp/a",
        ] {
            assert_eq!(folder(uri), "/tmp/a", "{uri:?}");
        }
        assert_eq!(Path::new(&folder(c"file:///tmp/a/")), Path::new("/tmp/a"));
        assert_eq!(folder(c"/tmp/a"), "/tmp/a");
        assert_eq!(folder(c"C"), "C");
    }

    #[test]
    fn percent_encoding_is_undone_in_uris_only() {
        assert_eq!(folder(c"file:///tmp/my%20fmu%2fa%C3%A4"), "/tmp/my fmu/a\u{e4}");
        assert_eq!(folder(c"file:///tmp/100%/a%2"), "/tmp/100%/a%2");
        assert_eq!(folder(c"/tmp/my%20fmu"), "/tmp/my%20fmu");
    }

    #[test]
    fn a_folder_whose_name_looks_encoded_is_found() {
        let folder_with_percent = std::env::temp_dir().join(format!("ttb%20{}", std::process::id()));
        std::fs::create_dir_all(&folder_with_percent).unwrap();
        let uri = std::ffi::CString::new(format!("file://{}", folder_with_percent.display())).unwrap();
        assert_eq!(resource_folder(Some(&uri), 0), folder_with_percent);
        std::fs::remove_dir(&folder_with_percent).unwrap();
    }

    #[test]
    fn without_a_location_the_resources_lie_beside_the_library() {
        let here = std::env::current_exe().unwrap();
        let expected = here.ancestors().nth(3).unwrap().join("resources");
        let code = without_a_location_the_resources_lie_beside_the_library as *const () as usize;
        assert_eq!(resource_folder(None, code), expected);
        assert_eq!(resource_folder(Some(c""), code), expected);
        assert_eq!(resource_folder(None, 0), Path::new(""));
    }
}
