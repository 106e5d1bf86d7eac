//! Reads M, C and K written by other finite-element programs.
