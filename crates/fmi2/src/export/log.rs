//! Messages to the environment: through its logger, if it has one.

use crate::types::{Status, fmi2CallbackFunctions, fmi2CallbackLogger, fmi2ComponentEnvironment};
use std::ffi::{CStr, CString};
use std::ptr;
use ttb_model_description::about::LOG_CATEGORIES;

/// The way to the environment's logger. Errors and warnings always go there, events only while debug logging is on.
pub struct Log {
    logger: Option<fmi2CallbackLogger>,
    environment: fmi2ComponentEnvironment,
    instance: CString,
    events: bool,
}

impl Log {
    /// Copies what it needs of the environment's callbacks (FMI does not promise that the struct stays).
    pub fn new(callbacks: Option<&fmi2CallbackFunctions>, instance: &CStr, events: bool) -> Self {
        let environment = callbacks.map_or(ptr::null_mut(), |c| c.component_environment);
        Self { logger: callbacks.and_then(|c| c.logger), environment, instance: instance.to_owned(), events }
    }

    /// A reason for an error.
    pub fn error(&self, message: &str) {
        self.send(Status::Error, LOG_CATEGORIES[0].0, message);
    }
    /// Why the model ends the run.
    pub fn end(&self, message: &str) {
        self.send(Status::Discard, LOG_CATEGORIES[0].0, message);
    }
    /// Something odd.
    pub fn warning(&self, message: &str) {
        self.send(Status::Warning, LOG_CATEGORIES[1].0, message);
    }
    /// A milestone.
    pub fn event(&self, message: &str) {
        if self.events {
            self.send(Status::Ok, LOG_CATEGORIES[2].0, message);
        }
    }

    /// Debug logging for the listed categories, for all when none is listed; returns the first unknown category.
    pub fn configure<'a>(&mut self, on: bool, categories: &[&'a str]) -> Option<&'a str> {
        let listed = |name: &str| categories.is_empty() || categories.contains(&name);
        self.events = on && (listed(LOG_CATEGORIES[2].0) || listed("logAll"));
        let known = |name: &&str| *name == "logAll" || LOG_CATEGORIES.iter().any(|(known, _)| name == known);
        categories.iter().copied().find(|name| !known(name))
    }

    fn send(&self, status: Status, category: &str, message: &str) {
        let Some(logger) = self.logger else { return };
        let (category, message) = (c_string(category), c_string(message));
        // SAFETY: the environment's own function, called as FMI 2.0 says; all strings are zero-terminated and outlive the
        // call, and "%s" takes exactly the one argument that follows it, so that a '%' in the message is harmless.
        unsafe {
            logger(
                self.environment,
                self.instance.as_ptr(),
                status as i32,
                category.as_ptr(),
                c"%s".as_ptr(),
                message.as_ptr(),
            );
        }
    }
}

/// Text for C; a zero byte inside, which C would take for the end, becomes a replacement character.
fn c_string(text: &str) -> CString {
    CString::new(text.replace('\0', "\u{fffd}")).unwrap_or_default()
}
