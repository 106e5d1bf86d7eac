//! Which speeds: a grid that is common to all trains and misses no resonance.
//!
//! ```text
//! Δv = v² / (8 f₁ L)      a step shifts the last of the load cycles f₁L/v by an eighth; L from first to last axle
//! ```
//!
//! Δv of the longest train counts, in whole quarters of a km/h, from 0.25 to 5 km/h.

use crate::list::{Numbers, tidy};

/// Least and greatest step, km/h.
const STEP: [f64; 2] = [0.25, 5.0];

/// How a range is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// By the rule above, for the first natural frequency in Hz and the longest train in m.
    Auto {
        /// f₁, Hz; with variants the greatest.
        frequency: f64,
        /// L, m.
        length: f64,
    },
    /// Equal steps, km/h.
    Equal(f64),
}

/// The speeds, km/h, rising.
///
/// # Errors
/// A speed or a step that cannot be, a sentence.
pub fn speeds(wanted: &Numbers, step: Step) -> Result<Vec<f64>, String> {
    let mut speeds = match wanted {
        Numbers::These(these) => these.clone(),
        Numbers::Range([from, to]) => range(*from, *to, step)?,
    };
    if let Some(wrong) = speeds.iter().find(|speed| !(0.0 < **speed && **speed <= 1000.0)) {
        return Err(format!("a speed must be above 0 and at most 1000 km/h: {wrong}"));
    }
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    Ok(speeds)
}

fn range(from: f64, to: f64, step: Step) -> Result<Vec<f64>, String> {
    match step {
        Step::Equal(step) if !(step > 0.0 && (to - from) / step < 100_000.0) => {
            Err(format!("a step of {step} km/h must be positive and give at most 100,000 speeds"))
        }
        Step::Equal(step) => {
            let count = ((to - from) / step + 1e-9).floor() as usize;
            let mut speeds: Vec<f64> = (0..=count).map(|k| tidy(from + k as f64 * step)).collect();
            speeds.extend(speeds.last().copied().filter(|last| *last < to - 1e-9).map(|_| to));
            Ok(speeds)
        }
        Step::Auto { frequency, length } => {
            let (mut speeds, mut v) = (Vec::new(), from);
            while v < to - 1e-9 {
                speeds.push(tidy(v));
                let by_rule = 3.6 * (v / 3.6).powi(2) / (8.0 * frequency * length);
                v += ((by_rule / STEP[0] + 1e-9).floor() * STEP[0]).clamp(STEP[0], STEP[1]);
            }
            speeds.push(to);
            Ok(speeds)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_gives_steps_of_one_to_five_kilometres_an_hour() {
        let auto = Step::Auto { frequency: 3.5543, length: 397.525 };
        let speeds = speeds(&Numbers::Range([140.0, 420.0]), auto).unwrap();
        assert_eq!((speeds[0], speeds[1], speeds.last()), (140.0, 140.25, Some(&420.0)));
        for pair in speeds.windows(2) {
            let rule = 3.6 * (pair[0] / 3.6).powi(2) / (8.0 * 3.5543 * 397.525);
            assert!(pair[1] - pair[0] <= rule.max(0.25) + 1e-9, "{pair:?}");
        }
        let short = Step::Auto { frequency: 3.5543, length: 17.0 };
        let few = super::speeds(&Numbers::Range([140.0, 152.0]), short).unwrap();
        assert_eq!(few, [140.0, 145.0, 150.0, 152.0]);
    }

    #[test]
    fn equal_steps_end_at_the_end() {
        assert_eq!(speeds(&Numbers::Range([200.0, 212.0]), Step::Equal(5.0)).unwrap(), [200.0, 205.0, 210.0, 212.0]);
        assert_eq!(speeds(&Numbers::These(vec![3.0, 1.0, 3.0]), Step::Equal(5.0)).unwrap(), [1.0, 3.0]);
        assert!(speeds(&Numbers::These(vec![0.0]), Step::Equal(5.0)).is_err());
        assert!(speeds(&Numbers::Range([1.0, 2.0]), Step::Equal(0.0)).is_err());
    }
}
