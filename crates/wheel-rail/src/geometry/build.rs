//! The table from two profiles: sums over the wheel at equal distances, which are the nodes' distances in D as well.

use super::{Geometry, LEAST_CURVATURE, Node, Part};
use crate::profile::rail::Placed;
use crate::profile::wheel::FLANGE_BACK;
use crate::profile::{Point, Shape};

/// How a wheelset stands in the track, and how finely its table is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pairing {
    /// Distance of the flange backs, mm.
    pub back_to_back: f64,
    /// s of the wheel's flange back, mm.
    pub flange_back: f64,
    /// ε, mm.
    pub softness: f64,
    /// Where the wheel's profile is split: flange for smaller s, mm.
    pub split: f64,
    /// Distance of the table's nodes and of the points of the sums, mm.
    pub spacing: f64,
    /// Largest displacement to either side, mm.
    pub reach: f64,
}

impl Default for Pairing {
    /// 1360 mm between the backs, ε = 20 µm, S1002's split at −33 mm, nodes each 0.025 mm up to 25 mm.
    fn default() -> Self {
        Self {
            back_to_back: 1360.0,
            flange_back: FLANGE_BACK,
            softness: 0.02,
            split: -33.0,
            spacing: 0.025,
            reach: 25.0,
        }
    }
}

/// Gaps larger than the smallest by this many ε weigh nothing: e⁻⁴⁰.
const NEGLIGIBLE: f64 = 40.0;
/// The flange's table ends where the slope has come back to this after its steepest: the top of the flange stands on the rail.
const FLANGE_TOP: f64 = -0.1;

/// The flange's table begins where it comes this close to the rail, m.
const NEAR: f64 = 5e-3;

/// Points whose smallest gap is looked at together: most blocks are far from each other and weigh nothing.
const BLOCK: usize = 64;

/// The table of `wheel` on `rail`.
///
/// # Errors
/// Profiles that never touch on the tread within the reach, or settings without sense, as a message.
pub fn of_profiles(wheel: &Shape, rail: &Placed, pairing: &Pairing) -> Result<Geometry, String> {
    let Pairing { softness, spacing, reach, split, .. } = *pairing;
    for (name, value) in [("softness", softness), ("spacing", spacing), ("reach", reach)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(format!("the {name} of a contact table is {value} mm; it must be a number above 0"));
        }
    }
    if reach / spacing > 20_000.0 {
        return Err(format!("a contact table of {reach} mm to either side each {spacing} mm is too large"));
    }
    let half = (reach / spacing).round() as i64;
    let taping = 0.5 * pairing.back_to_back - pairing.flange_back;
    let [from, to] = wheel.extent();
    let [below, above] = [(from / spacing).ceil() as i64, (to / spacing).floor() as i64];
    let at = ((split / spacing).round() as i64).clamp(below, above);
    let wheel: Vec<Point> = (below..=above).map(|i| wheel.at(i as f64 * spacing)).collect();
    let u = |i: i64| taping + i as f64 * spacing;
    let rails: Vec<Option<Point>> = (below - half..=above + half).map(|i| rail.at(u(i))).collect();
    let heights = rails.iter().map(|rail| rail.map_or(f64::INFINITY, |rail| rail.z)).collect();
    let sums = Sums {
        wheel_heights: wheel.iter().map(|point| point.z).collect(),
        wheel_curvatures: wheel.iter().map(Point::curvature).collect(),
        heights,
        slopes: rails.iter().map(|rail| rail.map_or(0.0, |rail| rail.slope)).collect(),
        curvatures: rails.iter().map(|rail| rail.map_or(0.0, |rail| rail.curvature())).collect(),
        below,
        half,
        u: &u,
        softness,
        spacing,
    };
    let mut tread = part(&sums, [at, above], half);
    let mut flange = part(&sums, [below, at], half);
    let [start, end] = tread.extent();
    if tread.nodes.is_empty() || start > 0.0 || end < 0.0 {
        return Err(
            "the wheel's tread does not lie on the rail: check gauge, distance of the wheels and profiles".into()
        );
    }
    // Where the flange lies deep beside the rail its edges alone would be seen.
    let near = flange.nodes.iter().position(|node| node.distance < NEAR).unwrap_or(flange.nodes.len());
    flange.nodes.drain(..near);
    flange.start += near as f64 * flange.spacing;
    let steepest = flange.nodes.iter().enumerate().min_by(|a, b| a.1.slope.total_cmp(&b.1.slope)).map_or(0, |(i, _)| i);
    if let Some(top) = flange.nodes[steepest..].iter().position(|node| node.slope > FLANGE_TOP) {
        flange.nodes.truncate(steepest + top + 1);
    }
    let offset = tread.distance(0.0)[0];
    tread.nodes.iter_mut().chain(&mut flange.nodes).for_each(|node| node.distance -= offset);
    Ok(Geometry { parts: [tread, flange], softness: 1e-3 * softness })
}

struct Sums<'a> {
    /// z and curvature of the wheel's points.
    wheel_heights: Vec<f64>,
    wheel_curvatures: Vec<f64>,
    /// z, slope and curvature of the rail's; z is infinite where there is no rail.
    heights: Vec<f64>,
    slopes: Vec<f64>,
    curvatures: Vec<f64>,
    /// Index of the wheel's first point; s = index × spacing.
    below: i64,
    half: i64,
    u: &'a dyn Fn(i64) -> f64,
    softness: f64,
    spacing: f64,
}

/// The part for the wheel's points from the first to the second index, as far as it lies over the rail.
fn part(sums: &Sums, wheel: [i64; 2], half: i64) -> Part {
    let all = (-half..=half).map(|shift| (shift, sums.node(wheel, shift)));
    let mut over = all.skip_while(|(_, node)| node.is_none()).map_while(|(shift, node)| Some((shift, node?)));
    let Some((first, node)) = over.next() else { return Part::default() };
    let nodes = std::iter::once(node).chain(over.map(|(_, node)| node)).collect();
    Part { start: 1e-3 * first as f64 * sums.spacing, spacing: 1e-3 * sums.spacing, nodes }
}

impl Sums<'_> {
    /// The sums at D = `shift` × spacing; `None` where the wheel's part has no rail below it. Metres.
    fn node(&self, [first, last]: [i64; 2], shift: i64) -> Option<Node> {
        let at = (first - self.below) as usize;
        let over = (first + shift - self.below + self.half) as usize;
        let count = (last - first + 1) as usize;
        let (wheels, rails) = (&self.wheel_heights[at..at + count], &self.heights[over..over + count]);
        let blocks = wheels.chunks(BLOCK).zip(rails.chunks(BLOCK));
        let smallest: Vec<f64> = blocks.map(|(wheels, rails)| smallest_gap(wheels, rails)).collect();
        let closest = smallest.iter().copied().fold(f64::INFINITY, least);
        if !closest.is_finite() {
            return None;
        }
        let negligible = closest + NEGLIGIBLE * self.softness;
        let (mut sum, mut node) = (0.0, Node::default());
        let near = smallest.iter().enumerate().filter(|(_, gap)| **gap <= negligible);
        for i in near.flat_map(|(block, _)| BLOCK * block..count.min(BLOCK * (block + 1))) {
            let (wheel, gap) = (wheels[i], rails[i] - wheels[i]);
            if gap > negligible {
                continue;
            }
            // Trapezoidal rule.
            let end = if i == 0 || i + 1 == count { 0.5 } else { 1.0 };
            let p = end * libm::exp(-(gap - closest) / self.softness);
            sum += p;
            node.slope += p * self.slopes[over + i];
            node.across += p * (self.u)(first + i as i64 + shift);
            node.radius_change += p * wheel;
            node.curvature += p * (self.curvatures[over + i] - self.wheel_curvatures[at + i]);
        }
        Some(Node {
            distance: 1e-3 * (closest - self.softness * libm::log(sum * self.spacing)),
            slope: node.slope / sum,
            across: 1e-3 * node.across / sum,
            radius_change: 1e-3 * node.radius_change / sum,
            curvature: (1e3 * node.curvature / sum).max(LEAST_CURVATURE),
        })
    }
}

/// The smallest of rail − wheel; lanes, each with its own smallest, do not wait for each other.
fn smallest_gap(wheels: &[f64], rails: &[f64]) -> f64 {
    let ((wheels, rest_w), (rails, rest_r)) = (wheels.as_chunks::<8>(), rails.as_chunks::<8>());
    let mut lanes = [f64::INFINITY; 8];
    for (wheels, rails) in wheels.iter().zip(rails) {
        (0..8).for_each(|i| lanes[i] = least(lanes[i], rails[i] - wheels[i]));
    }
    let rest = rest_w.iter().zip(rest_r).map(|(wheel, rail)| rail - wheel);
    lanes.into_iter().chain(rest).fold(f64::INFINITY, least)
}

/// The smaller of two numbers that are no NaN, in one instruction.
fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}
