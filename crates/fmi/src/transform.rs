//! Units and factors between the iteration and an FMU: lines through which coupled values pass.

/// `factor · x + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Scale; not 0.
    pub factor: f64,
    /// Shift.
    pub offset: f64,
}

impl Linear {
    /// What changes nothing, not a bit.
    pub const IDENTITY: Self = Self { factor: 1.0, offset: 0.0 };

    /// This line, then `next`.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        Self { factor: next.factor * self.factor, offset: next.factor * self.offset + next.offset }
    }

    /// The way back.
    #[must_use]
    pub fn inverse(self) -> Self {
        Self { factor: self.factor.recip(), offset: -self.offset / self.factor }
    }

    fn apply(self, x: f64) -> f64 {
        if self == Self::IDENTITY { x } else { self.factor * x + self.offset }
    }
}

/// The lines of all coupled variables of an FMU, and room for what passes through them.
#[derive(Default)]
pub(super) struct Transform {
    /// From the iteration to the FMU.
    inputs: Vec<Linear>,
    /// From the FMU to the iteration.
    outputs: Vec<Linear>,
    values: Vec<f64>,
    rates: Vec<f64>,
}

impl Transform {
    /// None if nothing is changed.
    pub fn new(inputs: &[Linear], outputs: &[Linear]) -> Option<Self> {
        if inputs.iter().chain(outputs).all(|line| *line == Linear::IDENTITY) {
            return None;
        }
        let room = || vec![0.0; inputs.len()];
        Some(Self { inputs: inputs.to_vec(), outputs: outputs.to_vec(), values: room(), rates: room() })
    }

    /// What the FMU gets for values of the iteration.
    pub fn values(&mut self, values: &[f64]) -> &[f64] {
        let lines = self.values.iter_mut().zip(&self.inputs).zip(values);
        lines.for_each(|((to, line), x)| *to = line.apply(*x));
        &self.values
    }

    /// What the FMU gets for rates, or for a seed: no offset.
    pub fn rates(&mut self, rates: &[f64]) -> &[f64] {
        let lines = self.rates.iter_mut().zip(&self.inputs).zip(rates);
        lines.for_each(|((to, line), x)| *to = line.factor * x);
        &self.rates
    }

    /// What the iteration gets.
    pub fn outputs(&self, outputs: &mut [f64]) {
        outputs.iter_mut().zip(&self.outputs).for_each(|(x, line)| *x = line.apply(*x));
    }

    /// What the iteration gets for changes of outputs: no offset.
    pub fn changes(&self, changes: &mut [f64]) {
        changes.iter_mut().zip(&self.outputs).for_each(|(x, line)| *x *= line.factor);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_changes_nothing_is_left_out_and_the_rest_passes_line_by_line() {
        let milli = Linear { factor: 1e-3, offset: 0.5 };
        assert!(Transform::new(&[Linear::IDENTITY], &[Linear::IDENTITY; 2]).is_none());
        let mut transform = Transform::new(&[milli, Linear::IDENTITY], &[milli]).unwrap();
        assert_eq!(transform.values(&[2000.0, -0.0]), [2.5, -0.0]);
        assert_eq!(transform.rates(&[2000.0, 3.0]), [2.0, 3.0]);
        let (mut value, mut change) = ([1000.0], [1000.0]);
        transform.outputs(&mut value);
        transform.changes(&mut change);
        assert_eq!((value, change), ([1.5], [1.0]));
    }
}
