//! What an instance is asked, wherever it lives: in this process ([`super::local`]) or in one of its own
//! ([`crate::isolate`]). The verbs are the functions of FMI 2.0; names, results, errors and counts are [`FmuInstance`]'s.
//!
//! [`FmuInstance`]: super::FmuInstance

use super::messages::Sink;
use crate::types::{Status, fmi2Status};
use std::time::Duration;

/// What a call answered, and how long it took inside the FMU.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Answer {
    pub status: fmi2Status,
    pub time: Duration,
    /// Earlier calls that answered fmi2Warning only now.
    pub warnings: u32,
}

impl Answer {
    /// The answer of a function that is not there; callers look at [`Slave::has`] first.
    pub const NOTHING: Self = Self { status: Status::Error as fmi2Status, time: Duration::ZERO, warnings: 0 };
}

/// Declares [`Optional`] from one table.
macro_rules! optional {
    ($($name:ident = $symbol:literal,)*) => {
        /// The functions an FMU may lack.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Optional { $($name,)* }

        impl Optional {
            /// Name in the standard.
            pub fn symbol(self) -> &'static str {
                match self { $(Self::$name => $symbol,)* }
            }
            /// This function's bit in a set of them.
            pub const fn bit(self) -> u64 {
                1 << self as u64
            }
        }
    };
}

optional! {
    GetInteger = "fmi2GetInteger",
    GetBoolean = "fmi2GetBoolean",
    GetString = "fmi2GetString",
    SetInteger = "fmi2SetInteger",
    SetBoolean = "fmi2SetBoolean",
    SetString = "fmi2SetString",
    SetInputDerivatives = "fmi2SetRealInputDerivatives",
    GetState = "fmi2GetFMUstate",
    SetState = "fmi2SetFMUstate",
    FreeState = "fmi2FreeFMUstate",
    Serialize = "fmi2SerializeFMUstate",
    Deserialize = "fmi2DeSerializeFMUstate",
    DirectionalDerivative = "fmi2GetDirectionalDerivative",
}

/// A saved state, as the FMU names it; 0 is none.
pub(crate) type Handle = usize;

/// An instance as its functions. Slices that belong together are of equal length; functions that [`Slave::has`] denies are
/// not called. After [`Slave::free_instance`] nothing is. Setting values and states may be answered before it is done: what it
/// comes to, the next call says.
pub(crate) trait Slave: Send {
    /// Whether the library has a function.
    fn has(&self, function: Optional) -> bool;

    fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Answer;
    fn enter_initialization(&mut self) -> Answer;
    fn exit_initialization(&mut self) -> Answer;
    fn do_step(&mut self, t: f64, h: f64, may_restore: bool) -> Answer;
    fn terminate(&mut self) -> Answer;
    fn reset(&mut self) -> Answer;
    fn free_instance(&mut self);

    fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Answer;
    fn set_real(&mut self, references: &[u32], values: &[f64]) -> Answer;
    fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Answer;
    fn directional_derivative(&mut self, unknown: &[u32], known: &[u32], seed: &[f64], out: &mut [f64]) -> Answer;
    fn get_integer(&mut self, reference: u32, value: &mut i32) -> Answer;
    fn get_boolean(&mut self, reference: u32, value: &mut bool) -> Answer;
    fn get_string(&mut self, reference: u32, value: &mut String) -> Answer;
    fn set_integer(&mut self, reference: u32, value: i32) -> Answer;
    fn set_boolean(&mut self, reference: u32, value: bool) -> Answer;
    /// The text contains no zero byte.
    fn set_string(&mut self, reference: u32, value: &str) -> Answer;

    fn get_state(&mut self, handle: &mut Handle) -> Answer;
    fn set_state(&mut self, handle: Handle) -> Answer;
    fn free_state(&mut self, handle: &mut Handle) -> Answer;
    fn serialize(&mut self, handle: Handle, bytes: &mut Vec<u8>) -> Answer;
    fn deserialize(&mut self, bytes: &[u8], handle: &mut Handle) -> Answer;

    /// Hands over what was logged since, if it does not reach the sink by itself.
    fn collect(&mut self, _sink: &Sink) {}

    /// The earlier call that a failure belongs to, if it was answered before it was made; asked for once.
    fn blame(&mut self) -> Option<&'static str> {
        None
    }

    /// How the FMU's process came to its end, if it did.
    fn death(&self) -> Option<&str> {
        None
    }

    /// Tells whoever listens what went wrong when nobody waits for an answer any more.
    fn report(&self, _what: &str) {}
}
