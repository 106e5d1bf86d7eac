//! The master's end: every verb becomes a request.

use super::Isolation;
use super::call::Op;
use super::control::{CONTROL, Control, POSTED, PROGRESS, progress};
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
    /// Requests that go with the next one, and the numbers they occupy in the data.
    posted: [Option<Op>; POSTED],
    filled: usize,
    owed_time: Duration,
    owed_warnings: u32,
    functions: u64,
    collected: u64,
    death: Option<String>,
    /// The posted request that failed.
    blamed: Option<&'static str>,
    process: Process,
    /// Last: the folder goes after the process.
    _folder: Arc<TempDir>,
}

/// What a call answers when nobody is there.
const GONE: Answer = Answer { status: Status::Fatal as fmi2Status, time: Duration::ZERO, warnings: 0 };
/// What a posted request answers.
const POSTPONED: Answer = Answer { status: Status::Ok as fmi2Status, time: Duration::ZERO, warnings: 0 };

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
            posted: [None; POSTED],
            filled: 0,
            owed_time: Duration::ZERO,
            owed_warnings: 0,
            functions: 0,
            collected: 0,
            death: None,
            blamed: None,
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
        let posted = std::mem::take(&mut self.posted);
        let count = posted.iter().flatten().count();
        self.filled = 0;
        let mine = self.gate.mine();
        mine.posted.store(count as u32, Relaxed);
        mine.code.store(op as u32, Relaxed);
        mine.numbers.iter().zip(numbers).for_each(|(place, number)| place.store(*number, Relaxed));
        self.gate.signal(n);
        let come = self.gate.wait(n, Some(LOOKS[0])) || self.wait_long(n);
        let theirs = self.gate.theirs();
        let (status, warnings) = (theirs.code.load(Relaxed) as fmi2Status, theirs.posted.load(Relaxed));
        if count > 0 && (!come || status > Status::Warning as fmi2Status) {
            let reached = theirs.numbers[PROGRESS].load(Relaxed);
            let at = (0..count).find(|i| progress(n, *i) == reached);
            self.blamed = at.and_then(|i| posted[i]).and_then(Op::posted_function);
        }
        if !come {
            return GONE;
        }
        let time = Duration::from_nanos(theirs.numbers[0].load(Relaxed)) + std::mem::take(&mut self.owed_time);
        Answer { status, time, warnings: warnings + std::mem::take(&mut self.owed_warnings) }
    }

    /// Leaves a request for the next one to take along: it saves the way there and back. `values` lie in the data from
    /// [`Remote::filled`] on.
    fn post(&mut self, op: Op, numbers: &[u64], values: usize) -> Answer {
        if self.death.is_some() {
            return GONE;
        }
        let Some(i) = self.posted.iter().position(Option::is_none) else {
            return self.call(op, numbers);
        };
        self.posted[i] = Some(op);
        let place = &self.control.header().posted[i];
        place.code.store(op as u32, Relaxed);
        place.numbers.iter().zip(numbers).for_each(|(place, number)| place.store(*number, Relaxed));
        self.filled += values;
        POSTPONED
    }

    /// Makes the posted requests now; what they cost is counted with the next call.
    fn flushed(&mut self) -> Result<(), Answer> {
        if self.posted[0].is_none() {
            return if self.death.is_some() { Err(GONE) } else { Ok(()) };
        }
        let answer = self.call(Op::Flush, &[]);
        if answer.status > Status::Warning as fmi2Status {
            return Err(answer);
        }
        (self.owed_time, self.owed_warnings) = (answer.time, answer.warnings);
        Ok(())
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
        if let Err(failed) = self.reserve(0, texts[0].len() + texts[1].len()) {
            return failed;
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
        if length > LARGEST || self.reserve(0, length as usize).is_err() {
            return Vec::new();
        }
        let fetched = self.call(Op::Fetch, &[]);
        if fetched.status == 0 { self.payload.read_bytes(0, length as usize) } else { Vec::new() }
    }

    /// Makes room, behind the values of posted requests or without them; fails as they do, or if there is none.
    fn reserve_behind(&mut self, items: usize, values: usize) -> Result<(), Answer> {
        let (has_items, has_bytes) = self.payload.room();
        let fits = items <= has_items && 8 * (self.filled + values) <= has_bytes;
        if fits && self.death.is_none() { Ok(()) } else { self.reserve(items, 8 * values) }
    }

    /// Makes room for bytes and makes the posted requests; fails as they do, or if there is none: the FMU is then given up.
    fn reserve(&mut self, items: usize, bytes: usize) -> Result<(), Answer> {
        self.flushed()?;
        let (has_items, has_bytes) = self.payload.room();
        if items <= has_items && bytes <= has_bytes {
            return Ok(());
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
                return Err(GONE);
            }
        }
        let grown = self.call(Op::Grow, &[items as u64, bytes as u64]);
        if grown.status == Status::Ok as fmi2Status { Ok(()) } else { Err(grown) }
    }

    /// Numbers of the lists with these items, which are sent if the host does not have them. Those of posted requests stay.
    fn lists(&mut self, items: [&[u32]; 2]) -> Result<[u64; 2], Answer> {
        let busy = self.lists.iter().filter(|list| list.used > self.calls).count();
        if busy + 2 > LISTS {
            self.flushed()?;
        }
        Ok(items.map(|items| self.list(items)))
    }

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

/// What a request needs before it can be made, or the answer.
macro_rules! some {
    ($result:expr) => {
        match $result {
            Ok(value) => value,
            Err(answer) => return answer,
        }
    };
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
        let list = self.reserve_behind(n, n).and_then(|()| self.lists([references; 2]));
        let [list, _] = some!(list);
        let first = self.filled;
        let answer = self.call(Op::GetReal, &[list, n as u64, 0, 0, 0, first as u64]);
        self.payload.read(first, values);
        answer
    }
    fn set_real(&mut self, references: &[u32], values: &[f64]) -> Answer {
        let n = references.len();
        let list = self.reserve_behind(n, n).and_then(|()| self.lists([references; 2]));
        let [list, _] = some!(list);
        self.payload.write(self.filled, values);
        self.post(Op::SetReal, &[list, n as u64, 0, 0, 0, self.filled as u64], n)
    }
    fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Answer {
        let n = references.len();
        let lists = self.reserve_behind(n, n).and_then(|()| self.lists([references, to_list(orders)]));
        let [list, orders] = some!(lists);
        self.payload.write(self.filled, values);
        self.post(Op::SetInputDerivatives, &[list, n as u64, orders, 0, 0, self.filled as u64], n)
    }
    fn directional_derivative(&mut self, unknown: &[u32], known: &[u32], seed: &[f64], out: &mut [f64]) -> Answer {
        let (n, m) = (unknown.len(), known.len());
        let lists = self.reserve(n.max(m), 8 * (n + m)).and_then(|()| self.lists([unknown, known]));
        let [unknown, known] = some!(lists);
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
        some!(self.reserve(0, value.len()));
        self.payload.write_bytes(0, value.as_bytes());
        self.one(Op::SetString, reference, value.len() as u64)
    }

    fn get_state(&mut self, handle: &mut Handle) -> Answer {
        let answer = self.call(Op::GetState, &[*handle as u64]);
        if self.blamed.is_none() && self.death.is_none() {
            *handle = self.result() as Handle;
        }
        answer
    }
    fn set_state(&mut self, handle: Handle) -> Answer {
        self.post(Op::SetState, &[handle as u64], 0)
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
        some!(self.reserve(0, bytes.len()));
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

    fn blame(&mut self) -> Option<&'static str> {
        self.blamed.take()
    }

    fn death(&self) -> Option<&str> {
        self.death.as_deref()
    }

    fn report(&self, what: &str) {
        (self.isolation.listener)(&self.name, what);
    }
}
