//! m·ẍ + c·ẋ + k·x = f, the smallest model with everything an FMU of this project has: resources, parameters of each
//! kind, inputs held or interpolated, equilibrium, states, directional derivatives — and ways to misbehave.

use std::path::Path;
use ttb_contract::{Interface, Kind, Model, ModelError, Values, Variable};

/// Value references, in the order of the interface list.
pub mod vr {
    pub const FORCE: u32 = 0;
    pub const DISPLACEMENT: u32 = 1;
    pub const VELOCITY: u32 = 2;
    pub const STIFFNESS: u32 = 3;
    pub const MISBEHAVIOUR: u32 = 4;
    pub const SEED: u32 = 5;
    pub const DAMPED: u32 = 6;
    pub const COUNT: u32 = 7;
}

/// What the enumeration parameter can make the model do in a step.
pub const MISBEHAVIOURS: &[(&str, &str)] =
    &[("None", "behave"), ("Panic", "panic in a step"), ("Fail", "refuse a step"), ("NaN", "answer NaN")];

/// One mass on a spring.
pub struct Oscillator {
    interface: Interface,
    mass: f64,
    stiffness: f64,
    damping: f64,
    state: [f64; 2],
    rate_before: bool,
}

impl Model for Oscillator {
    type State = [f64; 2];
    const DIRECTIONAL_DERIVATIVES: bool = true;

    /// The mass stands in `mass.txt`.
    fn load(resources: &Path) -> Result<Self, ModelError> {
        let file = resources.join("mass.txt");
        let text = std::fs::read_to_string(&file).map_err(|e| ModelError(format!("{}: {e}", file.display())))?;
        let mass = text.trim().parse().map_err(|e| ModelError(format!("{}: {e}", file.display())))?;
        let interface = Interface::new(
            vec![Variable::input("support[1].force", "N", "force on the mass")],
            vec![
                Variable::output("support[1].displacement", "m", "displacement of the mass"),
                Variable::output("support[1].velocity", "m/s", "velocity of the mass"),
            ],
            vec![
                Variable::parameter("stiffness", "N/m", 100.0, "stiffness of the spring; must be positive"),
                Variable::parameter_of("misbehaviour", Kind::Enumeration(MISBEHAVIOURS), 1.0, "what a step does"),
                Variable::parameter_of("seed", Kind::Integer { min: 0, max: 9 }, 3.0, "unused"),
                Variable::parameter_of("damped", Kind::Boolean, 1.0, "whether there is a damper"),
            ],
        );
        Ok(Self { interface, mass, stiffness: 0.0, damping: 0.0, state: [0.0; 2], rate_before: false })
    }
    fn interface(&self) -> &Interface {
        &self.interface
    }
    fn default_experiment(&self) -> (f64, f64) {
        (0.01, 1.0)
    }
    fn build(&mut self, values: &Values, _start: f64) -> Result<(), ModelError> {
        self.stiffness = values.all[vr::STIFFNESS as usize];
        self.damping = values.all[vr::DAMPED as usize];
        if self.stiffness <= 0.0 {
            return Err(ModelError(format!("stiffness must be positive, not {}", self.stiffness)));
        }
        Ok(())
    }
    fn equilibrium(&mut self, values: &mut Values) -> Result<(), ModelError> {
        self.state = [values.all[vr::FORCE as usize] / self.stiffness, 0.0];
        values.all[1..3].copy_from_slice(&self.state);
        Ok(())
    }
    fn start(&mut self, values: &mut Values) -> Result<(), ModelError> {
        self.equilibrium(values)
    }
    /// The trapezoidal rule, exact for a force that is a straight line: (f_n + f_{n+1})/2 is all it sees.
    fn step(&mut self, values: &mut Values, _t: f64, h: f64) -> Result<(), ModelError> {
        match values.all[vr::MISBEHAVIOUR as usize] as usize {
            2 => panic!("the oscillator was told to panic"),
            3 => {
                self.state[0] += 1.0; // half-way through
                return Err(ModelError("the oscillator was told to fail".into()));
            }
            _ => {}
        }
        let rate = if values.has_rates { values.rates[0] } else { 0.0 };
        self.rate_before = values.has_rates;
        let f = values.all[vr::FORCE as usize] + 0.5 * h * rate;
        let [x, v] = self.state;
        let (m, c, k) = (self.mass, self.damping, self.stiffness);
        let mean_v = (m * v + 0.5 * h * (f - k * x)) / (m + 0.5 * h * c + 0.25 * h * h * k);
        self.state = [x + h * mean_v, 2.0 * mean_v - v];
        values.all[1..3].copy_from_slice(&self.state);
        if values.all[vr::MISBEHAVIOUR as usize] == 4.0 {
            values.all[1] = f64::NAN;
        }
        Ok(())
    }
    fn save(&self) -> Self::State {
        self.state
    }
    fn restore(&mut self, state: &Self::State) {
        self.state = *state;
    }
    fn write_state(&self, state: &Self::State, bytes: &mut Vec<u8>) {
        state.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    fn read_state(&self, bytes: &[u8]) -> Result<Self::State, ModelError> {
        let bytes: [u8; 16] = bytes.try_into().map_err(|_| ModelError("an oscillator's state has 16 bytes".into()))?;
        let (x, v) = bytes.split_at(8);
        Ok([x, v].map(|b| f64::from_le_bytes(std::array::from_fn(|i| b[i]))))
    }
    /// For the step of the default experiment.
    fn directional_derivative(&mut self, _has_rates: bool, seed: &[f64], out: &mut [f64]) -> Result<(), ModelError> {
        let h = self.default_experiment().0;
        let mean_v = 0.5 * h * seed[0] / (self.mass + 0.5 * h * self.damping + 0.25 * h * h * self.stiffness);
        out.copy_from_slice(&[h * mean_v, 2.0 * mean_v]);
        Ok(())
    }
}
