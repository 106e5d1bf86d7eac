//! A case: cars, track, bridge, contacts, irregularity and the state they start from.
//!
//! The unknowns of track and bridge are numbered [track | bridge], the track as [`Track`] numbers itself, the bridge as its
//! finite-element model does: all degrees of freedom, whatever reduction the scenario asks for.

use std::path::Path;

use ttb_bridge::assembled::Assembled;
use ttb_bridge::deck::Row;
use ttb_bridge::law::Law;
use ttb_bridge::{imported, law, plane, space};
use ttb_contract::finite::larger;
use ttb_dynamics::newmark::Motion;
use ttb_scenario::spec::{BridgeSpec, StructureSpec, TrainTrackSpec};
use ttb_scenario::travel::{fade_in, wheel_offsets};
use ttb_scenario::types::{Damping, Newmark, Spring, Support};
use ttb_sparse::Layout;
use ttb_sparse::Pencil;
use ttb_sparse::modes::lowest;
use ttb_train_track::car::{AXLES, Car};
use ttb_train_track::law::Law as Contact;
use ttb_train_track::profile::Irregularity;
use ttb_train_track::speed::Running;
use ttb_train_track::track::{FastenerFactors, Track};

use crate::error::ReferenceError;
use crate::layout::layout;
use crate::wheels::Wheels;

/// The bridge in all its degrees of freedom.
pub struct Bridge {
    /// K, M and the dashpots' C.
    pub pencil: Pencil,
    /// Rayleigh's α and β; no factors.
    pub law: Law,
    /// Displacement under every support, as weights on degrees of freedom.
    pub supports: Vec<Row>,
    /// The monitored points alike.
    pub points: Vec<Row>,
}

/// Displacements, velocities and accelerations of all, and the contact forces.
#[derive(Clone, Debug)]
pub struct State {
    /// The track.
    pub track: Motion,
    /// The bridge.
    pub bridge: Motion,
    /// The cars, 10 degrees of freedom each.
    pub cars: Motion,
    /// Contact force of every axle, N.
    pub forces: Vec<f64>,
    /// Approach s = δ + c_loc F of every axle, m.
    pub approach: Vec<f64>,
}

/// All that does not depend on the step.
pub struct Whole {
    /// The track; its base springs stand on the ground until the bridge is put under them.
    pub track: Track,
    /// Springs between track and bridge.
    pub base: Spring,
    /// Cars from the front.
    pub cars: Vec<Car>,
    /// Laws of the contacts, and where the wheels are.
    pub wheels: Wheels,
    /// The bridge.
    pub bridge: Bridge,
    /// γ and β.
    pub newmark: Newmark,
    /// Helps to order the elimination of track and bridge.
    pub layout: Layout,
    /// At t = 0.
    pub start: State,
    /// Greatest static axle load, N.
    pub axle_load: f64,
}

impl Whole {
    /// Assembles a case, undeformed and at rest.
    ///
    /// # Errors
    /// Modal damping, matrices that cannot be factorised, data that a subsystem refuses.
    pub(crate) fn assemble(train: &TrainTrackSpec, spec: &BridgeSpec) -> Result<Self, ReferenceError> {
        if !train.vehicles.is_empty() {
            return Err(case("the methods of the paper know cars of 10 degrees of freedom only"));
        }
        let assembled = match &spec.structure {
            StructureSpec::Beams { .. } | StructureSpec::Frame(_) => plane::assemble(spec),
            StructureSpec::FiniteElements(model) => space::assemble(model, &spec.supports, &spec.points),
            StructureSpec::Matrices { files, folder, .. } => {
                imported::assemble(files, Path::new(folder), &spec.supports)
            }
            StructureSpec::Stored => return Err(case("a stored bridge has no equations to compare with")),
        };
        let assembled = assembled.map_err(case)?;
        let track = Track::new(train, FastenerFactors::default());
        let layout = layout(train, &track, &assembled);
        let Assembled { equations, nodes, node_of, supports, monitors, points, .. } = assembled;
        let own = Layout { node_of, place: nodes, ..Layout::default() };
        let pencil = equations.finish_with(&own).map_err(case)?;
        let law = law(&spec.damping, &pencil)?;
        let points = points.iter().map(|p| monitors[p.motion].clone()).collect();
        let cars: Vec<Car> = train.cars.iter().map(Car::new).collect();
        let axle_load = cars.iter().map(|c| c.axle_load).fold(0.0, larger);
        let laws = cars.iter().flat_map(|c| [Contact::new(&train.contact, c.axle_load); AXLES]).collect();
        let length: f64 = train.cars.iter().map(|c| c.length).sum();
        let offsets = wheel_offsets(&train.cars);
        let last = offsets.last().copied().unwrap_or(0.0);
        let passage = [fade_in(train.front_wheel, last, length, train.pre_roll), track.extent().1];
        let irregularity = Irregularity::new(&train.irregularity, train.irregularity_scale, passage, None);
        let running = Running::new(&train.speed, 1.0);
        let wheels = Wheels::new(laws, offsets, train.front_wheel, running, irregularity);
        let (n, ndof) = (track.order(), pencil.ndof());
        let axles = vec![0.0; cars.len() * AXLES];
        let start = State {
            track: Motion::rest(n),
            bridge: Motion::rest(ndof),
            cars: Motion::rest(cars.len() * 10),
            forces: axles.clone(),
            approach: axles,
        };
        let bridge = Bridge { pencil, law, supports, points };
        let (base, newmark) = (base(&train.track.support), train.newmark);
        Ok(Self { track, base, cars, wheels, bridge, newmark, layout, start, axle_load })
    }

    /// Degrees of freedom of track and bridge.
    pub fn order(&self) -> usize {
        self.track.order() + self.bridge.pencil.ndof()
    }

    /// Degrees of freedom of the rail.
    pub fn rail(&self) -> impl Iterator<Item = u32> {
        (0..self.track.nodes()).map(|node| self.track.node_dof(node) as u32).flat_map(|dof| [dof, dof + 1])
    }

    /// Deck displacement under every support.
    pub fn deck(&self, u: &[f64]) -> Vec<f64> {
        self.bridge.supports.iter().map(|row| dot(row, u)).collect()
    }
}

/// A row times a vector.
pub fn dot(row: &Row, u: &[f64]) -> f64 {
    row.iter().map(|(dof, weight)| weight * u[*dof as usize]).sum()
}

pub(crate) fn case(why: impl std::fmt::Display) -> ReferenceError {
    ReferenceError::Case(why.to_string())
}

/// The lowest spring of a support.
fn base(support: &Support) -> Spring {
    match support {
        Support::SingleLayer { fastener } => *fastener,
        Support::TwoLayer { ballast, .. } => *ballast,
        Support::ThreeLayer { sub_ballast, .. } => *sub_ballast,
    }
}

/// The bridge's damping, in all degrees of freedom.
pub(crate) fn law(damping: &Damping, pencil: &Pencil) -> Result<Law, ReferenceError> {
    let ratio = match *damping {
        Damping::None => 0.0,
        Damping::Rayleigh { ratio, .. } => ratio,
        Damping::Modal { .. } => {
            return Err(case(
                "bridge.damping is modal; the strongly and loosely coupled methods know Rayleigh damping only",
            ));
        }
    };
    let omega2 = match law::modes_needed(damping, None) {
        0 => Vec::new(),
        count => lowest(pencil, &pencil.factor(1.0, 0.0, 0.0).map_err(case)?, count).map_err(case)?.omega2,
    };
    law::law(damping, &omega2, ratio, 1.0, 1.0).map_err(case)
}
