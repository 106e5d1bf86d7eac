//! Files that documents name.

/// A file that a document names: relative to the document, or by its whole path.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// The path, decoded, with slashes.
    pub path: String,
    /// The path as it was written, where percent signs in it were decoded: some tools do not encode.
    pub raw: Option<String>,
    /// Which document inside an archive, if not the usual one.
    pub variant: Option<String>,
    /// Whether it is relative to the component's file, not to the document.
    pub in_component: bool,
}

impl Source {
    /// A path inside the archive.
    pub fn inside(path: impl Into<String>) -> Self {
        Self { path: path.into(), ..Self::default() }
    }
}

impl std::fmt::Display for Source {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.path)
    }
}
