//! Between inputs and outputs of the model and what the march takes and sees: the ground's accelerations behind the forces, its
//! motion added to what is seen relative to it.

use ttb_dynamics::newmark::Motion;
use ttb_scenario::ground::GroundState;

use crate::ground::Ground;
use crate::interface::Held;
use crate::march::{Forces, Seen};
use crate::structure::Structure;

/// How the acceleration of a point is read.
#[derive(Clone, Copy)]
pub enum Acceleration {
    /// ü of the state.
    State,
    /// (u̇ − u̇₀)/h, where a held input is the mean.
    Mean(f64),
}

/// Inputs, and the accelerations of the ground as two more.
#[derive(Default)]
pub struct Shaken {
    /// Values.
    pub values: Vec<f64>,
    /// Rates; they stand for nothing where the inputs have none.
    pub rates: Vec<f64>,
}

impl Shaken {
    /// The accelerations run straight over the step, whatever the inputs mean.
    pub fn fill(&mut self, forces: &Forces, [begin, end]: [[f64; 2]; 2], h: f64) {
        let mean = |i: usize| 0.5 * (begin[i] + end[i]);
        let value = |i: usize| match (forces.rates, forces.held) {
            (Some(_), _) => begin[i],
            (None, Held::End) => end[i],
            (None, Held::Mean) => mean(i),
        };
        self.values.clear();
        self.values.extend(forces.values.iter().copied().chain([value(0), value(1)]));
        self.rates.clear();
        let slope = |i: usize| (end[i] - begin[i]) / h;
        self.rates.extend(forces.rates.into_iter().flatten().copied().chain([slope(0), slope(1)]));
    }
}

/// Adds the ground's motion to what is seen relative to it, in the order of the outputs.
pub fn carry(
    structure: &Structure,
    ground: &Ground,
    [begin, end]: [GroundState; 2],
    acceleration: Acceleration,
    outputs: &mut [f64],
) {
    let n = structure.stations;
    let (down, rest) = outputs.split_at_mut(2 * n);
    for (block, moved) in down.chunks_mut(n.max(1)).zip([end.displacement, end.velocity]) {
        block.iter_mut().for_each(|out| *out += moved[1]);
    }
    let accelerated = match acceleration {
        Acceleration::State => end.acceleration,
        Acceleration::Mean(h) => [0, 1].map(|i| (end.velocity[i] - begin.velocity[i]) / h),
    };
    let mut rest = rest.iter_mut();
    for (point, share) in structure.points.iter().zip(&ground.points) {
        for moved in [end.displacement, end.velocity, accelerated] {
            rest.next().into_iter().for_each(|out| *out += share[0] * moved[0] + share[1] * moved[1]);
        }
        point.moment.is_some().then(|| rest.next());
    }
    if structure.ports() > n {
        for moved in [end.displacement, end.velocity] {
            rest.by_ref().take(n).for_each(|out| *out += moved[0]);
        }
    }
}

/// Writes all outputs; `stiffness` is the factor that moments share.
pub fn read_out(structure: &Structure, stiffness: f64, seen: &Seen, acceleration: Acceleration, outputs: &mut [f64]) {
    let Motion { u, v, a } = &seen.end;
    let stations = structure.stations;
    let (displacements, outputs) = outputs.split_at_mut(stations);
    let (velocities, outputs) = outputs.split_at_mut(stations);
    displacements.copy_from_slice(&u[..stations]);
    velocities.copy_from_slice(&v[..stations]);
    let mut outputs = outputs.iter_mut();
    let mut put = |value: f64| {
        if let Some(out) = outputs.next() {
            *out = value;
        }
    };
    for point in &structure.points {
        let row = point.motion;
        put(u[row]);
        put(v[row]);
        put(match acceleration {
            Acceleration::State => a[row],
            Acceleration::Mean(h) => (v[row] - seen.velocity_before[row]) / h,
        });
        point.moment.into_iter().for_each(|row| put(stiffness * u[row]));
    }
    // Component by component: positions, then rates.
    for first in (stations..structure.ports()).step_by(stations.max(1)) {
        u[first..first + stations].iter().chain(&v[first..first + stations]).for_each(|value| put(*value));
    }
}
