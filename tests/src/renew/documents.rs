//! The Markdown files of the workspace.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A Markdown file of the workspace.
#[derive(Clone, Debug)]
pub struct Document {
    /// Path, relative to the workspace.
    pub name: String,
    /// Path of the file.
    pub path: PathBuf,
    /// Text of the document.
    pub text: String,
}

/// Every Markdown file under `root`, by name; skips folders that git ignores.
///
/// # Errors
/// If a folder or a file cannot be read.
pub fn documents(root: &Path) -> io::Result<Vec<Document>> {
    let mut found = Vec::new();
    gather(root, root, &mut found)?;
    found.sort_by(|left, right| left.name.cmp(&right.name));
    Ok(found)
}

fn gather(root: &Path, folder: &Path, found: &mut Vec<Document>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let (kind, path) = (entry.file_type()?, entry.path());
        let is_kept = !name.starts_with('.')
            && !["target", "runs", "shared", "golden"].contains(&name.as_str());
        if kind.is_dir() && is_kept {
            gather(root, &path, found)?;
        } else if kind.is_file() && name.ends_with(".md") {
            let name = path.strip_prefix(root).unwrap_or(&path);
            found.push(Document {
                name: name.to_string_lossy().replace('\\', "/"),
                text: fs::read_to_string(&path)?,
                path,
            });
        }
    }
    Ok(())
}
