//! Starts an isolated instance: its process, the library there, the instance.

use super::call::Op;
use super::exchange::Exchange;
use super::settings::{Instantiation, Isolation};
use crate::error::FmuError;
use crate::library::LibraryError;
use crate::log::Sink;
use crate::platform::bytes;
use crate::slave::{Call, Slave};
use crate::status::Status;
use crate::version::Version;
use std::time::Duration;

/// The instance, and the time it took inside the FMU.
///
/// # Errors
/// The process cannot be started or ends, the library cannot be loaded, the FMU gives no instance.
pub(crate) fn start(
    wanted: &Instantiation,
    version: &'static Version,
    isolation: &Isolation,
    sink: &Sink,
) -> Result<(Box<dyn Slave>, Duration), FmuError> {
    let instance = || wanted.name.to_string();
    let begun = Exchange::begin(wanted.name, isolation.clone());
    let mut remote = begun.map_err(|e| FmuError::Impossible {
        instance: instance(),
        what: format!("its process cannot be started ({}): {e}", isolation.program.display()),
    })?;
    let gone = |remote: &Exchange, call: &str| {
        let how = remote.ended()?;
        Some(FmuError::Gone { instance: instance(), call: call.into(), how, messages: sink.take() })
    };
    let identifier = &wanted.description.co_simulation.model_identifier;
    let loaded = remote.send(Op::Load, &[bytes(wanted.folder), identifier.as_bytes()], 0);
    remote.collect(sink);
    if loaded.status != Status::Ok as i32 {
        return Err(gone(&remote, "loading its library").unwrap_or_else(|| {
            let text = String::from_utf8_lossy(&remote.fetch()).into_owned();
            FmuError::Library { fmu: wanted.fmu.to_path_buf(), source: LibraryError::Isolated(text) }
        }));
    }
    remote.functions = remote.result();
    let texts = [wanted.name.as_bytes(), wanted.description.guid.as_bytes()];
    let made = remote.send(Op::Call(Call::Instantiate), &texts, u64::from(wanted.logging));
    remote.collect(sink);
    if made.status != Status::Ok as i32 {
        let call = (version.symbol)(Call::Instantiate);
        let none = || FmuError::NoInstance { instance: instance(), call, messages: sink.take() };
        return Err(gone(&remote, call).unwrap_or_else(none));
    }
    Ok((Box::new(remote), loaded.time + made.time))
}
