//! Access check of a device file, without opening it.

use std::path::Path;

use rustix::fs::{Access as Wanted, access};
use rustix::io::Errno;
use taceva_core::Access;

/// Access of this user to read and write a device file. The remedy for missing access names `group`, which usually owns the file.
pub(crate) fn access_of(path: &Path, group: &str) -> Access {
    match access(path, Wanted::READ_OK | Wanted::WRITE_OK) {
        Err(Errno::ACCESS | Errno::PERM) => Access::Denied {
            remedy: format!(
                "join the group `{group}` and log in again, or permit {} by a udev rule; `taceva doctor` prints the remedy",
                path.display()
            ),
        },
        _ => Access::Ready,
    }
}
