//! What a deck in space does to the track: twist and horizontal rotation, from the motions under the supports.
//!
//! ```text
//! twist      s |φ(x + 3 m) − φ(x)|, s = 1.435 m, between supports straight       m on 3 m
//! rotation   |d_y,2 − d_y,1|/(x₂ − x₁) of the outermost two supports at each end   rad
//! ```

use super::{Place, Record, Reduced};
use crate::filter::RAW;
use crate::peak::quantity::{DECK_HORIZONTAL_ROTATION, DECK_TWIST};
use crate::peak::{Peak, PlaceKind, Statistic};

/// Gauge and length that a twist is measured over, m.
const GAUGE: f64 = 1.435;
const BASE: f64 = 3.0;

/// Motions of the deck under the supports; empty unless the run is in space and keeps them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Supports {
    /// Where they stand, m from the begin of the bridge, rising.
    pub x: Vec<f64>,
    /// Rotation about the track, rad, of each.
    pub rotation: Vec<Vec<f64>>,
    /// Displacement to the right, m, of each.
    pub lateral: Vec<Vec<f64>>,
}

pub(super) fn reduce(supports: &Supports, record: Record, out: &mut Reduced) {
    let Supports { x, rotation, lateral } = supports;
    let known =
        |motion: &Vec<Vec<f64>>| motion.len() == x.len() && motion.iter().all(|one| one.len() == record.time.len());
    if x.len() >= 2 && known(rotation) {
        let mut worst: Option<(f64, usize, usize)> = None;
        for (i, from) in x.iter().enumerate() {
            let to = from + BASE;
            let after = x.partition_point(|place| *place < to);
            if after == x.len() {
                break;
            }
            let share = (to - x[after - 1]) / (x[after] - x[after - 1]);
            let ahead = rotation[after - 1].iter().zip(&rotation[after]).map(|(a, b)| a + share * (b - a));
            for (n, (ahead, here)) in ahead.zip(&rotation[i]).enumerate() {
                let twist = GAUGE * (ahead - here).abs();
                if worst.is_none_or(|(most, ..)| twist > most) {
                    worst = Some((twist, i, n));
                }
            }
        }
        out.peaks.extend(worst.map(|(value, i, n)| row(DECK_TWIST, "m", value, x[i], record.time[n])));
    }
    if x.len() >= 2 && known(lateral) {
        let last = x.len() - 1;
        for (from, to) in [(0, 1), (last - 1, last)] {
            let slope = |n: usize| ((lateral[to][n] - lateral[from][n]) / (x[to] - x[from])).abs();
            let at = (0..record.time.len()).max_by(|a, b| slope(*a).total_cmp(&slope(*b))).unwrap_or(0);
            let place = if from == 0 { x[0] } else { x[last] };
            out.peaks.push(row(DECK_HORIZONTAL_ROTATION, "rad", slope(at), place, record.time[at]));
        }
    }
}

fn row(quantity: &'static str, unit: &'static str, value: f64, x: f64, time: f64) -> Peak {
    let place = Place { quantity, kind: PlaceKind::Deck, name: format!("{x}"), unit };
    Peak { x: Some(x), time: Some(time), ..place.row(RAW, Statistic::AbsMax, value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// φ = k x t: the twist over 3 m is s · 3 k t everywhere; d_y = c t x bends nothing and turns by c t.
    #[test]
    fn twist_and_rotation_of_a_deck_that_turns_evenly_are_known() {
        let x: Vec<f64> = (0..12).map(|i| 0.65 * f64::from(i)).collect();
        let time: Vec<f64> = (0..50).map(|n| 0.01 * f64::from(n)).collect();
        let (k, c) = (2e-4, -3e-4);
        let of = |factor: f64| x.iter().map(|x| time.iter().map(|t| factor * x * t).collect()).collect();
        let supports = Supports { x: x.clone(), rotation: of(k), lateral: of(c) };
        let mut out = Reduced::default();
        reduce(&supports, Record::of(&time).expect("equal steps"), &mut out);
        let [twist, front, rear] = &out.peaks[..] else { panic!("{:?}", out.peaks) };
        assert!((twist.value / (1.435 * 3.0 * k * 0.49) - 1.0).abs() < 1e-12, "{twist:?}");
        for end in [front, rear] {
            assert!((end.value / (3e-4 * 0.49) - 1.0).abs() < 1e-12, "{end:?}");
        }
    }
}
