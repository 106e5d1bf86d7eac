//! The requests.

use crate::slave::Call;

/// Declares [`Op`] and its way back from a number.
macro_rules! operations {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// What the master asks of the host. `numbers` are the request's arguments in order; results are the reply's numbers
        /// from the second on. The last argument of a request with values is the place of the first one in the data. A *list* is the number of a list of references in the payload.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u32)]
        pub enum Op { $($(#[$doc])* $name,)* }

        impl Op {
            /// The request of a code.
            pub fn from_code(code: u32) -> Option<Self> {
                [$(Self::$name),*].into_iter().find(|op| *op as u32 == code)
            }
        }
    };
}

operations! {
    /// Data: folder, model identifier; numbers: their lengths. Result: set of optional functions, or with an error the
    /// length of its text.
    Load,
    /// Data: name, GUID; numbers: their lengths, debug logging.
    Instantiate,
    /// The payload is larger now. Numbers: items of a list, bytes of data.
    Grow,
    /// The bytes of the result before, which did not fit, into the data.
    Fetch,
    /// Only the posted requests.
    Flush,
    /// Nothing follows.
    Quit,
    /// Numbers: start, whether there is a stop, stop.
    SetupExperiment,
    EnterInitialization,
    ExitInitialization,
    /// Numbers: t, h, whether a restore may follow, list, n. After a step that was done the n outputs in the list are read
    /// too, if n > 0. Result: 1 if that went well. Data of the reply: n values.
    DoStep,
    Terminate,
    Reset,
    FreeInstance,
    /// Numbers: list, n. Data of the reply: n values.
    GetReal,
    /// Numbers: list, n. Data: n values.
    SetReal,
    /// Numbers: list, n, list of orders. Data: n values.
    SetInputDerivatives,
    /// Numbers: list of unknowns, n, list of knowns, m. Data: m values of the seed; of the reply: n values behind them.
    DirectionalDerivative,
    /// Number: reference. Result: value.
    GetInteger,
    /// Number: reference. Result: value.
    GetBoolean,
    /// Number: reference. Result: length of the text, which is to be fetched.
    GetString,
    /// Numbers: reference, value.
    SetInteger,
    /// Numbers: reference, value.
    SetBoolean,
    /// Numbers: reference, length. Data: the text.
    SetString,
    /// Number: handle. Result: handle.
    GetState,
    /// Number: handle.
    SetState,
    /// Number: handle. Result: handle.
    FreeState,
    /// Number: handle. Result: length of the bytes, which are to be fetched.
    Serialize,
    /// Numbers: handle, length. Data: the bytes. Result: handle.
    Deserialize,
}

impl Op {
    /// The call behind a request that may be posted: one that gives nothing back and whose values the host may read
    /// later.
    pub fn posted_call(self) -> Option<Call> {
        match self {
            Self::SetReal => Some(Call::SetReal),
            Self::SetInputDerivatives => Some(Call::SetInputDerivatives),
            Self::SetState => Some(Call::SetState),
            _ => None,
        }
    }
}
