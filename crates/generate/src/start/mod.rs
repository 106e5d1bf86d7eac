//! First files of a project: a scenario that runs at once, whose comments say what to put in place of each number.
//!
//! Numbers that were not asked for are typical of railway bridges, not of anybody's: n₀ the geometric mean of the limits of
//! EN 1991-2 figure 6.10 (known from memory of the standard), 12 t/m, 1 % damping.

mod fmu;
mod matrices;

use crate::error::{Refused, Rules};

/// A file: its name and its text.
pub type File = (&'static str, String);

/// Name of the scenario.
pub const SCENARIO: &str = "scenario.json";
/// Mass of a span that says nothing, kg/m.
const MASS: f64 = 12_000.0;

/// What a beginner knows of a bridge.
#[derive(Clone, Debug)]
pub struct Start {
    /// Lengths of the spans, m.
    pub spans: Vec<f64>,
    /// Whether they are one beam.
    pub continuous: bool,
    /// First natural frequency, Hz.
    pub n0: Option<f64>,
    /// kg/m, dead loads included.
    pub mass: Option<f64>,
    /// A bundled train.
    pub train: String,
    /// km/h.
    pub speed: f64,
}

impl Start {
    /// The first frequency in use, Hz.
    pub fn frequency(&self) -> f64 {
        self.n0.unwrap_or_else(|| usual_frequency(self.spans.iter().copied().fold(0.0, f64::max)))
    }

    /// The mass in use, kg/m.
    pub fn mass(&self) -> f64 {
        self.mass.unwrap_or(MASS)
    }

    /// # Errors
    /// All numbers that no bridge has.
    fn check(&self) -> Result<(), Refused> {
        let mut rules = Rules::default();
        rules.demand(!self.spans.is_empty(), "a bridge has spans", "none");
        for length in &self.spans {
            rules.demand((1.0..=500.0).contains(length), "spans must be from 1 to 500 m long", format!("{length} m"));
        }
        let numbers = [("n0", self.n0, "Hz"), ("mass", self.mass, "kg/m"), ("speed", Some(self.speed), "km/h")];
        for (name, value, unit) in numbers {
            let value = value.unwrap_or(1.0);
            let rule = format!("{name} must be greater than 0");
            rules.demand(value > 0.0 && value.is_finite(), &rule, format!("{value} {unit}"));
        }
        rules.result()
    }
}

/// Between the limits of EN 1991-2 figure 6.10 for a span of L m: 94.76 L^−0.748 above, 80/L (to 20 m) or 23.58 L^−0.592
/// below.
fn usual_frequency(length: f64) -> f64 {
    let lower = if length <= 20.0 { 80.0 / length } else { 23.58 * length.powf(-0.592) };
    let mean = (lower * 94.76 * length.powf(-0.748)).sqrt();
    // Two digits: it is a guess.
    format!("{mean:.1e}").parse().unwrap_or(mean)
}

/// Spans of beams.
///
/// # Errors
/// Numbers that no bridge has.
pub fn beams(start: &Start) -> Result<Vec<File>, Refused> {
    start.check()?;
    let (n0, mass) = (start.frequency(), start.mass());
    let guessed = start.n0.is_none();
    let note = if guessed { ", here between the limits of EN 1991-2 figure 6.10: put yours" } else { "" };
    let of_span = if start.continuous { String::new() } else { format!(", \"first_frequency\": {n0}") };
    let spans =
        start.spans.iter().map(|length| format!("        {{ \"length\": {length}, \"mass\": {mass}{of_span} }}"));
    let spans = spans.collect::<Vec<_>>().join(",\n");
    let (continuous, whole) = if start.continuous {
        (" \"continuous\": true,", format!(" \"first_frequency\": {n0},"))
    } else {
        ("", String::new())
    };
    let structure = format!(
        r#"{{
      "$comment": "Lengths in m; mass in kg/m with ballast and dead loads; first_frequency in Hz{note}, or bending_stiffness in N m².",
      "type": "beams",{continuous}{whole}
      "spans": [
{spans}
      ]
    }}"#
    );
    Ok(vec![(SCENARIO, scenario(start, &title(start), &structure))])
}

fn title(start: &Start) -> String {
    let spans = start.spans.iter().map(ToString::to_string).collect::<Vec<_>>().join(" + ");
    format!("{} at {} km/h over {spans} m", start.train, start.speed)
}

/// A scenario around a structure.
fn scenario(start: &Start, title: &str, structure: &str) -> String {
    let Start { train, speed, .. } = start;
    format!(
        r#"{{
  "$comment": "ttb run {SCENARIO}; ttb check-scenario {SCENARIO}; every key: docs/guide/scenario.md. What is left out is chosen and printed.",
  "title": "{title}",
  "train": {{
    "$comment": "ttb list cars, ttb list trains: what there is.",
    "cars": ["{train}"],
    "speed": {{ "km_h": {speed} }}
  }},
  "track": {{
    "$comment": "slab, ballast-zhai or ballast-two-layer; ttb list tracks.",
    "type": "slab"
  }},
  "irregularity": {{
    "$comment": "Leave this section out for a smooth rail. Another seed is another rail of the same quality.",
    "type": "spectrum", "spectrum": "german-low", "seed": 1, "wavelengths": [3, 80]
  }},
  "bridge": {{
    "structure": {structure},
    "damping": {{
      "$comment": "Ratio of critical damping. EN 1991-2 table 6.6, lower bounds: steel 0.005, prestressed 0.01, reinforced 0.015; more below 20 m.",
      "type": "rayleigh", "ratio": 0.01
    }}
  }}
}}
"#
    )
}

pub use fmu::fmu;
pub use matrices::matrices;
