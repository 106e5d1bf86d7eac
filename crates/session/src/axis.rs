//! The time axis of a run.

/// Equal macro steps from 0 to the end; the last one is shortened to hit it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeAxis {
    step: f64,
    end: f64,
    steps: u64,
}

/// Parts of a step that are rounding: an end within this of a whole number of steps is that number of steps.
const ROUNDING: f64 = 1e-9;

impl TimeAxis {
    /// From step and end, s, both positive.
    pub fn new(step: f64, end: f64) -> Self {
        Self { step, end, steps: (end / step - ROUNDING).ceil().max(1.0) as u64 }
    }
    /// Number of macro steps.
    pub fn steps(&self) -> u64 {
        self.steps
    }
    /// t_n = n h, never summed up; the last one is the end itself.
    pub fn time(&self, n: u64) -> f64 {
        if n >= self.steps { self.end } else { n as f64 * self.step }
    }
    /// Size of the step from t_n.
    pub fn size(&self, n: u64) -> f64 {
        let rest = self.end - self.time(n);
        if n + 1 < self.steps || (rest - self.step).abs() <= 10.0 * ROUNDING * self.step { self.step } else { rest }
    }
}

/// A time n h with 15 significant digits, as many as the product is right to: 0.009 for 0.009000000000000001. For what is
/// written; steps are taken with the product itself.
pub fn shortest(time: f64) -> f64 {
    format!("{time:.14e}").parse().unwrap_or(time)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_hits_its_end_and_never_ends_on_a_crumb() {
        let axis = TimeAxis::new(1e-3, 1.1);
        assert_eq!((axis.steps(), axis.time(1100), axis.size(1099)), (1100, 1.1, 1e-3));
        let axis = TimeAxis::new(0.3, 1.0);
        assert_eq!((axis.steps(), axis.time(4)), (4, 1.0));
        assert!((axis.size(3) - 0.1).abs() < 1e-15);
        assert_eq!(TimeAxis::new(1.0, 0.5).size(0), 0.5);
    }
}
