//! The order in which a child gives up what it could do.

use super::isolation::LANDLOCK_WHOLE;
use super::{Confinement, Isolation, files, identity, seccomp};

/// Gives up everything but what `confinement` leaves, for good; before anything is loaded and while there is one thread.
///
/// # Errors
/// What could not be given up, in words. The process must end then: it may be confined in part.
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
            "this kernel cannot isolate a plugin, expected Landlock {LANDLOCK_WHOLE} (Linux 6.12) and filters of system calls, found {isolation}"
        ))
    }
}

/// Gives up what only loading needs: from now on no more code comes into the process, on any of its threads.
///
/// # Errors
/// As [`confine`].
pub(crate) fn seal(isolation: &Isolation) -> Result<(), String> {
    match isolation.system_calls {
        Some(_) if !isolation.takes_code => seccomp::filter_after_loading(),
        _ => Ok(()),
    }
}
