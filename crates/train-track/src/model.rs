//! The train–track subsystem as a [`Model`]: parameters and inputs by value reference around [`Either`],
//! a plane train or one in space.

use std::path::Path;
use std::sync::Arc;

use ttb_contract::finite::not_finite;
use ttb_contract::{Interface, Model, ModelError, Prepare, Values};
use ttb_scenario::limits::{MOST_BAYS, MOST_ELEMENTS_PER_BAY};
use ttb_scenario::spec::TrainTrackSpec;

use crate::built::Built;
use crate::either::{Either, Saved};
use crate::fleet::Fleet;
use crate::interface::interface;
use crate::outputs::plane_variables;
use crate::parameters::{Parameter, Parameters};
use crate::prepared::Prepared;
use crate::state::State;
use crate::track::FastenerFactors;

/// Resource file inside the FMU.
const RESOURCE: &str = "train-track.json";

/// The train–track subsystem.
pub struct TrainTrack {
    spec: TrainTrackSpec,
    interface: Interface,
    /// The track of the specification, where other runs share it.
    shared: Option<Arc<Prepared>>,
    /// Outputs that a plane run has.
    plane_outputs: usize,
    built: Option<Either>,
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
        if spec.axle_count() == 0 || spec.speed.is_empty() || spec.on_bridge.is_empty() {
            return Err(error("the train–track data lack cars, speed or supports on the bridge"));
        }
        let bays = (1..=MOST_BAYS).contains(&spec.bays);
        if !bays || !(1..=MOST_ELEMENTS_PER_BAY).contains(&spec.elements_per_bay) {
            let (bays, elements) = (spec.bays, spec.elements_per_bay);
            return Err(error(format!("a track of {bays} bays of {elements} rail elements cannot be built")));
        }
        if spec.on_bridge.iter().any(|support| *support > spec.bays) {
            return Err(error("a support on the bridge lies beyond the track"));
        }
        Fleet::new(&spec.consist()).map_err(error)?;
        let plane_outputs = plane_variables(&spec).len();
        Ok(Self { interface: interface(&spec), spec, shared: None, plane_outputs, built: None })
    }

    /// The same on a track that other runs share: for sweeps over speeds, seeds and trains.
    ///
    /// # Errors
    /// As [`TrainTrack::new`], and a track that is not the specification's.
    pub fn from_prepared(spec: TrainTrackSpec, prepared: Arc<Prepared>) -> Result<Self, ModelError> {
        if !prepared.fits(&spec, FastenerFactors::default()) {
            return Err(error("the prepared track is not that of the specification"));
        }
        Ok(Self { shared: Some(prepared), ..Self::new(spec)? })
    }

    /// The track that the present parameters run on; none before initialization.
    pub fn prepared(&self) -> Option<&Arc<Prepared>> {
        self.built.as_ref().map(Either::prepared)
    }

    fn built(&mut self) -> Result<&mut Either, ModelError> {
        self.built.as_mut().ok_or_else(|| error("the model is not initialized"))
    }

    /// Fills in the outputs at time `t`, s.
    ///
    /// # Errors
    /// One that is not finite, by name.
    fn outputs(&mut self, values: &mut Values, t: f64) -> Result<(), ModelError> {
        let Some(built) = &mut self.built else { return Ok(()) };
        let range = self.interface.outputs();
        let out = &mut values.all[range.clone()];
        built.outputs(t, self.plane_outputs, out);
        let Some(i) = not_finite(out) else { return Ok(()) };
        let name = &self.interface.variables()[range.start + i].name;
        Err(error(format!("{name} is {} at t = {t} s", out[i])))
    }

    /// The track for the present parameters: the shared one or the last one, unless the parameters change it.
    fn track(
        &self,
        last: Option<Arc<Prepared>>,
        spec: &TrainTrackSpec,
        fasteners: FastenerFactors,
    ) -> Result<Arc<Prepared>, ModelError> {
        match self.shared.clone().into_iter().chain(last).find(|prepared| prepared.fits(spec, fasteners)) {
            Some(prepared) => Ok(prepared),
            None => Prepared::with(spec, fasteners).map(Arc::new).map_err(error),
        }
    }
}

impl Model for TrainTrack {
    type State = Saved;

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
        // Of the parameters before these nothing may answer later, also when these are refused.
        let known = self.built.take().map(|built| Arc::clone(built.prepared()));
        let parameters = Parameters::check(&self.interface, values).map_err(error)?;
        let local_compliance = parameters.get(Parameter::LocalCompliance) != 0.0;
        let spec = TrainTrackSpec { local_compliance, ..self.spec.clone() };
        let fasteners = FastenerFactors {
            stiffness: parameters.get(Parameter::FastenerStiffnessFactor),
            damping: parameters.get(Parameter::FastenerDampingFactor),
        };
        let prepared = self.track(known, &spec, fasteners)?;
        let plane = Built::new(&spec, prepared, &parameters, start).map_err(error)?;
        self.built = Some(if spec.space.is_some() {
            Either::Space(Box::new(plane.in_space(&spec, &parameters).map_err(error)?))
        } else {
            Either::Plane(Box::new(plane))
        });
        Ok(())
    }

    fn equilibrium(&mut self, values: &mut Values) -> Result<(), ModelError> {
        let inputs = self.interface.inputs();
        let built = self.built()?;
        built.equilibrium(&values.all[inputs]).map_err(error)?;
        let start = built.start();
        self.outputs(values, start)
    }

    fn start(&mut self, values: &mut Values) -> Result<(), ModelError> {
        let built = self.built()?;
        built.roll_in().map_err(error)?;
        let start = built.start();
        self.outputs(values, start)
    }

    fn step(&mut self, values: &mut Values, t: f64, h: f64) -> Result<(), ModelError> {
        let inputs = self.interface.inputs();
        let rates = values.has_rates.then_some(&values.rates[..]);
        self.built()?.step(&values.all[inputs], rates, t, h).map_err(error)?;
        self.outputs(values, t + h)
    }

    fn has_ended(&self) -> bool {
        self.built.as_ref().is_some_and(Either::has_ended)
    }

    fn save(&self) -> Self::State {
        self.built.as_ref().map_or_else(|| Saved::Plane(Arc::new(State::rest(0, 0, 0, 0))), Either::save)
    }

    fn restore(&mut self, state: &Self::State) {
        if let Some(built) = &mut self.built {
            built.restore(state);
        }
    }

    fn write_state(&self, state: &Self::State, bytes: &mut Vec<u8>) {
        state.write(bytes);
    }

    fn read_state(&self, bytes: &[u8]) -> Result<Self::State, ModelError> {
        let built = self.built.as_ref().ok_or_else(|| error("the model is not initialized"))?;
        built.read(bytes).map_err(error)
    }
}

impl Prepare for Prepared {
    type Spec = TrainTrackSpec;
    type Model = TrainTrack;

    fn prepare(spec: &TrainTrackSpec) -> Result<Arc<Self>, ModelError> {
        // What cannot be built at all is refused before a track is.
        TrainTrack::new(spec.clone())?;
        Ok(Arc::new(Prepared::new(spec).map_err(error)?))
    }
    fn serves(&self, spec: &TrainTrackSpec) -> bool {
        self.fits(spec, FastenerFactors::default())
    }
    fn model(self: &Arc<Self>, spec: &TrainTrackSpec) -> Result<TrainTrack, ModelError> {
        TrainTrack::from_prepared(spec.clone(), Arc::clone(self))
    }
}
