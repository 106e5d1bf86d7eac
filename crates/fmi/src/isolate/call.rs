//! The requests: calls of the FMU, and what both processes have to arrange beside them.
//!
//! `numbers` are a request's arguments in order; results are the reply's numbers from the second on. The last argument of a
//! request with values is the place of the first one in the data. A *list* is the number of a list of references in the payload.
//!
//! ```text
//! Load                    data: folder, model identifier; their lengths. Result: set of optional functions, or with an error the
//!                         length of its text
//! Grow                    the payload is larger now: items of a list, bytes of data
//! Fetch                   the bytes of the result before, which did not fit, into the data
//! Flush                   only the posted requests
//! Quit                    nothing follows
//! Instantiate             data: name, GUID; their lengths, debug logging
//! SetupExperiment         start, whether there is a stop, stop
//! DoStep                  t, h, whether a restore may follow, list, n. After a step that was done the n outputs in the list are
//!                         read too, if n > 0. Result: 1 if that went well. Data of the reply: n values
//! GetReal                 list, n. Data of the reply: n values
//! SetReal                 list, n. Data: n values
//! SetInputDerivatives     list, n, list of orders. Data: n values
//! DirectionalDerivative   list of unknowns, n, list of knowns, m. Data: m values of the seed; of the reply: n values behind them
//! GetInteger, GetBoolean  reference. Result: value
//! GetString               reference. Result: length of the text, which is to be fetched
//! SetInteger, SetBoolean  reference, value
//! SetString               reference, length. Data: the text
//! GetState, FreeState     handle. Result: handle
//! SetState                handle
//! Serialize               handle. Result: length of the bytes, which are to be fetched
//! Deserialize             handle, length. Data: the bytes. Result: handle
//! ```

use crate::slave::Call;

/// What the master asks of the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// Loads the library.
    Load,
    /// The payload has grown.
    Grow,
    /// A long result.
    Fetch,
    /// Posted requests.
    Flush,
    /// The end.
    Quit,
    /// A call of the FMU.
    Call(Call),
}

/// What is no call of the FMU, by number; the calls come behind.
const OTHERS: [Op; 5] = [Op::Load, Op::Grow, Op::Fetch, Op::Flush, Op::Quit];

impl Op {
    /// As a number.
    pub fn code(self) -> u32 {
        match self {
            Self::Call(call) => OTHERS.len() as u32 + call as u32,
            other => OTHERS.iter().position(|op| *op == other).unwrap_or_default() as u32,
        }
    }

    /// The request of a number.
    pub fn from_code(code: u32) -> Option<Self> {
        let code = code as usize;
        let call = || Call::ALL.get(code - OTHERS.len()).map(|call| Self::Call(*call));
        OTHERS.get(code).copied().or_else(call)
    }

    /// The call behind a request that may be posted: one that gives nothing back and whose values the host may read
    /// later.
    pub fn posted_call(self) -> Option<Call> {
        match self {
            Self::Call(call @ (Call::SetReal | Call::SetInputDerivatives | Call::SetState)) => Some(call),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_request_has_a_number_of_its_own() {
        let all: Vec<Op> = OTHERS.into_iter().chain(Call::ALL.iter().map(|call| Op::Call(*call))).collect();
        for (code, op) in all.iter().enumerate() {
            assert_eq!((op.code(), Op::from_code(code as u32)), (code as u32, Some(*op)));
        }
        assert_eq!(Op::from_code(all.len() as u32), None);
    }
}
