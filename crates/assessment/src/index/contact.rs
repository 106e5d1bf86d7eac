//! Losses of contact of a wheelset: intervals in which its contact force is not positive.
//!
//! A value of the record that is not positive stands for the step that ends with it, as in the summary of a run.

/// An interval without contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// Index of the first value without contact.
    pub first: usize,
    /// Number of values without contact.
    pub count: usize,
}

impl Loss {
    /// How long, s.
    pub fn seconds(&self, rate: f64) -> f64 {
        self.count as f64 / rate
    }
}

/// All intervals of a record of contact forces.
pub fn losses(forces: &[f64]) -> Vec<Loss> {
    let mut losses: Vec<Loss> = Vec::new();
    let mut before = false;
    for (i, force) in forces.iter().enumerate() {
        let lost = *force <= 0.0;
        match losses.last_mut() {
            Some(loss) if lost && before => loss.count += 1,
            _ if lost => losses.push(Loss { first: i, count: 1 }),
            _ => {}
        }
        before = lost;
    }
    losses
}
