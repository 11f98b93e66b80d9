//! Check whether other users can write to a search folder.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

const OTHERS_WRITE: u32 = 0o002;
const STICKY: u32 = 0o1000;

/// Write check with a cache of folders.
#[derive(Default)]
pub(super) struct Writable {
    above: BTreeMap<PathBuf, Option<PathBuf>>,
}

impl Writable {
    /// Entry that every user may write: `path` itself, or a folder above it in which users could replace it. `path` has no links.
    pub(super) fn by_all(&mut self, path: &Path) -> io::Result<Option<PathBuf>> {
        if fs::metadata(path)?.permissions().mode() & OTHERS_WRITE != 0 {
            return Ok(Some(path.to_owned()));
        }
        match path.parent() {
            Some(parent) => self.above(parent),
            None => Ok(None),
        }
    }

    /// As [`by_all`](Writable::by_all), for entries of `folder`. The sticky bit of a folder keeps users from replacing entries of other users.
    fn above(&mut self, folder: &Path) -> io::Result<Option<PathBuf>> {
        if let Some(known) = self.above.get(folder) {
            return Ok(known.clone());
        }
        let mode = fs::metadata(folder)?.permissions().mode();
        let open = if mode & OTHERS_WRITE != 0 && mode & STICKY == 0 {
            Some(folder.to_owned())
        } else {
            match folder.parent() {
                Some(parent) => self.above(parent)?,
                None => None,
            }
        };
        self.above.insert(folder.to_owned(), open.clone());
        Ok(open)
    }
}
