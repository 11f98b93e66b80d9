//! Other programs that have a serial port open. Without a lock, they would take answers away unnoticed.

use std::fs::{self, DirEntry, Metadata};
use std::os::unix::fs::{FileTypeExt, MetadataExt};

use crate::text::shown;

/// Other processes that have the serial port at `path` open, such as `1234 (octoprint)`. Only root sees those of other users. Empty without `/proc`.
fn other_users(path: &str) -> Vec<String> {
    let Ok(port) = fs::metadata(path) else {
        return Vec::new();
    };
    let own = std::process::id();
    let others = entries("/proc").filter_map(|entry| {
        let id: u32 = entry.file_name().to_str()?.parse().ok()?;
        let folder = entry.path();
        let mut open = entries(folder.join("fd")).filter_map(|file| fs::metadata(file.path()).ok());
        if id == own || !open.any(|file| is_same_device(&file, &port)) {
            return None;
        }
        let name = fs::read_to_string(folder.join("comm")).unwrap_or_default();
        Some(format!("{id} ({})", shown(name.trim())))
    });
    others.collect()
}

/// Warning for the operator of the port at `path`; `None` if no other process has it open.
pub(super) fn warning(path: &str) -> Option<String> {
    let others = other_users(path);
    (!others.is_empty()).then(|| {
        format!(
            "the serial port {} is also open in process {}, which may take answers of the machine away: end that program",
            shown(path),
            others.join(", ")
        )
    })
}

fn is_same_device(file: &Metadata, port: &Metadata) -> bool {
    file.file_type().is_char_device() && file.rdev() == port.rdev()
}

fn entries(folder: impl AsRef<std::path::Path>) -> impl Iterator<Item = DirEntry> {
    fs::read_dir(folder).into_iter().flatten().flatten()
}
