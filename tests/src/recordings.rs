//! Real recordings: present on some machines, never part of the project.

use std::path::PathBuf;

use taceva_needs::{Need, skip};

use crate::workspace::root;

/// The folder of the recording called `name`, under `TACEVA_DATA` or beside the workspace; where it is absent, says so
/// and gives `None`, and the test that asked returns.
pub fn recording(name: &str) -> Option<PathBuf> {
    let data = std::env::var_os("TACEVA_DATA")
        .map_or_else(|| root().join("../shared/data"), PathBuf::from);
    let folder = data.join(name);
    if folder.is_dir() {
        return Some(folder);
    }
    let reason = format!("no recording `{name}`: TACEVA_DATA names the folder that holds it");
    skip(Need::Recordings, reason);
    None
}
