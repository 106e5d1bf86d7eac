//! The wheels: where they stand, and how the contact of each, in series with the rail's local compliance, answers.

use ttb_train_track::law::Law;
use ttb_train_track::profile::Irregularity;
use ttb_train_track::speed::Running;
use ttb_train_track::track::{RailPoint, Track};

/// Laws and places of all axles.
#[derive(Clone)]
pub struct Wheels {
    /// Contact laws.
    pub laws: Vec<Law>,
    offsets: Vec<f64>,
    front: f64,
    running: Running,
    irregularity: Irregularity,
    /// Abscissa of the leading axle, m.
    placed: f64,
    /// Where they stand on the rail.
    pub points: Vec<RailPoint>,
    /// r there, m.
    pub roughness: Vec<f64>,
}

impl Wheels {
    /// From the laws, distances behind the leading axle, its abscissa at t = 0, the distance run and the rail's profile.
    pub fn new(laws: Vec<Law>, offsets: Vec<f64>, front: f64, running: Running, irregularity: Irregularity) -> Self {
        let n = laws.len();
        Self {
            laws,
            offsets,
            front,
            running,
            irregularity,
            placed: front,
            points: vec![RailPoint::default(); n],
            roughness: vec![0.0; n],
        }
    }

    /// Number of axles.
    pub fn len(&self) -> usize {
        self.laws.len()
    }

    /// No axles.
    pub fn is_empty(&self) -> bool {
        self.laws.is_empty()
    }

    /// Abscissa of an axle where it was put last, m.
    pub fn abscissa(&self, axle: usize) -> f64 {
        self.placed - self.offsets[axle]
    }

    /// Puts all axles where they are at time t.
    ///
    /// # Errors
    /// One is beyond the rail.
    pub fn place(&mut self, track: &Track, t: f64) -> Result<(), String> {
        self.placed = self.front + self.running.distance(t);
        for axle in 0..self.laws.len() {
            let x = self.abscissa(axle);
            let point = track.locate(x);
            self.points[axle] = point.ok_or_else(|| format!("wheel {} leaves the rail at x = {x} m", axle + 1))?;
            self.roughness[axle] = self.irregularity.at(x);
        }
        Ok(())
    }

    /// F(s) and F′(s) of the contact in series with c_loc: δ + c_loc F(δ) = s, by Newton from above, where F is convex.
    pub fn force(&self, axle: usize, s: f64) -> (f64, f64) {
        let (law, compliance) = (&self.laws[axle], self.points[axle].local_compliance);
        if compliance == 0.0 || s <= 0.0 {
            return law.force(s);
        }
        let mut delta = s;
        for _ in 0..50 {
            let (force, slope) = law.force(delta);
            let change = (delta + compliance * force - s) / (1.0 + compliance * slope);
            delta -= change;
            if change.abs() <= 1e-15 * s {
                break;
            }
        }
        let (force, slope) = law.force(delta);
        (force, slope / (1.0 + compliance * slope))
    }

    /// The load that forces on the wheels put on the rail, as degrees of freedom and numbers.
    pub fn load(&self, track: &Track, forces: &[f64], load: &mut Vec<(u32, f64)>) {
        load.clear();
        for (point, force) in self.points.iter().zip(forces) {
            let dofs = track.element_dofs(point.element);
            load.extend(dofs.iter().zip(point.row).map(|(dof, n)| (*dof as u32, n * force)));
        }
    }
}
