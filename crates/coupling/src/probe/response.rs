//! From what forces did to a deck in trial steps to what is wrong with its signs and units.

use std::ops::Range;

use ttb_contract::finite::largest;
use ttb_contract::{Parts, Ports};

/// Masses a support that some bridge might have, kg: light decks have 60 kg under a support, heavy ones 130 t; a factor
/// of a thousand leads out of this.
pub const CREDIBLE: Range<f64> = 50.0..2e5;
/// Factor by which displacement and velocity may disagree: integrators differ, and decks are not free masses.
const AGREE: f64 = 5.0;
/// S_ij² may exceed S_ii S_jj by this factor, and S_ij and S_ji may differ by this part of √(S_ii S_jj).
const PASSIVE: f64 = 1.2;
const RECIPROCAL: f64 = 0.2;
/// What of S is noise, relative to its largest entry.
const NOISE: f64 = 1e-3;
/// A deck that is displaced by less than this times the first step's displacement after the last does not move on.
const MOVES_ON: f64 = 3.0;

/// What forces did to one deck.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Its forces, by position.
    pub forces: Range<usize>,
    /// m_d and m_v, kg a support; infinite where nothing moves.
    pub mass: [f64; 2],
    /// Forces that were also tried alone.
    pub probed: Vec<usize>,
    /// S_ij, displacement at `probed[i]` by a force at `probed[j]` after some steps, m/N, by rows; zero where it was not tried.
    pub compliance: Vec<f64>,
    step: usize,
    /// Whether the deck moves on under a force that stays, as a mass does. One that is stiff for the step is at rest after
    /// the first: what it shows is stiffness, and seems a mass without bound.
    moves_on: bool,
}

/// What is wrong with a deck's variables.
#[derive(Clone, Debug, PartialEq)]
pub enum Mismatch {
    /// Displacement (0) or velocity (1) does not move under forces.
    Still(usize),
    /// Force and both motions do not fit: they are too large by this factor, negative for opposite signs.
    Together(f64),
    /// Displacement (0) or velocity (1) alone is too large by this factor.
    Alone(usize, f64),
    /// One of the two, it cannot be said which: displacement is too large by this factor, or velocity too small.
    OneOf(f64),
    /// A displacement, by position, goes against its own force, others do not.
    Against(usize),
    /// Two supports, by position, answer each other's forces as those of no deck do: the order of forces and motions differs.
    Mixed(usize, usize),
}

impl Response {
    /// Of the forces `group` from a run under `load` and one without.
    pub(crate) fn new(
        ports: &Ports,
        group: Range<usize>,
        load: &[f64],
        loaded: &[Vec<f64>],
        base: &[Vec<f64>],
        h: f64,
    ) -> Self {
        let squares: f64 = load[group.clone()].iter().map(|v| v * v).sum();
        // Σ v Δd and Σ v Δḋ after k steps.
        let work = |part: fn(Parts<&[f64]>) -> &[f64], k: usize| -> f64 {
            let (loaded, base) = (part(ports.parts(&loaded[k])), part(ports.parts(&base[k])));
            group.clone().map(|i| load[i] * (loaded[i] - base[i])).sum()
        };
        let (mut mass, mut step) = ([f64::INFINITY; 2], 0);
        let steps = if ports.complete() { loaded.len() } else { 0 };
        let displaced: Vec<f64> = (0..steps).map(|k| work(|motion| motion.positions, k).abs()).collect();
        let moves_on = match displaced[..] {
            // A free mass goes five times as far in the second step, and 25 times in the fourth.
            [first, .., last] => last > MOVES_ON * first,
            _ => true,
        };
        for k in 0..steps {
            let count = (k + 1) as f64;
            let m_d = squares * h * h * (0.5 * count * count - 0.5 * count + 0.25) / work(|motion| motion.positions, k);
            let m_v = squares * h * (count - 0.5) / work(|motion| motion.rates, k);
            if m_d.abs() < mass[0].abs() {
                (mass[0], step) = (m_d, k);
            }
            if m_v.abs() < mass[1].abs() {
                mass[1] = m_v;
            }
        }
        let probed = probed(&group);
        Self { compliance: vec![0.0; probed.len() * probed.len()], forces: group, mass, probed, step, moves_on }
    }

    /// Adds what the force at `probed[j]` did.
    pub(crate) fn add(&mut self, j: usize, single: &[f64], answer: &[Vec<f64>], base: &[Vec<f64>]) {
        let Some(at) = self.probed.get(j) else { return };
        for (i, to) in self.probed.iter().enumerate() {
            self.compliance[i * self.probed.len() + j] = (answer[self.step][*to] - base[self.step][*to]) / single[*at];
        }
    }

    /// What is wrong, if anything is.
    pub fn mismatch(&self) -> Option<Mismatch> {
        let [m_d, m_v] = self.mass;
        for (which, mass) in self.mass.iter().enumerate() {
            if !mass.is_finite() {
                return Some(Mismatch::Still(which));
            }
        }
        let credible = |mass: f64| CREDIBLE.contains(&mass) || !self.moves_on && mass >= CREDIBLE.start;
        // Displacements are so many times too large, if velocities are right.
        let excess = m_v / m_d;
        if excess > 0.0 && (AGREE.recip()..AGREE).contains(&excess) {
            let middle = m_d.signum() * (m_d.abs() * m_v.abs()).sqrt();
            return if credible(middle) { self.order() } else { Some(Mismatch::Together(thousands(middle))) };
        }
        match (credible(m_d), credible(m_v)) {
            (false, true) => Some(Mismatch::Alone(0, power(excess))),
            (true, false) => Some(Mismatch::Alone(1, power(excess.recip()))),
            _ => Some(Mismatch::OneOf(power(excess))),
        }
    }

    /// Whether single forces and motions belong to each other: S is symmetric and positive for every deck.
    fn order(&self) -> Option<Mismatch> {
        let n = self.probed.len();
        let s = |i: usize, j: usize| self.compliance[i * n + j];
        let pairs = || (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
        if self.compliance.iter().all(|s| *s == 0.0) {
            return None;
        }
        let largest = largest((0..n).map(|i| s(i, i).abs()));
        if let Some(i) = (0..n).find(|i| s(*i, *i) < -NOISE * largest) {
            return Some(Mismatch::Against(self.probed[i]));
        }
        let odd = |(i, j): &(usize, usize)| {
            let (across, own) = (s(*i, *j) * s(*j, *i), s(*i, *i) * s(*j, *j));
            let largest = s(*i, *j).abs().max(s(*j, *i).abs());
            across.abs() > PASSIVE * own || (s(*i, *j) - s(*j, *i)).abs() > RECIPROCAL * own.sqrt().max(largest)
        };
        pairs().find(odd).map(|(i, j)| Mismatch::Mixed(self.probed[j], self.probed[i]))
    }
}

/// A handful: two neighbours in the middle, which tell an order that is shifted, and two far apart, which tell one that is
/// reversed.
fn probed(group: &Range<usize>) -> Vec<usize> {
    let n = group.len();
    let mut few: Vec<usize> = [n / 5, n / 2, n / 2 + 1, n - n / 5 - 1].into_iter().filter(|i| *i < n).collect();
    few.dedup();
    few.iter().map(|i| group.start + i).collect()
}

/// The power of ten next to a factor, with its sign.
fn power(factor: f64) -> f64 {
    factor.signum() * 10.0_f64.powi(factor.abs().log10().round() as i32)
}

/// By how much motions are too large that show such a mass: ±1000 and the like, or −1 if only the sign is wrong.
fn thousands(mass: f64) -> f64 {
    let credible = |e: &i32| CREDIBLE.contains(&(mass.abs() * 10.0_f64.powi(*e)));
    let exponent = [0, 3, -3, 6, -6, 9, -9].into_iter().find(credible);
    let middle = (CREDIBLE.start * CREDIBLE.end).sqrt();
    let exponent = exponent.unwrap_or_else(|| (middle / mass.abs()).log10().round() as i32);
    mass.signum() * 10.0_f64.powi(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn response(m_d: f64, m_v: f64) -> Response {
        Response { forces: 0..1, mass: [m_d, m_v], probed: vec![0], compliance: vec![0.0], step: 0, moves_on: true }
    }

    #[test]
    fn a_deck_that_is_stiff_for_the_step_is_no_wrong_unit() {
        // d = F/k after the first step and on: k h²/4 and k h²/2 for masses.
        let stiff = Response { moves_on: false, ..response(6e6, 1.2e7) };
        assert_eq!(stiff.mismatch(), None);
        assert_eq!(Response { mass: [-6e6, -1.2e7], ..stiff }.mismatch(), Some(Mismatch::Together(-1e-3)));
        assert_eq!(response(6e6, 1.2e7).mismatch(), Some(Mismatch::Together(1e-3)));
    }

    #[test]
    fn every_wrong_sign_and_unit_of_a_usual_bridge_is_told_apart() {
        for mass in [300.0, 6e3, 3e4] {
            let mismatch = |d: f64, v: f64| response(mass / d, mass / v).mismatch();
            assert_eq!(mismatch(1.0, 1.0), None);
            assert_eq!(mismatch(0.5, 1.0), None); // half a step of delay, another integrator
            assert_eq!(mismatch(-1.0, -1.0), Some(Mismatch::Together(-1.0)));
            assert_eq!(mismatch(-1.0, 1.0), Some(Mismatch::Alone(0, -1.0)));
            assert_eq!(mismatch(1.0, -1.0), Some(Mismatch::Alone(1, -1.0)));
            assert_eq!(mismatch(1e3, 1e3), Some(Mismatch::Together(1e3)));
            assert_eq!(mismatch(-1e3, -1e3), Some(Mismatch::Together(-1e3)));
            assert_eq!(mismatch(1e-3, 1e-3), Some(Mismatch::Together(1e-3)));
            assert_eq!(mismatch(1.0, 0.0), Some(Mismatch::Still(1)));
        }
        assert_eq!(response(6.0, 6e3).mismatch(), Some(Mismatch::Alone(0, 1e3)));
        assert_eq!(response(6e3, -6.0).mismatch(), Some(Mismatch::Alone(1, -1e3)));
        assert_eq!(response(6e6, 6e3).mismatch(), Some(Mismatch::Alone(0, 1e-3)));
        assert_eq!(response(f64::INFINITY, 6e3).mismatch(), Some(Mismatch::Still(0)));
        // Both masses are credible, or neither is, and they contradict each other: it is one of the two.
        assert_eq!(response(6e2, 6e3).mismatch(), Some(Mismatch::OneOf(10.0)));
        assert_eq!(response(6e-3, 6.0).mismatch(), Some(Mismatch::OneOf(1e3)));
    }

    #[test]
    fn a_single_displacement_against_its_own_force_is_found() {
        let mut response = response(6e3, 6e3);
        (response.probed, response.compliance) = (vec![4, 10], vec![1.0, 0.2, 0.2, -1.0]);
        assert_eq!(response.mismatch(), Some(Mismatch::Against(10)));
        response.compliance = vec![1.0, 0.2, 0.2, 1.0];
        assert_eq!(response.mismatch(), None);
    }

    #[test]
    fn an_order_that_is_shifted_or_reversed_is_found() {
        // A deck that answers within some supports only.
        let s = |i: usize, j: usize| 0.7_f64.powi(i.abs_diff(j) as i32);
        let answer = |order: &dyn Fn(usize) -> usize| {
            let mut response = response(6e3, 6e3);
            response.probed = probed(&(0..20));
            assert_eq!(response.probed, [4, 10, 11, 15]);
            let rows = response.probed.iter().flat_map(|i| [4, 10, 11, 15].map(|j| s(order(*i), j)));
            response.compliance = rows.collect();
            response.mismatch()
        };
        assert_eq!(answer(&|i| i), None);
        assert_eq!(answer(&|i| i + 1), Some(Mismatch::Mixed(10, 11)));
        assert_eq!(answer(&|i| 19 - i), Some(Mismatch::Mixed(4, 10)));
    }
}
