//! What a child is asked to check.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::OwnedFd;

use rustix::fs::{MemfdFlags, memfd_create};

use crate::child::wire::{Wire, fields};

/// One check on one driver.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Probe {
    pub(crate) check: String,
    /// The key of the driver or estimator; empty for the plugin as a whole.
    pub(crate) driver: String,
    pub(crate) arguments: String,
    pub(crate) seed: u64,
    pub(crate) moves: bool,
}

fields!(Probe {
    check,
    driver,
    arguments,
    seed,
    moves
});

impl Probe {
    /// The probe as a file that a child is given.
    pub(super) fn sealed(&self) -> io::Result<OwnedFd> {
        let mut file = File::from(memfd_create(c"taceva-probe", MemfdFlags::CLOEXEC)?);
        let mut bytes = Vec::new();
        self.write(&mut bytes);
        file.write_all(&bytes)?;
        Ok(file.into())
    }
}
