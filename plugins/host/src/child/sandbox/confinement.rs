//! What a child confines itself to.

use std::path::PathBuf;

use super::Need;
use crate::child::wire::{Malformed, Reader, Wire, fields};

/// What a child must confine itself to before it loads anything.
///
/// Whatever stands here, it gets no other file than the libraries of the system, no socket that it does not need, no program to start, no
/// other process to see, and no memory that is writable and executable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Confinement {
    /// How much memory it may address, in bytes.
    pub memory: u64,
    /// How many files it may hold open.
    pub files: u64,
    /// What it reaches outside, as its manifest declares and its user allows.
    pub needs: Vec<Need>,
    /// Files and folders of its own that it reads: the environment of an interpreter.
    pub readable: Vec<PathBuf>,
    /// Whether no more code comes into it once it is loaded.
    pub seals: bool,
    /// Whether a kernel that enforces only a part will do; without, the child refuses to start.
    pub accepts_less: bool,
    /// Whether nothing is kept from it: its user trusts it, and it is apart only so that it can end alone.
    pub is_trusted: bool,
}

impl Default for Confinement {
    /// 4 GiB of addresses, 256 files, nothing outside, and nothing less.
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
