//! Content of a folder in memory.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::model::Disk;

/// Content of a folder by path: `None` for a folder, bytes for a file.
pub type Tree = BTreeMap<String, Option<Arc<Vec<u8>>>>;

pub(super) fn joined(prefix: &str, name: &str) -> String {
    if prefix.is_empty() {
        name.to_owned()
    } else {
        format!("{prefix}/{name}")
    }
}

/// Reads the content of the folder at `path`.
///
/// # Errors
/// Errors of reading the folder.
pub fn read_tree(path: &Path) -> std::io::Result<Tree> {
    Ok(Disk::load(path)?.live_tree())
}

/// Writes `tree` to the folder at `path`.
///
/// # Errors
/// Errors of writing.
pub fn write_tree(tree: &Tree, path: &Path) -> std::io::Result<()> {
    for (relative, content) in tree {
        let target = path.join(relative);
        match content {
            None => std::fs::create_dir_all(target)?,
            Some(bytes) => {
                if let Some(folder) = target.parent() {
                    std::fs::create_dir_all(folder)?;
                }
                std::fs::write(target, bytes.as_slice())?;
            }
        }
    }
    Ok(())
}
