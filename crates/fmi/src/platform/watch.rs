//! Noticing that another process is gone.

use rustix::event::{PollFd, PollFlags, poll};
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

/// All that the parent process writes into standard input until it is gone.
///
/// The end of the input alone would not tell: what the parent has started by `fork` holds the pipe open as well. So the
/// parent itself is watched, where the kernel can (5.3 or newer); the end of the input is the other sign.
pub fn read_until_parent_is_gone() -> io::Result<Vec<u8>> {
    let parent = getppid().and_then(|pid: Pid| pidfd_open(pid, PidfdFlags::empty()).ok());
    let mut read = Vec::new();
    let mut piece = [0; 4096];
    loop {
        let (has_input, parent_is_gone) = {
            let stdin = io::stdin();
            let watched = [Some(stdin.as_fd()), parent.as_ref().map(AsFd::as_fd)];
            let mut fds: Vec<_> =
                watched.into_iter().flatten().map(|fd| PollFd::from_borrowed_fd(fd, PollFlags::IN)).collect();
            match poll(&mut fds, None) {
                Err(Errno::INTR) => continue,
                Err(error) => return Err(error.into()),
                Ok(_) => (!fds[0].revents().is_empty(), fds.get(1).is_some_and(|fd| !fd.revents().is_empty())),
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
