//! Makes finite-element models of bridges from a few numbers.
