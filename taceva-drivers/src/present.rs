//! Whether a device file that is present could be opened; it is not.

use std::path::Path;

use rustix::fs::{Access as Wanted, access};
use rustix::io::Errno;
use taceva_core::Access;

/// Whether this user may read and write the file of a device, which `group` owns on most systems.
pub(crate) fn access_of(path: &Path, group: &str) -> Access {
    match access(path, Wanted::READ_OK | Wanted::WRITE_OK) {
        Err(Errno::ACCESS | Errno::PERM) => Access::Denied {
            remedy: format!(
                "join the group `{group}` and log in again, or permit {} by a udev rule; `taceva doctor` says which",
                path.display()
            ),
        },
        _ => Access::Ready,
    }
}
