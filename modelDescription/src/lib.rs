//! modelDescription.xml and FMU packaging.
