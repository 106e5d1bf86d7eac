//! The tower: two hollow legs, upright below the girder, leaning in above it, upright over the webs where the cables are
//! anchored; a crossbeam under the girder and one each at the kink and at the top.

use ttb_scenario::types::{Bearings, Freedom};

use crate::builder::Builder;
use crate::girder::{Placed, SIDES};
use crate::lines::{divide, nearest};
use crate::plan;

/// A leg: heights of its nodes (z, m) and the nodes.
pub(crate) struct Leg {
    z: Vec<f64>,
    nodes: Vec<u32>,
}

impl Leg {
    /// The node nearest to `height` above the floor.
    pub(crate) fn at(&self, height: f64) -> u32 {
        self.nodes[nearest(&self.z, -height)]
    }
}

/// y of the right leg's axis at `z`.
fn lean(z: f64) -> f64 {
    let part = ((plan::CROSSBEAM - z) / (plan::CROSSBEAM + plan::KINK)).clamp(0.0, 1.0);
    plan::LEG + (plan::MAIN.half_width - plan::LEG) * part
}

/// Adds the tower at `x` and joins the girder's webs at the two cross-beams there rigidly with its lower crossbeam.
pub(crate) fn add(b: &mut Builder, x: f64, girder: &Placed) -> [Leg; 2] {
    b.beam_section("tower-leg-above", "C50", &plan::upper_leg());
    b.beam_section("tower-leg-below", "C50", &plan::lower_leg());
    b.beam_section("tower-crossbeam", "C50", &plan::lower_crossbeam());
    b.beam_section("tower-upper-crossbeam", "C50", &plan::upper_crossbeam());
    let mut breaks = vec![plan::FOOT, plan::CROSSBEAM, -plan::KINK];
    breaks.extend(plan::CABLES.map(|i| -plan::anchor(i)));
    breaks.push(-plan::TOP);
    let legs = [-1.0, 1.0].map(|sign| {
        let z = divide(&breaks, plan::BEAM);
        let nodes: Vec<u32> = z.iter().map(|z| b.node([x, sign * lean(*z), *z])).collect();
        let knee = nearest(&z, plan::CROSSBEAM);
        b.beams("tower-leg-below", &nodes[..=knee]);
        b.beams("tower-leg-above", &nodes[knee..]);
        Leg { z, nodes }
    });
    let feet = legs.iter().map(|leg| leg.nodes[0]).collect();
    b.model.bearings.push(Bearings { nodes: feet, fixed: Freedom::ALL.to_vec() });
    let web = plan::MAIN.half_width;
    let seats = crossbeam(b, x, -plan::CROSSBEAM, &[-web, 0.0, web], "tower-crossbeam", &legs);
    crossbeam(b, x, plan::KINK, &[0.0], "tower-upper-crossbeam", &legs);
    crossbeam(b, x, plan::TOP, &[0.0], "tower-upper-crossbeam", &legs);
    for side in SIDES {
        let ends = [x - plan::SEAT, x + plan::SEAT];
        let followers = ends.iter().flat_map(|at| [girder.corners(*at)[side], girder.edges(*at)[side]]);
        b.rigid(seats[2 * side], followers.collect());
    }
    legs
}

/// A crossbeam at `height` above the floor; the nodes at `inner`.
fn crossbeam(b: &mut Builder, x: f64, height: f64, inner: &[f64], section: &str, legs: &[Leg; 2]) -> Vec<u32> {
    let reach = lean(-height);
    let breaks: Vec<f64> = [-reach].into_iter().chain(inner.iter().copied()).chain([reach]).collect();
    let y = divide(&breaks, plan::BEAM);
    let mut row = vec![legs[0].at(height)];
    row.extend(y[1..y.len() - 1].iter().map(|y| b.node([x, *y, -height])));
    row.push(legs[1].at(height));
    b.beams(section, &row);
    inner.iter().map(|at| row[nearest(&y, *at)]).collect()
}
