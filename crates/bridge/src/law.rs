//! Stiffness, mass and damping under the parameters in force, and how many modes the damping needs.

use ttb_contract::ModelError;
use ttb_dynamics::damping::rayleigh;
use ttb_dynamics::newmark::Newmark;
use ttb_scenario::types::{Damping, RayleighAt};

/// Stiffness, mass and damping under the parameters in force.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Factor k on the stiffness.
    pub stiffness: f64,
    /// Factor m on the mass.
    pub mass: f64,
    /// Rayleigh's α, 1/s.
    pub alpha: f64,
    /// Rayleigh's β, s.
    pub beta: f64,
    /// 2ζω of the lowest modes, 1/s; empty without modal damping.
    pub rates: Vec<f64>,
}

impl Law {
    /// c_K = k(1 + a₁β) and c_M = m(a₀ + a₁α): K̂ = c_K K₀ + c_M M₀ + a₁C₀.
    pub fn effective(&self, newmark: &Newmark) -> [f64; 2] {
        let [a0, a1, ..] = newmark.a;
        [self.stiffness * (1.0 + a1 * self.beta), self.mass * (a0 + a1 * self.alpha)]
    }

    /// α′, γ′ and kβ/c_K of [`crate::full`], with which a step's right-hand side needs no product with K₀.
    pub fn history(&self, newmark: &Newmark) -> [f64; 3] {
        let [c_k, c_m] = self.effective(newmark);
        let share = self.stiffness * self.beta / c_k;
        [self.alpha - c_m / self.mass * share, 1.0 - newmark.a[1] * share, share]
    }
}

/// The damping ratio ζ of a specification.
pub fn ratio(damping: &Damping) -> f64 {
    match damping {
        Damping::None => 0.0,
        Damping::Rayleigh { ratio, .. } | Damping::Modal { ratio, .. } => *ratio,
    }
}

/// Stiffness, mass and damping for a ratio and factors; `omega2` are the ω² of as many modes as [`modes_needed`] says,
/// without factors.
///
/// # Errors
/// A ratio on a bridge without damping, or frequencies that are not positive.
pub fn law(damping: &Damping, omega2: &[f64], ratio: f64, stiffness: f64, mass: f64) -> Result<Law, ModelError> {
    let omega: Vec<f64> = omega2.iter().map(|w2| (w2 * stiffness / mass).sqrt()).collect();
    let mode = |number: usize| {
        let omega = number.checked_sub(1).and_then(|j| omega.get(j)).copied();
        omega.ok_or_else(|| ModelError(format!("bridge: Rayleigh damping at mode {number}; modes are counted from 1")))
    };
    let (mut alpha, mut beta, mut rates) = (0.0, 0.0, Vec::new());
    match damping {
        Damping::None if ratio != 0.0 => {
            return Err(ModelError(format!("damping_ratio is {ratio}; on a bridge of damping type none it must be 0")));
        }
        Damping::None => {}
        Damping::Rayleigh { at, .. } => {
            let pair = match at {
                RayleighAt::Hz(pair) => pair.map(|hz| std::f64::consts::TAU * hz),
                RayleighAt::Modes([i, j]) => [mode(*i)?, mode(*j)?],
                RayleighAt::FirstTimes(multiple) => [mode(1)?, multiple * mode(1)?],
            };
            if !pair.iter().all(|omega| *omega > 0.0 && omega.is_finite()) {
                return Err(ModelError("bridge: the two frequencies of Rayleigh damping must be positive".into()));
            }
            (alpha, beta) = rayleigh(ratio, pair);
        }
        Damping::Modal { modes, .. } => rates = omega.iter().take(*modes).map(|omega| 2.0 * ratio * omega).collect(),
    }
    Ok(Law { stiffness, mass, alpha, beta, rates })
}

/// How many modes are needed: by the damping, and as coordinates if there are to be so many.
pub fn modes_needed(damping: &Damping, coordinates: Option<usize>) -> usize {
    let damping = match damping {
        Damping::Rayleigh { at: RayleighAt::Modes(pair), .. } => pair[0].max(pair[1]),
        Damping::Rayleigh { at: RayleighAt::FirstTimes(_), .. } => 1,
        Damping::Modal { modes, .. } if coordinates.is_none() => *modes,
        _ => 0,
    };
    damping.max(coordinates.unwrap_or(0))
}
