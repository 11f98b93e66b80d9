//! State of this process that a plugin must leave unchanged.

#![expect(unsafe_code, reason = "signal handlers are read through libc")]

use std::ffi::{CString, OsString};

/// Working directory, environment and signal handlers of this process.
pub(super) struct Surroundings {
    pub(super) folder: Option<CString>,
    pub(super) variables: Vec<(OsString, OsString)>,
    pub(super) handlers: Vec<usize>,
}

impl Surroundings {
    /// Reads the present state of this process.
    pub(super) fn now() -> Surroundings {
        let handler = |signal| {
            // SAFETY: zero bytes are a valid value of this C struct.
            let mut action: libc::sigaction = unsafe { std::mem::zeroed() };
            // SAFETY: no handler is set; the present action is written into `action`.
            let asked = unsafe { libc::sigaction(signal, std::ptr::null(), &raw mut action) };
            if asked == 0 { action.sa_sigaction } else { 0 }
        };
        Surroundings {
            folder: rustix::process::getcwd(Vec::new()).ok(),
            variables: std::env::vars_os().collect(),
            handlers: (1..32).map(handler).collect(),
        }
    }
}
