//! The cable-stayed bridge: one tower, two planes of cables, a simply supported girder at either end.
//!
//! ```text
//!     x = 0        a               a+112          a+192  a+224      2a+224
//!     ▲═ approach ═▲═══ main span ═══╪═══ side ════▲═ end ▲═ approach ═▲
//!     abutment     pier              tower         pier   pier         abutment
//! ```
//!
//! Bearings stand under the webs and hold vertically; a guide on the axis holds across. The tower carries the main girder
//! rigidly and so holds it along; the girders before and after are held along on their abutments,
//! at the floor: at the bottom of a cross-beam this would bend over its weak axis.

use ttb_scenario::types::{Bearings, DeckCarrier, DeckLine, Freedom, Model};

use crate::builder::Builder;
use crate::error::{Refused, Rules};
use crate::fit::{Mesh, coarsest, fit};
use crate::girder::{Girder, Placed, STRIP};
use crate::{cables, measure, piers, plan, tower};

/// What can be chosen of the cable-stayed bridge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CableStayed {
    /// Degrees of freedom aimed at.
    pub dofs: usize,
    /// y of the track's axis, m.
    pub track_y: f64,
    /// a: length of the girder before and of that after, m.
    pub approach: f64,
}

impl Default for CableStayed {
    fn default() -> Self {
        Self { dofs: 120_000, track_y: 0.0, approach: 32.0 }
    }
}

const SOURCE: &str = "Made by `ttb generate cable-stayed`. Railway cable-stayed bridge of the size in Zhu et al., Advances \
in Structural Engineering 2018, doi 10.1177/1369433217691775: one tower, double cable plane, spans 112 + 80 + 32 m = 224 m \
(the paper prints 30 for the last, which does not give its 224), C50 concrete of 26 kN/m3, channel girder 10.8 m wide and \
3.7/3.5 m high, secondary dead load 67.9 kN/m on the floor under the track, about 11,800 t without the simply supported \
girder at either end. The paper's sections and cables are not published; those here are estimates made for this program: \
floor 0.6 m, webs 0.65 m, flanges 1.0 x 0.4 m, cross-beams every 4 m; tower of hollow legs, foot 20 m below and top 50 m \
above the floor; cables every 8 m of girder, each under the tension whose vertical part carries the dead load of 8 m of half \
the girder, area for 550 N/mm2, E = 1.95e11 N/m2, steel and 5 % of sheath. z = 0 is the middle of the floor.";

/// The bridge as a finite-element model.
///
/// # Errors
/// Too few or too many degrees of freedom, a track beside the floor, girders too short.
pub fn cable_stayed(asked: &CableStayed) -> Result<Model, Refused> {
    let mut rules = Rules::default();
    let room = plan::MAIN.half_width - 0.5 * plan::MAIN.web - STRIP;
    let rule = format!("track_y must lie between {:.2} and {room:.2} m", -room);
    rules.demand(asked.track_y.abs() <= room, &rule, asked.track_y);
    let sane = (8.0..=200.0).contains(&asked.approach);
    rules.demand(sane, "the girders before and after must be 8 to 200 m long", asked.approach);
    rules.result()?;
    let girders = girders(asked);
    // tower and piers do not depend on the mesh: their share follows from the coarsest one
    let count = |mesh| 6 * girders.iter().map(|girder| girder.nodes(mesh)).sum::<usize>();
    let width = 2.0 * plan::MAIN.half_width;
    let coarse = coarsest(plan::BAY, width);
    let base = measure::degrees_of_freedom(&build(asked, &girders, coarse)) as isize - count(coarse) as isize;
    let free = |mesh| count(mesh).saturating_add_signed(base);
    let mesh = fit(asked.dofs, plan::BAY, width, free)?;
    Ok(build(asked, &girders, mesh))
}

/// Before, main, after.
fn girders(asked: &CableStayed) -> [Girder; 3] {
    let (a, length) = (asked.approach, plan::LENGTH);
    let tower = a + plan::TOWER;
    let mut main: Vec<f64> = even(a, a + length).into_iter().filter(|x| (x - tower).abs() > 1.0).collect();
    main.extend([tower - plan::SEAT, tower + plan::SEAT]);
    main.sort_by(f64::total_cmp);
    let girder = |prefix: &str, trough, heights, cross_beams| Girder {
        prefix: prefix.to_string(),
        trough,
        heights,
        cross_beams,
        track: asked.track_y,
    };
    let step = [[a + plan::INNER_PIER, plan::HEIGHT], [a + plan::INNER_PIER + 2.0 * plan::BAY, plan::LOW]];
    let low = || vec![[0.0, plan::LOW]];
    [
        girder("before", plan::APPROACH, low(), even(0.0, a)),
        girder("girder", plan::MAIN, step.to_vec(), main),
        girder("after", plan::APPROACH, low(), even(a + length, 2.0 * a + length)),
    ]
}

/// From `from` to `to` every 4 m or so.
pub(crate) fn even(from: f64, to: f64) -> Vec<f64> {
    crate::lines::divide(&[from, to], plan::BAY)
}

fn build(asked: &CableStayed, girders: &[Girder; 3], mesh: Mesh) -> Model {
    let mut b = Builder::new(SOURCE);
    b.material("C50", plan::MODULUS, plan::POISSON, plan::DENSITY);
    for girder in girders {
        girder.add_sections(&mut b, "C50", plan::TRACK_LOAD);
    }
    let [before, main, after] = girders.each_ref().map(|girder| girder.add(&mut b, mesh));
    let (a, length) = (asked.approach, plan::LENGTH);
    let inner = a + plan::INNER_PIER;
    let legs = tower::add(&mut b, a + plan::TOWER, &main);
    piers::add_sections(&mut b);
    piers::add(&mut b, a, &[&before, &main]);
    piers::add(&mut b, inner, &[&main]);
    piers::add(&mut b, a + length, &[&main, &after]);
    cables::add(&mut b, a + plan::TOWER, &girders[1], &main, &legs);
    abutment(&mut b, 0.0, &before);
    abutment(&mut b, 2.0 * a + length, &after);
    let floors = girders.iter().flat_map(Girder::floor).collect();
    b.model.deck = DeckLine { length: 2.0 * a + length, y: asked.track_y, z: None, on: DeckCarrier::Shells(floors) };
    b.model
}

/// The girder's end at `x` on the ground, held along.
fn abutment(b: &mut Builder, x: f64, girder: &Placed) {
    let held = |nodes: Vec<u32>, fixed: Vec<Freedom>| Bearings { nodes, fixed };
    b.model.bearings.push(held(girder.corners(x).to_vec(), vec![Freedom::Z]));
    b.model.bearings.push(held(girder.edges(x).to_vec(), vec![Freedom::X]));
    b.model.bearings.push(held(vec![girder.middle(x).0], vec![Freedom::Y]));
}
