//! The master's end of an isolated instance: requests that are made or posted, replies that are waited for.

use super::call::Op;
use super::control::{CONTROL, Control, POSTED, PROGRESS, progress};
use super::gate::Gate;
use super::payload::{FIRST_DATA, LISTS, Payload};
use super::process::Process;
use super::settings::Isolation;
use crate::platform::memory::Shared;
use crate::slave::{Answer, Call};
use crate::status::Status;
use std::io;
use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};

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
pub enum Fresh {
    /// Nothing of use.
    Nothing,
    /// A step, whose outputs nobody has read.
    Step,
    /// The outputs of [`Exchange::habit`], from an item of the data on.
    Outputs(usize),
}

/// An isolated instance.
pub struct Exchange {
    pub name: String,
    pub isolation: Isolation,
    memory: Shared,
    pub control: Control,
    gate: Gate,
    pub payload: Payload,
    lists: [List; LISTS],
    calls: u64,
    /// Requests that go with the next one, and the numbers they occupy in the data.
    pub posted: [Option<Op>; POSTED],
    pub filled: usize,
    /// Outputs that were read right after a step: the next one brings them along.
    pub habit: Vec<u32>,
    pub fresh: Fresh,
    owed_time: Duration,
    owed_warnings: u32,
    pub functions: u64,
    pub collected: u64,
    /// How the process came to its end.
    pub end: Option<String>,
    /// The posted request that failed.
    pub failed_posted: Option<Call>,
    pub process: Process,
}

/// What a call answers when nobody is there.
pub const GONE: Answer = Answer { status: Status::Fatal as i32, time: Duration::ZERO, warnings: 0 };
/// What a posted request answers.
pub const POSTPONED: Answer = Answer { status: Status::Ok as i32, time: Duration::ZERO, warnings: 0 };

impl Exchange {
    /// Starts the process.
    pub fn begin(name: &str, isolation: Isolation) -> io::Result<Self> {
        let memory = Shared::create(CONTROL + Payload::length(0, FIRST_DATA))?;
        let control = Control::new(&memory)?;
        control.sign();
        let payload = Payload::new(&memory, CONTROL, 0, FIRST_DATA)?;
        let (process, bells) = (Process::start(&isolation, name, &memory)?, memory.bells());
        Ok(Self {
            name: name.to_string(),
            isolation,
            memory,
            gate: Gate::new(control.clone(), bells, true),
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
            end: None,
            failed_posted: None,
            process,
        })
    }

    /// Makes a request and waits for the reply, the end of the process, or the end of patience.
    pub fn call(&mut self, op: Op, numbers: &[u64]) -> Answer {
        if self.end.is_some() {
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
        mine.code.store(op.code(), Relaxed);
        mine.numbers.iter().zip(numbers).for_each(|(place, number)| place.store(*number, Relaxed));
        self.gate.signal(n);
        let come = self.gate.wait(n, Some(LOOKS[0])) || self.wait_long(n);
        let theirs = self.gate.theirs();
        let (status, warnings) = (theirs.code.load(Relaxed) as i32, theirs.posted.load(Relaxed));
        if count > 0 && (!come || status > Status::Warning as i32) {
            let reached = theirs.numbers[PROGRESS].load(Relaxed);
            let at = (0..count).find(|i| progress(n, *i) == reached);
            self.failed_posted = at.and_then(|i| posted[i]).and_then(Op::posted_call);
        }
        if !come && theirs.numbers[PROGRESS].load(Relaxed) == progress(n, count + 1) {
            self.failed_posted = Some(Call::GetReal);
        }
        if !come {
            return GONE;
        }
        let time = Duration::from_nanos(theirs.numbers[0].load(Relaxed)) + std::mem::take(&mut self.owed_time);
        Answer { status, time, warnings: warnings + std::mem::take(&mut self.owed_warnings) }
    }

    /// Leaves a request for the next one to take along: it saves the way there and back. `values` lie in the data from
    /// [`Exchange::filled`] on.
    pub fn post(&mut self, op: Op, numbers: &[u64], values: usize) -> Answer {
        if self.end.is_some() {
            return GONE;
        }
        let Some(i) = self.posted.iter().position(Option::is_none) else {
            return self.call(op, numbers);
        };
        self.posted[i] = Some(op);
        self.fresh = Fresh::Nothing;
        let place = &self.control.header().posted[i];
        place.code.store(op.code(), Relaxed);
        place.numbers.iter().zip(numbers).for_each(|(place, number)| place.store(*number, Relaxed));
        self.filled += values;
        POSTPONED
    }

    /// Makes the posted requests now; what they cost is counted with the next call.
    fn flushed(&mut self) -> Result<(), Answer> {
        if self.posted[0].is_none() {
            return if self.end.is_some() { Err(GONE) } else { Ok(()) };
        }
        let answer = self.call(Op::Flush, &[]);
        if answer.status > Status::Warning as i32 {
            return Err(answer);
        }
        (self.owed_time, self.owed_warnings) = (answer.time, answer.warnings);
        Ok(())
    }

    /// Whether the reply has come; if not, the process has ended.
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
                self.end = Some(self.process.how_it_ended());
                return false;
            }
            if late {
                self.process.finish();
                self.end = Some(format!("gave no answer within {} s and was killed", timeout.as_secs_f64()));
                return false;
            }
            pause = (2 * pause).min(LOOKS[1]).min(timeout.saturating_sub(begin.elapsed()));
        }
    }

    /// A request with texts, their lengths and one more number.
    pub fn send(&mut self, op: Op, texts: &[&[u8]; 2], number: u64) -> Answer {
        if let Err(failed) = self.reserve(0, texts[0].len() + texts[1].len()) {
            return failed;
        }
        self.payload.write_bytes(0, texts[0]);
        self.payload.write_bytes(texts[0].len(), texts[1]);
        self.call(op, &[texts[0].len() as u64, texts[1].len() as u64, number])
    }

    /// The reply's result.
    pub fn result(&self) -> u64 {
        self.gate.theirs().numbers[1].load(Relaxed)
    }

    /// The bytes whose length is the reply's result.
    pub fn fetch(&mut self) -> Vec<u8> {
        let length = self.result();
        if length > LARGEST || self.reserve(0, length as usize).is_err() {
            return Vec::new();
        }
        let fetched = self.call(Op::Fetch, &[]);
        if fetched.status == 0 { self.payload.read_bytes(0, length as usize) } else { Vec::new() }
    }

    /// Makes room, behind the values of posted requests or without them; fails as they do, or if there is none.
    pub fn reserve_behind(&mut self, items: usize, values: usize) -> Result<(), Answer> {
        let (has_items, has_bytes) = self.payload.room();
        let fits = items <= has_items && 8 * (self.filled + values) <= has_bytes;
        if fits && self.end.is_none() { Ok(()) } else { self.reserve(items, 8 * values) }
    }

    /// Makes room for bytes and makes the posted requests; fails as they do, or if there is none: the FMU is then given up.
    pub fn reserve(&mut self, items: usize, bytes: usize) -> Result<(), Answer> {
        self.flushed()?;
        let (has_items, has_bytes) = self.payload.room();
        if items <= has_items && bytes <= has_bytes {
            return Ok(());
        }
        let more = |wanted: usize, has: usize| if wanted > has { wanted.next_power_of_two().max(2) } else { has };
        let (items, bytes) = (more(items, has_items), more(bytes, has_bytes));
        self.lists.iter_mut().for_each(|list| list.items.clear());
        let grown = self.memory.grow(CONTROL + Payload::length(items, bytes));
        match grown.and_then(|()| Payload::new(&self.memory, CONTROL, items, bytes)) {
            Ok(payload) => self.payload = payload,
            Err(error) => {
                self.process.finish();
                self.end = Some(format!("was given up: no shared memory for its values: {error}"));
                return Err(GONE);
            }
        }
        let grown = self.call(Op::Grow, &[items as u64, bytes as u64]);
        if grown.status == Status::Ok as i32 { Ok(()) } else { Err(grown) }
    }

    /// Numbers of the lists with these items, which are sent if the host does not have them. Those of posted requests stay.
    pub fn lists(&mut self, items: [&[u32]; 2]) -> Result<[u64; 2], Answer> {
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
    pub fn one(&mut self, op: Op, reference: u32, value: u64) -> Answer {
        self.call(op, &[u64::from(reference), value])
    }
}
