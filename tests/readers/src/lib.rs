//! Every reader of foreign bytes as a function of bytes, for fuzzing (`fuzz/`) and for a short pass over its corpora.
//!
//! None may panic, hang, or take memory beyond what the bytes account for, whatever they are; what is read without a
//! complaint has to be usable. What breaks that is a panic here.

mod files;
mod models;
mod states;

pub use files::{description, map, matrices, measured, ssp, tables};
pub use models::{model, resources, scenario};
pub use states::states;

/// A target: its name, which is that of its corpus, and its function.
pub type Target = (&'static str, fn(&[u8]));

/// All of them.
pub const TARGETS: [Target; 10] = [
    ("scenario", scenario),
    ("model", model),
    ("matrices", matrices),
    ("tables", tables),
    ("measured", measured),
    ("ssp", ssp),
    ("description", description),
    ("map", map),
    ("states", states),
    ("resources", resources),
];

/// A line that separates the files of one input.
const NEXT_FILE: &[u8] = b"%%%\n";

/// The files of an input.
fn parts(bytes: &[u8]) -> Vec<&[u8]> {
    let (mut parts, mut rest) = (Vec::new(), bytes);
    while let Some(at) = rest.windows(NEXT_FILE.len()).position(|window| window == NEXT_FILE) {
        parts.push(&rest[..at]);
        rest = &rest[at + NEXT_FILE.len()..];
    }
    parts.push(rest);
    parts
}
