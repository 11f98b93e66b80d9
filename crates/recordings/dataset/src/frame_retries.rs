//! Counts of retried and frozen frames, stored beside a recording so that a resumed run still reports them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Suffix of the file with the count of retried frames, after the name of the recording; `FROZEN` for frozen frames.
const RETRIED: &str = ".retried";
const FROZEN: &str = ".frozen";

/// Adds `count` to the count of retried frames beside the recording at `path`.
///
/// # Errors
/// Errors of the file system.
pub fn add_frame_retries(path: &Path, count: u64) -> io::Result<()> {
    add(&place(path, RETRIED), count)
}

/// Adds `count` to the count of frozen frames beside the recording at `path`.
///
/// # Errors
/// Errors of the file system.
pub fn add_frozen_frames(path: &Path, count: u64) -> io::Result<()> {
    add(&place(path, FROZEN), count)
}

/// Number of retried frames of the recording at `path`; 0 if no count is stored, as after the recording was moved.
pub fn frame_retries(path: &Path) -> u64 {
    read(&place(path, RETRIED))
}

/// Number of frozen frames of the recording at `path`, each of which ended a press early; 0 if no count is stored.
pub fn frozen_frames(path: &Path) -> u64 {
    read(&place(path, FROZEN))
}

fn add(place: &Path, count: u64) -> io::Result<()> {
    if count == 0 {
        return Ok(());
    }
    let all = read(place).saturating_add(count);
    taceva_files::replace(place, |staged| fs::write(staged, format!("{all}\n")))
}

fn read(place: &Path) -> u64 {
    let text = fs::read_to_string(place).unwrap_or_default();
    text.trim().parse().unwrap_or(0)
}

fn place(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(suffix);
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_several_sittings_took_again_is_added_up_and_nothing_is_not_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let recording = folder.path().join("1-gel");
        add_frame_retries(&recording, 0).expect("nothing");
        assert_eq!(
            (
                frame_retries(&recording),
                place(&recording, RETRIED).exists()
            ),
            (0, false)
        );
        add_frame_retries(&recording, 3).expect("written");
        add_frame_retries(&recording, 4).expect("written");
        add_frozen_frames(&recording, 2).expect("written");
        assert_eq!(
            (frame_retries(&recording), frozen_frames(&recording)),
            (7, 2)
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_link_at_its_name_is_replaced_and_leads_nothing_elsewhere() {
        let folder = tempfile::tempdir().expect("a folder");
        let (recording, theirs) = (folder.path().join("1-gel"), folder.path().join("theirs"));
        fs::write(&theirs, "5").expect("written");
        std::os::unix::fs::symlink(&theirs, place(&recording, RETRIED)).expect("linked");
        add_frame_retries(&recording, 3).expect("written");
        assert_eq!(frame_retries(&recording), 8);
        assert_eq!(fs::read_to_string(&theirs).expect("there"), "5");
    }
}
