//! The bridge behind the coupling contract: support forces in, support motions and monitored points out.

use std::path::Path;
use std::sync::Arc;

use ttb_contract::{Interface, Model, ModelError, Prepare, Values};
use ttb_dynamics::newmark::Motion;
use ttb_dynamics::pool::Pool;
use ttb_scenario::ground::GroundState;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};

use crate::interface::{self, Held, Parameters};
use crate::law::ratio;
use crate::march::{Forces, March, Owed};
use crate::prepared::Prepared;
use crate::read_out::{Acceleration, Shaken, carry, read_out};
use crate::reduction::Accuracy;
use crate::state::{Data, State};
use crate::stored;
use crate::structure::Structure;

/// Name of the specification among an FMU's resources.
const RESOURCE: &str = "bridge.json";

/// A bridge that can be stepped, saved and restored.
pub struct Bridge {
    interface: Interface,
    prepared: Arc<Prepared>,
    experiment: (f64, f64),
    parameters: Option<Parameters>,
    march: March,
    state: State,
    /// At rest without forces: where directional derivatives start.
    rest: State,
    pool: Pool<Data>,
    /// Size of the last macro step, s; before the first the nominal one.
    last_step: f64,
    /// Start time, s.
    begin: f64,
    /// Forces with the ground's accelerations behind them.
    shaken: Shaken,
    /// The ground at the begin and the end of the last step.
    carried: Option<[GroundState; 2]>,
}

impl Bridge {
    /// Meshes, assembles, factorises K, finds modes where they are needed.
    ///
    /// # Errors
    /// Anything in the specification that cannot be: the message names it.
    pub fn new(spec: BridgeSpec) -> Result<Self, ModelError> {
        Self::from_prepared(&Prepared::new(&spec)?)
    }

    /// A bridge over what is prepared already, with the step, end and damping that it was prepared with.
    ///
    /// # Errors
    /// The damping cannot be.
    pub fn from_prepared(prepared: &Arc<Prepared>) -> Result<Self, ModelError> {
        Self::over(prepared, prepared.spec())
    }

    /// A bridge over what is prepared already, with another step, end, damping ratio or Newmark's method.
    ///
    /// # Errors
    /// The specification differs in more than that ([`Prepared::serves`]); the damping cannot be.
    pub fn over(prepared: &Arc<Prepared>, spec: &BridgeSpec) -> Result<Self, ModelError> {
        if !prepared.serves(spec) {
            return Err(ModelError("bridge: it was prepared for another structure".into()));
        }
        let structure = &prepared.structure;
        let (unknowns, supports) = (structure.system.unknowns(), structure.supports);
        let law = structure.law(ratio(&spec.damping), 1.0, 1.0)?;
        let rest = Arc::new(Data::rest(unknowns, supports));
        Ok(Self {
            interface: interface::list(spec, structure),
            prepared: Arc::clone(prepared),
            experiment: (spec.step, spec.end),
            parameters: None,
            march: March::new(law),
            state: Arc::clone(&rest),
            rest,
            pool: Pool::default(),
            last_step: spec.step,
            begin: 0.0,
            shaken: Shaken::default(),
            carried: None,
        })
    }

    /// What it shares with other bridges.
    pub fn prepared(&self) -> &Arc<Prepared> {
        &self.prepared
    }

    fn structure(&self) -> &Structure {
        &self.prepared.structure
    }

    /// What a held force means under the parameters in force.
    fn held(&self) -> Held {
        self.parameters.map_or(Held::Mean, |parameters| parameters.held())
    }

    /// What the user should know of this bridge, a sentence each: rounding that shows, a reduced model that missed its
    /// error.
    pub fn remarks(&self) -> &[String] {
        &self.structure().remarks
    }

    /// Degrees of freedom of the finite-element model.
    pub fn ndof(&self) -> usize {
        self.prepared.structure.ndof
    }

    /// Unknowns solved for: degrees of freedom, or modes.
    pub fn unknowns(&self) -> usize {
        self.prepared.structure.system.unknowns()
    }

    /// The files that an FMU of this bridge needs: name and content.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn resources(&self, spec: &BridgeSpec) -> Result<Vec<(&'static str, Vec<u8>)>, ModelError> {
        let text = |spec: &BridgeSpec| {
            let text = serde_json::to_vec(spec).map_err(|e| ModelError(format!("{RESOURCE} cannot be made: {e}")))?;
            Ok((RESOURCE, text))
        };
        Ok(match self.prepared.structure.to_store() {
            None => vec![text(spec)?],
            Some(stored) => {
                let ground = self.structure().ground.as_ref();
                let ground_points = ground.map_or_else(Vec::new, |ground| ground.points.clone());
                let spec = BridgeSpec { structure: StructureSpec::Stored, ground_points, ..spec.clone() };
                vec![text(&spec)?, (stored::FILE, stored.bytes()?)]
            }
        })
    }

    /// How wrong a reduced model is.
    pub fn accuracy(&self) -> Option<&Accuracy> {
        self.prepared.structure.accuracy.as_ref()
    }

    /// Total mass under the parameters in force, kg.
    pub fn mass(&self) -> f64 {
        self.prepared.structure.mass * self.march.law().mass
    }

    /// The lowest natural frequencies under the parameters in force, Hz.
    ///
    /// # Errors
    /// More are asked for than there are.
    pub fn natural_frequencies(&self, count: usize) -> Result<Vec<f64>, ModelError> {
        let law = self.march.law();
        let factor = (law.stiffness / law.mass).sqrt();
        Ok(self.prepared.structure.natural_frequencies(count)?.into_iter().map(|f| factor * f).collect())
    }

    /// What is left of the last step for somebody to compute ahead.
    pub(crate) fn owed(&mut self) -> Option<Owed> {
        let state = Arc::clone(&self.state);
        self.march.owed(&state)
    }

    /// Takes what was computed ahead.
    pub(crate) fn keep(&mut self, owed: Owed) {
        self.march.keep(owed);
    }

    /// A buffer for the next state, and its only holder.
    fn buffer(&mut self) -> State {
        let (unknowns, supports) = (self.unknowns(), self.prepared.structure.supports);
        self.pool.take(|| Data::rest(unknowns, supports))
    }

    /// Writes all outputs of what the march saw last.
    fn read_out(&self, acceleration: Acceleration, values: &mut Values) {
        let outputs = &mut values.all[self.interface.outputs()];
        let structure = &self.prepared.structure;
        read_out(structure, self.march.law().stiffness, &self.march.seen, acceleration, outputs);
        if let (Some(ground), Some(ends)) = (&structure.ground, self.carried) {
            carry(structure, ground, ends, acceleration, outputs);
        }
    }

    /// Takes a written buffer as the state and gives the old one back.
    fn accept(&mut self, state: State) {
        self.pool.give(&state);
        self.state = state;
    }
}

/// There is always exactly one holder of a buffer fresh from the pool; said instead of assumed.
fn only_holder(state: &mut State) -> Result<&mut Data, ModelError> {
    Arc::get_mut(state).ok_or_else(|| ModelError("bridge: a state buffer is held twice".into()))
}

impl Model for Bridge {
    type State = State;
    const DIRECTIONAL_DERIVATIVES: bool = true;

    fn load(resources: &Path) -> Result<Self, ModelError> {
        let path = resources.join(RESOURCE);
        let text =
            std::fs::read_to_string(&path).map_err(|e| ModelError(format!("cannot read {}: {e}", path.display())))?;
        let spec: BridgeSpec =
            serde_json::from_str(&text).map_err(|e| ModelError(format!("{} is damaged: {e}", path.display())))?;
        Self::from_prepared(&Prepared::from_folder(&spec, resources)?)
    }

    fn interface(&self) -> &Interface {
        &self.interface
    }

    fn default_experiment(&self) -> (f64, f64) {
        self.experiment
    }

    fn build(&mut self, values: &Values, start: f64) -> Result<(), ModelError> {
        self.begin = start;
        let group = &values.all[self.interface.parameters()];
        let parameters =
            Parameters::read(group).ok_or_else(|| ModelError("bridge: seven parameters are needed".into()))?;
        if self.parameters == Some(parameters) {
            return Ok(());
        }
        if let Some(problem) = parameters.impossible() {
            return Err(ModelError(problem));
        }
        let Parameters { damping_ratio, stiffness_factor, mass_factor, step_size, gamma, beta, input_meaning: _ } =
            parameters;
        let law = self.structure().law(damping_ratio, stiffness_factor, mass_factor)?;
        self.march.set(&self.prepared, law, [step_size, gamma, beta])?;
        self.parameters = Some(parameters);
        Ok(())
    }

    fn equilibrium(&mut self, values: &mut Values) -> Result<(), ModelError> {
        let mut state = self.buffer();
        let data = only_holder(&mut state)?;
        data.force.fill(0.0);
        let inputs = &values.all[self.interface.inputs()];
        data.force[..inputs.len()].copy_from_slice(inputs);
        data.pending = None;
        let unknowns = self.prepared.structure.system.unknowns();
        let Motion { u, v, a } = &mut data.motion;
        for x in [&mut *u, v, a] {
            x.clear();
            x.resize(unknowns, 0.0);
        }
        self.prepared.structure.rows.add_transposed(&data.force, u);
        let solved = self.prepared.structure.system.statics(self.march.law(), u);
        solved.map_err(|e| ModelError(format!("bridge: {e}")))?;
        self.march.seen.read(&self.prepared.structure, &data.motion);
        self.carried = self.prepared.structure.ground.as_ref().map(|ground| [ground.at(self.begin); 2]);
        self.read_out(Acceleration::State, values);
        self.accept(state);
        self.last_step = self.march.steps.nominal();
        Ok(())
    }

    fn start(&mut self, _values: &mut Values) -> Result<(), ModelError> {
        // The state is static equilibrium already: no velocity, no acceleration, f_n the inputs.
        self.prepared.structure.system.rest_statics();
        Ok(())
    }

    fn step(&mut self, values: &mut Values, t: f64, h: f64) -> Result<(), ModelError> {
        let inputs = self.interface.inputs();
        let rates = values.has_rates.then_some(&values.rates[..]);
        let mut state = self.buffer();
        let data = only_holder(&mut state)?;
        let mut forces = Forces { values: &values.all[inputs], rates, held: self.held() };
        if let Some(ground) = &self.prepared.structure.ground {
            let ends = [ground.at(t), ground.at(t + h)];
            self.shaken.fill(&forces, ends.map(|end| end.acceleration), h);
            self.carried = Some(ends);
            forces.values = &self.shaken.values;
            forces.rates = rates.map(|_| &self.shaken.rates[..]);
        }
        let acceleration = if forces.end_is_known() { Acceleration::State } else { Acceleration::Mean(h) };
        self.march.run(&self.prepared, &self.state, forces, h, data)?;
        self.read_out(acceleration, values);
        self.accept(state);
        self.last_step = h;
        Ok(())
    }

    fn save(&self) -> State {
        Arc::clone(&self.state)
    }

    fn restore(&mut self, state: &State) {
        self.state = Arc::clone(state);
    }

    fn write_state(&self, state: &State, bytes: &mut Vec<u8>) {
        state.write(bytes);
    }

    fn read_state(&self, bytes: &[u8]) -> Result<State, ModelError> {
        Data::read(self.unknowns(), self.prepared.structure.supports, bytes).map(Arc::new)
    }

    /// The step is linear: the outputs' change is the step itself, from rest, with the seed as input. With interpolated
    /// inputs the seed changes the values and leaves the rates.
    fn directional_derivative(&mut self, has_rates: bool, seed: &[f64], out: &mut [f64]) -> Result<(), ModelError> {
        let (mut state, h) = (self.buffer(), self.last_step);
        let data = only_holder(&mut state)?;
        let constant = vec![0.0; self.prepared.structure.supports];
        let mut changes = constant.clone();
        changes[..seed.len()].copy_from_slice(seed);
        let forces = Forces { values: &changes, rates: has_rates.then_some(&constant[..]), held: self.held() };
        let acceleration = if forces.end_is_known() { Acceleration::State } else { Acceleration::Mean(h) };
        self.march.run(&self.prepared, &self.rest, forces, h, data)?;
        read_out(&self.prepared.structure, self.march.law().stiffness, &self.march.seen, acceleration, out);
        self.pool.give(&state);
        Ok(())
    }
}

impl Prepare for Prepared {
    type Spec = BridgeSpec;
    type Model = Bridge;

    fn prepare(spec: &BridgeSpec) -> Result<Arc<Self>, ModelError> {
        Prepared::new(spec)
    }
    fn serves(&self, spec: &BridgeSpec) -> bool {
        Prepared::serves(self, spec)
    }
    fn model(self: &Arc<Self>, spec: &BridgeSpec) -> Result<Bridge, ModelError> {
        Bridge::over(self, spec)
    }
}
