//! The probe: both models under the same forces, all degrees of freedom and the reduced one.
//!
//! It is a train of axle loads that runs over the supports and trembles by ± 15 % with frequencies from 1 to 100 Hz, harder
//! than a train on a track, whose rail spreads and whose springs hold back what is fast.

use ttb_contract::finite::largest;
use ttb_dynamics::newmark::Motion;

use super::Supports;
use crate::rows::Rows;
use crate::system::{Base, Step, Work};

/// Steps of the probe.
const PROBE: usize = 160;

/// Displacements and accelerations of all rows under the probe load, step by step.
pub fn probe(step: &dyn Step, rows: &Rows, supports: Supports, unknowns: usize, h: f64) -> [Vec<f64>; 2] {
    let (mut base, mut next, mut work) = (Base::default(), Motion::default(), Work::default());
    base.motion = Motion::rest(unknowns);
    let (mut displacements, mut accelerations) = (Vec::new(), Vec::new());
    let mut forces = vec![0.0; supports.ports];
    let mut seen = vec![0.0; rows.len()];
    for n in 1..=PROBE {
        supports.load(n as f64 * h, &mut forces);
        step.begin(&mut base, &mut work);
        step.finish(&base, &forces, &mut next, &mut work);
        for (values, kept) in [(&next.u, &mut displacements), (&next.a, &mut accelerations)] {
            rows.multiply(values, &mut seen);
            kept.extend_from_slice(&seen);
        }
        std::mem::swap(&mut base.motion, &mut next);
    }
    [displacements, accelerations]
}

impl Supports<'_> {
    /// Forces of the probe at a time; in space a fifth of them across, and their moment about the track with a lever of 0.2 m.
    fn load(self, t: f64, forces: &mut [f64]) {
        let (down, others) = forces.split_at_mut(self.stations.len());
        load(self.stations, t, down);
        for (block, share) in others.chunks_mut(self.stations.len().max(1)).zip([0.2, 0.2]) {
            block.iter_mut().zip(&*down).for_each(|(force, down)| *force = share * down);
        }
    }

    /// Greatest difference relative to the greatest value, the worst of: down and monitored points, across, about the track.
    pub fn difference(self, a: &[f64], b: &[f64], rows: usize) -> f64 {
        let stations = self.stations.len();
        if self.ports == stations {
            return difference(a, b);
        }
        let block = |row: usize| if row < self.ports { row / stations.max(1) } else { 0 };
        let of = |values: &[f64], wanted: usize| -> Vec<f64> {
            let kept = values.iter().enumerate().filter(|(i, _)| block(i % rows) == wanted);
            kept.map(|(_, value)| *value).collect()
        };
        largest((0..3).map(|i| difference(&of(a, i), &of(b, i))))
    }
}

/// Forces of the probe at a time: axles of 150 kN in pairs over the whole bridge, each shared by the supports beside it.
fn load(stations: &[f64], t: f64, forces: &mut [f64]) {
    const AXLE: f64 = 150e3;
    const SPEED: f64 = 70.0;
    const PITCH: [f64; 2] = [2.5, 17.4];
    /// Of the axles' grip, s.
    const RISE: f64 = 0.02;
    const HERTZ: [f64; 10] = [1.0, 3.1, 7.7, 13.3, 21.7, 34.9, 48.1, 63.7, 81.3, 99.1];
    forces.fill(0.0);
    let ([first, ..], [.., last]) = (stations, stations) else { return };
    let mut x = first + (SPEED * t) % (PITCH[0] + PITCH[1]);
    let mut axle = 0_usize;
    while x <= *last {
        let phase = |k: usize| (1 + k * 5 + axle * 7) as f64;
        let terms = HERTZ.iter().enumerate().map(|(k, f)| (std::f64::consts::TAU * f * t + phase(k)).sin());
        let tremble = terms.sum::<f64>() / (HERTZ.len() as f64).sqrt();
        let force = AXLE * (t / RISE).min(1.0) * (1.0 + 0.15 * tremble);
        let right = stations.partition_point(|s| *s <= x).min(stations.len() - 1);
        let left = right.saturating_sub(1);
        let gap = stations[right] - stations[left];
        let share = if gap > 0.0 { ((x - stations[left]) / gap).clamp(0.0, 1.0) } else { 1.0 };
        forces[right] += share * force;
        forces[left] += (1.0 - share) * force;
        x += PITCH[axle % 2];
        axle += 1;
    }
}

/// Greatest difference relative to the greatest value; nothing differs where both are zero.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let greatest = largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    if greatest == 0.0 { 0.0 } else { greatest / largest(b.iter().map(|x| x.abs())) }
}
