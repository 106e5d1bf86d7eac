//! First trial of a step, extrapolated from the accepted forces of the steps before.

use std::collections::VecDeque;

use crate::settings::Predictor;

/// Accepted forces kept at most.
const LEVELS: usize = 4;

/// The accepted forces at t_n, t_{n−1}, … of a run, or over the steps that ended there; its first one counts as one that
/// lasted for ever, λ_{−1} = λ_0.
#[derive(Debug)]
pub struct History {
    /// Forces are means over steps, and belong to their middles.
    means: bool,
    /// Newest first.
    levels: VecDeque<Vec<f64>>,
    /// Length of the step that led to each level, s; zero for λ_0.
    steps: VecDeque<f64>,
    /// Levels in use.
    known: usize,
}

impl History {
    /// Begins with zero forces: end values of steps, or means over them.
    pub fn new(n: usize, means: bool) -> Self {
        Self { means, levels: vec![vec![0.0; n]; LEVELS].into(), steps: vec![0.0; LEVELS].into(), known: 1 }
    }
    /// λ_n.
    pub fn now(&self) -> &[f64] {
        &self.levels[0]
    }
    /// Begins a run with λ_0.
    pub fn start(&mut self, lambda: &[f64]) {
        self.levels[0].copy_from_slice(lambda);
        self.known = 1;
    }
    /// λ_{n+1} was accepted after a step of `h` seconds.
    pub fn accept(&mut self, lambda: &[f64], h: f64) {
        self.levels.rotate_right(1);
        self.levels[0].copy_from_slice(lambda);
        self.steps.rotate_right(1);
        self.steps[0] = h;
        self.known = (self.known + 1).min(LEVELS);
    }

    /// λ⁰ for a step of `h` seconds, by Lagrange's formula:
    ///
    /// ```text
    /// λ⁰ = Σ_i λ_{n−i} Π_{j≠i} (h + a_j)/(a_j − a_i),   a_i = t_n − t_{n−i}
    /// ```
    ///
    /// Means stand in the middles of their steps: h is then h/2, and a_i greater by half the step that led to t_{n−i}.
    pub fn predict(&self, predictor: Predictor, h: f64, lambda: &mut [f64]) {
        let points = predictor.points().min(self.known);
        let mut age = [0.0; LEVELS];
        for i in 1..points {
            age[i] = age[i - 1] + self.steps[i - 1];
        }
        let mut ahead = h;
        if self.means {
            ahead = 0.5 * h;
            age.iter_mut().zip(&self.steps).for_each(|(age, step)| *age += 0.5 * step);
        }
        lambda.copy_from_slice(&self.levels[0]);
        for i in 1..points {
            let others = (0..points).filter(|j| *j != i);
            let weight: f64 = others.map(|j| (ahead + age[j]) / (age[j] - age[i])).product();
            // The weights sum up to 1: written as differences from λ_n, equal forces are predicted without rounding.
            for ((l, then), now) in lambda.iter_mut().zip(&self.levels[i]).zip(&self.levels[0]) {
                *l += weight * (then - now);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_is_predicted_exactly_whatever_the_steps() {
        let curve = |t: f64| [2.0 + t, 1.0 - t * t, t * t * t];
        let mut history = History::new(3, false);
        history.start(&curve(0.0));
        let mut t = 0.0;
        for h in [1.0, 0.5, 0.5, 2.0] {
            t += h;
            history.accept(&curve(t), h);
        }
        let mut lambda = [0.0; 3];
        for (predictor, exact) in [(Predictor::Linear, 1), (Predictor::Quadratic, 2), (Predictor::Cubic, 3)] {
            history.predict(predictor, 0.25, &mut lambda);
            let error = |i: usize| (lambda[i] - curve(t + 0.25)[i]).abs();
            assert!((0..exact).all(|i| error(i) < 1e-12), "{predictor:?}: {lambda:?}");
            assert!((exact..3).all(|i| error(i) > 1e-3), "{predictor:?}: {lambda:?}");
        }
        history.predict(Predictor::Constant, 0.5, &mut lambda);
        assert_eq!(lambda, curve(t));
    }

    #[test]
    fn at_the_start_of_a_run_the_first_force_is_repeated() {
        let mut history = History::new(1, false);
        history.start(&[1.0]);
        let mut lambda = [0.0];
        history.predict(Predictor::Cubic, 1.0, &mut lambda);
        assert_eq!(lambda, [1.0]);
        history.accept(&[3.0], 1.0);
        history.predict(Predictor::Cubic, 0.5, &mut lambda);
        assert_eq!(lambda, [4.0]);
    }

    #[test]
    fn means_over_steps_belong_to_their_middles() {
        // f(t) = 2 + t and its square have these means over [a, b].
        let mean = |a: f64, b: f64| [2.0 + 0.5 * (a + b), (b.powi(3) - a.powi(3)) / (3.0 * (b - a))];
        let mut history = History::new(2, true);
        // The run begins on the curve, as if it had been a mean over no time.
        history.start(&[2.0, 0.0]);
        let mut t = 0.0;
        for h in [1.0, 0.5, 0.25] {
            history.accept(&mean(t, t + h), h);
            t += h;
        }
        let mut lambda = [0.0; 2];
        history.predict(Predictor::Linear, 0.75, &mut lambda);
        assert!((lambda[0] - mean(t, t + 0.75)[0]).abs() < 1e-12, "{lambda:?}");
        history.predict(Predictor::Constant, 0.75, &mut lambda);
        assert_eq!(lambda, mean(t - 0.25, t));
    }
}
