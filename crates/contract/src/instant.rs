//! Whether a step begins where the last one has ended.
//!
//! Importers compute times in their own ways: n·h, or h added n times, whose sum is off by 2·10⁻¹¹ t after 10⁶ steps; a last
//! step of next to nothing meets a stop time. A step that is left out or made twice is off by h. With t the time asked for
//! and t_n the end of the last step, a step of h is accepted if
//!
//! ```text
//!  |t − t_n| ≤ max(τ, min(10⁻⁹ |t| + 10⁻⁶ h, h/10))
//!  |t − t_n| ≤ 10⁻⁹ max(1, |t|)                            for h < τ, a step that does nothing
//!          τ = max(10⁻¹² max(1, min(|t|, 10³ s)), 8 ε |t|) ε: rounding of a number of 1
//! ```

/// Steps shorter than this, relative to a time from 1 s to [`LONG`], succeed and do nothing (some importers end on one).
const TINY_STEP: f64 = 1e-12;
/// Beyond this time, in s, only rounding is too little for a step: a simulation may begin at a date.
const LONG: f64 = 1e3;
/// What adding up leaves of a time, relative to it.
const ADDED_UP: f64 = 1e-9;
/// What rounding leaves of a step, relative to it.
const OF_STEP: f64 = 1e-6;
/// Largest part of a step that is taken for rounding.
const LARGEST: f64 = 0.1;

/// Whether a step of `h` (s) from `t` (s) is too short to do anything.
pub fn is_nothing(t: f64, h: f64) -> bool {
    h < tiny(t)
}

fn tiny(t: f64) -> f64 {
    (TINY_STEP * t.abs().clamp(1.0, LONG)).max(8.0 * f64::EPSILON * t.abs())
}

/// Whether a step of `h` (s) from `t` (s) follows one that ended at `end` (s), but for rounding.
pub fn follows(end: f64, t: f64, h: f64) -> bool {
    let allowed = if is_nothing(t, h) {
        ADDED_UP * t.abs().max(1.0)
    } else {
        tiny(t).max((ADDED_UP * t.abs() + OF_STEP * h).min(LARGEST * h))
    };
    (t - end).abs() <= allowed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_steps_follow_each_other_whether_times_are_added_up_or_multiplied() {
        for h in [1e-4, 1e-3, 0.1 + 1e-17, 1.0 / 3.0] {
            let (mut added, mut end) = (0.0, 0.0);
            for n in 0..1_000_000 {
                let exact = f64::from(n) * h;
                assert!(follows(end, added, h) && follows(added, exact, h) && follows(exact, added, h), "{h} {n}");
                end = added + h;
                added += h;
            }
        }
    }

    #[test]
    fn a_step_left_out_or_made_twice_does_not_follow() {
        for (end, h) in [(0.0, 1e-3), (1.0, 1e-6), (1e3, 1e-4), (1e6, 1e-4), (-5.0, 0.1), (1.7e9, 1e-3)] {
            assert!(follows(end, end, h));
            assert!(!follows(end, end + h, h) && !follows(end, end - h, h), "{end} {h}");
            assert!(!follows(end, end + 0.5 * h, h), "{end} {h}");
        }
        assert!(is_nothing(1.0, 1e-13) && !is_nothing(1.7e9, 1e-3));
        assert!(!follows(0.0, 1e-3, 1e-17));
        assert!(follows(10.0, 10.0 - 1e-10, 1e-17));
    }
}
