//! Runs one or several checks in a child process. The child reports readiness if the promises hold, and otherwise an error.

use std::fs::File;
use std::io::{Read, Seek};
use std::sync::Arc;

use taceva_core::{ErrorKind, caught};

use super::probe::{BETWEEN, Probe};
use super::subject::Subject;
use super::{Check, checks};
use crate::promise::Unmet;
use taceva_host::Manifest;
use taceva_host::Session;
use taceva_host::bare::Source;
use taceva_host::bare::pending_call;

/// Prefix of the reason that a child reports for a skipped check.
pub(super) const SKIPPED: &str = "skipped: ";
/// Name of the pending call while a check is outside plugin calls.
pub(super) const WHOLE: &str = "end the check";

/// Runs the checks that `file` lists on the plugin of `source`, in this process. Returns the session with the plugin if the promises hold.
///
/// # Errors
/// Kind and reason of the unmet promise.
pub(crate) fn run(
    mut file: File,
    source: Source,
    manifest: &Manifest,
) -> Result<Arc<dyn Session>, (ErrorKind, String)> {
    let mut bytes = Vec::new();
    let read = file.rewind().and_then(|()| file.read_to_end(&mut bytes));
    read.map_err(|error| (ErrorKind::Internal, error.to_string()))?;
    let probe: Probe =
        serde_json::from_slice(&bytes).map_err(|error| (ErrorKind::Abi, error.to_string()))?;
    let named = |name: &str| {
        let check = checks().into_iter().find(|check| check.name == name);
        check.ok_or_else(|| (ErrorKind::Abi, format!("no check `{name}`")))
    };
    let wanted = probe.check.split(BETWEEN).map(named);
    let wanted: Vec<Check> = wanted.collect::<Result<_, _>>()?;
    let made = caught(|| {
        let _under_way = pending_call::begin(WHOLE);
        let subject = Subject::new(source, manifest, probe)?;
        wanted
            .iter()
            .try_for_each(|check| check.test.run(&subject))?;
        Ok(subject.session)
    });
    match made {
        Ok(Ok(session)) => Ok(Arc::new(session)),
        Ok(Err(Unmet::Broken(why))) => Err((ErrorKind::DeviceFault, why)),
        Ok(Err(Unmet::Skipped(why))) => Err((ErrorKind::Unsupported, format!("{SKIPPED}{why}"))),
        Err(_) => Err((ErrorKind::Internal, "the check itself panicked".to_owned())),
    }
}
