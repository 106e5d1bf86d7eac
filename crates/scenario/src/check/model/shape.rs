//! Lengths, directions and areas of elements.

/// A sine or a relative area below this is none.
const FLAT: f64 = 1e-6;

pub(super) type Point = [f64; 3];

pub(super) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn difference(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn norm(a: Point) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Whether two vectors, not zero, lie along one line.
pub(super) fn parallel(a: Point, b: Point) -> bool {
    let unit = |a: Point| a.map(|component| component / norm(a));
    norm(cross(unit(a), unit(b))) < FLAT
}

/// Whether the corners of a polygon, in order, span an area.
pub(super) fn spans(corners: &[Point]) -> bool {
    let Some((first, others)) = corners.split_first() else { return false };
    let sides: Vec<Point> = others.iter().map(|corner| difference(*corner, *first)).collect();
    let area = sides.windows(2).fold([0.0; 3], |area, pair| add(area, cross(pair[0], pair[1])));
    let size = sides.iter().map(|side| norm(*side)).fold(0.0, f64::max);
    norm(area) > FLAT * size * size
}
