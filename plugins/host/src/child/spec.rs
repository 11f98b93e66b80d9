//! Specification of a child to start.

use std::ffi::OsString;
use std::fmt;
use std::os::fd::OwnedFd;
use std::path::PathBuf;

use super::exit_status::Fate;
use super::quarantine::Quarantine;
use super::sandbox::Confinement;
use super::timeouts::Patience;
use super::usage::Usage;
use crate::library::Log;
use crate::manifest::Sha256Digest;

/// Callback that receives the reason for the end of a child, and its run and processor times.
pub(super) type Ended = Box<dyn FnOnce(&Fate, Usage) + Send>;

/// Specification of a child to start.
pub struct ChildSpec {
    /// Name of the plugin, for messages.
    pub plugin: String,
    /// Program whose `main` begins with [`main_if_child`](crate::main_if_child); `None` for this program.
    pub program: Option<PathBuf>,
    /// Arguments before the host-child argument, such as the file that an interpreter runs.
    pub arguments: Vec<OsString>,
    /// Files passed to the child, at most three. The program of the child defines the meaning of each file.
    pub files: Vec<OwnedFd>,
    /// Limits that the child imposes on itself.
    pub confinement: Confinement,
    /// Timeouts of the child.
    pub patience: Patience,
    /// Callback that the keeper thread calls once, with the reason for the end of the child.
    pub ended: Option<Ended>,
    /// True if the child loads a plugin. Otherwise the child only reports its isolation.
    pub loads: bool,
    /// Callback for log lines of the plugin, on a separate thread. Without a callback, errors and warnings are part of the child's printed output.
    pub log: Option<Log>,
    /// Quarantine, and the library's digest. A quarantined library does not start. A library that crashes is added.
    pub quarantine: Option<(Quarantine, Sha256Digest)>,
}

impl ChildSpec {
    /// Specifies a child of this program that receives `files`, with default confinement and timeouts.
    pub fn new(plugin: impl Into<String>, files: Vec<OwnedFd>) -> ChildSpec {
        ChildSpec {
            plugin: plugin.into(),
            program: None,
            arguments: Vec::new(),
            files,
            confinement: Confinement::default(),
            patience: Patience::default(),
            ended: None,
            loads: true,
            log: None,
            quarantine: None,
        }
    }
}

impl fmt::Debug for ChildSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ChildSpec")
            .field("plugin", &self.plugin)
            .field("program", &self.program)
            .field("confinement", &self.confinement)
            .finish_non_exhaustive()
    }
}
