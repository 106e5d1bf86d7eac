//! The train–track subsystem as a [`Model`]: parameters, initialization, sub-steps and input meaning around
//! [`TrainTrackSystem::step`].

use std::path::Path;
use std::sync::Arc;

use ttb_contract::{Interface, Model, ModelError, Values};
use ttb_dynamics::band::BandFactor;
use ttb_dynamics::newmark::Newmark;
use ttb_dynamics::pool::Pool;
use ttb_scenario::spec::TrainTrackSpec;
use ttb_scenario::travel::wheel_offsets;

use crate::car::{AXLES, Car};
use crate::contact::{Contacts, Law};
use crate::coupled::{State, StepMatrices, TrainTrackSystem};
use crate::over::Over;
use crate::profile::Irregularity;
use crate::speed::Running;
use crate::statics;
use crate::track::{FastenerFactors, Track};
use crate::variables::{self, Parameter};

/// Resource file inside the FMU.
const RESOURCE: &str = "train-track.json";
/// Steps within this of the factorised one are that one.
const SAME_STEP: f64 = 1e-9;
/// Sub-steps of a macro step at most: more is a mistake in `step_size`.
const MOST_SUBSTEPS: f64 = 1e6;
/// Pre-roll at most, m.
const LONGEST_PRE_ROLL: f64 = 1e4;
/// Step sizes kept factorised.
const STEP_SIZES: usize = 4;

/// The train–track subsystem.
pub struct TrainTrack {
    spec: TrainTrackSpec,
    interface: Interface,
    built: Option<Built>,
}

/// Everything that follows from the parameters, and the running state.
struct Built {
    system: TrainTrackSystem,
    statics: BandFactor,
    /// The nominal step first, then others as they come.
    steps: Vec<StepMatrices>,
    start: f64,
    pre_roll: f64,
    input_meaning: f64,
    state: Arc<State>,
    pool: Pool<State>,
    /// [d…, ḋ…] at the end of a sub-step.
    deck: Vec<f64>,
    /// What the last macro step adds to its end.
    over: Over,
}

fn error(message: impl Into<String>) -> ModelError {
    ModelError(message.into())
}

impl TrainTrack {
    /// From a resolved scenario.
    ///
    /// # Errors
    /// Never for a checked specification; a message otherwise.
    pub fn new(spec: TrainTrackSpec) -> Result<Self, ModelError> {
        if spec.cars.is_empty()
            || spec.speed.is_empty()
            || spec.on_bridge.is_empty()
            || spec.bays == 0
            || spec.elements_per_bay == 0
        {
            return Err(error("the train–track data lack cars, speed, track bays or supports on the bridge"));
        }
        if spec.on_bridge.last().is_some_and(|last| *last > spec.bays) {
            return Err(error("a support on the bridge lies beyond the track"));
        }
        Ok(Self { interface: variables::interface(&spec), spec, built: None })
    }

    fn built(&mut self) -> Result<&mut Built, ModelError> {
        self.built.as_mut().ok_or_else(|| error("the model is not initialized"))
    }

    fn outputs(&self, values: &mut Values, t: f64) {
        if let Some(b) = &self.built {
            let out = &mut values.all[self.interface.outputs()];
            variables::write_outputs(&b.system, &b.state, &b.over, t, out);
        }
    }
}

impl Model for TrainTrack {
    type State = Arc<State>;

    fn load(resources: &Path) -> Result<Self, ModelError> {
        let path = resources.join(RESOURCE);
        let text = std::fs::read_to_string(&path).map_err(|e| error(format!("resource {}: {e}", path.display())))?;
        let spec =
            serde_json::from_str(&text).map_err(|e| error(format!("resource {} is damaged: {e}", path.display())))?;
        Self::new(spec)
    }

    fn interface(&self) -> &Interface {
        &self.interface
    }

    fn default_experiment(&self) -> (f64, f64) {
        (self.spec.step, self.spec.end)
    }

    fn build(&mut self, values: &Values, start: f64) -> Result<(), ModelError> {
        let get = |p| variables::parameter(&self.interface, values, p);
        check_parameters(&get)?;
        let mut spec = self.spec.clone();
        spec.front_wheel = get(Parameter::FrontWheel);
        spec.pre_roll = get(Parameter::PreRoll);
        spec.local_compliance = get(Parameter::LocalCompliance) != 0.0;
        spec.irregularity_scale = get(Parameter::IrregularityScale);
        let first = spec.speed[0][1];
        let factor = if first > 0.0 { get(Parameter::Speed) / first } else { 1.0 };
        if first <= 0.0 && get(Parameter::Speed) != first {
            return Err(error("parameter speed scales the speed profile, which begins at rest: it cannot be changed"));
        }
        let running = Running::new(&spec.speed, factor);
        let newmark = Newmark::new(get(Parameter::Gamma), get(Parameter::Beta), get(Parameter::StepSize));
        let factors = FastenerFactors {
            stiffness: get(Parameter::FastenerStiffnessFactor),
            damping: get(Parameter::FastenerDampingFactor),
        };
        let track = Track::new(&spec, factors);
        let cars: Vec<Car> = spec.cars.iter().map(Car::new).collect();
        let laws = cars.iter().flat_map(|c| [Law::new(&spec.contact, c.axle_load); AXLES]).collect();
        // The cars are pre-rolled over their own length more, so that the last one has run as far as asked.
        let length: f64 = spec.cars.iter().map(|c| c.length).sum();
        let pre_roll = if spec.pre_roll > 0.0 { spec.pre_roll + length } else { 0.0 };
        let seed = get(Parameter::IrregularitySeed) as u64;
        let way = [spec.front_wheel - pre_roll, track.extent().1];
        let irregularity = Irregularity::new(&spec.irregularity, spec.irregularity_scale, way, Some(seed));
        let statics = track.effective(0.0, 0.0).factorise().map_err(|e| error(format!("track at rest: {e}")))?;
        let (n, supports) = (track.order(), track.bridge_supports());
        let points: Option<Vec<_>> = spec.rail_points.iter().map(|point| track.locate(point.x)).collect();
        let over = Over::new(supports, points.ok_or_else(|| error("a monitored point lies beyond the rail"))?);
        let offsets = wheel_offsets(&spec.cars);
        let system =
            TrainTrackSystem::new(track, cars, Contacts::new(laws), offsets, spec.front_wheel, running, irregularity);
        let steps = vec![system.matrices(newmark).map_err(error)?];
        let state = Arc::new(State::rest(n, system.cars.len(), supports));
        let input_meaning = get(Parameter::InputMeaning);
        let deck = vec![0.0; 2 * supports];
        self.built = Some(Built {
            system,
            statics,
            steps,
            start,
            pre_roll,
            input_meaning,
            state,
            pool: Pool::default(),
            deck,
            over,
        });
        Ok(())
    }

    fn equilibrium(&mut self, values: &mut Values) -> Result<(), ModelError> {
        let inputs = values.all[self.interface.inputs()].to_vec();
        let b = self.built()?;
        let mut state = State::clone(&b.state);
        statics::equilibrium(&mut b.system, &b.statics, 0.0, &inputs, &mut state).map_err(error)?;
        b.replace(state);
        self.outputs(values, 0.0);
        Ok(())
    }

    fn start(&mut self, values: &mut Values) -> Result<(), ModelError> {
        let b = self.built()?;
        if b.pre_roll > 0.0 {
            let mut state = State::clone(&b.state);
            statics::pre_roll(&mut b.system, &b.statics, &b.steps[0], b.pre_roll, &mut state).map_err(error)?;
            b.replace(state);
        }
        self.outputs(values, 0.0);
        Ok(())
    }

    fn step(&mut self, values: &mut Values, t: f64, h: f64) -> Result<(), ModelError> {
        let inputs = self.interface.inputs();
        let b = self.built.as_mut().ok_or_else(|| error("the model is not initialized"))?;
        b.macro_step(&values.all[inputs], values.has_rates.then_some(&values.rates), t - b.start, h).map_err(error)?;
        let end = t - b.start + h;
        self.outputs(values, end);
        Ok(())
    }

    fn save(&self) -> Self::State {
        self.built.as_ref().map_or_else(|| Arc::new(State::rest(0, 0, 0)), |b| Arc::clone(&b.state))
    }

    fn restore(&mut self, state: &Self::State) {
        if let Some(b) = &mut self.built {
            b.state = Arc::clone(state);
        }
    }

    fn write_state(&self, state: &Self::State, bytes: &mut Vec<u8>) {
        state.numbers().for_each(|x| bytes.extend(x.to_le_bytes()));
    }

    fn read_state(&self, bytes: &[u8]) -> Result<Self::State, ModelError> {
        let b = self.built.as_ref().ok_or_else(|| error("the model is not initialized"))?;
        let mut state = State::clone(&b.state);
        if state.numbers().count() * 8 != bytes.len() {
            return Err(error("the serialized FMU state belongs to another train or track"));
        }
        let numbers =
            bytes.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]));
        state.numbers_mut().zip(numbers).for_each(|(x, y)| *x = y);
        Ok(Arc::new(state))
    }
}

impl Built {
    fn replace(&mut self, state: State) {
        self.state = Arc::new(state);
        self.over.rest(&self.state);
    }

    /// Position of the matrices for sub-steps of `h` seconds; factorises when the size is new.
    fn matrices(&mut self, h: f64) -> Result<usize, String> {
        let same = |m: &StepMatrices| (m.newmark.h - h).abs() <= SAME_STEP * h;
        if let Some(i) = self.steps.iter().position(same) {
            return Ok(i);
        }
        let nominal = self.steps[0].newmark;
        let matrices = self.system.matrices(Newmark::new(nominal.gamma, nominal.beta, h))?;
        if self.steps.len() == STEP_SIZES {
            self.steps.remove(1);
        }
        self.steps.push(matrices);
        Ok(self.steps.len() - 1)
    }

    /// One macro step: as many equal sub-steps as it takes to be no longer than the nominal step.
    fn macro_step(&mut self, inputs: &[f64], rates: Option<&Vec<f64>>, t: f64, h: f64) -> Result<(), String> {
        let nominal = self.steps[0].newmark.h;
        let parts = (h / nominal * (1.0 - SAME_STEP)).ceil().max(1.0);
        if parts > MOST_SUBSTEPS {
            return Err(format!("a step of {h} s has more than {MOST_SUBSTEPS} parts of step_size = {nominal} s"));
        }
        let matrices = self.matrices(h / parts)?;
        let supports = self.over.mean.len();
        self.over.begin();
        for part in 1..=parts as u64 {
            let tau = h * (part as f64 / parts);
            self.deck_at(inputs, rates, tau, supports);
            let mut buffer = self.pool.take(|| State::clone(&self.state));
            let Some(new) = Arc::get_mut(&mut buffer) else { return Err("a state buffer is in use".into()) };
            self.system.step(&self.steps[matrices], &self.state, new, &self.deck, t + tau)?;
            self.over.add(&self.system.track, &self.state, new, parts);
            self.pool.give(&buffer);
            self.state = buffer;
        }
        Ok(())
    }

    /// Deck motion at `tau` seconds into the step, from what the inputs mean.
    fn deck_at(&mut self, inputs: &[f64], rates: Option<&Vec<f64>>, tau: f64, supports: usize) {
        let end_of_last = &self.state.deck;
        for i in 0..inputs.len() {
            self.deck[i] = match rates {
                Some(rates) => inputs[i] + rates[i] * tau,
                None if self.input_meaning == 2.0 => 2.0 * inputs[i] - end_of_last[i],
                None if self.input_meaning == 1.0 && i < supports => inputs[i] + tau * inputs[i + supports],
                None => inputs[i],
            };
        }
    }
}

/// What the interface list cannot say: parameters that must be positive, or not negative.
fn check_parameters(get: &dyn Fn(Parameter) -> f64) -> Result<(), ModelError> {
    use Parameter::{Beta, FastenerDampingFactor, FastenerStiffnessFactor, Gamma, PreRoll, Speed, StepSize};
    let upper = [(PreRoll, "pre_roll", LONGEST_PRE_ROLL), (Gamma, "gamma", 1.0)];
    for (parameter, name, most) in upper {
        if get(parameter) > most {
            return Err(error(format!("parameter {name} is {}; it must be at most {most}", get(parameter))));
        }
    }
    let rules = [
        (FastenerStiffnessFactor, "fastener_stiffness_factor", 0.0, true),
        (FastenerDampingFactor, "fastener_damping_factor", 0.0, false),
        (PreRoll, "pre_roll", 0.0, false),
        (Speed, "speed", 0.0, false),
        (StepSize, "step_size", 0.0, true),
        (Gamma, "gamma", 0.5, false),
        (Beta, "beta", 0.0, true),
    ];
    for (parameter, name, least, strict) in rules {
        let value = get(parameter);
        if value < least || (strict && value == least) {
            let rule = if strict { "above" } else { "at least" };
            return Err(error(format!("parameter {name} is {value}; it must be {rule} {least}")));
        }
    }
    Ok(())
}
