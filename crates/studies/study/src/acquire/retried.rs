//! How many frames of a recording were taken again, kept beside it so that a run which was interrupted still says so.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Adds `count` to what is written beside the recording at `path`.
pub(super) fn add(path: &Path, count: u64) -> io::Result<()> {
    if count == 0 {
        return Ok(());
    }
    fs::write(
        place(path),
        format!("{}\n", read(path).saturating_add(count)),
    )
}

/// A note on the recording at `path`, if frames of it were taken again.
pub(crate) fn note(path: &Path) -> Option<String> {
    let count = read(path);
    (count > 0).then(|| {
        format!(
            "{count} frames were lost, damaged or older than their contact, and were taken again"
        )
    })
}

/// Nothing where nothing can be read: a recording that was moved has left it behind.
fn read(path: &Path) -> u64 {
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
        add(&recording, 0).expect("nothing");
        assert_eq!(
            (note(&recording), place(&recording).exists()),
            (None, false)
        );
        add(&recording, 3).expect("written");
        add(&recording, 4).expect("written");
        let said = note(&recording).expect("seven");
        assert!(said.starts_with("7 frames were lost, damaged"), "{said}");
    }
}
