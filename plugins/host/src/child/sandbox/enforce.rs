//! Applies the limits of a child in the required order.

use super::isolation::LANDLOCK_WHOLE;
use super::{Confinement, Isolation, files, identity, seccomp};

/// Permanently gives up every right that `confinement` does not grant. Call this function before anything is loaded, while there is one thread.
///
/// # Errors
/// Describes the right that could not be given up. The process must then end, because it may be partly confined.
pub(crate) fn confine(confinement: &Confinement, parent: u32) -> Result<Isolation, String> {
    if confinement.is_trusted {
        identity::end_with(parent)?;
        return Ok(Isolation::default());
    }
    identity::limit(confinement)?;
    let user = identity::give_up_root(&confinement.needs)?;
    identity::end_with(parent)?;
    let landlock = files::close_off(confinement)?;
    let system_calls = seccomp::filter_for_loading(&confinement.needs)?;
    let isolation = Isolation {
        landlock,
        system_calls,
        user,
        memory: confinement.memory,
        needs: confinement.needs.clone(),
        takes_code: !confinement.seals,
    };
    if isolation.is_whole() || confinement.accepts_less {
        Ok(isolation)
    } else {
        Err(format!(
            "this kernel cannot isolate a plugin, expected Landlock {LANDLOCK_WHOLE} (Linux 6.12) and system-call filters, found {isolation}"
        ))
    }
}

/// Gives up the right to map code, which only loading needs, on every thread of the process.
///
/// # Errors
/// As [`confine`].
pub(crate) fn seal(isolation: &Isolation) -> Result<(), String> {
    match isolation.system_calls {
        Some(_) if !isolation.takes_code => seccomp::filter_after_loading(),
        _ => Ok(()),
    }
}
