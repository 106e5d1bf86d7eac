//! A train in space on its track, ready to run: set-up and macro steps around [`SpaceSystem::step`].

use std::sync::Arc;

use ttb_dynamics::newmark::Newmark;
use ttb_dynamics::pool::Pool;
use ttb_scenario::spec::{SpaceSpec, TrainTrackSpec};
use ttb_wheel_rail::contact::Contact;

use super::axle::{Lever, PORTS};
use super::car::{AXLES, Car, DOFS};
use super::error::StepError;
use super::newton::CarPorts;
use super::outputs;
use super::pre_roll::pre_roll;
use super::prepared::Lines;
use super::spec::settings;
use super::state::SpaceState;
use super::statics::{PLANE, rest};
use super::system::{SpaceStep, SpaceSystem};
use crate::coupled::TrainTrackSystem;
use crate::fleet::Reading;
use crate::macro_step::{Inputs, Sizes};
use crate::outputs::View;
use crate::profile::rails::Rails;
use crate::state::State;
use crate::step_means::StepMeans;
use crate::track::Track;
use crate::wheels::Wheels;

/// A sub-step is divided into so many parts at most.
const MOST_PARTS: u32 = 16;

/// A part of a macro step.
#[derive(Clone, Copy)]
struct Span {
    /// Begin and length of the macro step, s after the start.
    t: f64,
    h: f64,
    /// End and length of the part, in parts of the macro step.
    to: f64,
    size: f64,
}

/// A train on its track.
pub struct SpaceBuilt {
    system: SpaceSystem,
    sizes: Sizes<SpaceStep>,
    start: f64,
    pre_roll: f64,
    input_meaning: f64,
    /// The plane train on the plane track: for rest, and for the outputs that plane runs have, too.
    plane: TrainTrackSystem,
    plane_state: State,
    readings: Vec<Reading>,
    state: Arc<SpaceState>,
    pool: Pool<SpaceState>,
    deck: Vec<f64>,
    means: StepMeans,
    /// Mean forces of all supports: blocks of F_z, F_y, M_x.
    mean: Vec<f64>,
    /// Whether the last step could not be done because a wheel has left its rail.
    derailed: bool,
}

/// What a run begins with, besides its specification.
pub struct Begin {
    /// Start of the run, s.
    pub start: f64,
    /// Distance of the pre-roll with the train's length, m.
    pub pre_roll: f64,
    /// Parameter `input_meaning`.
    pub input_meaning: f64,
    /// Parameter `friction`.
    pub friction: f64,
    /// Newmark's constants of the nominal step.
    pub newmark: Newmark,
    /// Points of the rail that are monitored, without supports.
    pub means: StepMeans,
    /// Where the axles are, with the level.
    pub wheels: Wheels,
    /// Irregularity of both rails.
    pub irregularity: Rails,
}

impl SpaceBuilt {
    /// Joins the plane train and what it has in space.
    ///
    /// # Errors
    /// Data that this train cannot run with, as a message.
    pub fn new(
        spec: &TrainTrackSpec,
        space: &SpaceSpec,
        plane: TrainTrackSystem,
        lines: Arc<Lines>,
        begin: Begin,
    ) -> Result<Self, String> {
        let (mut kinds, mut of_kind): (Vec<Car>, Vec<usize>) = (Vec::new(), Vec::new());
        let mut known: Vec<usize> = Vec::new();
        for (c, data) in space.cars.iter().enumerate() {
            match known.iter().position(|other| space.cars[*other] == *data) {
                Some(kind) => of_kind.push(kind),
                None => {
                    kinds.push(Car::new(data).map_err(|e| format!("car {}: {e}", c + 1))?);
                    known.push(c);
                    of_kind.push(kinds.len() - 1);
                }
            }
        }
        if AXLES * of_kind.len() != spec.axle_count() {
            return Err("a train in space is made of cars with four axles".into());
        }
        let contacts: Result<Vec<Arc<Contact>>, String> = kinds
            .iter()
            .map(|kind| {
                let settings = settings(&space.contact, kind.radius, begin.friction);
                Contact::new(lines.geometry.clone(), &settings).map(Arc::new)
            })
            .collect();
        let contacts = contacts?;
        let ports = of_kind.iter().map(|kind| {
            let car = &kinds[*kind];
            let lever = Lever { radius: car.radius, head: space.track.head_height, rail: space.track.half_distance };
            let elements = car.elements.iter().map(|(_, element)| element.clone()).collect();
            CarPorts::new(Arc::clone(&contacts[*kind]), lever, elements)
        });
        let ports: Vec<_> = ports.collect();
        let prepared = Arc::clone(&plane.prepared);
        let supports = prepared.track.bridge_supports();
        let system =
            SpaceSystem::new(prepared, lines, kinds, of_kind, ports, begin.wheels, begin.irregularity, space.clone());
        let sizes = Sizes::new(begin.newmark, system.matrices(begin.newmark)?);
        let plane_state = State::rest(plane.track().order(), plane.fleet.order(), plane.fleet.axles(), supports);
        Ok(Self {
            state: Arc::new(system.rest()),
            sizes,
            start: begin.start,
            pre_roll: begin.pre_roll,
            input_meaning: begin.input_meaning,
            readings: plane.fleet.readings().concat(),
            plane,
            plane_state,
            pool: Pool::default(),
            deck: vec![0.0; 6 * supports],
            means: begin.means,
            mean: vec![0.0; 3 * supports],
            derailed: false,
            system,
        })
    }

    /// The system.
    pub fn system(&self) -> &SpaceSystem {
        &self.system
    }

    /// Whether the last step could not be done because a wheel has left its rail.
    pub fn has_ended(&self) -> bool {
        self.derailed
    }

    /// Start of the run, s.
    pub fn start(&self) -> f64 {
        self.start
    }

    /// The state at the end of the last step.
    pub fn state(&self) -> &Arc<SpaceState> {
        &self.state
    }

    /// Puts back a saved state.
    pub fn restore(&mut self, state: &Arc<SpaceState>) {
        self.state = Arc::clone(state);
    }

    /// Static equilibrium for the deck motion (velocities ignored).
    ///
    /// # Errors
    /// There is none, or it was not found.
    pub fn equilibrium(&mut self, deck: &[f64]) -> Result<(), String> {
        let mut state = self.system.rest();
        rest(&mut self.system, &mut self.plane, deck, &mut self.plane_state, &mut state)?;
        self.replace(state);
        Ok(())
    }

    /// From static equilibrium to the state of the start.
    ///
    /// # Errors
    /// The pre-roll cannot be done.
    pub fn roll_in(&mut self) -> Result<(), String> {
        if self.pre_roll > 0.0 {
            let mut state = SpaceState::clone(&self.state);
            pre_roll(&mut self.system, self.sizes.nominal(), self.pre_roll, &mut state)?;
            self.replace(state);
        }
        Ok(())
    }

    fn replace(&mut self, state: SpaceState) {
        self.mean.copy_from_slice(&state.supports);
        self.state = Arc::new(state);
        self.means.begin();
        let n = self.means.mean.len();
        self.means.mean.copy_from_slice(&self.mean[..n]);
    }

    /// One macro step from `t` to `t + h`: as many equal sub-steps as it takes to be no longer than the nominal step.
    ///
    /// # Errors
    /// A sub-step cannot be done; the state is then that of the last one that could.
    pub fn step(&mut self, inputs: &[f64], rates: Option<&[f64]>, t: f64, h: f64) -> Result<(), String> {
        let parts = self.sizes.parts(h)?;
        let deck = Inputs { values: inputs, rates, meaning: self.input_meaning, supports: self.mean.len() / 3 };
        self.means.begin();
        self.mean.fill(0.0);
        self.derailed = false;
        let done = (0..parts as u64).try_for_each(|part| {
            let span = Span { t: t - self.start, h, to: (part + 1) as f64 / parts, size: 1.0 / parts };
            self.sub_step(&deck, &span)
        });
        self.derailed = matches!(done, Err(StepError::Derailed(_)));
        done.map_err(|error| error.to_string())
    }

    /// One sub-step. Where no forces of the contacts are found it is taken in 2, 4, 8 or 16 parts. A creep force without bound
    /// grows as N^{2/3}, as fast as the approach and at a flange that begins to touch much faster than N: there may be no
    /// equilibrium at the end of a long step. The inertia of wheel and rail helps in a short one, though not against the local
    /// compliance of the rail.
    fn sub_step(&mut self, deck: &Inputs, span: &Span) -> Result<(), StepError> {
        let before = Arc::clone(&self.state);
        let (mut done, mut divided) = (self.advance(deck, span), 1_u32);
        while matches!(done, Err(StepError::Unsolved(_))) && divided < MOST_PARTS {
            divided *= 2;
            let size = span.size / f64::from(divided);
            let (mean, means) = (self.mean.clone(), self.means.clone());
            done = (1..=divided).try_for_each(|k| {
                self.advance(deck, &Span { to: span.to - f64::from(divided - k) * size, size, ..*span })
            });
            if done.is_err() {
                (self.state, self.mean, self.means) = (Arc::clone(&before), mean, means);
            }
        }
        done
    }

    /// One step over a span, with matrices of its size.
    fn advance(&mut self, deck: &Inputs, span: &Span) -> Result<(), StepError> {
        let Span { t, h, to, size } = *span;
        let matrices = self.sizes.of(h * size, |newmark| self.system.matrices(newmark))?;
        let tau = h * to;
        deck.at(tau, &self.state.deck, &mut self.deck);
        let mut buffer = self.pool.take(|| SpaceState::clone(&self.state));
        let Some(new) = Arc::get_mut(&mut buffer) else {
            return Err(StepError::Refused("a state buffer is in use".into()));
        };
        self.system.step(matrices, &self.state, new, &self.deck, t + tau)?;
        add([&self.state, new], size, &self.system.prepared.track, &mut self.mean, &mut self.means);
        self.pool.give(&buffer);
        self.state = buffer;
        Ok(())
    }

    /// Fills in all outputs at time `t`, s; `plane` of them are those of a plane run.
    pub fn outputs(&mut self, t: f64, plane: usize, out: &mut [f64]) {
        self.see_plane();
        let (first, rest) = out.split_at_mut(plane);
        View {
            system: &self.plane,
            readings: &self.readings,
            state: &self.plane_state,
            means: &self.means,
            t: t - self.start,
        }
        .write(first);
        outputs::write(&self.system, &self.state, &self.mean, rest);
    }

    /// The state as a plane run would see it.
    fn see_plane(&mut self) {
        let (state, plane) = (&self.state, &mut self.plane_state);
        for (to, from) in [
            (&mut plane.track.u, &state.track.u),
            (&mut plane.track.v, &state.track.v),
            (&mut plane.track.a, &state.track.a),
        ] {
            to.copy_from_slice(from);
        }
        let n = self.mean.len() / 3;
        plane.supports.copy_from_slice(&state.supports[..n]);
        plane.deck.copy_from_slice(&state.deck[..2 * n]);
        for car in 0..self.system.of_kind.len() {
            for (to, from) in PLANE {
                let (to, from) = (car * PLANE.len() + to, car * DOFS + from);
                plane.cars.u[to] = state.cars.u[from];
                plane.cars.v[to] = state.cars.v[from];
                plane.cars.a[to] = state.cars.a[from];
            }
        }
        self.plane.wheels.points.copy_from_slice(&self.system.wheels.points);
        self.plane.wheels.roughness.copy_from_slice(&self.system.wheels.roughness);
        let mut at = 0;
        for (car, ports) in self.system.ports.iter().enumerate() {
            for axle in 0..AXLES {
                let (i, port) = (car * AXLES + axle, at + axle * PORTS);
                plane.forces[i] = -state.ports[0][port + 1];
                plane.delta[i] = state.ports[1][port + 1] - self.system.wheels.roughness[i];
            }
            at += ports.n;
        }
    }
}

/// Takes a step between two states, `size` of a macro step, into means, work and peaks.
fn add([old, new]: [&SpaceState; 2], size: f64, track: &Track, mean: &mut [f64], means: &mut StepMeans) {
    let n = mean.len() / 3;
    for (k, mean) in mean.iter_mut().enumerate() {
        let force = 0.5 * (old.supports[k] + new.supports[k]);
        let at = k / n * 2 * n + k % n;
        *mean += size * force;
        means.work += force * (new.deck[at] - old.deck[at]);
    }
    means.mean.copy_from_slice(&mean[..n]);
    means.look(track, &new.track.a);
}
