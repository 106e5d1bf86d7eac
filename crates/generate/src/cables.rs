//! The cables: from the tower's legs to the tops of the webs, one truss each.
//!
//! ```text
//!     T sin α = w · 8 m / 2,   A = T / σ
//! ```
//!
//! w: dead weight of a metre of girder at the anchor, with cross-beams and track; α: the cable's angle with the horizontal.

use ttb_scenario::types::{LineSection, Trusses};

use crate::builder::Builder;
use crate::girder::{Girder, Placed, SIDES};
use crate::measure::distance;
use crate::tower::Leg;
use crate::{lines, plan};

/// E of the wires, N/m².
const MODULUS: f64 = 1.95e11;
/// σ under dead load, N/m².
const STRESS: f64 = 5.5e8;
/// Steel and 5 % of sheath, kg/m³.
const DENSITY: f64 = 1.05 * 7850.0;

/// Adds all cables of the tower at `x`.
pub(crate) fn add(b: &mut Builder, x: f64, girder: &Girder, placed: &Placed, legs: &[Leg; 2]) {
    b.material("cable", MODULUS, 0.3, DENSITY);
    for i in plan::CABLES {
        let reach = plan::CABLE_DISTANCE * i as f64;
        for (name, foot) in [("main", x - reach), ("side", x + reach)] {
            let ends = SIDES.map(|side| [placed.top(foot, side), legs[side].at(plan::anchor(i))]);
            let at = |node: u32| b.model.nodes.get(node as usize - 1).map_or([0.0; 3], |n| [n.1, n.2, n.3]);
            let [low, high] = ends[0].map(at);
            let sine = (low[2] - high[2]) / distance(&low, &high);
            let tension = 0.5 * weight(girder, foot) * plan::CABLE_DISTANCE / sine;
            // tension to the kN, area to the cm²
            let tension = (tension / 1e3).round() * 1e3;
            let section = format!("cable-{name}-{i}");
            b.model.line_sections.push(LineSection {
                name: section.clone(),
                material: "cable".into(),
                area: lines::rounded((tension / STRESS * 1e4).round() / 1e4),
                inertia_2: 0.0,
                inertia_3: 0.0,
                torsion: 0.0,
                shear_area_2: None,
                shear_area_3: None,
                added_mass: 0.0,
            });
            b.model.trusses.push(Trusses { section, elements: ends.to_vec(), tensions: Some(vec![tension; 2]) });
        }
    }
}

/// Dead load w of the girder, N/m.
fn weight(girder: &Girder, x: f64) -> f64 {
    let concrete = girder.trough.area(girder.height(x)) + girder.trough.cross_beam_volume() / plan::BAY;
    (concrete * plan::DENSITY + plan::TRACK_LOAD) * ttb_scenario::GRAVITY
}
