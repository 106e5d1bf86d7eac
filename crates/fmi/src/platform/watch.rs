//! Noticing that another process is gone.

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::{Errno, fcntl_dupfd_cloexec};
use rustix::process::{Pid, PidfdFlags, Signal, getppid, pidfd_open};
use std::fs::File;
use std::io;
use std::os::fd::{AsFd, OwnedFd};

/// A copy of standard input, which is replaced by an empty one for those who come later.
pub fn take_stdin() -> io::Result<OwnedFd> {
    let taken = fcntl_dupfd_cloexec(io::stdin(), 3)?;
    rustix::stdio::dup2_stdin(File::open("/dev/null")?)?;
    Ok(taken)
}

/// A copy of standard error, for [`reader_is_gone`].
pub fn copy_of_stderr() -> io::Result<OwnedFd> {
    Ok(fcntl_dupfd_cloexec(io::stderr(), 3)?)
}

/// Sleeps until nobody reads from the other end of a pipe any more.
pub fn reader_is_gone(output: &OwnedFd) {
    loop {
        let mut fds = [PollFd::new(output, PollFlags::empty())];
        let polled = poll(&mut fds, None);
        if polled.is_ok() && fds[0].revents().intersects(PollFlags::ERR | PollFlags::HUP) {
            return;
        }
    }
}

/// Ends this process and what it has started, at once.
pub fn end_own_group() {
    let _ = rustix::process::kill_current_process_group(Signal::KILL);
}

/// All that the parent process, whose number is `parent`, writes into standard input until it is gone.
///
/// The end of the input alone would not tell: what the parent has started by `fork` holds the pipe open as well. So the
/// parent itself is watched, where the kernel can (5.3 or newer); the end of the input is the other sign. It may have gone
/// before this process looked: then somebody else has become the parent.
pub fn read_until_parent_is_gone(parent: Option<u32>) -> io::Result<Vec<u8>> {
    let is_parent = |pid: Pid| parent.is_none_or(|parent| pid.as_raw_nonzero().get().unsigned_abs() == parent);
    let watched = getppid().filter(|pid| is_parent(*pid)).and_then(|pid| pidfd_open(pid, PidfdFlags::empty()).ok());
    // Looked at again: the number that was opened may have been given to another process meanwhile.
    let gone_before = !getppid().is_some_and(is_parent);
    let at_once = Timespec { tv_sec: 0, tv_nsec: 0 };
    let mut read = Vec::new();
    let mut piece = [0; 4096];
    loop {
        let (has_input, parent_is_gone) = {
            let stdin = io::stdin();
            let watched = [Some(stdin.as_fd()), watched.as_ref().map(AsFd::as_fd)];
            let mut fds: Vec<_> =
                watched.into_iter().flatten().map(|fd| PollFd::from_borrowed_fd(fd, PollFlags::IN)).collect();
            match poll(&mut fds, gone_before.then_some(&at_once)) {
                Err(Errno::INTR) => continue,
                Err(error) => return Err(error.into()),
                Ok(_) => {
                    let ended = fds.get(1).is_some_and(|fd| !fd.revents().is_empty());
                    (!fds[0].revents().is_empty(), gone_before || ended)
                }
            }
        };
        // What was written before the end still lies in the pipe.
        let n = if has_input { rustix::io::read(io::stdin(), &mut piece)? } else { 0 };
        read.extend_from_slice(&piece[..n]);
        if n == 0 && (has_input || parent_is_gone) {
            return Ok(read);
        }
    }
}
