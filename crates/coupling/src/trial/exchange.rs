//! One trial of a step: forces to the bridge, its motion to train and track, their forces back.
//!
//! Sent is a straight line over the step, as value and rate, or as the held mean:
//!
//! ```text
//! λ_n, (λ − λ_n)/h;   d_n, ḋ_n, (d − d_n)/h, (ḋ − ḋ_n)/h        or        (λ_n + λ)/2;   (d_n + d)/2, (ḋ_n + ḋ)/2
//! ```
//!
//! Where train and track take sub-steps, λ is the mean force of a step and goes to the bridge as it is, held.

use ttb_contract::{Failure, Parts, Ports, Subsystem};

use crate::algebra::{each, not_finite};
use crate::error::IterationError;
use crate::report::Side;
use crate::settings::Settings;

/// Both subsystems and the step [t, t + h] they are asked for.
pub(crate) struct Sides<'a> {
    pub train_track: &'a mut dyn Subsystem,
    pub bridge: &'a mut dyn Subsystem,
    pub t: f64,
    pub h: f64,
}

impl Sides<'_> {
    pub fn save(&mut self) -> Result<(), Failure> {
        self.train_track.save()?;
        self.bridge.save()
    }
    pub fn restore(&mut self) -> Result<(), Failure> {
        self.train_track.restore()?;
        self.bridge.restore()
    }
    /// The same subsystems for another step.
    pub fn over(&mut self, t: f64, h: f64) -> Sides<'_> {
        Sides { train_track: &mut *self.train_track, bridge: &mut *self.bridge, t, h }
    }
}

/// Deck motion, and room for what is sent. Vectors of motions are in the order of the ports: positions, rates, others.
#[derive(Debug)]
pub(crate) struct Exchange {
    ports: Ports,
    /// Send forces as held means whatever the bridge can.
    hold_forces: bool,
    /// λ is a mean already.
    mean_forces: bool,
    /// Motion at t_n.
    pub now: Vec<f64>,
    /// Motion at the end of the trial.
    pub motion: Vec<f64>,
    sent_force: Vec<f64>,
    sent_motion: Vec<f64>,
}

impl Exchange {
    pub fn new(ports: Ports, settings: &Settings) -> Self {
        let (force, motion) = (vec![0.0; ports.forces()], vec![0.0; ports.motions()]);
        let Settings { hold_forces, mean_forces, .. } = *settings;
        Self {
            ports,
            hold_forces,
            mean_forces,
            now: motion.clone(),
            motion: motion.clone(),
            sent_force: force,
            sent_motion: motion,
        }
    }

    /// The ports.
    pub fn ports(&self) -> &Ports {
        &self.ports
    }

    /// Motion at t_n and at the end of the trial, by parts.
    pub fn parts(&mut self) -> (Parts<&[f64]>, Parts<&mut [f64]>) {
        (self.ports.parts(&self.now), self.ports.parts_mut(&mut self.motion))
    }

    /// What the bridge gets of a change of λ: all of it, at the step's end or as mean, or half of it as mean.
    pub fn share_of_force(&self, bridge: &dyn Subsystem) -> f64 {
        if self.mean_forces || self.interpolates(bridge) { 1.0 } else { 0.5 }
    }

    fn interpolates(&self, bridge: &dyn Subsystem) -> bool {
        bridge.can_interpolate() && !self.hold_forces
    }

    /// λ → motion, from the states the subsystems are in.
    pub fn bridge(&mut self, sides: &mut Sides, now: &[f64], lambda: &[f64], back: bool) -> Result<(), IterationError> {
        self.announce(sides, now, lambda)?;
        sides.bridge.step(sides.t, sides.h, back)?;
        sides.bridge.get_outputs(&mut self.motion)?;
        check(&self.motion, Side::Bridge, sides.bridge, sides.t + sides.h)
    }

    /// Sets the bridge's forces for a step that is not taken (yet).
    pub fn announce(&mut self, sides: &mut Sides, now: &[f64], lambda: &[f64]) -> Result<(), Failure> {
        if self.mean_forces {
            return sides.bridge.set_inputs(lambda, None);
        }
        let interpolate = self.interpolates(sides.bridge);
        send(sides.bridge, now, lambda, sides.h, interpolate, &mut self.sent_force)
    }

    /// Motion → G.
    pub fn train_track(&mut self, sides: &mut Sides, answer: &mut [f64], back: bool) -> Result<(), IterationError> {
        let interpolate = sides.train_track.can_interpolate();
        send(sides.train_track, &self.now, &self.motion, sides.h, interpolate, &mut self.sent_motion)?;
        sides.train_track.step(sides.t, sides.h, back)?;
        sides.train_track.get_outputs(answer)?;
        check(answer, Side::TrainTrack, sides.train_track, sides.t + sides.h)
    }

    /// λ → G(λ), from the saved states.
    pub fn trial(
        &mut self,
        sides: &mut Sides,
        now: &[f64],
        lambda: &[f64],
        answer: &mut [f64],
    ) -> Result<(), IterationError> {
        // Also before the first trial: some FMUs step differently the first time than after a restored state.
        sides.restore()?;
        self.bridge(sides, now, lambda, true)?;
        self.train_track(sides, answer, true)
    }

    /// λ → G(λ) in static equilibrium.
    pub fn equilibrium(&mut self, sides: &mut Sides, lambda: &[f64], answer: &mut [f64]) -> Result<(), IterationError> {
        sides.bridge.set_inputs(lambda, None)?;
        sides.bridge.get_outputs(&mut self.motion)?;
        check(&self.motion, Side::Bridge, sides.bridge, sides.t + sides.h)?;
        sides.train_track.set_inputs(&self.motion, None)?;
        sides.train_track.get_outputs(answer)?;
        check(answer, Side::TrainTrack, sides.train_track, sides.t + sides.h)
    }

    /// Reads what both sides say after initialization mode: the motion at t_0, and the forces into `answer`.
    pub fn start(&mut self, sides: &mut Sides, answer: &mut [f64]) -> Result<(), IterationError> {
        sides.bridge.get_outputs(&mut self.now)?;
        check(&self.now, Side::Bridge, sides.bridge, sides.t)?;
        sides.train_track.get_outputs(answer)?;
        check(answer, Side::TrainTrack, sides.train_track, sides.t)
    }

    /// The trial is accepted.
    pub fn accept(&mut self) {
        std::mem::swap(&mut self.now, &mut self.motion);
    }
}

/// Refuses NaN and infinity where they appear: one of them spoils everything it meets. `t` is the time they belong to.
fn check(values: &[f64], side: Side, from: &dyn Subsystem, t: f64) -> Result<(), IterationError> {
    let Some(index) = not_finite(values) else { return Ok(()) };
    let (subsystem, output) = (from.name().to_string(), from.output_name(index));
    Err(IterationError::NotFinite { t, side, subsystem, output, value: values[index] })
}

/// Sends a straight line from `from` to `to` over a step of `h`: as value and rate, or as the held mean.
fn send(
    to_whom: &mut dyn Subsystem,
    from: &[f64],
    to: &[f64],
    h: f64,
    interpolate: bool,
    buffer: &mut [f64],
) -> Result<(), Failure> {
    if interpolate {
        // One division for all: they are slow.
        let per_second = 1.0 / h;
        each(buffer, [from, to], |[from, to]| per_second * (to - from));
        to_whom.set_inputs(from, Some(buffer))
    } else {
        each(buffer, [from, to], |[from, to]| 0.5 * (from + to));
        to_whom.set_inputs(buffer, None)
    }
}
