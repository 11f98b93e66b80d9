//! What a child is started with.

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

/// What is called with how a child ended.
pub(super) type Ended = Box<dyn FnOnce(&Fate, Usage) + Send>;

/// A child to be started.
pub struct ChildSpec {
    /// The name of the plugin, for messages.
    pub plugin: String,
    /// The program whose `main` begins with [`main_if_child`](crate::main_if_child): this one, if none is named.
    pub program: Option<PathBuf>,
    /// What that program is given before the argument of a host child: how an interpreter is told which file to run.
    pub arguments: Vec<OsString>,
    /// What is handed to it, at most three files; it decides what they are.
    pub files: Vec<OwnedFd>,
    /// What it must confine itself to.
    pub confinement: Confinement,
    /// How long it is waited for.
    pub patience: Patience,
    /// Called once with how it ended, from the thread that watches it.
    pub ended: Option<Ended>,
    /// Whether it loads anything; one that does not only shows what is enforced upon it.
    pub loads: bool,
    /// Takes what its plugin logs, from a thread of its own; without, the errors and warnings stand among what the child prints.
    pub log: Option<Log>,
    /// Where its library is kept if it crashes, and where it must not be; and the digest of that library.
    pub quarantine: Option<(Quarantine, Sha256Digest)>,
}

impl ChildSpec {
    /// A child of this program that is given `files`, with the usual confinement and patience.
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
