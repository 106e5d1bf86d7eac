//! Limits of what a run may ask for, in one place: the checks of scenarios and the FMU's parameters share them.
//!
//! They lie far beyond any run that makes sense. What is beyond them is a slip (a unit, a sign, an exponent) that would
//! otherwise fill the memory or keep the program busy for days.

use std::fmt;

/// Steps of a run at most. Even at a microsecond a step they take 11 days; a double counts them exactly.
pub const MOST_STEPS: f64 = 1e12;
/// Shortest and longest step of time, s: a shorter one loses the motion in rounding, a longer one resolves none.
pub const STEP: [f64; 2] = [1e-9, 1e3];
/// Sub-steps that a scenario may give, or that are chosen for it.
pub const MOST_CHOSEN_SUBSTEPS: usize = 1000;
/// Parts that a subsystem may divide a macro step into.
pub const MOST_SUBSTEPS: usize = 1_000_000;
/// Pre-roll at most, m.
pub const LONGEST_PRE_ROLL: f64 = 1e4;
/// Steps of a pre-roll at most: some ten seconds for a car.
pub const MOST_PRE_ROLL_STEPS: f64 = 1e7;
/// Train speed at most, m/s.
pub const GREATEST_SPEED: f64 = 300.0;
/// Bays of the track at most.
pub const MOST_BAYS: usize = 1_000_000;
/// Rail elements of a bay at most.
pub const MOST_ELEMENTS_PER_BAY: usize = 20;

/// Beam elements of a span, or of a member of a frame, at most: rounding shows long before.
pub const MOST_ELEMENTS_PER_SPAN: usize = 1_000_000;

/// A limit that is not kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exceeded {
    /// What must hold.
    pub rule: String,
    /// What was found.
    pub found: String,
}

impl fmt::Display for Exceeded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.rule, self.found)
    }
}

/// The number of steps of `h` s up to `end` s.
///
/// # Errors
/// More than [`MOST_STEPS`], or no number.
pub fn steps(end: f64, h: f64) -> Result<f64, Exceeded> {
    let steps = (end / h).ceil();
    if steps <= MOST_STEPS {
        return Ok(steps);
    }
    let days = steps * 1e-6 / 86_400.0;
    let found = format!("{steps:.3e}, which take {days:.0} days even at a microsecond each");
    Err(Exceeded { rule: format!("the run must have at most {MOST_STEPS:e} steps"), found })
}

/// The number of steps of `h` s for a pre-roll of `distance` m at `speed` m/s.
///
/// # Errors
/// A train that stands, or one so slow that it takes more than [`MOST_PRE_ROLL_STEPS`].
pub fn pre_roll_steps(distance: f64, speed: f64, h: f64) -> Result<u64, Exceeded> {
    if distance <= 0.0 {
        return Ok(0);
    }
    if speed == 0.0 {
        let rule = "a pre-roll needs a speed above 0 at the start".into();
        return Err(Exceeded { rule, found: format!("{distance} m at 0 m/s") });
    }
    let steps = (distance / (speed * h)).ceil();
    if steps <= MOST_PRE_ROLL_STEPS {
        return Ok(steps as u64);
    }
    let found = format!("{steps:.3e}: {distance} m at {speed} m/s in steps of {h} s");
    Err(Exceeded { rule: format!("a pre-roll must have at most {MOST_PRE_ROLL_STEPS:e} steps"), found })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pre_roll_is_counted_and_bounded() {
        assert_eq!(pre_roll_steps(0.0, 0.0, 1e-3), Ok(0));
        assert_eq!(pre_roll_steps(500.0, 50.0, 1e-3), Ok(10_000));
        for (distance, speed, h) in [(1.0, 0.0, 1e-3), (1.0, 1e-320, 1e-3), (1e308, 1.0, 1e-3), (1.0, f64::NAN, 1e-3)] {
            assert!(pre_roll_steps(distance, speed, h).is_err(), "{distance} m at {speed} m/s");
        }
    }

    #[test]
    fn a_run_of_a_thousand_million_steps_is_allowed_and_of_more_than_a_million_million_not() {
        assert_eq!(steps(1e6, 1e-3), Ok(1e9));
        assert_eq!(steps(1e12, 1.0), Ok(1e12));
        for (end, h) in [(1e12, 0.5), (1.0, 1e-320), (1.0, 0.0), (0.0, 0.0), (f64::NAN, 1.0)] {
            assert!(steps(end, h).is_err(), "{end} s in steps of {h} s");
        }
    }
}
