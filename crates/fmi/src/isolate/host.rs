//! The FMU's end: a loop that takes requests from shared memory; [`super::answers`] makes the calls.

use super::answers::{Answers, NO_SENSE};
use super::call::Op;
use super::control::{CONTROL, Control, POSTED, PROGRESS, progress};
use super::gate::Gate;
use super::payload::{FIRST_DATA, Payload};
use crate::platform::memory::Shared;
use crate::platform::process::end_with_starter;
use crate::slave::Answer;
use crate::status::Status;
use crate::version::Version;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Duration;

/// Serves one FMU until the master is done with it. The program that [`super::Isolation`] names calls this at its very
/// beginning, before it reads or prints anything.
///
/// # Errors
/// The program was not started as a host.
pub fn host(version: &'static Version) -> Result<(), String> {
    let no_host = "this command is not for people: `ttb run --isolate` starts it to run an FMU";
    let fault = |e: std::io::Error| format!("isolated FMU: {e}");
    // The FMU gets an empty standard input.
    let Some(memory) = Shared::from_stdin().map_err(fault)? else { return Err(no_host.into()) };
    let control = Control::new(&memory).map_err(fault)?;
    if !control.is_signed() {
        return Err(no_host.into());
    }
    end_with_starter().map_err(fault)?;
    let payload = Payload::new(&memory, CONTROL, 0, FIRST_DATA).map_err(fault)?;
    let gate = Gate::new(control.clone(), memory.bells(), false);
    let answers = Answers::new(version, memory, control.clone(), payload);
    Host { control, gate, answers }.serve();
    Ok(())
}

struct Host {
    control: Control,
    gate: Gate,
    answers: Answers,
}

impl Host {
    fn serve(mut self) {
        let mut n = 0_u32;
        loop {
            n = n.wrapping_add(1);
            while !self.gate.wait(n, None) {}
            let op = self.request(n);
            if op == Some(Op::Quit) {
                // The library is closed before the answer: should that fail, it is seen.
                self.answers.end();
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
        let mut last = (None, Answer { status: NO_SENSE, time, warnings }, 0);
        for i in 0..=posted {
            mine.numbers[PROGRESS].store(progress(n, i), Relaxed);
            let (code, numbers) = match control.header().posted[..posted].get(i) {
                Some(posted) => (&posted.code, &posted.numbers),
                None => (&theirs.code, &theirs.numbers),
            };
            let op = Op::from_code(code.load(Relaxed));
            let numbers = std::array::from_fn(|i| numbers[i].load(Relaxed));
            let reply = op.and_then(|op| self.answers.answer(op, numbers));
            let (answer, result) = reply.unwrap_or((Answer { status: NO_SENSE, time: Duration::ZERO, warnings: 0 }, 0));
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
}
