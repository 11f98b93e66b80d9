//! Real recordings: present on some machines, not part of the project.

use std::path::PathBuf;

use taceva_needs::{Need, skip};

use crate::workspace::root;

/// Folder of the recording `name`, under `TACEVA_DATA` or beside the workspace. If it is missing, records a skip and returns `None`; the
/// calling test then returns.
pub fn recording(name: &str) -> Option<PathBuf> {
    let data = std::env::var_os("TACEVA_DATA")
        .map_or_else(|| root().join("../shared/data"), PathBuf::from);
    let folder = data.join(name);
    if folder.is_dir() {
        return Some(folder);
    }
    let reason =
        format!("recording `{name}` is missing: set TACEVA_DATA to the folder that holds it");
    skip(Need::Recordings, reason);
    None
}
