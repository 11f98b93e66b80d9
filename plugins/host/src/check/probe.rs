//! What a child is told to check, and how it answers: by serving if the promise holds, by refusing to if not.

use std::fs::File;
use std::io::{self, Read, Seek, Write};
use std::os::fd::OwnedFd;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rustix::fs::{MemfdFlags, memfd_create};
use taceva_core::ErrorKind;

use super::checks;
use super::subject::{Ending, Subject};
use crate::child::wire::{Wire, decode, fields};
use crate::in_process::InProcess;
use crate::library::Image;
use crate::manifest::Manifest;

/// How the answer of a check begins that could not be made.
pub(super) const SKIPPED: &str = "skipped: ";

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

/// Makes the check that `file` asks for on the plugin of `image`, in this process; a session that is still whole is the sign that it held.
///
/// # Errors
/// Why the promise does not hold, in the words of the check.
pub(crate) fn run(
    mut file: File,
    image: &Image,
    manifest: &Manifest,
) -> Result<InProcess, (ErrorKind, String)> {
    let mut bytes = Vec::new();
    let read = file.rewind().and_then(|()| file.read_to_end(&mut bytes));
    read.map_err(|error| (ErrorKind::Internal, error.to_string()))?;
    let probe: Probe = decode(&bytes).map_err(|error| (ErrorKind::Abi, error.to_string()))?;
    let check = checks().find(|check| check.name == probe.check);
    let check = check.ok_or_else(|| (ErrorKind::Abi, format!("no check `{}`", probe.check)))?;
    let made = catch_unwind(AssertUnwindSafe(|| {
        let subject = Subject::new(image, manifest, probe)?;
        (check.run)(&subject)?;
        Ok(subject.session)
    }));
    match made {
        Ok(Ok(session)) => Ok(session),
        Ok(Err(Ending::Broken(why))) => Err((ErrorKind::DeviceFault, why)),
        Ok(Err(Ending::Skipped(why))) => Err((ErrorKind::Unsupported, format!("{SKIPPED}{why}"))),
        Err(_) => Err((ErrorKind::Internal, "the check itself panicked".to_owned())),
    }
}
