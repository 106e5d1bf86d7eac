//! What an instance is asked, wherever it lives: in this process or in one of its own ([`crate::isolate`]). Names, results,
//! errors and counts are [`FmuInstance`](crate::FmuInstance)'s.

use crate::log::Sink;
use crate::status::Status;
use std::time::Duration;

/// What a call answered, and how long it took inside the FMU.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// The status as a C value.
    pub status: i32,
    /// Time inside the FMU.
    pub time: Duration,
    /// Earlier calls that answered with a warning only now.
    pub warnings: u32,
}

impl Answer {
    /// The answer of a function that is not there; callers look at [`Slave::has`] first.
    pub const NOTHING: Self = Self { status: Status::Error as i32, time: Duration::ZERO, warnings: 0 };
}

/// Declares [`Call`] and the list of all.
macro_rules! calls {
    ($($name:ident,)*) => {
        /// The calls, whatever they are called in a version of FMI.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs)] // their names say it
        #[repr(u8)]
        pub enum Call { $($name,)* }

        impl Call {
            /// All of them, each at the place of its number.
            pub const ALL: &[Self] = &[$(Self::$name,)*];
        }
    };
}

calls! {
    Instantiate,
    SetupExperiment,
    EnterInitialization,
    ExitInitialization,
    DoStep,
    Terminate,
    Reset,
    FreeInstance,
    GetReal,
    SetReal,
    SetInputDerivatives,
    DirectionalDerivative,
    GetInteger,
    GetBoolean,
    GetString,
    SetInteger,
    SetBoolean,
    SetString,
    GetState,
    SetState,
    FreeState,
    Serialize,
    Deserialize,
}

impl Call {
    /// This call's bit in a set of them.
    pub const fn bit(self) -> u64 {
        1 << self as u64
    }
}

/// A saved state, as the FMU names it; 0 is none.
pub type Handle = usize;

/// An instance as its functions. Slices that belong together are of equal length; functions that [`Slave::has`] denies are
/// not called. After [`Slave::free_instance`] nothing is. Setting values and states may be answered before it is done: what it
/// comes to, the next call says.
#[allow(missing_docs)] // each is the call of that name; FMI says what it does
pub trait Slave: Send {
    /// Whether the library has a function; only optional ones are asked for.
    fn has(&self, function: Call) -> bool;

    /// Start and, if given, stop time in s.
    fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Answer;
    fn enter_initialization(&mut self) -> Answer;
    fn exit_initialization(&mut self) -> Answer;
    /// One step from t to t + h, s; `may_restore`: a state from before t may still come back.
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
    fn earlier_failure(&mut self) -> Option<Call> {
        None
    }

    /// How the FMU came to its end, if it did: a sentence after its name.
    fn ended(&self) -> Option<String> {
        None
    }

    /// Tells whoever listens what went wrong when nobody waits for an answer any more.
    fn report(&self, _what: &str) {}
}
