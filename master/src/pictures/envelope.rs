//! A curve thinned as it comes: what is seen of it where each column of pixels holds many points.
//!
//! ```text
//! column k:  from + k w ≤ t < from + (k + 1) w,      w = (to − from)/n
//! keeps its first, least, greatest and last point: lines through these cover the same pixels as lines through all
//! ```
//!
//! Memory depends on n alone, however many points there are. What leaves [from, to] is cut off where it crosses an end.

/// Columns of a curve; about one a unit of a picture's width.
pub const COLUMNS: usize = 1000;

/// A point of a curve: time and value.
pub type Point = (f64, f64);

/// Extremes of a curve in each of a fixed number of columns.
#[derive(Clone, Debug)]
pub struct Envelope {
    from: f64,
    to: f64,
    columns: Vec<Option<Column>>,
    before: Option<Point>,
}

#[derive(Clone, Copy, Debug)]
struct Column {
    first: Point,
    low: Point,
    high: Point,
    last: Point,
}

impl Envelope {
    /// Of the stretch of time between `from` and `to`, s.
    pub fn new(from: f64, to: f64) -> Self {
        Self { from, to, columns: vec![None; COLUMNS], before: None }
    }

    /// Takes in the next point; times do not fall. What is not finite is left out.
    pub fn add(&mut self, t: f64, x: f64) {
        if !t.is_finite() || !x.is_finite() {
            return;
        }
        let before = self.before.replace((t, x));
        for end in [self.from, self.to] {
            if let Some((t0, x0)) = before.filter(|(t0, _)| *t0 < end && end < t) {
                self.put((end, x0 + (x - x0) * (end - t0) / (t - t0)));
            }
        }
        if (self.from..=self.to).contains(&t) {
            self.put((t, x));
        }
    }

    fn put(&mut self, point: Point) {
        let share = (point.0 - self.from) / (self.to - self.from);
        let at = (share * COLUMNS as f64) as usize;
        let column = &mut self.columns[at.min(COLUMNS - 1)];
        match column {
            None => *column = Some(Column { first: point, low: point, high: point, last: point }),
            Some(column) => {
                column.last = point;
                if point.1 < column.low.1 {
                    column.low = point;
                }
                if point.1 > column.high.1 {
                    column.high = point;
                }
            }
        }
    }

    /// What is drawn: at most four points a column, in the order of time.
    pub fn points(&self) -> Vec<Point> {
        let mut points: Vec<Point> = Vec::new();
        for Column { first, low, high, last } in self.columns.iter().flatten() {
            let (early, late) = if low.0 <= high.0 { (low, high) } else { (high, low) };
            for point in [first, early, late, last] {
                if points.last() != Some(point) {
                    points.push(*point);
                }
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extremes_of_a_million_points_are_kept_in_the_memory_of_a_thousand_columns() {
        let mut envelope = Envelope::new(0.0, 1.0);
        for i in 0..=1_000_000_u32 {
            let t = f64::from(i) * 1e-6;
            let spike = if i == 345_678 { 9.0 } else { 0.0 };
            envelope.add(t, (1e4 * t).sin() + spike);
        }
        let points = envelope.points();
        assert!(points.len() <= 4 * COLUMNS && points.is_sorted_by(|a, b| a.0 <= b.0));
        assert!(points.contains(&(0.345678, (1e4 * 0.345678_f64).sin() + 9.0)));
        assert_eq!((points[0].0, points[points.len() - 1].0), (0.0, 1.0));
        assert!(points.iter().any(|p| p.1 < -0.999_999));
    }

    #[test]
    fn a_curve_is_cut_off_where_it_leaves_the_stretch() {
        let mut envelope = Envelope::new(1.0, 2.0);
        [(0.0, 0.0), (1.5, 3.0), (1.6, f64::NAN), (3.5, -1.0)].iter().for_each(|(t, x)| envelope.add(*t, *x));
        assert_eq!(envelope.points(), [(1.0, 2.0), (1.5, 3.0), (2.0, 2.0)]);
        // A line that steps over the whole stretch crosses both ends.
        let mut over = Envelope::new(1.0, 2.0);
        [(0.0, 0.0), (4.0, 4.0)].iter().for_each(|(t, x)| over.add(*t, *x));
        assert_eq!(over.points(), [(1.0, 1.0), (2.0, 2.0)]);
    }
}
