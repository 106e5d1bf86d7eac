//! Motions of a deck at places of interest, recorded under names of ours: displacement and velocity by interpolation from its
//! own places, acceleration as the mean over the step,
//!
//! ```text
//! d = W d′,   ḋ = W ḋ′,   d̈ = (ḋ_{n+1} − ḋ_n)/h
//! ```
//!
//! which is what a bridge under held forces has.

use ttb_contract::Signal;

use crate::adapters::stations::Stations;

/// A place of interest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// What the names of its quantities begin with: `point[mid]`.
    pub name: String,
    /// Whether its acceleration is of interest, too.
    pub acceleration: bool,
}

/// Places of interest and their motion: now, at the begin of the step, as saved.
#[derive(Clone)]
pub struct Watch {
    /// From the deck's own places.
    at: Stations,
    places: Vec<Place>,
    /// Displacements, then velocities.
    now: Vec<f64>,
    before: Vec<f64>,
    saved: Vec<f64>,
    h: f64,
    /// What is recorded: place and order of the derivative.
    recorded: Vec<(usize, usize)>,
}

/// Quantities by the order of the derivative, and their units.
const QUANTITIES: [(&str, &str); 3] = [("displacement", "m"), ("velocity", "m/s"), ("acceleration", "m/s2")];

impl Watch {
    /// Of places in the order of the rows of `at`.
    pub fn new(at: Stations, places: Vec<Place>) -> Self {
        let n = 2 * places.len();
        let rest = || vec![0.0; n];
        Self { at, places, now: rest(), before: rest(), saved: rest(), h: 0.0, recorded: Vec::new() }
    }

    /// The deck moves so at its own places: positions, then rates, of both the vertical component first. Where nothing is
    /// recorded this costs nothing.
    pub fn see(&mut self, own: &[f64]) {
        if self.recorded.is_empty() {
            return;
        }
        let (positions, rates) = own.split_at(own.len() / 2);
        let (d, v) = self.now.split_at_mut(self.places.len());
        self.at.motion(positions, d);
        self.at.motion(rates, v);
    }

    /// A step of `h` seconds begins.
    pub fn begin(&mut self, h: f64) {
        self.before.copy_from_slice(&self.now);
        self.h = h;
    }

    /// Keeps the motion.
    pub fn save(&mut self) {
        self.saved.copy_from_slice(&self.now);
    }

    /// Takes the motion that was kept.
    pub fn restore(&mut self) {
        self.now.copy_from_slice(&self.saved);
    }

    /// Chooses what is recorded: what is wanted and not among the names that the bridge has itself.
    pub fn record(&mut self, own: &[Signal], wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        let mut signals = Vec::new();
        self.recorded.clear();
        for (i, place) in self.places.iter().enumerate() {
            for (order, (quantity, unit)) in QUANTITIES.iter().enumerate().take(if place.acceleration { 3 } else { 2 })
            {
                let signal = Signal { name: format!("{}.{quantity}", place.name), unit: (*unit).to_string() };
                if wanted(&signal) && own.iter().all(|known| known.name != signal.name) {
                    self.recorded.push((i, order));
                    signals.push(signal);
                }
            }
        }
        signals
    }

    /// Reads what was chosen. Before the first step there is no acceleration.
    pub fn read(&self, row: &mut [f64]) {
        let n = self.places.len();
        for (value, (i, order)) in row.iter_mut().zip(&self.recorded) {
            let v = n + i;
            *value = match order {
                0 => self.now[*i],
                1 => self.now[v],
                _ if self.h > 0.0 => (self.now[v] - self.before[v]) / self.h,
                _ => 0.0,
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adapters::stations::Shape;

    #[test]
    fn a_step_that_is_repeated_has_the_acceleration_of_the_last_trial() {
        let at = Stations::new(&[0.0, 2.0], &[], &[1.0], Shape::Linear).unwrap();
        let mut watch = Watch::new(at, vec![Place { name: "point[mid]".into(), acceleration: true }]);
        let own = [Signal { name: "point[mid].velocity".into(), unit: "m/s".into() }];
        let names: Vec<String> = watch.record(&own, &|_| true).into_iter().map(|signal| signal.name).collect();
        assert_eq!(names, ["point[mid].displacement", "point[mid].acceleration"]);
        let mut row = [f64::NAN; 2];
        watch.see(&[1.0, 3.0, 0.5, 1.5]);
        watch.read(&mut row);
        assert_eq!(row, [2.0, 0.0]);
        watch.save();
        for v in [9.0, 3.0] {
            watch.restore();
            watch.begin(0.5);
            watch.see(&[1.0, 5.0, v, v]);
        }
        watch.read(&mut row);
        assert_eq!(row, [3.0, (3.0 - 1.0) / 0.5]);
        // In space other components follow the vertical one.
        watch.see(&[1.0, 5.0, 7.0, 7.0, 8.0, 8.0, 2.0, 4.0, 6.0, 6.0, 9.0, 9.0]);
        watch.read(&mut row);
        assert_eq!(row, [3.0, (3.0 - 1.0) / 0.5]);
    }
}
