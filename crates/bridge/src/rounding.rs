//! Whether rounding spoils a bridge: too fine a mesh, or members much stiffer than their neighbours, are told or refused.

use ttb_contract::ModelError;
use ttb_sparse::{Condition, Factor, Pencil};

use crate::deck::Row;

/// Expected errors above this are told.
const TOLD: f64 = 1e-5;
/// Expected errors above this are refused.
const REFUSED: f64 = 1e-2;

/// What is known of a bridge under a unit force on every support (on every degree of freedom with mass, without
/// supports).
pub fn condition(pencil: &Pencil, stiffness: &Factor, supports: &[Row]) -> Option<Condition> {
    let mut load = vec![0.0; pencil.ndof()];
    supports.iter().flatten().for_each(|(dof, weight)| load[*dof as usize] += weight);
    Condition::of(pencil, stiffness, &load).or_else(|| {
        let mut load = vec![0.0; pencil.ndof()];
        pencil.add_mass(&vec![1.0; pencil.ndof()], &mut load);
        Condition::of(pencil, stiffness, &load)
    })
}

/// The condition in words.
pub fn words(condition: &Condition) -> String {
    format!(
        "the stiffness matrix has the condition {:.1e}: rounding alone makes displacements wrong by about {:.0e} of \
         themselves",
        condition.number,
        condition.error()
    )
}

/// Whether a bridge of this condition is accepted.
pub fn is_tolerable(condition: &Condition) -> bool {
    condition.error() <= REFUSED
}

/// A remark where rounding shows.
///
/// # Errors
/// Rounding spoils the results.
pub fn check(pencil: &Pencil, stiffness: &Factor, supports: &[Row]) -> Result<Option<String>, ModelError> {
    condition(pencil, stiffness, supports).map_or(Ok(None), |condition| remark(&condition))
}

/// As [`check`], for a condition that is known.
///
/// # Errors
/// As there.
pub fn remark(condition: &Condition) -> Result<Option<String>, ModelError> {
    let (error, words) = (condition.error(), words(condition));
    let advice = "use longer elements (the error of a beam grows with the fourth power of their number), or replace \
                  members much stiffer than their neighbours by links";
    if error <= TOLD {
        Ok(None)
    } else if is_tolerable(condition) {
        Ok(Some(format!("bridge: {words}; {advice}")))
    } else {
        Err(ModelError(format!("bridge: {words}, and at most {REFUSED} is accepted; {advice}")))
    }
}
