//! Check of the free disk space before a command writes files.

use std::path::Path;

use crate::amount::bytes;

/// Compression factor of pictures in the best case. A run is rejected only if a fiftieth of the bytes of its pictures exceeds the free space.
const PACKED: u64 = 50;

/// Bytes that a command will write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Need {
    /// Lower bound, bytes.
    pub(crate) at_least: u64,
    /// Upper bound, bytes.
    pub(crate) at_most: u64,
}

/// Error for files that exceed the free space.
#[derive(Debug)]
pub(crate) struct NoRoom {
    need: Need,
    free: u64,
    folder: String,
}

impl std::fmt::Display for NoRoom {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "at least {} are needed and {} are free in {}; nothing was started: free space, or name another path",
            bytes(self.need.at_least),
            bytes(self.free),
            self.folder
        )
    }
}

impl std::error::Error for NoRoom {}

impl Need {
    /// Need of a run whose uncompressed pictures have `bytes` bytes.
    pub(crate) fn of_pictures(bytes: u64) -> Need {
        Need {
            at_least: bytes / PACKED,
            at_most: bytes,
        }
    }

    /// Text on needed and free bytes; `None` if nothing will be written.
    ///
    /// # Errors
    /// [`NoRoom`] if even the lower bound exceeds the free space.
    pub(crate) fn hold_against(
        self,
        free: Option<u64>,
        target: &Path,
    ) -> Result<Option<String>, NoRoom> {
        if self.at_most == 0 {
            return Ok(None);
        }
        let most = if self.at_most == self.at_least {
            ""
        } else {
            "at most "
        };
        let needs = format!("{most}{} of pictures", bytes(self.at_most));
        match free {
            Some(free) if free < self.at_least => Err(NoRoom {
                need: self,
                free,
                folder: holder(target).display().to_string(),
            }),
            Some(free) if free < self.at_most => Ok(Some(format!(
                "{needs}, but only {} are free: the disk may become full",
                bytes(free)
            ))),
            Some(free) => Ok(Some(format!("{needs}, {} are free", bytes(free)))),
            None => Ok(Some(needs)),
        }
    }
}

/// Nearest existing folder above `target`.
fn holder(target: &Path) -> &Path {
    let above = target.ancestors().find(|folder| folder.is_dir());
    above.unwrap_or(Path::new("."))
}

/// Free bytes on the disk of `target`, without the reserve of the administrator; `None` if unknown.
pub(crate) fn free(target: &Path) -> Option<u64> {
    #[cfg(unix)]
    {
        let facts = rustix::fs::statvfs(holder(target)).ok()?;
        facts.f_bavail.checked_mul(facts.f_frsize)
    }
    #[cfg(not(unix))]
    {
        let _ = target;
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_fit_is_refused_and_what_may_not_is_said() {
        let need = Need {
            at_least: 10_000,
            at_most: 200_000,
        };
        let said = |free| need.hold_against(free, Path::new("/nowhere/at/all"));
        let refused = said(Some(9_999)).expect_err("it cannot fit").to_string();
        assert!(
            refused.starts_with("at least 10.0 kB are needed"),
            "{refused}"
        );
        assert!(refused.contains("are free in /;"), "{refused}");
        let said = |free| {
            said(free)
                .expect("it may fit")
                .expect("there is something to write")
        };
        assert_eq!(
            said(Some(50_000)),
            "at most 200 kB of pictures, but only 50.0 kB are free: the disk may become full"
        );
        assert_eq!(
            said(Some(200_000)),
            "at most 200 kB of pictures, 200 kB are free"
        );
        assert_eq!(said(None), "at most 200 kB of pictures");
        let nothing = Need::default().hold_against(Some(0), Path::new("."));
        assert_eq!(nothing.expect("nothing fits everywhere"), None);
    }

    #[test]
    #[cfg(unix)]
    fn what_is_free_is_known_for_folders_that_are_still_to_be_made() {
        let folder = tempfile::tempdir().expect("a folder");
        let deep = folder.path().join("a/b/c");
        let ratio = |left: u64, right: u64| left.abs_diff(right) < 1 << 30;
        let (here, there) = (free(folder.path()), free(&deep));
        assert!(ratio(here.expect("known"), there.expect("known")));
    }
}
