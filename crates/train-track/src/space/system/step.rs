//! The step itself.

use std::sync::Arc;

use ttb_contract::finite::not_finite;
use ttb_dynamics::newmark::Motion;
use ttb_wheel_rail::patch::Contacting;

use super::super::axle::{PORTS, RAIL_PORTS};
use super::super::car::AXLES;
use super::super::error::StepError;
use super::super::newton::Of;
use super::super::rails::W_SUM;
use super::super::state::SpaceState;
use super::{SpaceStep, SpaceSystem};

impl SpaceSystem {
    /// One step from `old` to `new`, which ends at time `t` with the deck motion `deck` (see [`SpaceState::deck`]).
    ///
    /// # Errors
    /// A wheel beyond the rail or off it, contacts that do not converge, a number that is not finite.
    pub fn step(
        &mut self,
        matrices: &SpaceStep,
        old: &Arc<SpaceState>,
        new: &mut SpaceState,
        deck: &[f64],
        t: f64,
    ) -> Result<(), StepError> {
        self.place(matrices, t)?;
        let newmark = &matrices.newmark;
        let key = |of: &Option<(Arc<SpaceState>, u64, u64)>| {
            of.as_ref().is_some_and(|(state, h, at)| {
                Arc::ptr_eq(state, old) && *h == newmark.h.to_bits() && *at == t.to_bits()
            })
        };
        if !key(&self.history_for) {
            self.prepared.track.history(newmark, &old.track, &mut self.history[0], &mut self.work);
            for (k, (line, _)) in self.lines.lines.iter().enumerate() {
                line.history(newmark, &old.lines[k], &mut self.history[k + 1]);
            }
            if let Some(ground) = &self.loads.ground {
                let ground = ground.at(t);
                let ([y, z], [vy, vz]) = (ground.displacement, ground.velocity);
                self.prepared.track.add_ground(z, vz, &mut self.history[0]);
                for ((line, _), history) in self.lines.lines.iter().zip(&mut self.history[1..]) {
                    line.add_ground(y, vy, history);
                }
            }
            for (free, history) in self.free.iter_mut().zip(&self.history) {
                free.copy_from_slice(history);
            }
            matrices.track.factor.solve(&mut self.free[0]);
            for (factors, free) in matrices.lines.iter().zip(&mut self.free[1..]) {
                factors.factor.solve(free);
            }
            self.free_cars(matrices, &old.cars, t);
            self.history_for = Some((Arc::clone(old), newmark.h.to_bits(), t.to_bits()));
        }
        // 2: ports.
        let supports = self.prepared.track.bridge_supports();
        let across = |i: usize| {
            [[deck[2 * supports + i], deck[4 * supports + i]], [deck[3 * supports + i], deck[5 * supports + i]]]
        };
        self.prepared.track.deck_forces(&deck[..2 * supports], &mut self.deck_forces);
        for ((line, _), forces) in self.lines.lines.iter().zip(&mut self.line_forces) {
            line.deck_forces(across, forces);
        }
        self.free_car_ports(newmark, &old.cars);
        self.free_rail_ports(matrices, old);
        let of = Of { a1: newmark.a[1], gamma: newmark.gamma, h: newmark.h, rails_move: true };
        self.begin_ports(old);
        let known = key(&self.jacobian_for);
        self.jacobian_for = None;
        self.begin_jacobians(&of, known)?;
        self.jacobian_for = Some((Arc::clone(old), newmark.h.to_bits(), t.to_bits()));
        self.solve_ports(&of, t)?;
        // 3: rails and cars.
        new.track.u.copy_from_slice(&self.history[0]);
        self.prepared.track.add_deck_forces(&self.deck_forces, &mut new.track.u);
        for (k, (line, _)) in self.lines.lines.iter().enumerate() {
            new.lines[k].u.copy_from_slice(&self.history[k + 1]);
            line.add_deck_forces(&self.line_forces[k], &mut new.lines[k].u);
        }
        for axle in 0..self.wheels.points.len() {
            let f = self.ports[axle / AXLES].on_rails(axle % AXLES);
            self.prepared.track.add_force(&self.wheels.points[axle], f[W_SUM], &mut new.track.u);
            for (k, (line, ports)) in self.lines.lines.iter().enumerate() {
                for (own, port) in ports.iter().enumerate() {
                    line.add_force(&self.points[k][axle], own, f[*port], &mut new.lines[k].u);
                }
            }
        }
        matrices.track.factor.solve(&mut new.track.u);
        newmark.finish_all(&old.track, &mut new.track);
        for (k, factors) in matrices.lines.iter().enumerate() {
            factors.factor.solve(&mut new.lines[k].u);
            newmark.finish_all(&old.lines[k], &mut new.lines[k]);
        }
        self.finish_cars(matrices, &old.cars, &mut new.cars);
        self.end_ports(new);
        // 4: support forces.
        self.support_forces(new, deck);
        match not_finite(&new.supports) {
            None => Ok(()),
            Some(i) => {
                let (support, force) = (i % supports + 1, new.supports[i]);
                Err(StepError::Refused(format!("the force of support {support} is {force} at t = {t} s")))
            }
        }
    }

    /// Forces on the deck of a state, with the deck motion `deck`, which the state takes over.
    pub fn support_forces(&self, state: &mut SpaceState, deck: &[f64]) {
        let supports = self.prepared.track.bridge_supports();
        let across = |i: usize| {
            [[deck[2 * supports + i], deck[4 * supports + i]], [deck[3 * supports + i], deck[5 * supports + i]]]
        };
        state.deck.copy_from_slice(deck);
        let (down, rest) = state.supports.split_at_mut(supports);
        self.prepared.track.support_forces(&state.track, &deck[..2 * supports], down);
        rest.fill(0.0);
        for ((line, _), motion) in self.lines.lines.iter().zip(&state.lines) {
            line.support_forces(motion, across, |i, [force, moment]| {
                rest[i] += force;
                rest[supports + i] += moment;
            });
        }
    }

    /// Takes the rails' free motion into s_free and ṡ_free.
    fn free_rail_ports(&mut self, matrices: &SpaceStep, old: &SpaceState) {
        let newmark = &matrices.newmark;
        let track = &self.prepared.track;
        for axle in 0..self.wheels.points.len() {
            let point = &self.wheels.points[axle];
            let mut motion = [[0.0; RAIL_PORTS]; 2];
            let mut set = |port: usize, s: f64, gone: f64| {
                (motion[0][port], motion[1][port]) = (s, newmark.a[1] * s - gone);
            };
            let reached = matrices.track.compliance.to_supports(point, &mut self.to_supports);
            let from_deck: f64 =
                self.to_supports[reached.clone()].iter().zip(&self.deck_forces[reached]).map(|(y, f)| y * f).sum();
            let s = track.deflection(point, &self.free[0]) + from_deck;
            let dofs = track.element_dofs(point.element);
            let past = |motion: &Motion, i: usize| newmark.damping(motion.u[i], motion.v[i], motion.a[i]);
            let gone: f64 = dofs.iter().zip(point.row).map(|(i, n)| n * past(&old.track, *i)).sum();
            set(W_SUM, s, gone);
            for (k, (line, rail_ports)) in self.lines.lines.iter().enumerate() {
                let point = &self.points[k][axle];
                let from_deck = matrices.lines[k].by_deck(line, point, &self.line_forces[k]);
                for (own, port) in rail_ports.iter().enumerate() {
                    let s = line.at(point, own, &self.free[k + 1]) + from_deck[own];
                    let gone = line.of(point, own, |i| past(&old.lines[k], i));
                    set(*port, s, gone);
                }
            }
            self.ports[axle / AXLES].meet_rails(axle % AXLES, motion);
        }
    }

    /// Forces and places of the patches of both wheels of an axle in a state.
    pub fn wheel(&self, state: &SpaceState, axle: usize, side: usize) -> (f64, [Contacting; 2]) {
        let before: usize = self.ports[..axle / AXLES].iter().map(|car| car.n).sum();
        let at = before + axle % AXLES * PORTS;
        let ports = &self.ports[axle / AXLES];
        let [s, v] = [1, 2].map(|k| &state.ports[k][at..at + PORTS]);
        ports.lever.patches(&ports.contact, side, s, v, &ports.places[axle % AXLES])
    }
}
