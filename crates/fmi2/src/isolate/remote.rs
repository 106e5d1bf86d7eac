//! The master's end of an isolated instance: starts its process and makes requests; [`super::verbs`] says which.

use super::Isolation;
use super::call::Op;
use super::control::{CONTROL, Control, POSTED, PROGRESS, progress};
use super::gate::Gate;
use super::memory::{LISTS, Payload, create, grow};
use super::process::Process;
use crate::import::ModelDescription;
use crate::import::error::FmuError;
use crate::import::library::LibraryError;
use crate::import::messages::Sink;
use crate::import::slave::{Answer, Slave};
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

/// What the last call has left behind.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Fresh {
    /// Nothing of use.
    Nothing,
    /// A step, whose outputs nobody has read.
    Step,
    /// The outputs of [`Remote::habit`], from an item of the data on.
    Outputs(usize),
}

/// An isolated instance.
pub(crate) struct Remote {
    pub(super) name: String,
    pub(super) isolation: Isolation,
    memory: OwnedFd,
    pub(super) control: Control,
    gate: Gate,
    pub(super) payload: Payload,
    lists: [List; LISTS],
    calls: u64,
    /// Requests that go with the next one, and the numbers they occupy in the data.
    pub(super) posted: [Option<Op>; POSTED],
    pub(super) filled: usize,
    /// Outputs that were read right after a step: the next one brings them along.
    pub(super) habit: Vec<u32>,
    pub(super) fresh: Fresh,
    owed_time: Duration,
    owed_warnings: u32,
    pub(super) functions: u64,
    pub(super) collected: u64,
    pub(super) death: Option<String>,
    /// The posted request that failed.
    pub(super) blamed: Option<&'static str>,
    pub(super) process: Process,
    /// Last: the folder goes after the process.
    _folder: Arc<TempDir>,
}

/// What a call answers when nobody is there.
pub(super) const GONE: Answer = Answer { status: Status::Fatal as fmi2Status, time: Duration::ZERO, warnings: 0 };
/// What a posted request answers.
pub(super) const POSTPONED: Answer = Answer { status: Status::Ok as fmi2Status, time: Duration::ZERO, warnings: 0 };

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
            habit: Vec::new(),
            fresh: Fresh::Nothing,
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
    pub(super) fn call(&mut self, op: Op, numbers: &[u64]) -> Answer {
        if self.death.is_some() {
            return GONE;
        }
        self.calls += 1;
        let n = self.calls as u32;
        let posted = std::mem::take(&mut self.posted);
        self.fresh = Fresh::Nothing;
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
        if !come && theirs.numbers[PROGRESS].load(Relaxed) == progress(n, count + 1) {
            self.blamed = Some("fmi2GetReal");
        }
        if !come {
            return GONE;
        }
        let time = Duration::from_nanos(theirs.numbers[0].load(Relaxed)) + std::mem::take(&mut self.owed_time);
        Answer { status, time, warnings: warnings + std::mem::take(&mut self.owed_warnings) }
    }

    /// Leaves a request for the next one to take along: it saves the way there and back. `values` lie in the data from
    /// [`Remote::filled`] on.
    pub(super) fn post(&mut self, op: Op, numbers: &[u64], values: usize) -> Answer {
        if self.death.is_some() {
            return GONE;
        }
        let Some(i) = self.posted.iter().position(Option::is_none) else {
            return self.call(op, numbers);
        };
        self.posted[i] = Some(op);
        self.fresh = Fresh::Nothing;
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
    pub(super) fn result(&self) -> u64 {
        self.gate.theirs().numbers[1].load(Relaxed)
    }

    /// The bytes whose length is the reply's result.
    pub(super) fn fetch(&mut self) -> Vec<u8> {
        let length = self.result();
        if length > LARGEST || self.reserve(0, length as usize).is_err() {
            return Vec::new();
        }
        let fetched = self.call(Op::Fetch, &[]);
        if fetched.status == 0 { self.payload.read_bytes(0, length as usize) } else { Vec::new() }
    }

    /// Makes room, behind the values of posted requests or without them; fails as they do, or if there is none.
    pub(super) fn reserve_behind(&mut self, items: usize, values: usize) -> Result<(), Answer> {
        let (has_items, has_bytes) = self.payload.room();
        let fits = items <= has_items && 8 * (self.filled + values) <= has_bytes;
        if fits && self.death.is_none() { Ok(()) } else { self.reserve(items, 8 * values) }
    }

    /// Makes room for bytes and makes the posted requests; fails as they do, or if there is none: the FMU is then given up.
    pub(super) fn reserve(&mut self, items: usize, bytes: usize) -> Result<(), Answer> {
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
    pub(super) fn lists(&mut self, items: [&[u32]; 2]) -> Result<[u64; 2], Answer> {
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
    pub(super) fn one(&mut self, op: Op, reference: u32, value: u64) -> Answer {
        self.call(op, &[u64::from(reference), value])
    }
}
