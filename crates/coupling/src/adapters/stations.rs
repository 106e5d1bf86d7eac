//! A deck that is known at other places than under the track's supports: interpolation along x, the same both ways.
//!
//! ```text
//! d = W d',   ḋ = W ḋ',   λ' = Wᵀ λ          primes: at the deck's own stations
//! ```
//!
//! so that λ'ᵀ ḋ' = λᵀ ḋ: no work is lost or gained. Every row of W sums to 1 and W x' = x, so that force and moment are
//! kept too. A bearing is a station that does not move; what it takes goes to the ground.

/// Stations a row may use: cubic interpolation.
const WIDTH: usize = 4;

/// Shape of the deck between stations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shape {
    /// Straight lines.
    #[default]
    Linear,
    /// Cubics through the four stations about (Lagrange), fewer at a deck of fewer.
    Cubic,
}

/// Why a deck cannot be interpolated.
#[derive(Clone, Debug, PartialEq)]
pub enum StationError {
    /// Stations and bearings do not increase strictly: two of them, m.
    NotIncreasing(f64, f64),
    /// Supports outside the stations and bearings, whose forces would be lost: how many, the first, and the range, m.
    Outside(usize, f64, [f64; 2]),
    /// There is none.
    None,
}

impl std::fmt::Display for StationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NotIncreasing(a, b) => {
                write!(f, "stations and bearings must increase along the track: {b} m follows {a} m")
            }
            Self::Outside(count, x, [from, to]) => write!(
                f,
                "{count} supports stand outside its stations, which reach from {from} m to {to} m, the first at {x:.3} m: their \
                 forces would be lost. If the deck bears beyond its stations, name the bearings"
            ),
            Self::None => write!(f, "there is no station"),
        }
    }
}
impl std::error::Error for StationError {}

/// W, a few entries a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Stations {
    rows: Vec<[(usize, f64); WIDTH]>,
    stations: usize,
}

impl Stations {
    /// From increasing `stations` and `bearings`, m, to `supports`, m.
    ///
    /// # Errors
    /// Positions that do not increase, or supports outside.
    pub fn new(stations: &[f64], bearings: &[f64], supports: &[f64], shape: Shape) -> Result<Self, StationError> {
        // Places in order; a bearing has no number.
        let mut places: Vec<(f64, Option<usize>)> = stations.iter().enumerate().map(|(i, x)| (*x, Some(i))).collect();
        if let Some(pair) = stations.windows(2).find(|pair| pair[1] <= pair[0] || pair.iter().any(|x| x.is_nan())) {
            return Err(StationError::NotIncreasing(pair[0], pair[1]));
        }
        places.extend(bearings.iter().map(|x| (*x, None)));
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let Some(pair) = places.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(StationError::NotIncreasing(pair[0].0, pair[1].0));
        }
        let (Some(first), Some(last)) = (places.first(), places.last()) else { return Err(StationError::None) };
        let range = [first.0, last.0];
        // A millimetre is nobody's bridge: positions come from files.
        let outside = |x: &&f64| !(range[0] - 1e-3..=range[1] + 1e-3).contains(*x);
        if let Some(x) = supports.iter().find(outside) {
            return Err(StationError::Outside(supports.iter().filter(outside).count(), *x, range));
        }
        let rows = supports.iter().map(|x| row(&places, *x, shape)).collect();
        Ok(Self { rows, stations: stations.len() })
    }

    /// How many stations there are.
    pub fn stations(&self) -> usize {
        self.stations
    }

    /// How many supports there are.
    pub fn supports(&self) -> usize {
        self.rows.len()
    }

    /// d = W d' of every block of a vector of motions.
    pub fn motions(&self, theirs: &[f64], ours: &mut [f64]) {
        let blocks = theirs.chunks_exact(self.stations.max(1)).zip(ours.chunks_exact_mut(self.rows.len().max(1)));
        blocks.for_each(|(theirs, ours)| self.motion(theirs, ours));
    }

    /// λ' = Wᵀ λ of every block of a vector of forces.
    pub fn forces(&self, ours: &[f64], theirs: &mut [f64]) {
        let blocks = ours.chunks_exact(self.rows.len().max(1)).zip(theirs.chunks_exact_mut(self.stations.max(1)));
        blocks.for_each(|(ours, theirs)| self.force(ours, theirs));
    }

    /// d = W d'.
    pub fn motion(&self, theirs: &[f64], ours: &mut [f64]) {
        for (ours, row) in ours.iter_mut().zip(&self.rows) {
            *ours = row.iter().map(|(i, w)| w * theirs[*i]).sum();
        }
    }

    /// λ' = Wᵀ λ.
    pub fn force(&self, ours: &[f64], theirs: &mut [f64]) {
        theirs.fill(0.0);
        for (ours, row) in ours.iter().zip(&self.rows) {
            row.iter().for_each(|(i, w)| theirs[*i] += w * ours);
        }
    }
}

/// Weights of the places about x; a bearing's are left out, since it does not move. Unused entries have weight 0.
fn row(places: &[(f64, Option<usize>)], x: f64, shape: Shape) -> [(usize, f64); WIDTH] {
    let width = if shape == Shape::Linear { 2 } else { WIDTH }.min(places.len());
    let next = places.partition_point(|(place, _)| *place < x);
    let begin = next.saturating_sub(width / 2).min(places.len() - width);
    let about = &places[begin..begin + width];
    let mut row = [(0, 0.0); WIDTH];
    for (k, (at, station)) in about.iter().enumerate() {
        let Some(station) = station else { continue };
        let others = about.iter().enumerate().filter(|(other, _)| *other != k);
        row[k] = (*station, others.map(|(_, (other, _))| (x - other) / (at - other)).product());
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: [f64; 6] = [0.5, 1.5, 2.0, 4.0, 5.5, 6.0];
    const SUPPORTS: [f64; 7] = [0.5, 0.9, 1.7, 2.0, 3.3, 5.9, 6.0];

    #[test]
    fn cubics_are_kept_exactly_and_straight_lines_by_both() {
        let cubic = |x: f64| 1.0 - 2.0 * x + 0.3 * x * x - 0.1 * x.powi(3);
        let line = |x: f64| 1.0 - 2.0 * x;
        for (shape, f) in [(Shape::Cubic, &cubic as &dyn Fn(f64) -> f64), (Shape::Linear, &line)] {
            let stations = Stations::new(&X, &[], &SUPPORTS, shape).unwrap();
            let mut ours = [0.0; 7];
            stations.motion(&X.map(f), &mut ours);
            assert!(ours.iter().zip(SUPPORTS).all(|(d, x)| (d - f(x)).abs() < 1e-12));
        }
    }

    #[test]
    fn work_force_and_moment_are_kept() {
        for shape in [Shape::Linear, Shape::Cubic] {
            let stations = Stations::new(&X, &[], &SUPPORTS, shape).unwrap();
            let force = [1.0, -2.0, 3.0, 0.5, 7.0, 1.0, 2.0];
            let motion = [0.3, 0.1, -0.5, 2.0, 1.0, 0.7];
            let (mut theirs, mut ours) = ([0.0; 6], [0.0; 7]);
            stations.force(&force, &mut theirs);
            stations.motion(&motion, &mut ours);
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            assert!((dot(&theirs, &motion) - dot(&force, &ours)).abs() < 1e-12);
            assert!((theirs.iter().sum::<f64>() - force.iter().sum::<f64>()).abs() < 1e-12);
            assert!((dot(&theirs, &X) - dot(&force, &SUPPORTS)).abs() < 1e-12);
        }
    }

    #[test]
    fn what_would_lose_force_is_refused_and_bearings_take_what_is_theirs() {
        let outside = Stations::new(&X, &[], &[0.2, 3.0, 7.0], Shape::Linear);
        assert_eq!(outside, Err(StationError::Outside(2, 0.2, [0.5, 6.0])));
        let borne = Stations::new(&X, &[0.0, 7.0], &[0.2, 3.0, 7.0], Shape::Linear).unwrap();
        let mut theirs = [0.0; 6];
        borne.force(&[10.0, 0.0, 0.0], &mut theirs);
        assert!((theirs[0] - 4.0).abs() < 1e-12);
        assert_eq!(Stations::new(&[1.0, 1.0], &[], &[1.0], Shape::Linear), Err(StationError::NotIncreasing(1.0, 1.0)));
        assert_eq!(Stations::new(&[1.0], &[1.0], &[1.0], Shape::Linear), Err(StationError::NotIncreasing(1.0, 1.0)));
        assert_eq!(Stations::new(&[], &[], &[], Shape::Linear), Err(StationError::None));
    }
}
