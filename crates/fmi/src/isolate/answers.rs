//! What the FMU's end does when it is asked: each request is a call of the FMU.

use super::call::Op;
use super::control::{CONTROL, Control, PROGRESS, Ring};
use super::payload::{Payload, from_list};
use crate::platform;
use crate::platform::memory::Shared;
use crate::slave::{Answer, Call, Slave};
use crate::status::Status;
use crate::version::{Library, Version};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Duration;

/// Status of a reply beside those of FMI: the request made no sense.
pub const NO_SENSE: i32 = 99;

/// An answer that took no time.
fn fine(status: Status) -> Answer {
    Answer { status: status as i32, time: Duration::ZERO, warnings: 0 }
}

/// The FMU and what it is called with.
pub struct Answers {
    version: &'static Version,
    memory: Shared,
    control: Control,
    payload: Payload,
    folder: PathBuf,
    library: Option<Arc<dyn Library>>,
    slave: Option<Box<dyn Slave>>,
    /// A result whose length the master must know first.
    bytes: Vec<u8>,
}

impl Answers {
    /// Nothing is loaded yet.
    pub fn new(version: &'static Version, memory: Shared, control: Control, payload: Payload) -> Self {
        let (folder, bytes) = (PathBuf::new(), Vec::new());
        Self { version, memory, control, payload, folder, library: None, slave: None, bytes }
    }

    /// Unloads the library: this process may be lost, and the library's destructors may have something to write.
    pub fn end(&mut self) {
        self.slave = None;
        if let Some(library) = self.library.take() {
            library.unload();
        }
    }

    /// What an operation answers; nothing if it made no sense at this point.
    pub fn answer(&mut self, op: Op, a: [u64; 6]) -> Option<(Answer, u64)> {
        let at = |i: usize| a[i] as usize;
        Some(match op {
            Op::Load => self.load(at(0), at(1)),
            Op::Grow => {
                let grown = Payload::new(&self.memory, CONTROL, at(0), at(1));
                let status = if grown.is_ok() { Status::Ok } else { Status::Error };
                grown.into_iter().for_each(|payload| self.payload = payload);
                (fine(status), 0)
            }
            Op::Fetch => {
                self.payload.write_bytes(0, &self.bytes);
                (fine(Status::Ok), 0)
            }
            Op::Flush | Op::Quit => (fine(Status::Ok), 0),
            Op::Call(Call::Instantiate) => self.instantiate(at(0), at(1), a[2] != 0)?,
            Op::Call(call) => self.call(call, a)?,
        })
    }

    /// What a call of the instance answers; nothing if there is none.
    fn call(&mut self, call: Call, a: [u64; 6]) -> Option<(Answer, u64)> {
        let at = |i: usize| a[i] as usize;
        let (slave, payload) = (self.slave.as_mut()?, &mut self.payload);
        let mut result = 0;
        let answer = match call {
            Call::SetupExperiment => {
                slave.setup_experiment(f64::from_bits(a[0]), (a[1] != 0).then(|| f64::from_bits(a[2])))
            }
            Call::EnterInitialization => slave.enter_initialization(),
            Call::ExitInitialization => slave.exit_initialization(),
            Call::DoStep => {
                let mut done = slave.do_step(f64::from_bits(a[0]), f64::from_bits(a[1]), a[2] != 0);
                if a[4] > 0 && done.status <= Status::Warning as i32 {
                    let reply = &self.control.header().reply.numbers[PROGRESS];
                    reply.store(reply.load(Relaxed) + 1, Relaxed);
                    let ([list, _], values) = payload.in_place([(at(3), at(4)), (0, 0)], at(5), at(4));
                    let read = slave.get_real(list, values);
                    done.time += read.time;
                    result = u64::from(read.status == Status::Ok as i32);
                }
                done
            }
            Call::Terminate => slave.terminate(),
            Call::Reset => slave.reset(),
            Call::FreeInstance => {
                slave.free_instance();
                self.slave = None;
                fine(Status::Ok)
            }
            Call::GetReal => {
                let ([list, _], values) = payload.in_place([(at(0), at(1)), (0, 0)], at(5), at(1));
                slave.get_real(list, values)
            }
            Call::SetReal => {
                let ([list, _], values) = payload.in_place([(at(0), at(1)), (0, 0)], at(5), at(1));
                slave.set_real(list, values)
            }
            Call::SetInputDerivatives => {
                let ([list, orders], values) = payload.in_place([(at(0), at(1)), (at(2), at(1))], at(5), at(1));
                slave.set_input_derivatives(list, from_list(orders), values)
            }
            Call::DirectionalDerivative => {
                let lists = [(at(0), at(1)), (at(2), at(3))];
                let ([unknown, known], values) = payload.in_place(lists, 0, at(1) + at(3));
                let (seed, out) = values.split_at_mut(at(3));
                slave.directional_derivative(unknown, known, seed, out)
            }
            Call::GetInteger => {
                let mut value = 0;
                let answer = slave.get_integer(a[0] as u32, &mut value);
                result = u64::from(value as u32);
                answer
            }
            Call::GetBoolean => {
                let mut value = false;
                let answer = slave.get_boolean(a[0] as u32, &mut value);
                result = u64::from(value);
                answer
            }
            Call::GetString => {
                let mut text = String::new();
                let answer = slave.get_string(a[0] as u32, &mut text);
                self.bytes = text.into_bytes();
                result = self.bytes.len() as u64;
                answer
            }
            Call::SetInteger => slave.set_integer(a[0] as u32, a[1] as u32 as i32),
            Call::SetBoolean => slave.set_boolean(a[0] as u32, a[1] != 0),
            Call::SetString => slave.set_string(a[0] as u32, &String::from_utf8_lossy(&payload.read_bytes(0, at(1)))),
            Call::GetState | Call::FreeState => {
                let mut handle = at(0);
                let answer =
                    if call == Call::GetState { slave.get_state(&mut handle) } else { slave.free_state(&mut handle) };
                result = handle as u64;
                answer
            }
            Call::SetState => slave.set_state(at(0)),
            Call::Serialize => {
                let answer = slave.serialize(at(0), &mut self.bytes);
                result = self.bytes.len() as u64;
                answer
            }
            Call::Deserialize => {
                let mut handle = at(0);
                let answer = slave.deserialize(&payload.read_bytes(0, at(1)), &mut handle);
                result = handle as u64;
                answer
            }
            Call::Instantiate => return None,
        };
        Some((answer, result))
    }

    fn load(&mut self, folder: usize, identifier: usize) -> (Answer, u64) {
        let path = platform::path(&self.payload.read_bytes(0, folder)).into_owned();
        let identifier = String::from_utf8_lossy(&self.payload.read_bytes(folder, identifier)).into_owned();
        let begin = std::time::Instant::now();
        let (status, result) = match (self.version.load)(&path, &identifier) {
            Ok(library) => {
                let set = library.optional();
                (self.library, self.folder) = (Some(library), path);
                (Status::Ok, set)
            }
            Err(error) => {
                self.bytes = error.to_string().into_bytes();
                (Status::Error, self.bytes.len() as u64)
            }
        };
        (Answer { status: status as i32, time: begin.elapsed(), warnings: 0 }, result)
    }

    fn instantiate(&mut self, name: usize, guid: usize, logging: bool) -> Option<(Answer, u64)> {
        let text = |offset, length| String::from_utf8_lossy(&self.payload.read_bytes(offset, length)).into_owned();
        let (name, guid) = (text(0, name), text(name, guid));
        let (library, ring) = (Arc::clone(self.library.as_ref()?), Ring::new(self.control.clone()));
        let (slave, time) = library.instantiate(&name, &guid, &self.folder, ring, logging);
        let status = if slave.is_some() { Status::Ok } else { Status::Error } as i32;
        self.slave = slave;
        Some((Answer { status, time, warnings: 0 }, 0))
    }
}
