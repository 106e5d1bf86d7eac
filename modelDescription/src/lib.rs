//! What an FMU says about itself: from one interface list to modelDescription.xml, GUID, documentation and archive.
//!
//! [`guid()`] identifies an interface, [`xml()`] describes it, [`documentation`] explains it to people, and
//! [`package::pack`] puts everything into a file that any FMI 2.0 co-simulation importer loads. The export shell
//! computes the same GUID from the model it has loaded, so that a binary refuses the description of another.

pub mod about;
pub mod date;
pub mod documentation;
pub mod guid;
pub mod package;
pub mod units;
pub mod xml;

pub use about::About;
pub use date::Date;
pub use guid::guid;
pub use package::{Contents, Libraries, PackError, pack};
pub use xml::{XmlError, xml};
