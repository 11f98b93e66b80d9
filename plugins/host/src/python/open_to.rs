//! Checks that every user of the machine can read a path.

use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

/// Permission bit for other users to read a file or list a folder; the next constant is the bit to traverse a folder.
const READ: u32 = 0o4;
const GO_THROUGH: u32 = 0o1;

/// First entry that denies other users access to `path`: `path` itself or a folder above it. `None` if access is allowed or `path` does not exist.
pub(crate) fn closed_by(path: &Path) -> Option<PathBuf> {
    let real = std::fs::canonicalize(path).ok()?;
    let mode = |path: &Path| path.metadata().ok().map(|metadata| metadata.mode());
    let above = real.ancestors().skip(1).collect::<Vec<_>>();
    for folder in above.into_iter().rev() {
        if mode(folder).is_some_and(|mode| mode & GO_THROUGH == 0) {
            return Some(folder.to_owned());
        }
    }
    let wanted = match real.is_dir() {
        true => READ | GO_THROUGH,
        false => READ,
    };
    let is_open = mode(&real).is_none_or(|mode| mode & wanted == wanted);
    (!is_open).then_some(real)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::{self, Permissions};
    use std::os::unix::fs::PermissionsExt;

    #[test]
    fn a_folder_that_others_may_not_enter_closes_everything_below_it_and_is_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let home = folder.path().canonicalize().expect("there").join("home");
        fs::create_dir_all(home.join("venv/bin")).expect("room");
        let open = |path: &Path, mode| {
            fs::set_permissions(path, Permissions::from_mode(mode)).expect("ours");
        };
        open(folder.path(), 0o755);
        for below in ["", "venv", "venv/bin"] {
            open(&home.join(below), 0o755);
        }
        assert_eq!(closed_by(&home.join("venv/bin")), None);
        open(&home, 0o700);
        assert_eq!(closed_by(&home.join("venv/bin")), Some(home.clone()));
        open(&home, 0o711);
        assert_eq!(closed_by(&home.join("venv/bin")), None);
        assert_eq!(closed_by(&home), Some(home.clone()));
        assert_eq!(closed_by(&home.join("nothing")), None);
    }
}
