//! reference methods.
