//! The master's end: every verb becomes a request.

use super::Isolation;
use super::call::Op;
use super::control::{CONTROL, Control};
use super::gate::Gate;
use super::memory::{LISTS, Payload, create, grow, to_list};
use super::process::Process;
use crate::import::ModelDescription;
use crate::import::error::FmuError;
use crate::import::library::LibraryError;
use crate::import::messages::{KEPT, Sink};
use crate::import::slave::{Answer, Handle, Optional, Slave};
use crate::types::{Status, fmi2Status};
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Bytes of data there is room for at the beginning.
pub(super) const FIRST_DATA: usize = 1 << 16;
/// More than this no FMU hands out at once.
const LARGEST: u64 = 1 << 32;
/// Pauses between two looks whether the process still lives.
const LOOKS: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(50)];

/// A list of references as the host has it.
#[derive(Default)]
struct List {
    items: Vec<u32>,
    used: u64,
}

/// An isolated instance.
pub(crate) struct Remote {
    name: String,
    isolation: Isolation,
    memory: OwnedFd,
    control: Control,
    gate: Gate,
    payload: Payload,
    lists: [List; LISTS],
    calls: u64,
    functions: u64,
    collected: u64,
    death: Option<String>,
    process: Process,
    /// Last: the folder goes after the process.
    _folder: Arc<TempDir>,
}

/// What a call answers when nobody is there.
const GONE: Answer = Answer { status: Status::Fatal as fmi2Status, time: Duration::ZERO };

impl Remote {
    /// Starts the process, loads the library there and instantiates; the time is that inside the FMU.
    pub fn start(
        name: &str,
        fmu: &Path,
        description: &ModelDescription,
        folder: Arc<TempDir>,
        isolation: &Isolation,
        logging: bool,
        sink: &Sink,
    ) -> Result<(Self, Duration), FmuError> {
        let instance = || name.to_string();
        let begun = Self::begin(name, Arc::clone(&folder), isolation.clone());
        let mut remote = begun.map_err(|e| FmuError::Impossible {
            instance: instance(),
            what: format!("its process cannot be started ({}): {e}", isolation.program.display()),
        })?;
        let gone = |remote: &Self, call: &str| {
            let how = remote.death.clone()?;
            Some(FmuError::Gone { instance: instance(), call: call.into(), how, messages: sink.take() })
        };
        let (path, identifier) = (folder.path().as_os_str().as_bytes(), &description.co_simulation.model_identifier);
        let loaded = remote.send(Op::Load, &[path, identifier.as_bytes()], 0);
        remote.collect(sink);
        if loaded.status != Status::Ok as fmi2Status {
            return Err(gone(&remote, "loading its library").unwrap_or_else(|| {
                let text = String::from_utf8_lossy(&remote.fetch()).into_owned();
                FmuError::Library { fmu: fmu.to_path_buf(), source: LibraryError::Isolated(text) }
            }));
        }
        remote.functions = remote.result();
        let made = remote.send(Op::Instantiate, &[name.as_bytes(), description.guid.as_bytes()], u64::from(logging));
        remote.collect(sink);
        if made.status != Status::Ok as fmi2Status {
            let none = || FmuError::NoInstance { instance: instance(), messages: sink.take() };
            return Err(gone(&remote, "fmi2Instantiate").unwrap_or_else(none));
        }
        Ok((remote, loaded.time + made.time))
    }

    fn begin(name: &str, folder: Arc<TempDir>, isolation: Isolation) -> io::Result<Self> {
        let memory = create(CONTROL + Payload::length(0, FIRST_DATA))?;
        let control = Control::new(&memory)?;
        control.sign();
        let payload = Payload::new(&memory, CONTROL, 0, FIRST_DATA)?;
        let process = Process::start(&isolation, name, memory.try_clone()?)?;
        Ok(Self {
            name: name.to_string(),
            isolation,
            memory,
            gate: Gate::new(control.clone(), true),
            control,
            payload,
            lists: Default::default(),
            calls: 0,
            functions: 0,
            collected: 0,
            death: None,
            process,
            _folder: folder,
        })
    }

    /// Makes a request and waits for the reply, the end of the process, or the end of patience.
    fn call(&mut self, op: Op, numbers: &[u64]) -> Answer {
        if self.death.is_some() {
            return GONE;
        }
        self.calls += 1;
        let n = self.calls as u32;
        let mine = self.gate.mine();
        mine.code.store(op as u32, Relaxed);
        mine.numbers.iter().zip(numbers).for_each(|(place, number)| place.store(*number, Relaxed));
        self.gate.signal(n);
        if !self.gate.wait(n, Some(LOOKS[0])) && !self.wait_long(n) {
            return GONE;
        }
        let theirs = self.gate.theirs();
        Answer {
            status: theirs.code.load(Relaxed) as fmi2Status,
            time: Duration::from_nanos(theirs.numbers[0].load(Relaxed)),
        }
    }

    /// Whether the reply has come; if not, the process is dead.
    fn wait_long(&mut self, n: u32) -> bool {
        let (begin, timeout) = (Instant::now(), self.isolation.timeout);
        let mut pause = LOOKS[0];
        loop {
            // In this order: an answer may be the last thing a process gives.
            let (ended, late) = (self.process.has_ended(), begin.elapsed() >= timeout);
            if self.gate.sleep(n, Some(if ended { Duration::from_nanos(1) } else { pause })) {
                return true;
            }
            if ended {
                self.death = Some(self.process.epitaph());
                return false;
            }
            if late {
                self.process.finish();
                self.death = Some(format!("gave no answer within {} s and was killed", timeout.as_secs_f64()));
                return false;
            }
            pause = (2 * pause).min(LOOKS[1]).min(timeout.saturating_sub(begin.elapsed()));
        }
    }

    /// A request with texts, their lengths and one more number.
    fn send(&mut self, op: Op, texts: &[&[u8]; 2], number: u64) -> Answer {
        if !self.reserve(0, texts[0].len() + texts[1].len()) {
            return GONE;
        }
        self.payload.write_bytes(0, texts[0]);
        self.payload.write_bytes(texts[0].len(), texts[1]);
        self.call(op, &[texts[0].len() as u64, texts[1].len() as u64, number])
    }

    /// The reply's result.
    fn result(&self) -> u64 {
        self.gate.theirs().numbers[1].load(Relaxed)
    }

    /// The bytes whose length is the reply's result.
    fn fetch(&mut self) -> Vec<u8> {
        let length = self.result();
        if length > LARGEST || !self.reserve(0, length as usize) {
            return Vec::new();
        }
        let fetched = self.call(Op::Fetch, &[]);
        if fetched.status == 0 { self.payload.read_bytes(0, length as usize) } else { Vec::new() }
    }

    /// Makes room; without it the FMU is given up.
    fn reserve(&mut self, items: usize, bytes: usize) -> bool {
        let (has_items, has_bytes) = self.payload.room();
        if items <= has_items && bytes <= has_bytes {
            return self.death.is_none();
        }
        let more = |wanted: usize, has: usize| if wanted > has { wanted.next_power_of_two().max(2) } else { has };
        let (items, bytes) = (more(items, has_items), more(bytes, has_bytes));
        self.lists.iter_mut().for_each(|list| list.items.clear());
        let grown = grow(&self.memory, CONTROL + Payload::length(items, bytes));
        match grown.and_then(|()| Payload::new(&self.memory, CONTROL, items, bytes)) {
            Ok(payload) => self.payload = payload,
            Err(error) => {
                self.process.finish();
                self.death = Some(format!("was given up: no shared memory for its values: {error}"));
                return false;
            }
        }
        self.call(Op::Grow, &[items as u64, bytes as u64]).status == 0
    }

    /// Number of the list with these items, which is sent if the host does not have it.
    fn list(&mut self, items: &[u32]) -> u64 {
        let known = self.lists.iter().position(|list| list.items == items);
        let place = known.unwrap_or_else(|| {
            let oldest = (0..LISTS).min_by_key(|i| self.lists[*i].used).unwrap_or_default();
            let list = &mut self.lists[oldest];
            list.items.clear();
            list.items.extend_from_slice(items);
            self.payload.set_list(oldest, items);
            oldest
        });
        self.lists[place].used = self.calls + 1;
        place as u64
    }

    /// A request about one variable.
    fn one(&mut self, op: Op, reference: u32, value: u64) -> Answer {
        self.call(op, &[u64::from(reference), value])
    }
}

impl Slave for Remote {
    fn has(&self, function: Optional) -> bool {
        self.functions & function.bit() != 0
    }

    fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Answer {
        let numbers = [start.to_bits(), u64::from(stop.is_some()), stop.unwrap_or_default().to_bits()];
        self.call(Op::SetupExperiment, &numbers)
    }
    fn enter_initialization(&mut self) -> Answer {
        self.call(Op::EnterInitialization, &[])
    }
    fn exit_initialization(&mut self) -> Answer {
        self.call(Op::ExitInitialization, &[])
    }
    fn do_step(&mut self, t: f64, h: f64, may_restore: bool) -> Answer {
        self.call(Op::DoStep, &[t.to_bits(), h.to_bits(), u64::from(may_restore)])
    }
    fn terminate(&mut self) -> Answer {
        self.call(Op::Terminate, &[])
    }
    fn reset(&mut self) -> Answer {
        self.call(Op::Reset, &[])
    }
    /// Also ends the process.
    fn free_instance(&mut self) {
        self.call(Op::FreeInstance, &[]);
        self.call(Op::Quit, &[]);
        if self.death.is_some() {
            return;
        }
        if !self.process.ends_within(self.isolation.timeout) {
            self.process.finish();
            self.death = Some("did not end after it had freed the instance and was killed".into());
        } else if !self.process.finish().is_some_and(|status| status.success()) {
            self.death = Some(self.process.epitaph());
        }
    }

    fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Answer {
        let n = references.len();
        if !self.reserve(n, 8 * n) {
            return GONE;
        }
        let list = self.list(references);
        let answer = self.call(Op::GetReal, &[list, n as u64]);
        self.payload.read(0, values);
        answer
    }
    fn set_real(&mut self, references: &[u32], values: &[f64]) -> Answer {
        let n = references.len();
        if !self.reserve(n, 8 * n) {
            return GONE;
        }
        let list = self.list(references);
        self.payload.write(0, values);
        self.call(Op::SetReal, &[list, n as u64])
    }
    fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Answer {
        let n = references.len();
        if !self.reserve(n, 8 * n) {
            return GONE;
        }
        let (list, orders) = (self.list(references), self.list(to_list(orders)));
        self.payload.write(0, values);
        self.call(Op::SetInputDerivatives, &[list, n as u64, orders])
    }
    fn directional_derivative(&mut self, unknown: &[u32], known: &[u32], seed: &[f64], out: &mut [f64]) -> Answer {
        let (n, m) = (unknown.len(), known.len());
        if !self.reserve(n.max(m), 8 * (n + m)) {
            return GONE;
        }
        let (unknown, known) = (self.list(unknown), self.list(known));
        self.payload.write(0, seed);
        let answer = self.call(Op::DirectionalDerivative, &[unknown, n as u64, known, m as u64]);
        self.payload.read(m, out);
        answer
    }
    fn get_integer(&mut self, reference: u32, value: &mut i32) -> Answer {
        let answer = self.one(Op::GetInteger, reference, 0);
        *value = self.result() as i32;
        answer
    }
    fn get_boolean(&mut self, reference: u32, value: &mut bool) -> Answer {
        let answer = self.one(Op::GetBoolean, reference, 0);
        *value = self.result() != 0;
        answer
    }
    fn get_string(&mut self, reference: u32, value: &mut String) -> Answer {
        let answer = self.one(Op::GetString, reference, 0);
        *value = String::from_utf8_lossy(&self.fetch()).into_owned();
        if self.death.is_some() { GONE } else { answer }
    }
    fn set_integer(&mut self, reference: u32, value: i32) -> Answer {
        self.one(Op::SetInteger, reference, u64::from(value as u32))
    }
    fn set_boolean(&mut self, reference: u32, value: bool) -> Answer {
        self.one(Op::SetBoolean, reference, u64::from(value))
    }
    fn set_string(&mut self, reference: u32, value: &str) -> Answer {
        if !self.reserve(0, value.len()) {
            return GONE;
        }
        self.payload.write_bytes(0, value.as_bytes());
        self.one(Op::SetString, reference, value.len() as u64)
    }

    fn get_state(&mut self, handle: &mut Handle) -> Answer {
        let answer = self.call(Op::GetState, &[*handle as u64]);
        *handle = self.result() as Handle;
        answer
    }
    fn set_state(&mut self, handle: Handle) -> Answer {
        self.call(Op::SetState, &[handle as u64])
    }
    fn free_state(&mut self, handle: &mut Handle) -> Answer {
        let answer = self.call(Op::FreeState, &[*handle as u64]);
        *handle = 0;
        answer
    }
    fn serialize(&mut self, handle: Handle, bytes: &mut Vec<u8>) -> Answer {
        let answer = self.call(Op::Serialize, &[handle as u64]);
        *bytes = self.fetch();
        if self.death.is_some() { GONE } else { answer }
    }
    fn deserialize(&mut self, bytes: &[u8], handle: &mut Handle) -> Answer {
        if !self.reserve(0, bytes.len()) {
            return GONE;
        }
        self.payload.write_bytes(0, bytes);
        let answer = self.call(Op::Deserialize, &[*handle as u64, bytes.len() as u64]);
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

    fn death(&self) -> Option<&str> {
        self.death.as_deref()
    }

    fn report(&self, what: &str) {
        (self.isolation.listener)(&self.name, what);
    }
}
