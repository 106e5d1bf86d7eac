//! Where the axles stand: abscissae, points of the rail, irregularity under them.

use crate::profile::Irregularity;
use crate::speed::Running;
use crate::track::{RailPoint, Track};

/// Places of all axles.
#[derive(Clone, Debug)]
pub struct Wheels {
    /// Distance of every axle behind the leading one, m.
    offsets: Vec<f64>,
    /// Abscissa of the leading axle at t = 0, m.
    front: f64,
    /// Speed over time since the start.
    pub running: Running,
    /// Rail irregularity.
    pub irregularity: Irregularity,
    /// Points of the rail where they were found last.
    pub points: Vec<RailPoint>,
    /// r there, m, with `raised`.
    pub roughness: Vec<f64>,
    /// What the contact of every axle is away from its place at D = 0, m: g(D) of a run in space, else 0.
    pub raised: Vec<f64>,
}

impl Wheels {
    /// Axles at the distances `offsets` behind the leading one, which stands at `front` at t = 0.
    pub fn new(offsets: Vec<f64>, front: f64, running: Running, irregularity: Irregularity) -> Self {
        let n = offsets.len();
        let (points, roughness) = (vec![RailPoint::default(); n], vec![0.0; n]);
        Self { offsets, front, running, irregularity, points, roughness, raised: vec![0.0; n] }
    }

    /// Abscissa of an axle at time `t` after the start, m.
    pub fn position(&self, axle: usize, t: f64) -> f64 {
        self.front + self.running.distance(t) - self.offsets[axle]
    }

    /// Finds every axle on the rail at time `t`.
    ///
    /// # Errors
    /// A wheel beyond the ends of the rail.
    pub fn locate(&mut self, track: &Track, t: f64) -> Result<(), String> {
        for axle in 0..self.points.len() {
            let x = self.position(axle, t);
            self.points[axle] = on_rail(track, axle, x, t)?;
            self.roughness[axle] = self.irregularity.at(x) + self.raised[axle];
        }
        Ok(())
    }

    /// Reads the irregularity under every axle at time `t`, on the rail or before it.
    pub fn roll_over(&mut self, t: f64) {
        for axle in 0..self.roughness.len() {
            self.roughness[axle] = self.irregularity.at(self.position(axle, t));
        }
    }
}

/// The point of the rail on which an axle stands at time `t`.
///
/// # Errors
/// It is beyond the ends of the rail.
pub fn on_rail(track: &Track, axle: usize, x: f64, t: f64) -> Result<RailPoint, String> {
    track.locate(x).ok_or_else(|| {
        let (wheel, (from, to)) = (axle + 1, track.extent());
        format!("wheel {wheel} leaves the rail at t = {t} s: x = {x} m, the rail lies from {from} m to {to} m")
    })
}
