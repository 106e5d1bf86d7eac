//! Finite elements in space: beams, trusses, shells, springs, masses; their matrices and interpolation.
