//! Noticing that another process is gone.

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use rustix::process::{Pid, PidfdFlags, getpid, getppid, pidfd_open, set_child_subreaper};
use std::io;
use std::os::fd::AsFd;
use std::time::Duration;

/// Pause between two looks whether the parent is gone, where it cannot be waited for.
const LOOK: Duration = Duration::from_millis(200);
/// The same where it can: foreign code may have closed what tells of it, and opened something else there.
const LOOK_AGAIN: Timespec = Timespec { tv_sec: 1, tv_nsec: 0 };

/// Calls `end`, in a thread of its own, once the parent process is gone; `expected` is its number. This process becomes the
/// parent of all orphans below it.
///
/// # Errors
/// There is no thread to be had.
pub fn end_with_parent(expected: Option<i32>, end: impl Fn() + Send + 'static) -> io::Result<()> {
    let _ = set_child_subreaper(Some(getpid()));
    let parent = expected.and_then(Pid::from_raw).or_else(getppid);
    let watched = parent.and_then(|pid| pidfd_open(pid, PidfdFlags::empty()).ok());
    let watch = move || {
        while getppid() == parent {
            let waited = watched.as_ref().map(|fd| {
                let mut fds = [PollFd::new(fd, PollFlags::IN)];
                poll(&mut fds, Some(&LOOK_AGAIN)).is_ok() && !fds[0].revents().contains(PollFlags::NVAL)
            });
            if waited != Some(true) {
                std::thread::sleep(LOOK);
            }
        }
        end();
    };
    std::thread::Builder::new().name("watch".into()).spawn(watch).map(drop)
}

/// All that the parent process, whose number is `parent`, writes into standard input until it is gone.
///
/// The end of the input alone would not tell: what the parent has started by `fork` holds the pipe open as well. So the
/// parent itself is watched, where the kernel can (5.3 or newer); only where not, the end of the input is the sign, since
/// foreign code in the parent may close what is not its own. The parent may have gone before this process looked: then somebody
/// else has become the parent.
pub fn read_until_parent_is_gone(parent: Option<u32>) -> io::Result<Vec<u8>> {
    let is_parent = |pid: Pid| parent.is_none_or(|parent| pid.as_raw_nonzero().get().unsigned_abs() == parent);
    let watched = getppid().filter(|pid| is_parent(*pid)).and_then(|pid| pidfd_open(pid, PidfdFlags::empty()).ok());
    // Looked at again: the number that was opened may have been given to another process meanwhile.
    let gone_before = !getppid().is_some_and(is_parent);
    let at_once = Timespec { tv_sec: 0, tv_nsec: 0 };
    let (mut read, mut is_closed) = (Vec::new(), false);
    let mut piece = [0; 4096];
    loop {
        let (has_input, parent_is_gone) = {
            let stdin = io::stdin();
            let watched = [(!is_closed).then_some(stdin.as_fd()), watched.as_ref().map(AsFd::as_fd)];
            let mut fds: Vec<_> =
                watched.into_iter().flatten().map(|fd| PollFd::from_borrowed_fd(fd, PollFlags::IN)).collect();
            match poll(&mut fds, gone_before.then_some(&at_once)) {
                Err(Errno::INTR) => continue,
                Err(error) => return Err(error.into()),
                Ok(_) => {
                    let speaks = |fd: Option<&PollFd>| fd.is_some_and(|fd| !fd.revents().is_empty());
                    let ended = speaks(fds.get(usize::from(!is_closed)));
                    (!is_closed && speaks(fds.first()), gone_before || ended)
                }
            }
        };
        // What was written before the end still lies in the pipe.
        let n = if has_input { rustix::io::read(io::stdin(), &mut piece)? } else { 0 };
        read.extend_from_slice(&piece[..n]);
        is_closed |= has_input && n == 0;
        if n == 0 && (parent_is_gone || is_closed && watched.is_none()) {
            return Ok(read);
        }
    }
}
