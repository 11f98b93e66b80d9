//! Limits that a child imposes on itself.

use std::path::PathBuf;

use super::Need;
use crate::child::wire::{Malformed, Reader, Wire, fields};

/// Limits that a child imposes on itself before it loads anything.
///
/// An untrusted child can always read the system libraries. The child has no access to unneeded files or sockets, and cannot start programs or see other
/// processes. No memory is both writable and executable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Confinement {
    /// Limit of address space, bytes.
    pub memory: u64,
    /// Limit of open files.
    pub files: u64,
    /// Outside resources that the manifest declares and the user allows.
    pub needs: Vec<Need>,
    /// Further files and folders that the child may read, such as the environment of an interpreter.
    pub readable: Vec<PathBuf>,
    /// True if the child can map no further code after its plugin is loaded.
    pub seals: bool,
    /// True if the child starts although the kernel enforces only a part of the limits. If false, the child refuses to start.
    pub accepts_less: bool,
    /// True if nothing is restricted, because the user trusts the plugin. The process then only protects the host from crashes.
    pub is_trusted: bool,
}

impl Default for Confinement {
    /// 4 GiB of address space, 256 open files, no outside resource, and full enforcement.
    fn default() -> Confinement {
        Confinement {
            memory: 4 << 30,
            files: 256,
            needs: Vec::new(),
            readable: Vec::new(),
            seals: true,
            accepts_less: false,
            is_trusted: false,
        }
    }
}

fields!(Confinement {
    memory,
    files,
    needs,
    readable,
    seals,
    accepts_less,
    is_trusted
});

impl Wire for Need {
    fn write(&self, into: &mut Vec<u8>) {
        self.to_string().write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Need, Malformed> {
        let text = String::read(from)?;
        text.parse().map_err(|_| from.malformed("a need"))
    }
}
