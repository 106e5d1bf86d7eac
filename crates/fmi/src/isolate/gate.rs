//! Handshake of two processes over two words: first spin, then sleep.
//!
//! A reply that is there within microseconds is met spinning, without a system call on either side. Whoever has spun for
//! [`SPIN`] in vain says so (`parked`) and sleeps; only then does the other need a system call to wake it. On few
//! cores the spinning takes time from the very process that is waited for, hence the short limit; while it helps in
//! less than half of the cases it is tried only every [`RARELY`]th time, and with one core never.

use super::control::{Control, Side};
use crate::platform::word::Bells;
use std::sync::atomic::Ordering::{Acquire, Relaxed, SeqCst};
use std::time::{Duration, Instant};

/// Longest spinning.
const SPIN: Duration = Duration::from_micros(20);
/// Looks at the word between two looks at the clock.
const LOOKS: usize = 32;
/// How seldom hopeless spinning is tried.
const RARELY: u32 = 16;

/// One process's end.
pub struct Gate {
    control: Control,
    bells: Bells,
    is_master: bool,
    may_spin: bool,
    waits: u32,
    /// Share of waits that spinning has ended, a running mean over about 16 of them.
    luck: f32,
}

impl Gate {
    /// The end of the master or the host.
    pub fn new(control: Control, bells: Bells, is_master: bool) -> Self {
        let may_spin = std::thread::available_parallelism().is_ok_and(|cores| cores.get() > 1);
        Self { control, bells, is_master, may_spin, waits: 0, luck: 1.0 }
    }

    /// What this process writes.
    pub fn mine(&self) -> &Side {
        let header = self.control.header();
        if self.is_master { &header.request } else { &header.reply }
    }

    /// What the other process writes.
    pub fn theirs(&self) -> &Side {
        let header = self.control.header();
        if self.is_master { &header.reply } else { &header.request }
    }

    /// Publishes message `n`, all of it written before, and wakes the other if it sleeps.
    pub fn signal(&self, n: u32) {
        self.mine().word.store(n, SeqCst);
        if self.theirs().parked.load(SeqCst) != 0 {
            self.bells.wake(self.is_master, &self.mine().word);
        }
    }

    /// Waits for message `n`, asleep no longer than `limit`; whether it has come.
    pub fn wait(&mut self, n: u32, limit: Option<Duration>) -> bool {
        self.spin(n) || self.sleep(n, limit)
    }

    /// Waits for message `n` without spinning.
    pub fn sleep(&self, n: u32, limit: Option<Duration>) -> bool {
        let (mine, theirs) = (self.mine(), self.theirs());
        mine.parked.store(1, SeqCst);
        // Either the other sees `parked`, or this sees its word: both are sequentially consistent.
        let seen = theirs.word.load(SeqCst);
        if seen != n {
            self.bells.wait(!self.is_master, &theirs.word, seen, limit);
        }
        mine.parked.store(0, Relaxed);
        self.has_come(n)
    }

    fn has_come(&self, n: u32) -> bool {
        self.theirs().word.load(Acquire) == n
    }

    fn spin(&mut self, n: u32) -> bool {
        if self.has_come(n) {
            self.luck += (1.0 - self.luck) / 16.0;
            return true;
        }
        self.waits = self.waits.wrapping_add(1);
        if !self.may_spin || self.luck < 0.5 && !self.waits.is_multiple_of(RARELY) {
            return false;
        }
        let (mut come, begin) = (false, Instant::now());
        while !come && begin.elapsed() < SPIN {
            for _ in 0..LOOKS {
                std::hint::spin_loop();
                come = self.has_come(n);
                if come {
                    break;
                }
            }
        }
        self.luck += (f32::from(u8::from(come)) - self.luck) / 16.0;
        come
    }
}
