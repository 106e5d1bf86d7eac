//! Velocities from displacements, of a bridge that does not give them: as in the trapezoidal rule,
//!
//! ```text
//! ḋ_{n+1} = 2 (d_{n+1} − d_n)/h − ḋ_n,      ḋ_0 = 0
//! ```
//!
//! which is what a bridge that integrates by this rule (Newmark's, γ = 1/2, β = 1/4) has; it is of second order for any other.

/// Displacements and the velocities that follow from them, now and as saved.
#[derive(Clone)]
pub(super) struct Velocities {
    now: Motion,
    saved: Motion,
    /// Room for the displacements at the end of a step.
    pub end: Vec<f64>,
    /// The last step, s.
    h: f64,
    /// Whether steps are taken: during initialization there is no velocity.
    stepping: bool,
}

#[derive(Clone)]
struct Motion {
    d: Vec<f64>,
    v: Vec<f64>,
}

impl Velocities {
    /// Of `n` displacements; `h` is the size of the steps to come, s.
    pub fn new(n: usize, h: f64) -> Self {
        let rest = || Motion { d: vec![0.0; n], v: vec![0.0; n] };
        Self { now: rest(), saved: rest(), end: vec![0.0; n], h, stepping: false }
    }

    /// Begins at rest with the displacements in [`Velocities::end`].
    pub fn start(&mut self) {
        self.now.d.copy_from_slice(&self.end);
        self.now.v.fill(0.0);
        self.stepping = true;
    }

    /// After a step of `h` seconds to the displacements in [`Velocities::end`].
    pub fn step(&mut self, h: f64) {
        for ((d, v), end) in self.now.d.iter_mut().zip(&mut self.now.v).zip(&self.end) {
            (*v, *d) = (2.0 / h * (end - *d) - *v, *end);
        }
        self.h = h;
    }

    /// Displacements, then velocities; `None` during initialization.
    pub fn now(&self) -> Option<[&[f64]; 2]> {
        self.stepping.then_some([&self.now.d, &self.now.v])
    }

    /// The change of the velocities along a change of the displacements at the end of a step: its factor, 1/s.
    pub fn per_displacement(&self) -> f64 {
        2.0 / self.h
    }

    pub fn save(&mut self) {
        self.saved.d.copy_from_slice(&self.now.d);
        self.saved.v.copy_from_slice(&self.now.v);
    }

    pub fn restore(&mut self) {
        self.now.d.copy_from_slice(&self.saved.d);
        self.now.v.copy_from_slice(&self.saved.v);
    }
}
