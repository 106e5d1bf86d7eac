//! The verbs of an isolated instance as requests. Setting values and restoring a state are only posted; the outputs that
//! were read right after the last step come with the next one: a trial step of the iteration is then a single exchange.

use super::call::Op;
use super::exchange::{Exchange, Fresh, GONE, POSTPONED};
use super::payload::to_list;
use crate::log::{KEPT, Sink};
use crate::slave::{Answer, Call, Handle, Slave};

/// What a request needs before it can be made, or the answer.
macro_rules! some {
    ($result:expr) => {
        match $result {
            Ok(value) => value,
            Err(answer) => return answer,
        }
    };
}

impl Slave for Exchange {
    fn has(&self, function: Call) -> bool {
        self.functions & function.bit() != 0
    }

    fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Answer {
        let numbers = [start.to_bits(), u64::from(stop.is_some()), stop.unwrap_or_default().to_bits()];
        self.call(Op::Call(Call::SetupExperiment), &numbers)
    }
    fn enter_initialization(&mut self) -> Answer {
        self.call(Op::Call(Call::EnterInitialization), &[])
    }
    fn exit_initialization(&mut self) -> Answer {
        self.call(Op::Call(Call::ExitInitialization), &[])
    }
    fn do_step(&mut self, t: f64, h: f64, may_restore: bool) -> Answer {
        let habit = std::mem::take(&mut self.habit);
        let n = habit.len();
        let list = self.reserve_behind(n, n).and_then(|()| if n > 0 { self.lists([&habit; 2]) } else { Ok([0; 2]) });
        self.habit = habit;
        let [list, _] = some!(list);
        let first = self.filled;
        let numbers = [t.to_bits(), h.to_bits(), u64::from(may_restore), list, n as u64, first as u64];
        let answer = self.call(Op::Call(Call::DoStep), &numbers);
        self.fresh = if n > 0 && self.result() == 1 { Fresh::Outputs(first) } else { Fresh::Step };
        answer
    }
    fn terminate(&mut self) -> Answer {
        self.call(Op::Call(Call::Terminate), &[])
    }
    fn reset(&mut self) -> Answer {
        self.call(Op::Call(Call::Reset), &[])
    }
    /// Also ends the process.
    fn free_instance(&mut self) {
        self.call(Op::Call(Call::FreeInstance), &[]);
        self.call(Op::Quit, &[]);
        if self.end.is_some() {
            return;
        }
        if !self.process.ends_within(self.isolation.timeout) {
            self.process.finish();
            self.end = Some("did not end after it had freed the instance and was killed".into());
        } else if !self.process.finish().is_some_and(|status| status.success()) {
            self.end = Some(self.process.how_it_ended());
        }
    }

    fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Answer {
        match self.fresh {
            Fresh::Outputs(first) if references == self.habit && self.end.is_none() => {
                self.payload.read(first, values);
                self.fresh = Fresh::Nothing;
                return POSTPONED;
            }
            Fresh::Step | Fresh::Outputs(_) => {
                self.habit.clear();
                self.habit.extend_from_slice(references);
            }
            _ => {}
        }
        let n = references.len();
        let list = self.reserve_behind(n, n).and_then(|()| self.lists([references; 2]));
        let [list, _] = some!(list);
        let first = self.filled;
        let answer = self.call(Op::Call(Call::GetReal), &[list, n as u64, 0, 0, 0, first as u64]);
        self.payload.read(first, values);
        answer
    }
    fn set_real(&mut self, references: &[u32], values: &[f64]) -> Answer {
        let n = references.len();
        let list = self.reserve_behind(n, n).and_then(|()| self.lists([references; 2]));
        let [list, _] = some!(list);
        self.payload.write(self.filled, values);
        self.post(Op::Call(Call::SetReal), &[list, n as u64, 0, 0, 0, self.filled as u64], n)
    }
    fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Answer {
        let n = references.len();
        let lists = self.reserve_behind(n, n).and_then(|()| self.lists([references, to_list(orders)]));
        let [list, orders] = some!(lists);
        self.payload.write(self.filled, values);
        self.post(Op::Call(Call::SetInputDerivatives), &[list, n as u64, orders, 0, 0, self.filled as u64], n)
    }
    fn directional_derivative(&mut self, unknown: &[u32], known: &[u32], seed: &[f64], out: &mut [f64]) -> Answer {
        let (n, m) = (unknown.len(), known.len());
        let lists = self.reserve(n.max(m), 8 * (n + m)).and_then(|()| self.lists([unknown, known]));
        let [unknown, known] = some!(lists);
        self.payload.write(0, seed);
        let answer = self.call(Op::Call(Call::DirectionalDerivative), &[unknown, n as u64, known, m as u64]);
        self.payload.read(m, out);
        answer
    }
    fn get_integer(&mut self, reference: u32, value: &mut i32) -> Answer {
        let answer = self.one(Op::Call(Call::GetInteger), reference, 0);
        *value = self.result() as i32;
        answer
    }
    fn get_boolean(&mut self, reference: u32, value: &mut bool) -> Answer {
        let answer = self.one(Op::Call(Call::GetBoolean), reference, 0);
        *value = self.result() != 0;
        answer
    }
    fn get_string(&mut self, reference: u32, value: &mut String) -> Answer {
        let answer = self.one(Op::Call(Call::GetString), reference, 0);
        *value = String::from_utf8_lossy(&self.fetch()).into_owned();
        if self.end.is_some() { GONE } else { answer }
    }
    fn set_integer(&mut self, reference: u32, value: i32) -> Answer {
        self.one(Op::Call(Call::SetInteger), reference, u64::from(value as u32))
    }
    fn set_boolean(&mut self, reference: u32, value: bool) -> Answer {
        self.one(Op::Call(Call::SetBoolean), reference, u64::from(value))
    }
    fn set_string(&mut self, reference: u32, value: &str) -> Answer {
        some!(self.reserve(0, value.len()));
        self.payload.write_bytes(0, value.as_bytes());
        self.one(Op::Call(Call::SetString), reference, value.len() as u64)
    }

    fn get_state(&mut self, handle: &mut Handle) -> Answer {
        let answer = self.call(Op::Call(Call::GetState), &[*handle as u64]);
        if self.failed_posted.is_none() && self.end.is_none() {
            *handle = self.result() as Handle;
        }
        answer
    }
    fn set_state(&mut self, handle: Handle) -> Answer {
        self.post(Op::Call(Call::SetState), &[handle as u64], 0)
    }
    fn free_state(&mut self, handle: &mut Handle) -> Answer {
        let answer = self.call(Op::Call(Call::FreeState), &[*handle as u64]);
        *handle = 0;
        answer
    }
    fn serialize(&mut self, handle: Handle, bytes: &mut Vec<u8>) -> Answer {
        let answer = self.call(Op::Call(Call::Serialize), &[handle as u64]);
        *bytes = self.fetch();
        if self.end.is_some() { GONE } else { answer }
    }
    fn deserialize(&mut self, bytes: &[u8], handle: &mut Handle) -> Answer {
        some!(self.reserve(0, bytes.len()));
        self.payload.write_bytes(0, bytes);
        let answer = self.call(Op::Call(Call::Deserialize), &[*handle as u64, bytes.len() as u64]);
        *handle = self.result() as Handle;
        answer
    }

    fn collect(&mut self, sink: &Sink) {
        let logged = self.control.logged();
        if logged != self.collected {
            let first = self.collected.max(logged.saturating_sub(KEPT as u64));
            (first..logged).for_each(|n| sink.push(self.control.message(n)));
            self.collected = logged;
        }
    }

    fn earlier_failure(&mut self) -> Option<Call> {
        self.failed_posted.take()
    }

    fn ended(&self) -> Option<String> {
        self.end.as_ref().map(|how| format!("its process {how}"))
    }

    fn report(&self, what: &str) {
        (self.isolation.listener)(&self.name, what);
    }
}
