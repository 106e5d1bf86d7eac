//! What an element is: its matrices, and the motions that it resists.

use ttb_elements::{Beam3, Mass, Matrices, Shell3, Shell4, Spring, Truss3};

/// An element of the model, ready to give its matrices.
pub(super) enum Kind {
    Beam { beam: Box<Beam3>, released: bool },
    Truss(Truss3),
    Shell4(Box<Shell4>),
    Shell3(Box<Shell3>),
    Spring { spring: Spring, grounded: bool },
    Mass(Mass),
}

impl Kind {
    /// K and M.
    pub fn matrices(&self) -> Matrices {
        match self {
            Self::Beam { beam, .. } => beam.matrices(),
            Self::Truss(truss) => truss.matrices(),
            Self::Shell4(shell) => shell.matrices(),
            Self::Shell3(shell) => shell.matrices(),
            Self::Spring { spring, grounded: true } => spring.grounded(),
            Self::Spring { spring, grounded: false } => spring.matrices(),
            Self::Mass(mass) => mass.matrices(),
        }
    }

    /// C; springs have one.
    pub fn damping(&self) -> Vec<f64> {
        match self {
            Self::Spring { spring, grounded: true } => spring.grounded_damping(),
            Self::Spring { spring, grounded: false } => spring.damping(),
            _ => Vec::new(),
        }
    }

    /// Which of its motions it resists, or moves with: a translation with mass must be held by something, a rotation that
    /// nothing resists is left out with its inertia.
    pub fn resists(&self) -> Vec<bool> {
        let translations = |nodes: usize| [true, true, true, false, false, false].repeat(nodes);
        match self {
            Self::Beam { released: false, .. } => vec![true; 12],
            // a rotation that both ends' hinges free, or the only beam's hinge
            Self::Beam { beam, released: true } => turned(&beam.matrices()),
            Self::Truss(_) => translations(2),
            Self::Shell4(_) => vec![true; 24],
            Self::Shell3(_) => vec![true; 18],
            Self::Spring { spring, grounded } => {
                spring.stiffness.map(|k| k > 0.0).repeat(if *grounded { 1 } else { 2 })
            }
            Self::Mass(mass) if mass.mass > 0.0 => translations(1),
            Self::Mass(_) => vec![false; 6],
        }
    }
}

/// Translations, and the rotations with more than rounding of stiffness.
fn turned(matrices: &Matrices) -> Vec<bool> {
    const ROUNDING: f64 = 1e-12;
    let n = matrices.n;
    let diagonal = |i: usize| matrices.k[i * (n + 1)];
    let rotations = (0..n).filter(|i| i % 6 >= 3);
    let greatest = rotations.map(diagonal).fold(0.0, f64::max);
    (0..n).map(|i| i % 6 < 3 || diagonal(i) > ROUNDING * greatest).collect()
}
