//! linear structural dynamics.
