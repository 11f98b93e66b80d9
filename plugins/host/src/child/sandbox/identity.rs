//! User, groups, resource limits and process attributes of a child.

use std::os::unix::fs::MetadataExt;

use rustix::process::{
    DumpableBehavior, Gid, Pid, Resource, Rlimit, Signal, Uid, geteuid, getppid,
    set_dumpable_behavior, set_parent_process_death_signal, setrlimit,
};
use rustix::thread::{set_no_new_privs, set_thread_groups, set_thread_res_gid, set_thread_res_uid};

use super::{Confinement, Need, devices};

/// Id of the user and of the group `nobody`, which own no files.
pub(crate) const NOBODY: u32 = 65_534;

/// Sets the resource limits of the process. The process cannot raise these limits again.
///
/// CPU time has no limit, because a run may last for days. The number of threads has no limit, because such a limit would include other programs of the user.
/// The system-call filter denies new processes.
pub(super) fn limit(confinement: &Confinement) -> Result<(), String> {
    let limits = [
        (Resource::As, confinement.memory, "memory"),
        (Resource::Nofile, confinement.files, "open files"),
        // The host allocates the shared memory; the child writes no file.
        (Resource::Fsize, 0, "the size of files"),
        (Resource::Core, 0, "core dumps"),
        (Resource::Msgqueue, 0, "message queues"),
        (Resource::Memlock, 0, "locked memory"),
    ];
    for (resource, most, name) in limits {
        let limit = Rlimit {
            current: Some(most),
            maximum: Some(most),
        };
        setrlimit(resource, limit).map_err(|error| format!("cannot limit {name}: {error}"))?;
    }
    Ok(())
}

/// Switches from root to user nobody. Returns `None` if the process is not root. Keeps the groups that own a needed device.
pub(super) fn give_up_root(needs: &[Need]) -> Result<Option<u32>, String> {
    if !geteuid().is_root() {
        return Ok(None);
    }
    let mut groups: Vec<u32> = devices::devices(needs)
        .iter()
        .filter_map(|path| path.metadata().ok())
        .map(|metadata| metadata.gid())
        .filter(|group| *group != 0)
        .collect();
    groups.sort_unstable();
    groups.dedup();
    let groups: Vec<Gid> = groups.into_iter().map(Gid::from_raw).collect();
    let (user, group) = (Uid::from_raw(NOBODY), Gid::from_raw(NOBODY));
    set_thread_groups(&groups)
        .and_then(|()| set_thread_res_gid(group, group, group))
        .and_then(|()| set_thread_res_uid(user, user, user))
        .map_err(|error| format!("cannot become user {NOBODY}: {error}"))?;
    Ok(Some(NOBODY))
}

/// Makes the process end with its parent, hides its memory and blocks new privileges.
///
/// Call this function after the change of user, because that change resets the parent-death signal.
pub(super) fn end_with(parent: u32) -> Result<(), String> {
    let said = |what: &str, error: rustix::io::Errno| format!("cannot {what}: {error}");
    set_parent_process_death_signal(Some(Signal::KILL))
        .map_err(|error| said("end with the process that started it", error))?;
    // A parent that ended before this call sends no signal.
    let is_there = getppid()
        .map(Pid::as_raw_nonzero)
        .map(std::num::NonZero::get);
    if is_there.and_then(|found| u32::try_from(found).ok()) != Some(parent) {
        return Err("the host has ended".to_owned());
    }
    set_dumpable_behavior(DumpableBehavior::NotDumpable)
        .map_err(|error| said("hide its memory", error))?;
    set_no_new_privs(true).map_err(|error| said("give up new privileges", error))
}
