//! The bridge behind the coupling contract: support forces in, support motions and monitored points out.

use std::path::Path;
use std::sync::Arc;

use ttb_coupling::{Interface, Model, ModelError, Values};
use ttb_dynamics::newmark::Motion;
use ttb_dynamics::pool::Pool;
use ttb_scenario::spec::BridgeSpec;

use crate::interface::{self, Parameters};
use crate::march::{Forces, March};
use crate::state::{Data, State};
use crate::structure::Structure;

/// A bridge.
pub struct Bridge {
    interface: Interface,
    structure: Structure,
    experiment: (f64, f64),
    parameters: Option<Parameters>,
    march: March,
    state: State,
    /// At rest without forces: where directional derivatives start.
    rest: State,
    pool: Pool<Data>,
    /// Size of the last macro step, s; before the first the nominal one.
    last_step: f64,
}

/// How the acceleration of a point is read.
#[derive(Clone, Copy)]
enum Acceleration<'a> {
    /// ü of the state.
    State,
    /// (u̇ − u̇₀)/h, with held inputs.
    Mean(&'a Motion, f64),
}

impl Bridge {
    /// Meshes, assembles, factorises K, finds modes where they are needed.
    ///
    /// # Errors
    /// Anything in the specification that cannot be: the message names it.
    pub fn new(spec: BridgeSpec) -> Result<Self, ModelError> {
        let structure = Structure::new(&spec)?;
        let (unknowns, supports) = (structure.system.unknowns(), structure.supports.len());
        let law = structure.law(structure.damping_ratio(), 1.0, 1.0)?;
        let rest = Arc::new(Data::rest(unknowns, supports));
        Ok(Self {
            interface: interface::list(&spec, &structure),
            structure,
            experiment: (spec.step, spec.end),
            parameters: None,
            march: March::new(law, unknowns),
            state: Arc::clone(&rest),
            rest,
            pool: Pool::default(),
            last_step: spec.step,
        })
    }

    /// Degrees of freedom of the finite-element model.
    pub fn ndof(&self) -> usize {
        self.structure.ndof()
    }

    /// Unknowns solved for: degrees of freedom, or modes.
    pub fn unknowns(&self) -> usize {
        self.structure.system.unknowns()
    }

    /// Total mass under the parameters in force, kg.
    pub fn mass(&self) -> f64 {
        self.structure.mass() * self.march.law().mass
    }

    /// The lowest natural frequencies under the parameters in force, Hz.
    ///
    /// # Errors
    /// More are asked for than there are.
    pub fn natural_frequencies(&self, count: usize) -> Result<Vec<f64>, ModelError> {
        let law = self.march.law();
        let factor = (law.stiffness / law.mass).sqrt();
        Ok(self.structure.natural_frequencies(count)?.into_iter().map(|f| factor * f).collect())
    }

    /// A buffer for the next state, and its only holder.
    fn buffer(&mut self) -> State {
        let (unknowns, supports) = (self.unknowns(), self.structure.supports.len());
        self.pool.take(|| Data::rest(unknowns, supports))
    }

    /// Takes a written buffer as the state and gives the old one back.
    fn accept(&mut self, state: State) {
        self.pool.give(&state);
        self.state = state;
    }
}

/// Writes all outputs of a state; `stiffness` is the factor that moments share.
fn read_out(structure: &Structure, stiffness: f64, data: &Data, acceleration: Acceleration, outputs: &mut [f64]) {
    let Motion { u, v, a } = &data.motion;
    let supports = structure.supports.len();
    let mut outputs = outputs.iter_mut();
    let mut put = |value: f64| {
        if let Some(out) = outputs.next() {
            *out = value;
        }
    };
    (0..supports).for_each(|i| put(structure.supports.dot(i, u)));
    (0..supports).for_each(|i| put(structure.supports.dot(i, v)));
    let monitors = &structure.monitors;
    for point in &structure.points {
        let velocity = monitors.dot(point.motion, v);
        put(monitors.dot(point.motion, u));
        put(velocity);
        put(match acceleration {
            Acceleration::State => monitors.dot(point.motion, a),
            Acceleration::Mean(before, h) => (velocity - monitors.dot(point.motion, &before.v)) / h,
        });
        point.moment.into_iter().for_each(|row| put(stiffness * monitors.dot(row, u)));
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
        let path = resources.join("bridge.json");
        let text =
            std::fs::read_to_string(&path).map_err(|e| ModelError(format!("cannot read {}: {e}", path.display())))?;
        let spec =
            serde_json::from_str(&text).map_err(|e| ModelError(format!("{} is damaged: {e}", path.display())))?;
        Self::new(spec)
    }

    fn interface(&self) -> &Interface {
        &self.interface
    }

    fn default_experiment(&self) -> (f64, f64) {
        self.experiment
    }

    fn build(&mut self, values: &Values, _start: f64) -> Result<(), ModelError> {
        let group = &values.all[self.interface.parameters()];
        let parameters =
            Parameters::read(group).ok_or_else(|| ModelError("bridge: six parameters are needed".into()))?;
        if self.parameters == Some(parameters) {
            return Ok(());
        }
        if let Some(problem) = parameters.impossible() {
            return Err(ModelError(problem));
        }
        let Parameters { damping_ratio, stiffness_factor, mass_factor, step_size, gamma, beta } = parameters;
        let law = self.structure.law(damping_ratio, stiffness_factor, mass_factor)?;
        self.march.set(&self.structure, law, [step_size, gamma, beta])?;
        self.parameters = Some(parameters);
        Ok(())
    }

    fn equilibrium(&mut self, values: &mut Values) -> Result<(), ModelError> {
        let mut state = self.buffer();
        let data = only_holder(&mut state)?;
        data.force.copy_from_slice(&values.all[self.interface.inputs()]);
        data.motion.numbers_mut().for_each(|x| *x = 0.0);
        self.structure.supports.add_transposed(&data.force, &mut data.motion.u);
        self.structure.system.statics(self.march.law(), &mut data.motion.u);
        read_out(
            &self.structure,
            self.march.law().stiffness,
            data,
            Acceleration::State,
            &mut values.all[self.interface.outputs()],
        );
        self.accept(state);
        self.last_step = self.march.steps.nominal();
        Ok(())
    }

    fn start(&mut self, _values: &mut Values) -> Result<(), ModelError> {
        // The state is static equilibrium already: no velocity, no acceleration, f_n the inputs.
        Ok(())
    }

    fn step(&mut self, values: &mut Values, _t: f64, h: f64) -> Result<(), ModelError> {
        let inputs = self.interface.inputs();
        let rates = values.has_rates.then_some(&values.rates[..]);
        let mut state = self.buffer();
        let data = only_holder(&mut state)?;
        self.march.run(&self.structure, &self.state, Forces { values: &values.all[inputs], rates }, h, data)?;
        let mean = Acceleration::Mean(&self.state.motion, h);
        let acceleration = if values.has_rates { Acceleration::State } else { mean };
        read_out(
            &self.structure,
            self.march.law().stiffness,
            data,
            acceleration,
            &mut values.all[self.interface.outputs()],
        );
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
        Data::read(self.unknowns(), self.structure.supports.len(), bytes).map(Arc::new)
    }

    /// The step is linear: the outputs' change is the step itself, from rest, with the seed as input. With interpolated
    /// inputs the seed changes the values and leaves the rates.
    fn directional_derivative(&mut self, has_rates: bool, seed: &[f64], out: &mut [f64]) -> Result<(), ModelError> {
        let (mut state, h) = (self.buffer(), self.last_step);
        let data = only_holder(&mut state)?;
        let constant = vec![0.0; seed.len()];
        let forces = Forces { values: seed, rates: has_rates.then_some(&constant[..]) };
        self.march.run(&self.structure, &self.rest, forces, h, data)?;
        let mean = Acceleration::Mean(&self.rest.motion, h);
        read_out(
            &self.structure,
            self.march.law().stiffness,
            data,
            if has_rates { Acceleration::State } else { mean },
            out,
        );
        self.pool.give(&state);
        Ok(())
    }
}
