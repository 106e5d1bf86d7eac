//! First trial of a step, extrapolated from the accepted forces of the steps before.

/// λ⁰ of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Predictor {
    /// λ_n.
    Constant,
    /// λ_n + (λ_n − λ_{n−1}) h/h_{n−1}.
    Linear,
}

/// The accepted forces at t_n and t_{n−1}.
#[derive(Debug)]
pub struct History {
    now: Vec<f64>,
    before: Vec<f64>,
    /// h_{n−1}; zero while there is no step before, λ_{−1} = λ_0.
    step: f64,
}

impl History {
    /// Begins with zero forces.
    pub fn new(n: usize) -> Self {
        Self { now: vec![0.0; n], before: vec![0.0; n], step: 0.0 }
    }
    /// λ_n.
    pub fn now(&self) -> &[f64] {
        &self.now
    }
    /// Begins a run with λ_0.
    pub fn start(&mut self, lambda: &[f64]) {
        self.now.copy_from_slice(lambda);
        self.before.copy_from_slice(lambda);
        self.step = 0.0;
    }
    /// λ_{n+1} was accepted after a step of `h` seconds.
    pub fn accept(&mut self, lambda: &[f64], h: f64) {
        std::mem::swap(&mut self.now, &mut self.before);
        self.now.copy_from_slice(lambda);
        self.step = h;
    }
    /// λ⁰ for a step of `h` seconds.
    pub fn predict(&self, predictor: Predictor, h: f64, lambda: &mut [f64]) {
        let ratio = if predictor == Predictor::Linear && self.step > 0.0 { h / self.step } else { 0.0 };
        for ((l, now), before) in lambda.iter_mut().zip(&self.now).zip(&self.before) {
            *l = now + ratio * (now - before);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_is_predicted_exactly_whatever_the_steps() {
        let mut history = History::new(1);
        history.start(&[1.0]);
        history.accept(&[3.0], 1.0);
        let mut lambda = [0.0];
        history.predict(Predictor::Linear, 0.5, &mut lambda);
        assert_eq!(lambda, [4.0]);
        history.predict(Predictor::Constant, 0.5, &mut lambda);
        assert_eq!(lambda, [3.0]);
    }
}
