//! A rail as it lies: inclined towards the track's middle and set to gauge.
//!
//! ```text
//! s across the rail (field side +), z down, (0, 0) at the middle of the head
//! u = s cos β + z sin β + u₀,   z′ = z cos β − s sin β + z₀           field side up by the inclination tan β
//! z₀: highest point at z′ = 0;  u₀: the gauge side at u = gauge/2, 14 mm below it
//! ```
//!
//! Head of 60E1 (EN 13674-1): R300, R80, R13, sides 1:20.

use super::{Piece, Point, Shape};

/// Depth below the running surface at which the gauge is measured, mm.
pub const GAUGE_DEPTH: f64 = 14.0;

/// Head of 60E1, not inclined; the sides go down to 40 mm.
///
/// # Errors
/// None with the numbers here; the check of [`Shape::new`].
pub fn r60e1() -> Result<Shape, String> {
    const JOINTS: [f64; 2] = [10.228, 26.0265];
    const SIDE: f64 = 20.0;
    let arc = |centre: [f64; 2], radius| Piece::Arc { centre, radius, above: true };
    // Each arc goes on from the one before with the same tangent: its centre lies on the same radius.
    let mut circles = vec![([0.0, 300.0], 300.0)];
    for (joint, radius) in JOINTS.into_iter().zip([80.0, 13.0]) {
        let (centre, old): ([f64; 2], f64) = circles[circles.len() - 1];
        let x = (joint - centre[0]) / old;
        let z = (1.0 - x * x).sqrt();
        circles.push(([joint - radius * x, centre[1] - (old - radius) * z], radius));
    }
    let (corner, radius) = circles[2];
    let normal = (1.0 + SIDE * SIDE).sqrt();
    let touch = [corner[0] + radius * SIDE / normal, corner[1] - radius / normal];
    let end = touch[0] + (40.0 - touch[1]) / SIDE;
    let mirrored = |([s, z], radius): ([f64; 2], f64)| arc([-s, z], radius);
    let side = |s: f64| Piece::Polynomial { origin: s, coefficients: vec![touch[1], SIDE * s.signum()] };
    Shape::new(
        -end,
        vec![
            (-touch[0], side(-touch[0])),
            (-JOINTS[1], mirrored(circles[2])),
            (-JOINTS[0], mirrored(circles[1])),
            (JOINTS[0], arc(circles[0].0, circles[0].1)),
            (JOINTS[1], arc(circles[1].0, circles[1].1)),
            (touch[0], arc(corner, radius)),
            (end, side(touch[0])),
        ],
    )
}

/// A rail in the track.
#[derive(Clone, Debug)]
pub struct Placed {
    shape: Shape,
    cos: f64,
    sin: f64,
    /// (u₀, z₀), mm.
    shift: [f64; 2],
}

impl Placed {
    /// `shape` inclined by `inclination` = tan β and set to `gauge`, mm.
    ///
    /// # Errors
    /// A profile that does not reach the gauge point, or that is too steep to be inclined.
    pub fn new(shape: Shape, inclination: f64, gauge: f64) -> Result<Self, String> {
        let angle = libm::atan(inclination);
        let mut placed = Self { shape, cos: libm::cos(angle), sin: libm::sin(angle), shift: [0.0; 2] };
        let [from, to] = placed.shape.extent();
        let turned = |s: f64| placed.shape.at(s).z * placed.cos - s * placed.sin;
        // The highest point: a fine scan, then a parabola is not needed, the head is flat there.
        let scan = (0..=20_000).map(|i| from + (to - from) * f64::from(i) / 20_000.0);
        let top = scan.min_by(|a, b| turned(*a).total_cmp(&turned(*b))).unwrap_or(0.0);
        let depth = |s: f64| turned(s) - turned(top) - GAUGE_DEPTH;
        let (mut outer, mut inner) = (top, from);
        if depth(inner) < 0.0 {
            return Err(format!("the rail profile ends less than {GAUGE_DEPTH} mm below its top on the gauge side"));
        }
        for _ in 0..60 {
            let middle = 0.5 * (outer + inner);
            if depth(middle) < 0.0 { outer = middle } else { inner = middle }
        }
        let here = placed.shape.at(inner).z;
        placed.shift = [0.5 * gauge - inner * placed.cos - here * placed.sin, -turned(top)];
        if [from, to].iter().any(|s| placed.cos + placed.shape.at(*s).slope * placed.sin <= 0.0) {
            return Err(format!("the rail profile overhangs when it is inclined by {inclination}"));
        }
        Ok(placed)
    }

    /// First and last u, mm.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        self.shape.extent().map(|s| self.across(s))
    }

    fn across(&self, s: f64) -> f64 {
        s * self.cos + self.shape.at(s).z * self.sin + self.shift[0]
    }

    /// The profile at the outward coordinate u, mm; `None` beyond its ends. The bend keeps the curve's curvature.
    #[must_use]
    pub fn at(&self, u: f64) -> Option<Point> {
        let [from, to] = self.shape.extent();
        if u < self.across(from) || u > self.across(to) {
            return None;
        }
        let (mut low, mut high) = (from, to);
        let mut s = (u - self.shift[0]).clamp(from, to);
        // u grows with s: Newton within a bracket.
        for _ in 0..60 {
            let miss = self.across(s) - u;
            if miss > 0.0 {
                high = s
            } else {
                low = s
            }
            let next = s - miss / (self.cos + self.shape.at(s).slope * self.sin);
            let next = if (low..=high).contains(&next) { next } else { 0.5 * (low + high) };
            if (next - s).abs() < 1e-12 {
                break;
            }
            s = next;
        }
        let point = self.shape.at(s);
        let slope = (point.slope * self.cos - self.sin) / (self.cos + point.slope * self.sin);
        let bend = point.curvature() * libm::pow(1.0 + slope * slope, 1.5);
        Some(Point { z: point.z * self.cos - s * self.sin + self.shift[1], slope, bend })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_has_the_width_of_the_drawing() {
        let head = r60e1().unwrap();
        assert!(head.largest_step() < 1e-12);
        // 72 mm at a depth of 14.3 mm: there the corner passes into the side.
        let end = head.pieces[5].0;
        assert!((end - 36.0).abs() < 5e-4 && (head.at(end).z - 14.3).abs() < 5e-4, "{end} {}", head.at(end).z);
    }

    #[test]
    fn an_inclined_rail_stands_to_gauge() {
        let rail = Placed::new(r60e1().unwrap(), 1.0 / 40.0, 1435.0).unwrap();
        assert!((rail.at(717.5).unwrap().z - GAUGE_DEPTH).abs() < 1e-9);
        let highest = (0..800).map(|i| rail.at(718.0 + 0.1 * f64::from(i)).map_or(1.0, |p| p.z)).fold(1.0, f64::min);
        assert!(highest.abs() < 1e-4, "{highest}");
        assert!(rail.at(600.0).is_none());
        // Slope and curvature are those of the turned curve.
        let h = 1e-3;
        for u in [722.0, 740.0, 750.0, 775.0] {
            let [before, here, after] = [u - h, u, u + h].map(|u| rail.at(u).unwrap());
            assert!((here.slope - (after.z - before.z) / (2.0 * h)).abs() < 1e-5, "{u}");
            assert!((here.bend - (after.slope - before.slope) / (2.0 * h)).abs() < 1e-5, "{u}");
        }
    }
}
