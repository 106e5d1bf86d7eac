//! What decides the result of a run, as one short word.
//!
//! ```text
//! id = first 16 hexadecimal digits of SHA-256 of the JSON of
//!      version of the program, meaning of the scenario, way, whether forces
//!      are looked at, loads of the train, variant without its name, rail, bits of v;
//!      if unusual: heading of the train, what its limits ask for;
//!      of bridges of other programs also: SHA-256 and map of each
//! ```
//!
//! Names, the order of the plan and what else it holds are not in it: more speeds or trains leave the ids of the others as they
//! are, so that nothing is computed twice.

use serde::Serialize;
use sha2::{Digest, Sha256};

/// The id of what decides a result: numbers, texts and lists of them.
pub fn of(decides: &impl Serialize) -> String {
    // There is nothing among them that cannot be written as JSON.
    let text = serde_json::to_vec(decides).unwrap_or_default();
    Sha256::digest(text).iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}
