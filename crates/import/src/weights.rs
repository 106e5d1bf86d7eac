//! Whether a support moves with the deck: the sum of its weights on translations is 1, or −1 where the axis points up.
//!
//! ```text
//! s_d = Σ w over the rows of direction d (all rows count as one direction where directions are unknown)
//! the support moves as far as the deck where |Σ_d s_d| = 1 or √(Σ_d s_d²) = 1 (a deck at an angle to the axes)
//! ```
//!
//! A table that was pasted twice has sums of 2, one that lost every other line sums of ½; either way forces and
//! displacements would be wrong by that factor, and the deflection by its square.

use crate::dofs::Dofs;
use crate::problem::Report;
use crate::rows::{NEAR, Row};

/// So far from 1 a sum may be: weights of few digits, a deck at a small angle.
const SLACK: f64 = 0.05;

/// Notes supports whose weights do not add up.
pub(crate) fn weights(supports: &[(f64, Row)], dofs: Option<&Dofs>, report: &mut Report) {
    let sums: Vec<(f64, Option<f64>)> = supports.iter().map(|(x, row)| (*x, sum(row, dofs))).collect();
    let known = || sums.iter().filter_map(|(x, sum)| Some((*x, (*sum)?)));
    let up = known().filter(|(_, sum)| *sum < 0.0).count();
    let usual = if 2 * up > known().count() { -1.0 } else { 1.0 };
    let odd: Vec<(f64, f64)> = known().filter(|(_, sum)| (sum - usual).abs() > SLACK).collect();
    let Some(&(x, sum)) = odd.first() else { return };
    let alike = odd.iter().all(|(_, other)| (other - sum).abs() < NEAR);
    let all =
        if odd.len() == supports.len() { "all".to_owned() } else { format!("{} of {}", odd.len(), supports.len()) };
    let what = if alike {
        format!("{sum} at {all} supports, first at x = {x} m")
    } else {
        format!("{sum} at x = {x} m, others elsewhere; {all} supports are so")
    };
    let near = |value: f64| (sum.abs() - value).abs() < 1e-3;
    let slip = if near(2.0) || near(3.0) {
        ": are its lines in the table more than once?"
    } else if near(0.5) {
        ": is a line with the other half missing?"
    } else if (sum + usual).abs() < SLACK {
        ": has it the wrong sign?"
    } else {
        ""
    };
    let unknown = if dofs.is_none() {
        "; every row counts as a translation, as no file `dofs` says which are rotations"
    } else {
        ""
    };
    let rule = "the weights of a support must add up to 1 (-1 if the axis points up), to 0 only over a bearing";
    report.whole(rule, format!("{what}{slip}{unknown}"));
}

/// Sum of the weights with its sign; none for a support without weights on translations, which does not move.
fn sum(row: &Row, dofs: Option<&Dofs>) -> Option<f64> {
    let mut sums = [0.0; 3];
    let mut any = false;
    for &(dof, weight) in row {
        let freedom = dofs.and_then(|dofs| dofs.dofs.get(dof as usize)).map_or(0, |dof| usize::from(dof.freedom));
        if let Some(sum) = sums.get_mut(freedom) {
            *sum += weight;
            any |= weight != 0.0;
        }
    }
    let total: f64 = sums.iter().sum();
    let length = sums.iter().map(|sum| sum * sum).sum::<f64>().sqrt();
    let nearest = if (length - 1.0).abs() < (total.abs() - 1.0).abs() { length.copysign(total) } else { total };
    any.then_some(nearest)
}
