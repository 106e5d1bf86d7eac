//! Where a file is that a document names: a URI (RFC 3986) relative to the document, or one that begins with `file:`.
//!
//! Inside an archive a relative path never leads out of it. Nothing is fetched from elsewhere.

use std::path::{Path, PathBuf};

use crate::types::Source;

/// What relative paths start from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Base {
    /// The folder of the document.
    pub folder: PathBuf,
    /// How far up a path may lead: the folder of the archive; `None`: the document lies by itself, and it may lead anywhere.
    pub archive: Option<PathBuf>,
    /// What messages call the folder.
    pub name: String,
}

/// A URI taken apart.
///
/// # Errors
/// What it is instead of the name of a file.
pub fn source(uri: &str) -> Result<Source, String> {
    let refused = |why: &str| Err(format!("is {uri:?}: {why}"));
    if let Some((scheme, rest)) = scheme(uri) {
        if scheme.len() == 1 {
            return refused(
                "this is a path of Windows; name the file by its path relative to the document, with slashes",
            );
        }
        if !scheme.eq_ignore_ascii_case("file") {
            return refused("nothing is fetched from elsewhere; name a file by its path relative to the document");
        }
        // file:/a, file:///a and file://localhost/a are the same.
        let path = rest.strip_prefix("//").map_or(rest, |rest| rest.strip_prefix("localhost").unwrap_or(rest));
        return if path.starts_with('/') { plain(path, uri) } else { refused("it names another computer") };
    }
    plain(uri, uri)
}

/// A path that may be percent-encoded and may name a document within an archive.
fn plain(path: &str, uri: &str) -> Result<Source, String> {
    let refused = |why: &str| Err(format!("is {uri:?}: {why}"));
    let (path, variant) = path.split_once('#').map_or((path, None), |(path, variant)| (path, Some(variant)));
    if path.contains('?') {
        return refused("only a file can be named");
    }
    let decode = |text: &str| decoded(text).map(|text| text.replace('\\', "/"));
    let (Some(text), variant) = (decode(path), variant.map(decode)) else {
        return refused("a percent sign that encodes nothing");
    };
    if text.contains('\0') || text.trim().is_empty() {
        return refused("it names no file");
    }
    let raw = (text != path).then(|| path.to_string());
    Ok(Source { path: text, raw, variant: variant.flatten(), in_component: false })
}

/// `file` and `///a` of `file:///a`, where a URI begins with a scheme.
fn scheme(uri: &str) -> Option<(&str, &str)> {
    let (scheme, rest) = uri.split_once(':')?;
    let letters = scheme.starts_with(|c: char| c.is_ascii_alphabetic())
        && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c));
    letters.then_some((scheme, rest))
}

/// Without percent encoding.
fn decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = uri.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(if byte == b'%' {
            let mut digit = || char::from(rest.next()?).to_digit(16);
            u8::try_from(16 * digit()? + digit()?).ok()?
        } else {
            byte
        });
    }
    String::from_utf8(bytes).ok()
}

impl Base {
    /// The file that a source names, whether it exists or not.
    ///
    /// # Errors
    /// It would lead out of the archive.
    pub fn path(&self, source: &Source) -> Result<PathBuf, String> {
        let whole = source.path.starts_with('/');
        let mut path = if whole { PathBuf::from("/") } else { self.folder.clone() };
        let floor = if whole { None } else { self.archive.as_deref() };
        let begin = path.clone();
        for part in source.path.split('/').filter(|part| !part.is_empty() && *part != ".") {
            if cfg!(windows) && part.contains(':') {
                // A drive, `/C:/folder`; anywhere else it would lead to one.
                if !(whole && path == begin && part.len() == 2 && part.ends_with(':')) {
                    return Err(format!("is {:?}: a name with a colon", source.path));
                }
                path = PathBuf::from(format!("{part}\\"));
            } else if part != ".." {
                path.push(part);
            } else if floor == Some(path.as_path()) || !path.pop() {
                return Err(format!("is {:?}: it leads out of the archive", source.path));
            }
        }
        if path == begin { Err(format!("is {:?}: it names no file", source.path)) } else { Ok(path) }
    }

    /// The file that a source names and that is there: as decoded, else as written.
    ///
    /// # Errors
    /// There is none; a file whose name differs in capitals only is named.
    pub fn find(&self, source: &Source) -> Result<PathBuf, String> {
        let path = self.path(source)?;
        let raw = source.raw.as_ref().map(|raw| self.path(&Source::inside(raw.replace('\\', "/"))));
        let candidates = std::iter::once(path.clone()).chain(raw.into_iter().flatten());
        if let Some(found) = candidates.into_iter().find(|path| path.is_file()) {
            return Ok(found);
        }
        let like = like(&path).map_or_else(String::new, |like| format!(" (there is {like}: capitals count)"));
        Err(format!("{} has no file {}{like}", self.name, source.path))
    }
}

/// A file beside the missing one whose name differs in capitals only.
fn like(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?.to_lowercase();
    let beside = std::fs::read_dir(path.parent()?).ok()?.flatten().map(|entry| entry.file_name());
    beside.filter_map(|other| other.into_string().ok()).find(|other| other.to_lowercase() == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn in_archive(uri: &str) -> Result<PathBuf, String> {
        let folder = PathBuf::from("/tmp/a");
        Base { archive: Some(folder.clone()), folder, name: "the archive".into() }.path(&source(uri)?)
    }

    #[test]
    fn a_relative_source_stays_inside_the_archive() {
        let inside = |path: &str| Ok(PathBuf::from("/tmp/a").join(path));
        assert_eq!(in_archive("resources/My%20Bridge.fmu"), inside("resources/My Bridge.fmu"));
        assert_eq!(in_archive("./resources//a.fmu"), inside("resources/a.fmu"));
        assert_eq!(in_archive("resources/../a.fmu"), inside("a.fmu"));
        assert_eq!(in_archive("resources\\a.fmu"), inside("resources/a.fmu"));
        for hostile in ["../a.fmu", "a/../../b.fmu", "%2e%2e/a.fmu", "..\\a.fmu", "..%5ca.fmu"] {
            assert!(in_archive(hostile).is_err_and(|why| why.contains("leads out of the archive")), "{hostile}");
        }
        for odd in ["", ".", "%zz", "http://x/a.fmu", "proxyfmu://localhost?file=a.fmu", "C:\\a.fmu", "file://pc/a.fmu"]
        {
            assert!(in_archive(odd).is_err(), "{odd}");
        }
    }

    #[test]
    fn a_file_elsewhere_is_named_by_a_whole_uri_and_a_document_by_itself_may_look_around() {
        for uri in ["file:///b/My%20a.fmu", "file:/b/My%20a.fmu", "file://localhost/b/My%20a.fmu"] {
            assert_eq!(in_archive(uri), Ok("/b/My a.fmu".into()));
        }
        let beside = Base { folder: "/tmp/a".into(), archive: None, name: "the folder".into() };
        assert_eq!(beside.path(&source("../b.fmu").unwrap()), Ok("/tmp/b.fmu".into()));
        assert_eq!(source("b.ssp#Variant%20B.ssd").unwrap().variant.as_deref(), Some("Variant B.ssd"));
    }
}
