//! Other programs that have a device open. If the device is not locked, such a program may receive answers that belong to this program.

use std::fs::{self, DirEntry, Metadata};
use std::os::unix::fs::{FileTypeExt, MetadataExt};
use std::path::Path;

use crate::text::shown;

/// Other processes that have the device `port` open, such as `1234 (octoprint)`. Only root sees processes of other users. `processes` is `/proc`;
/// without it the list is empty.
pub(crate) fn other_users(processes: &Path, port: &Path) -> Vec<String> {
    let Ok(port) = fs::metadata(port) else {
        return Vec::new();
    };
    let own = std::process::id();
    let others = entries(processes).filter_map(|entry| {
        let id: u32 = entry.file_name().to_str()?.parse().ok()?;
        let folder = entry.path();
        let files = entries(&folder.join("fd"));
        let mut open = files.filter_map(|file| fs::metadata(file.path()).ok());
        if id == own || !open.any(|file| is_same_device(&file, &port)) {
            return None;
        }
        let name = fs::read_to_string(folder.join("comm")).unwrap_or_default();
        Some(format!("{id} ({})", shown(name.trim())))
    });
    others.collect()
}

fn is_same_device(file: &Metadata, port: &Metadata) -> bool {
    file.file_type().is_char_device()
        && port.file_type().is_char_device()
        && file.rdev() == port.rdev()
}

fn entries(folder: &Path) -> impl Iterator<Item = DirEntry> + use<> {
    fs::read_dir(folder).into_iter().flatten().flatten()
}
