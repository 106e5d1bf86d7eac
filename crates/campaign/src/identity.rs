//! What decides the result of a run, as one short word.
//!
//! ```text
//! id = first 16 hexadecimal digits of SHA-256 of the JSON of
//!      version of the program, meaning of the scenario, way, whether forces
//!      are looked at, loads of the train, variant without its name, rail, bits of v
//! ```
//!
//! Names, the order of the plan and what else it holds are not in it: more speeds or trains leave the ids of the others as they
//! are, so that nothing is computed twice.

use sha2::{Digest, Sha256};

use crate::plan::{Load, Plan, Rail, Variant};

/// The id of a run.
pub fn of(plan: &Plan, load: &Load, variant: &Variant, rail: Rail, speed_km_h: Option<f64>) -> String {
    let factors = [variant.mass_factor, variant.stiffness_factor].map(f64::to_bits);
    let all = (
        (&plan.version, &plan.scenario_sha256, plan.way, plan.forces),
        (load, factors, &variant.set, rail, speed_km_h.map(f64::to_bits)),
    );
    // Numbers, texts and lists: there is nothing that cannot be written as JSON.
    let text = serde_json::to_vec(&all).unwrap_or_default();
    Sha256::digest(text).iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}
