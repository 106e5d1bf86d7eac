//! Mean comfort of EN 12299, vertical part.
//!
//! ```text
//! C_Cz  = rms of the weighted acceleration over each 5 s
//! N_MVZ = 6 · (95 % of the C_Cz)            at least 60 blocks, 5 minutes
//! ```

use super::{count, rms};
use crate::error::{SignalError, finite};
use crate::percentile::percentile;

/// Length of a block, s.
pub const BLOCK: f64 = 5.0;
/// The least length of a record for the mean comfort, s.
pub const NMV_LEAST: f64 = 300.0;

/// C_Cz of every whole block, of a weighted record.
///
/// # Errors
/// A value is not finite.
pub fn block_rms(weighted: &[f64], rate: f64) -> Result<Vec<f64>, SignalError> {
    finite(weighted)?;
    Ok(weighted.chunks_exact(count(BLOCK, rate)).map(rms).collect())
}

/// N_MVZ of a weighted record.
///
/// # Errors
/// The record is shorter than five minutes, or a value is not finite.
pub fn n_mv(weighted: &[f64], rate: f64) -> Result<f64, SignalError> {
    let blocks = block_rms(weighted, rate)?;
    let too_short = || SignalError::TooShort {
        what: "N_MV of EN 12299",
        needed: NMV_LEAST,
        found: weighted.len() as f64 / rate,
        unit: "s",
    };
    if (blocks.len() as f64) < NMV_LEAST / BLOCK {
        return Err(too_short());
    }
    percentile(&blocks, 95.0).map(|p| 6.0 * p).ok_or_else(too_short)
}
