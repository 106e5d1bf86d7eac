//! Trains given as rows of vehicles: gaps and loads.
//!
//! ```text
//! buffer ─ g₁ ─ axle ─ g₂ ─ axle … axle ─ g_{n+1} ─ buffer        n axles, n + 1 gaps, m
//! ```
//!
//! Vehicles stand buffer to buffer; x counts from the first axle of the train.

use serde::Deserialize;

use crate::train::Axle;

/// Some equal vehicles.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unit {
    /// Gaps, m: one more than there are axles.
    pub gaps: Vec<f64>,
    /// Loads, kN.
    pub loads: Loads,
    /// So many of them.
    #[serde(default = "one")]
    pub count: usize,
    /// The last axle runs first.
    #[serde(default)]
    pub mirrored: bool,
}

fn one() -> usize {
    1
}

/// Loads of a vehicle's axles, kN.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Loads {
    /// All the same.
    Same(f64),
    /// One an axle.
    Each(Vec<f64>),
}

impl Unit {
    /// Number of its axles.
    fn axles(&self) -> usize {
        self.gaps.len().saturating_sub(1)
    }

    /// Load of an axle, N.
    fn load(&self, axle: usize) -> f64 {
        1e3 * match &self.loads {
            Loads::Same(load) => *load,
            Loads::Each(loads) => loads.get(axle).copied().unwrap_or(0.0),
        }
    }

    /// What is wrong with it: rule, value and where in it.
    #[must_use]
    pub fn problems(&self) -> Vec<(&'static str, String, String)> {
        let mut found = Vec::new();
        if self.gaps.len() < 2 {
            let rule = "a vehicle needs the gaps buffer – axle – … – axle – buffer, one more than it has axles";
            found.push((rule, format!("{} gaps", self.gaps.len()), "gaps".into()));
        }
        for (i, gap) in self.gaps.iter().enumerate() {
            if !(*gap >= 0.0 && *gap <= 1e3) {
                found.push(("a gap must be between 0 and 1000 m", gap.to_string(), format!("gaps[{i}]")));
            }
        }
        if let Loads::Each(loads) = &self.loads
            && loads.len() != self.axles()
        {
            let value = format!("{} loads for {} axles", loads.len(), self.axles());
            found.push(("a vehicle needs one load an axle, or one number for all", value, "loads".into()));
        }
        if !(1..=10_000).contains(&self.count) {
            found.push(("count must be from 1 to 10000", self.count.to_string(), "count".into()));
        }
        found
    }
}

/// Axles of vehicles in a row, and their length over buffers, m.
#[must_use]
pub fn axles(units: &[Unit]) -> (Vec<Axle>, f64) {
    let (mut axles, mut x) = (Vec::new(), 0.0);
    for unit in units {
        let n = unit.axles();
        for _ in 0..unit.count {
            for place in 0..unit.gaps.len() {
                let (gap, axle) = if unit.mirrored { (n - place, n.wrapping_sub(place + 1)) } else { (place, place) };
                x += unit.gaps[gap];
                if place < n {
                    axles.push(Axle { x, load: unit.load(axle) });
                }
            }
        }
    }
    let first = axles.first().map_or(0.0, |axle: &Axle| axle.x);
    axles.iter_mut().for_each(|axle| axle.x -= first);
    (axles, x)
}
