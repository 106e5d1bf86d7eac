//! The engine in a Web Worker: three functions over the worker's memory, no other glue.
//!
//! ```text
//! reserve(n) ─► address     n bytes for the verb, a line feed and the request; the page writes them there
//! call() ─► n               computes; the answer has n bytes
//! answer() ─► address       of the answer
//! ```

use std::sync::atomic::AtomicBool;
use std::sync::{LazyLock, Mutex, PoisonError};

use crate::engine::Engine;
use crate::room::Room;

/// What lies in memory between two calls; a worker has one engine and makes one call at a time.
struct Desk {
    engine: Engine,
    request: Vec<u8>,
    answer: Vec<u8>,
}

static DESK: LazyLock<Mutex<Desk>> = LazyLock::new(|| {
    let engine = Engine::new("".into(), Room::PAGE, 1);
    Mutex::new(Desk { engine, request: Vec::new(), answer: Vec::new() })
});

fn desk<T>(with: impl FnOnce(&mut Desk) -> T) -> T {
    with(&mut DESK.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Room for a request.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn reserve(bytes: usize) -> usize {
    desk(|desk| {
        desk.request.clear();
        desk.request.resize(bytes, 0);
        desk.request.as_mut_ptr() as usize
    })
}

/// Computes the answer to the request that was written.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn call() -> usize {
    desk(|desk| {
        let at = desk.request.iter().position(|byte| *byte == b'\n').unwrap_or(desk.request.len());
        let (verb, body) = (String::from_utf8_lossy(&desk.request[..at]), desk.request.get(at + 1..).unwrap_or(&[]));
        desk.answer = desk.engine.call(&verb, body, &AtomicBool::new(false));
        desk.answer.len()
    })
}

/// Where the answer lies.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    desk(|desk| desk.answer.as_ptr() as usize)
}
