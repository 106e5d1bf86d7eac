//! Whether rounding spoils a bridge: too fine a mesh, or members much stiffer than their neighbours, are told or refused.

use std::ops::Range;

use ttb_contract::ModelError;
use ttb_sparse::{Condition, Factor, Pencil};

use crate::deck::Row;

/// Expected errors above this are told.
const TOLD: f64 = 1e-5;
/// Expected errors above this are refused.
const REFUSED: f64 = 1e-2;

/// A unit force on every support, or on every degree of freedom with mass, whichever does work first.
fn loads(pencil: &Pencil, supports: &[Row]) -> [Vec<f64>; 2] {
    let mut loads = [vec![0.0; pencil.ndof()], vec![0.0; pencil.ndof()]];
    supports.iter().flatten().for_each(|(dof, weight)| loads[0][*dof as usize] += weight);
    pencil.add_mass(&vec![1.0; pencil.ndof()], &mut loads[1]);
    loads
}

/// What is known of a bridge under a unit force on every support (on every degree of freedom with mass, without
/// supports).
pub fn condition(pencil: &Pencil, stiffness: &Factor, supports: &[Row]) -> Option<Condition> {
    loads(pencil, supports).iter().find_map(|load| Condition::of(pencil, stiffness, load))
}

/// A matrix written with few digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Digits {
    /// So many significant digits its file has.
    pub digits: u32,
    /// By how much the last of them moves displacements, relative; frequencies move by half of it.
    pub error: f64,
}

/// What the digits of K leave of displacements under unit forces; `None` for K in full precision, and for numbers so short
/// that they are surely meant as they stand.
///
/// ```text
/// δK_ij    uniform within half a unit of the last digit u_ij: standard deviation u_ij/√12
/// δ(xᵀKx) / xᵀKx = √(Σ_g (u_g Σ_ij ±x_i x_j)²/12) / xᵀKx,   entries of the amount g were rounded alike; twice that is told
/// ```
///
/// For K of 50 equal beam elements this is 5e-4 with 10 digits and 5e-2 with 8; found were 4e-4 and 4e-2.
#[must_use]
pub fn of_digits(pencil: &Pencil, stiffness: &Factor, supports: &[Row], digits: Option<u32>) -> Option<Digits> {
    /// So many digits hold a double as well as rounding in a factor does; with so few, numbers are exact.
    const JUDGED: Range<u32> = 3..15;
    /// Twice the standard deviation of a uniform distribution of width 1.
    const SPREAD: f64 = 0.577_350_269_189_625_8;
    let digits = digits.filter(|digits| JUDGED.contains(digits))?;
    let last = |k: f64| if k == 0.0 { 0.0 } else { 10.0_f64.powf(k.abs().log10().floor() + 1.0 - f64::from(digits)) };
    let mut scratch = vec![0.0; pencil.ndof()];
    loads(pencil, supports).iter().find_map(|load| {
        let mut x = load.clone();
        stiffness.solve_in_place(&mut x, &mut scratch);
        let work: f64 = load.iter().zip(&x).map(|(f, x)| f * x).sum();
        let error = SPREAD * pencil.stiffness_errors(&x, last) / work.abs();
        (work != 0.0).then_some(Digits { digits, error })
    })
}

impl Digits {
    /// A remark where it shows.
    #[must_use]
    pub fn remark(&self) -> Option<String> {
        /// Smaller errors are not told.
        const TOLD: f64 = 1e-3;
        let words = match self.error {
            error if error < 0.3 => {
                format!("moves displacements by about {:.1e} of themselves and frequencies by half of that", error)
            }
            _ => "leaves nothing of the displacements".to_owned(),
        };
        (self.error > TOLD).then(|| {
            format!(
                "bridge: the stiffness matrix is written with {} digits, and the last of them {words}: let the other \
                 program write 16 digits",
                self.digits
            )
        })
    }
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
