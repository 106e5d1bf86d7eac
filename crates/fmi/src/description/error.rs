//! Why a description cannot be used.

/// Elements within elements: real files reach a depth of 6; vendor annotations a few more.
pub(super) const DEPTH: usize = 100;

/// Why a description cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum DescriptionError {
    /// Missing or unreadable.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// No XML.
    #[error("is not well-formed near byte {position}: {message}")]
    NotXml {
        /// Where.
        position: u64,
        /// What the parser says.
        message: String,
    },
    /// Cut short.
    #[error("ends before its last element is closed")]
    Unfinished,
    /// Elements within elements within elements …
    #[error("has elements nested more than {} deep", DEPTH)]
    TooDeep,
    /// Another document.
    #[error("has the root element {0}, not fmiModelDescription")]
    WrongRoot(String),
    /// Another version of FMI than the reader's.
    #[error("is for FMI {found:?}; only FMI {supported} is supported")]
    WrongVersion {
        /// Version in the document.
        found: String,
        /// Version the reader reads.
        supported: &'static str,
    },
    /// Model exchange only.
    #[error("has no CoSimulation element: this FMU is for model exchange only")]
    NoCoSimulation,
    /// A name or value reference with two meanings.
    #[error("is ambiguous: {0}")]
    Ambiguous(String),
    /// A necessary attribute is missing or is no number.
    #[error("{element} has no usable attribute {attribute}")]
    Attribute {
        /// Which element.
        element: String,
        /// Which attribute.
        attribute: &'static str,
    },
}
