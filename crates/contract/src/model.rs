//! What a subsystem's physics provides, whether it runs behind FMI or inside this process.

use crate::interface::Interface;
use crate::values::Values;

/// Why a model could not do what it was asked; the message is meant for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelError(pub String);

impl std::fmt::Display for ModelError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}
impl std::error::Error for ModelError {}

/// A subsystem's physics: built once, brought to static equilibrium, stepped, saved, restored.
///
/// All traffic of numbers goes through [`Values`]: inputs, outputs and parameters by value reference. Inputs mean what
/// FMI says: the value at t_n and, where derivatives were set, a straight line from it over [t_n, t_n + h].
pub trait Model: Send + Sized + 'static {
    /// The dynamic state alone (inputs and outputs live in [`Values`]); cloning must be cheap (shared buffers).
    type State: Clone + Send;

    /// Reads the resources of a packed FMU (a folder).
    ///
    /// # Errors
    /// A missing or damaged resource, named in the message.
    fn load(resources: &std::path::Path) -> Result<Self, ModelError>;

    /// The interface list; fixed for the life of the model.
    fn interface(&self) -> &Interface;

    /// Preferred step in s, the one that is factorised for, and the default stop time in s.
    fn default_experiment(&self) -> (f64, f64);

    /// Sets up and factorises everything for the parameters in `values`; called on entering initialization mode and
    /// again when a parameter was changed there. `start` is the start time in s.
    ///
    /// # Errors
    /// An impossible parameter.
    fn build(&mut self, values: &Values, start: f64) -> Result<(), ModelError>;

    /// Static equilibrium for the inputs in `values` (velocities ignored); updates the outputs.
    ///
    /// # Errors
    /// The equilibrium iteration does not converge.
    fn equilibrium(&mut self, values: &mut Values) -> Result<(), ModelError>;

    /// Leaves initialization: from static equilibrium to the state the first step starts from.
    ///
    /// # Errors
    /// As [`Model::equilibrium`].
    fn start(&mut self, values: &mut Values) -> Result<(), ModelError>;

    /// One macro step [t, t + h] under the inputs in `values`; updates the outputs to t + h.
    ///
    /// # Errors
    /// The step cannot be done (contact iteration fails, the train leaves the track, an input is not finite).
    fn step(&mut self, values: &mut Values, t: f64, h: f64) -> Result<(), ModelError>;

    /// Whether the last step could not be done because the run ends there, as where a wheel leaves its rail: a result and no
    /// fault. The message is the step's.
    fn has_ended(&self) -> bool {
        false
    }

    /// The dynamic state, shared, not copied.
    fn save(&self) -> Self::State;

    /// Puts back a saved state.
    fn restore(&mut self, state: &Self::State);

    /// Appends the state's numbers, little endian.
    fn write_state(&self, state: &Self::State, bytes: &mut Vec<u8>);

    /// Reads what [`Model::write_state`] wrote.
    ///
    /// # Errors
    /// The bytes do not belong to this model (length).
    fn read_state(&self, bytes: &[u8]) -> Result<Self::State, ModelError>;

    /// Whether [`Model::directional_derivative`] is provided.
    const DIRECTIONAL_DERIVATIVES: bool = false;

    /// Derivative of all outputs at the end of a step of the size in use along a change `seed` of the inputs.
    ///
    /// `seed` has one entry per input, `out` one per output. `has_rates` tells whether inputs are held or interpolated.
    ///
    /// # Errors
    /// Not provided by this model.
    fn directional_derivative(&mut self, _has_rates: bool, _seed: &[f64], _out: &mut [f64]) -> Result<(), ModelError> {
        Err(ModelError("this model provides no directional derivatives".into()))
    }
}
