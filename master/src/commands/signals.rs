//! Ends that come from outside: Ctrl-C.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use ttb_fmi::leave;

/// Set by Ctrl-C; the run then ends after the step it is in. A second Ctrl-C ends the program at once.
pub fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    // Without a handler Ctrl-C ends the program at once: no reason not to run.
    if let Err(error) = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            leave(130);
        }
    }) {
        eprintln!("ttb: warning: Ctrl-C will not keep results: {error}");
    }
    stop
}
