//! Limits of what a run may ask for, in one place: the checks of scenarios and the FMU's parameters share them.
//!
//! They are far beyond any run that makes sense; what is beyond them is a slip (a unit, a sign, an exponent) that would
//! otherwise fill the memory or keep the program busy for days.

/// Steps of a run at most. At a microsecond a step, which nothing here reaches, they take 11 days; a double counts them
/// exactly.
pub const MOST_STEPS: f64 = 1e12;
/// Steps of time between these, s: a shorter one loses the motion in rounding, a longer one resolves none.
pub const STEP: [f64; 2] = [1e-9, 1e3];
/// Parts that train and track may divide a macro step into.
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

/// The number of steps of `h` s for a pre-roll of `distance` m at `speed` m/s.
///
/// # Errors
/// A train that stands, or one that is so slow that the pre-roll would take more than [`MOST_PRE_ROLL_STEPS`].
pub fn pre_roll_steps(distance: f64, speed: f64, h: f64) -> Result<u64, String> {
    if distance <= 0.0 {
        return Ok(0);
    }
    let steps = (distance / (speed * h)).ceil();
    if steps <= MOST_PRE_ROLL_STEPS {
        return Ok(steps as u64);
    }
    let found = if speed > 0.0 { format!("{distance} m at {speed} m/s in steps of {h} s") } else { "0 m/s".into() };
    Err(format!("a pre-roll needs a speed above 0 at the start and at most {MOST_PRE_ROLL_STEPS:e} steps: {found}"))
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
}
