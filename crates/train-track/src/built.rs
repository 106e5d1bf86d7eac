//! Everything that follows from the parameters, and the running state: set-up and macro steps around
//! [`TrainTrackSystem::step`].

use std::sync::Arc;

use ttb_dynamics::newmark::Newmark;
use ttb_dynamics::pool::Pool;
use ttb_scenario::limits::pre_roll_steps;
use ttb_scenario::spec::TrainTrackSpec;
use ttb_scenario::travel::fade_in;

use crate::contact::Contacts;
use crate::coupled::{StepMatrices, TrainTrackSystem};
use crate::fleet::{Fleet, Reading};
use crate::macro_step::{Inputs, Sizes};
use crate::outputs::View;
use crate::parameters::{Parameter, Parameters};
use crate::pre_roll::pre_roll;
use crate::prepared::Prepared;
use crate::profile::Irregularity;
use crate::profile::rails::Rails;
use crate::space::built::{Begin, SpaceBuilt};
use crate::speed::Running;
use crate::state::State;
use crate::statics::equilibrium;
use crate::step_means::StepMeans;
use crate::wheels::{Wheels, on_rail};

/// A train on its track, ready to run.
pub struct Built {
    system: TrainTrackSystem,
    sizes: Sizes<StepMatrices>,
    start: f64,
    pre_roll: f64,
    input_meaning: f64,
    /// Outputs of all vehicles.
    readings: Vec<Reading>,
    state: Arc<State>,
    pool: Pool<State>,
    /// [d…, ḋ…] at the end of a sub-step.
    deck: Vec<f64>,
    /// What the last macro step adds to its end.
    means: StepMeans,
    /// Abscissae between which wheels ever are, m.
    passage: [f64; 2],
}

impl Built {
    /// Sets up a train on a prepared track, at rest; time counts from `start`.
    ///
    /// # Errors
    /// Parameters that this train cannot run with, as a message.
    pub fn new(
        spec: &TrainTrackSpec,
        prepared: Arc<Prepared>,
        parameters: &Parameters,
        start: f64,
    ) -> Result<Self, String> {
        let get = |parameter| parameters.get(parameter);
        let (first, speed) = (spec.speed[0][1], get(Parameter::Speed));
        if first <= 0.0 && speed != first {
            return Err("parameter speed scales the speed profile, which begins at rest: it cannot be changed".into());
        }
        let running = Running::new(&spec.speed, if first > 0.0 { speed / first } else { 1.0 });
        let newmark = Newmark::new(get(Parameter::Gamma), get(Parameter::Beta), get(Parameter::StepSize));
        // The cars are pre-rolled over their own length more, so that the last one has run as far as asked.
        let length = spec.length();
        let pre_roll = if get(Parameter::PreRoll) > 0.0 { get(Parameter::PreRoll) + length } else { 0.0 };
        pre_roll_steps(pre_roll, running.speed(0.0), newmark.h).map_err(|e| format!("parameter pre_roll: {e}"))?;
        let (track, front) = (&prepared.track, get(Parameter::FrontWheel));
        let offsets = spec.offsets();
        for (axle, offset) in offsets.iter().enumerate() {
            on_rail(track, axle, front - offset, 0.0)?;
        }
        let wheels = offsets.last().copied().unwrap_or(0.0);
        let passage = [fade_in(front, wheels, length, get(Parameter::PreRoll)), track.extent().1];
        let (scale, seed) = (get(Parameter::IrregularityScale), get(Parameter::IrregularitySeed) as u64);
        let irregularity = Irregularity::new(&spec.irregularity, scale, passage, Some(seed));
        let points: Option<Vec<_>> = spec.rail_points.iter().map(|point| track.locate(point.x)).collect();
        let supports = track.bridge_supports();
        let means = StepMeans::new(supports, points.ok_or("a monitored point lies beyond the rail")?);
        let fleet = Fleet::new(&spec.consist())?;
        let state = Arc::new(State::rest(track.order(), fleet.order(), fleet.axles(), supports));
        let laws = fleet.laws(&spec.contact);
        let wheels = Wheels::new(offsets, front, running, irregularity);
        let system = TrainTrackSystem::new(prepared, fleet, Contacts::new(laws), wheels);
        Ok(Self {
            sizes: Sizes::new(newmark, system.matrices(newmark)?),
            start,
            pre_roll,
            readings: system.fleet.readings().concat(),
            system,
            input_meaning: get(Parameter::InputMeaning),
            state,
            pool: Pool::default(),
            deck: vec![0.0; 2 * supports],
            means,
            passage,
        })
    }

    /// The same train in space.
    ///
    /// # Errors
    /// Data that it cannot run with, as a message.
    pub fn in_space(self, spec: &TrainTrackSpec, parameters: &Parameters) -> Result<SpaceBuilt, String> {
        let (Some(space), Some(lines)) = (&spec.space, &self.system.prepared.lines) else {
            return Err("the data lack what a run in space has".into());
        };
        let get = |parameter| parameters.get(parameter);
        let passage = self.passage;
        let (scale, seed) = (get(Parameter::IrregularityScale), get(Parameter::IrregularitySeed) as u64);
        let begin = Begin {
            start: self.start,
            pre_roll: self.pre_roll,
            input_meaning: self.input_meaning,
            friction: get(Parameter::Friction),
            newmark: self.sizes.newmark(),
            means: self.means,
            wheels: self.system.wheels.clone(),
            irregularity: Rails::new(spec, &space.irregularity, scale, passage, Some(seed)),
        };
        let lines = Arc::clone(lines);
        SpaceBuilt::new(spec, space, self.system, lines, begin)
    }

    /// The track it runs on.
    pub fn prepared(&self) -> &Arc<Prepared> {
        &self.system.prepared
    }

    /// Start of the run, s.
    pub fn start(&self) -> f64 {
        self.start
    }

    /// The state at the end of the last step.
    pub fn state(&self) -> &Arc<State> {
        &self.state
    }

    /// Puts back a saved state.
    pub fn restore(&mut self, state: &Arc<State>) {
        self.state = Arc::clone(state);
    }

    /// Fills in all outputs at time `t`, s.
    pub fn outputs(&self, t: f64, out: &mut [f64]) {
        View {
            system: &self.system,
            readings: &self.readings,
            state: &self.state,
            means: &self.means,
            t: t - self.start,
        }
        .write(out);
    }

    /// Static equilibrium for the deck motion [d…, ḋ…] (velocities ignored).
    ///
    /// # Errors
    /// There is none, or it was not found.
    pub fn equilibrium(&mut self, deck: &[f64]) -> Result<(), String> {
        let mut state = State::clone(&self.state);
        equilibrium(&mut self.system, 0.0, deck, &mut state)?;
        self.replace(state);
        Ok(())
    }

    /// From static equilibrium to the state of the start: rolls the cars if that is asked for.
    ///
    /// # Errors
    /// The pre-roll cannot be done.
    pub fn roll_in(&mut self) -> Result<(), String> {
        if self.pre_roll > 0.0 {
            let mut state = State::clone(&self.state);
            pre_roll(&mut self.system, self.sizes.nominal(), self.pre_roll, &mut state)?;
            self.replace(state);
        }
        Ok(())
    }

    fn replace(&mut self, state: State) {
        self.state = Arc::new(state);
        self.means.rest(&self.state);
    }

    /// One macro step from `t` to `t + h`: as many equal sub-steps as it takes to be no longer than the nominal step.
    ///
    /// # Errors
    /// A sub-step cannot be done; the state is then that of the last one that could.
    pub fn step(&mut self, inputs: &[f64], rates: Option<&[f64]>, t: f64, h: f64) -> Result<(), String> {
        let parts = self.sizes.parts(h)?;
        let matrices = self.sizes.of(h / parts, |newmark| self.system.matrices(newmark))?;
        let supports = self.means.mean.len();
        let deck = Inputs { values: inputs, rates, meaning: self.input_meaning, supports };
        let t = t - self.start;
        self.means.begin();
        for part in 1..=parts as u64 {
            let tau = h * (part as f64 / parts);
            deck.at(tau, &self.state.deck, &mut self.deck);
            let mut buffer = self.pool.take(|| State::clone(&self.state));
            let Some(new) = Arc::get_mut(&mut buffer) else { return Err("a state buffer is in use".into()) };
            self.system.step(matrices, &self.state, new, &self.deck, t + tau)?;
            self.means.add(self.system.track(), &self.state, new, parts);
            self.pool.give(&buffer);
            self.state = buffer;
        }
        Ok(())
    }
}
