//! `ttb ui`: the page of `ttb_web` on this machine alone, computed by this program.
//!
//! ```text
//! http://127.0.0.1:PORT/TOKEN/            the page's files
//!                     /TOKEN/api/VERB     a request of the page: JSON in, JSON out
//! ```
//!
//! `gate` decides who is answered, `jobs` which computations go on, `http` reads requests, `serve` answers; `foreign` has
//! bridges of other programs.

mod foreign;
mod gate;
mod http;
mod jobs;
mod serve;

use std::net::{Ipv4Addr, TcpListener};
use std::path::Path;
use std::process::{Command, Stdio};

use ttb_web::Engine;
use ttb_web::room::Room;

use self::gate::Gate;
use self::serve::Service;
use crate::cli::Ui;
use crate::error::Error;
use crate::signals::Stop;

/// The command.
pub fn ui(arguments: &Ui, stop: &Stop) -> Result<(), Error> {
    let scenario = arguments.scenario.as_deref().map(|path| ttb_scenario::read_text(path).map_err(Error::io(path)));
    let folder = arguments.scenario.as_deref().and_then(Path::parent).unwrap_or(Path::new("")).to_path_buf();
    let listened = TcpListener::bind((Ipv4Addr::LOCALHOST, arguments.port));
    let listened = listened.and_then(|listener| Ok((listener.local_addr()?.port(), listener)));
    let (port, listener) = listened.map_err(|error| Error::Input(format!("--port {}: {error}", arguments.port)))?;
    let gate = Gate::new(port);
    let address = gate.address();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut engine = Engine::new(folder, Room::PROGRAM, threads);
    engine.masters = Some(foreign::masters());
    let service = Service::new(gate, engine, scenario.transpose()?);
    stop.gently();
    say!("{address}");
    note!("ttb: open this address in a browser on this machine; Ctrl-C ends the program");
    if arguments.open {
        open(&address);
    }
    service.serve(&listener, stop).map_err(Error::io(Path::new("the page's connection")))
}

/// Asks the desktop for its browser; without one the address that was printed is enough.
fn open(address: &str) {
    let program = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let mut command = Command::new(program);
    command.arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    if let Err(error) = command.spawn() {
        note!("ttb: warning: {program} could not be started ({error}): open the address yourself");
    }
}
