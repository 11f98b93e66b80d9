//! Real recordings: present on some machines, never part of the project.

use std::path::PathBuf;

use crate::workspace::root;

/// The folder of the recording called `name`, under `TACEVA_DATA` or beside the workspace; where it is absent, says so
/// and gives `None`, and the test that asked returns.
#[expect(clippy::print_stderr, reason = "a skipped test must say why")]
pub fn recording(name: &str) -> Option<PathBuf> {
    let data = std::env::var_os("TACEVA_DATA")
        .map_or_else(|| root().join("../shared/data"), PathBuf::from);
    let folder = data.join(name);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no recording `{name}`; set TACEVA_DATA to the folder that holds it");
    None
}
