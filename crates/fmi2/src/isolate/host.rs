//! The FMU's end: a loop that takes requests from shared memory and makes the calls.

use super::call::Op;
use super::control::{CONTROL, Control, POSTED, PROGRESS, Ring, progress};
use super::gate::Gate;
use super::memory::{Payload, from_list, is_ours};
use crate::import::fmu::{Folder, Loaded};
use crate::import::library::Functions;
use crate::import::local::Local;
use crate::import::slave::{Answer, Slave};
use crate::types::Status;
use rustix::event::{PollFd, PollFlags, poll};
use rustix::io::fcntl_dupfd_cloexec;
use std::fs::File;
use std::os::fd::OwnedFd;
use std::path::PathBuf;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Status of a reply beside those of FMI 2.0: the request made no sense.
const NO_SENSE: u32 = 99;

/// Serves one FMU until the master is done with it. The program that [`super::Isolation`] names calls this at its very
/// beginning, before it reads or prints anything.
///
/// # Errors
/// The program was not started as a host.
pub fn host() -> Result<(), String> {
    let no_host = "this command is not for people: `ttb run --isolate` starts it to run an FMU";
    if !is_ours(std::io::stdin()) {
        return Err(no_host.into());
    }
    let fault = |e: std::io::Error| format!("isolated FMU: {e}");
    // The FMU gets an empty standard input.
    let memory = fcntl_dupfd_cloexec(std::io::stdin(), 3).map_err(|e| fault(e.into()))?;
    let null = File::open("/dev/null").map_err(fault)?;
    rustix::stdio::dup2_stdin(&null).map_err(|e| fault(e.into()))?;
    let control = Control::new(&memory).map_err(fault)?;
    if !control.is_signed() {
        return Err(no_host.into());
    }
    let folder = Arc::new(Mutex::new(None));
    end_with_master(Arc::clone(&folder)).map_err(fault)?;
    let payload = Payload::new(&memory, CONTROL, 0, super::remote::FIRST_DATA).map_err(fault)?;
    let gate = Gate::new(control.clone(), false);
    Host { memory, control, gate, payload, folder, loaded: None, slave: None, bytes: Vec::new() }.serve();
    Ok(())
}

/// Ends this process with the master: the last reader of our output is gone then. Removes the FMU's folder, which
/// nobody else will, and takes along what the FMU has started. Works also while the FMU hangs.
fn end_with_master(folder: Arc<Mutex<Option<PathBuf>>>) -> std::io::Result<()> {
    let output = fcntl_dupfd_cloexec(std::io::stderr(), 3)?;
    let watch = move || {
        loop {
            let mut fds = [PollFd::new(&output, PollFlags::empty())];
            let polled = poll(&mut fds, None);
            if polled.is_ok() && fds[0].revents().intersects(PollFlags::ERR | PollFlags::HUP) {
                break;
            }
        }
        let folder = folder.lock().unwrap_or_else(PoisonError::into_inner).take();
        folder.map(std::fs::remove_dir_all);
        let _ = rustix::process::kill_current_process_group(rustix::process::Signal::KILL);
    };
    std::thread::Builder::new().name("watch".into()).spawn(watch)?;
    Ok(())
}

struct Host {
    memory: OwnedFd,
    control: Control,
    gate: Gate,
    payload: Payload,
    folder: Arc<Mutex<Option<PathBuf>>>,
    loaded: Option<Arc<Loaded>>,
    slave: Option<Local>,
    /// A result whose length the master must know first.
    bytes: Vec<u8>,
}

/// Status and time, then the results.
type Reply = (Answer, [u64; 1]);

impl Host {
    fn serve(mut self) {
        let mut n = 0_u32;
        loop {
            n = n.wrapping_add(1);
            while !self.gate.wait(n, None) {}
            let op = self.request(n);
            if op == Some(Op::Quit) {
                // The library is closed before the answer: should that fail, it is seen.
                self.slave = None;
                self.loaded = None;
                self.gate.signal(n);
                return;
            }
            self.gate.signal(n);
        }
    }

    /// Answers request `n`: first what was posted with it, up to the first failure, then itself.
    fn request(&mut self, n: u32) -> Option<Op> {
        let control = self.control.clone();
        let (theirs, mine) = (&control.header().request, &control.header().reply);
        let posted = (theirs.posted.load(Relaxed) as usize).min(POSTED);
        let (mut time, mut warnings) = (Duration::ZERO, 0);
        let mut last = (None, Answer { status: NO_SENSE as i32, time, warnings }, 0);
        for i in 0..=posted {
            mine.numbers[PROGRESS].store(progress(n, i), Relaxed);
            let (code, numbers) = match control.header().posted[..posted].get(i) {
                Some(posted) => (&posted.code, &posted.numbers),
                None => (&theirs.code, &theirs.numbers),
            };
            let op = Op::from_code(code.load(Relaxed));
            let numbers = std::array::from_fn(|i| numbers[i].load(Relaxed));
            let reply = op.and_then(|op| self.answer(op, numbers));
            let (answer, [result]) =
                reply.unwrap_or((Answer { status: NO_SENSE as i32, time: Duration::ZERO, warnings: 0 }, [0]));
            time += answer.time;
            last = (op, answer, result);
            match Status::from_c(answer.status) {
                Status::Ok => {}
                Status::Warning => warnings += u32::from(i < posted),
                _ => break,
            }
        }
        let (op, answer, result) = last;
        mine.code.store(answer.status as u32, Relaxed);
        mine.posted.store(warnings, Relaxed);
        mine.numbers[0].store(time.as_nanos() as u64, Relaxed);
        mine.numbers[1].store(result, Relaxed);
        op
    }

    /// What an operation answers; nothing if it made no sense at this point.
    fn answer(&mut self, op: Op, a: [u64; 6]) -> Option<Reply> {
        let fine = |status: Status| Answer { status: status as i32, time: Duration::ZERO, warnings: 0 };
        let at = |i: usize| a[i] as usize;
        match op {
            Op::Load => return Some(self.load(at(0), at(1))),
            Op::Instantiate => return self.instantiate(at(0), at(1), a[2] != 0),
            Op::Grow => {
                let grown = Payload::new(&self.memory, CONTROL, at(0), at(1));
                let status = if grown.is_ok() { Status::Ok } else { Status::Error };
                grown.into_iter().for_each(|payload| self.payload = payload);
                return Some((fine(status), [0]));
            }
            Op::Fetch => {
                self.payload.write_bytes(0, &self.bytes);
                return Some((fine(Status::Ok), [0]));
            }
            Op::Flush | Op::Quit => return Some((fine(Status::Ok), [0])),
            _ => {}
        }
        let (slave, payload) = (self.slave.as_mut()?, &mut self.payload);
        let mut result = 0;
        let answer = match op {
            Op::SetupExperiment => {
                slave.setup_experiment(f64::from_bits(a[0]), (a[1] != 0).then(|| f64::from_bits(a[2])))
            }
            Op::EnterInitialization => slave.enter_initialization(),
            Op::ExitInitialization => slave.exit_initialization(),
            Op::DoStep => {
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
            Op::Terminate => slave.terminate(),
            Op::Reset => slave.reset(),
            Op::FreeInstance => {
                slave.free_instance();
                self.slave = None;
                fine(Status::Ok)
            }
            Op::GetReal => {
                let ([list, _], values) = payload.in_place([(at(0), at(1)), (0, 0)], at(5), at(1));
                slave.get_real(list, values)
            }
            Op::SetReal => {
                let ([list, _], values) = payload.in_place([(at(0), at(1)), (0, 0)], at(5), at(1));
                slave.set_real(list, values)
            }
            Op::SetInputDerivatives => {
                let ([list, orders], values) = payload.in_place([(at(0), at(1)), (at(2), at(1))], at(5), at(1));
                slave.set_input_derivatives(list, from_list(orders), values)
            }
            Op::DirectionalDerivative => {
                let lists = [(at(0), at(1)), (at(2), at(3))];
                let ([unknown, known], values) = payload.in_place(lists, 0, at(1) + at(3));
                let (seed, out) = values.split_at_mut(at(3));
                slave.directional_derivative(unknown, known, seed, out)
            }
            Op::GetInteger => {
                let mut value = 0;
                let answer = slave.get_integer(a[0] as u32, &mut value);
                result = u64::from(value as u32);
                answer
            }
            Op::GetBoolean => {
                let mut value = false;
                let answer = slave.get_boolean(a[0] as u32, &mut value);
                result = u64::from(value);
                answer
            }
            Op::GetString => {
                let mut text = String::new();
                let answer = slave.get_string(a[0] as u32, &mut text);
                self.bytes = text.into_bytes();
                result = self.bytes.len() as u64;
                answer
            }
            Op::SetInteger => slave.set_integer(a[0] as u32, a[1] as u32 as i32),
            Op::SetBoolean => slave.set_boolean(a[0] as u32, a[1] != 0),
            Op::SetString => slave.set_string(a[0] as u32, &String::from_utf8_lossy(&payload.read_bytes(0, at(1)))),
            Op::GetState | Op::FreeState => {
                let mut handle = at(0);
                let answer =
                    if op == Op::GetState { slave.get_state(&mut handle) } else { slave.free_state(&mut handle) };
                result = handle as u64;
                answer
            }
            Op::SetState => slave.set_state(at(0)),
            Op::Serialize => {
                let answer = slave.serialize(at(0), &mut self.bytes);
                result = self.bytes.len() as u64;
                answer
            }
            Op::Deserialize => {
                let mut handle = at(0);
                let answer = slave.deserialize(&payload.read_bytes(0, at(1)), &mut handle);
                result = handle as u64;
                answer
            }
            Op::Load | Op::Instantiate | Op::Grow | Op::Fetch | Op::Flush | Op::Quit => return None,
        };
        Some((answer, [result]))
    }

    fn load(&mut self, folder: usize, identifier: usize) -> Reply {
        use std::os::unix::ffi::OsStringExt;
        let path = PathBuf::from(std::ffi::OsString::from_vec(self.payload.read_bytes(0, folder)));
        let identifier = String::from_utf8_lossy(&self.payload.read_bytes(folder, identifier)).into_owned();
        *self.folder.lock().unwrap_or_else(PoisonError::into_inner) = Some(path.clone());
        let begin = std::time::Instant::now();
        let (status, result) = match Functions::load(&path, &identifier) {
            Ok(functions) => {
                let set = functions.optional();
                self.loaded = Some(Arc::new(Loaded { functions, folder: Folder::Theirs(path) }));
                (Status::Ok, set)
            }
            Err(error) => {
                self.bytes = error.to_string().into_bytes();
                (Status::Error, self.bytes.len() as u64)
            }
        };
        (Answer { status: status as i32, time: begin.elapsed(), warnings: 0 }, [result])
    }

    fn instantiate(&mut self, name: usize, guid: usize, logging: bool) -> Option<Reply> {
        let text = |offset, length| String::from_utf8_lossy(&self.payload.read_bytes(offset, length)).into_owned();
        let (name, guid) = (text(0, name), text(name, guid));
        let ring = Ring::new(self.control.clone());
        let (slave, time) = Local::new(&name, &guid, Arc::clone(self.loaded.as_ref()?), ring, logging);
        let status = if slave.is_some() { Status::Ok } else { Status::Error } as i32;
        self.slave = slave;
        Some((Answer { status, time, warnings: 0 }, [0]))
    }
}
