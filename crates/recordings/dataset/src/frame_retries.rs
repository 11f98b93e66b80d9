//! Count of retried frames, stored beside a recording so that an interrupted run still reports it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Adds `count` to the count beside the recording at `path`.
///
/// # Errors
/// Those of the file system.
pub fn add_frame_retries(path: &Path, count: u64) -> io::Result<()> {
    if count == 0 {
        return Ok(());
    }
    let all = frame_retries(path).saturating_add(count);
    taceva_files::replace(&place(path), |staged| fs::write(staged, format!("{all}\n")))
}

/// Number of retried frames of the recording at `path`; 0 if there is no count, as for a recording that was moved.
pub fn frame_retries(path: &Path) -> u64 {
    let text = fs::read_to_string(place(path)).unwrap_or_default();
    text.trim().parse().unwrap_or(0)
}

fn place(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".retried");
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
            (frame_retries(&recording), place(&recording).exists()),
            (0, false)
        );
        add_frame_retries(&recording, 3).expect("written");
        add_frame_retries(&recording, 4).expect("written");
        assert_eq!(frame_retries(&recording), 7);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_at_its_name_is_replaced_and_leads_nothing_elsewhere() {
        let folder = tempfile::tempdir().expect("a folder");
        let (recording, theirs) = (folder.path().join("1-gel"), folder.path().join("theirs"));
        fs::write(&theirs, "5").expect("written");
        std::os::unix::fs::symlink(&theirs, place(&recording)).expect("linked");
        add_frame_retries(&recording, 3).expect("written");
        assert_eq!(frame_retries(&recording), 8);
        assert_eq!(fs::read_to_string(&theirs).expect("there"), "5");
    }
}
