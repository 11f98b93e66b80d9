//! Folder of a zarr store: on disk, or within a ZIP archive of the whole store.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::archive::members;
use crate::error::Problem;
use crate::member_bytes::{Budget, Packed, PackedBytes};
use crate::scalar::shown;
use crate::source::{ByteSource, FileBytes, bytes_of};

/// Folder of a zarr store.
#[derive(Clone, Debug)]
pub(crate) enum Tree {
    Folder(PathBuf),
    Archive(Archive),
}

/// Folder within a ZIP archive.
#[derive(Clone, Debug)]
pub(crate) struct Archive {
    file: Arc<FileBytes>,
    /// Archive members by path. Of several members with the same path the last is used, as in appended ZIP archives.
    members: Arc<BTreeMap<String, Packed>>,
    /// Path of the folder with a trailing `/`; empty for the root.
    folder: String,
}

impl Tree {
    /// Opens the zarr store at `path`.
    pub(crate) fn open(path: &Path) -> Result<Tree, Problem> {
        if fs::metadata(path).map_err(Problem::io("open"))?.is_dir() {
            return Ok(Tree::Folder(path.to_owned()));
        }
        let file = Arc::new(FileBytes::open(path)?);
        let mut by_path = BTreeMap::new();
        for member in members(&*file)? {
            let name = member.name.trim_start_matches("./").to_owned();
            by_path.insert(name, member);
        }
        let archive = Archive {
            file,
            folder: outermost(&by_path),
            members: Arc::new(by_path),
        };
        Ok(Tree::Archive(archive))
    }

    /// Subfolder `name`.
    pub(crate) fn join(&self, name: &str) -> Tree {
        match self {
            Tree::Folder(path) => Tree::Folder(path.join(name)),
            Tree::Archive(archive) => Tree::Archive(Archive {
                folder: format!("{}{name}/", archive.folder),
                ..archive.clone()
            }),
        }
    }

    /// Reads the file `name` in this folder, of at most `most` bytes; `None` if it does not exist. Error messages call the file `what`.
    pub(crate) fn bytes(
        &self,
        name: &str,
        what: &str,
        most: u64,
    ) -> Result<Option<Vec<u8>>, Problem> {
        let checked = |source: &dyn ByteSource| match source.length() {
            length if length > most => Err(Problem::too_large(what, length, most)),
            length => bytes_of(source, 0, length),
        };
        match self {
            Tree::Folder(folder) => {
                let path = folder.join(name);
                match fs::symlink_metadata(&path) {
                    Ok(_) => checked(&FileBytes::open(&path)?).map(Some),
                    Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
                    Err(error) => Err(Problem::io("open")(error)),
                }
            }
            Tree::Archive(archive) => {
                let path = format!("{}{name}", archive.folder);
                let Some(member) = archive.members.get(&path) else {
                    return Ok(None);
                };
                let mut budget = Budget::default();
                let source = PackedBytes::new(&archive.file, member.clone(), &mut budget);
                let bytes = checked(&source)?;
                let is_other = member
                    .crc32
                    .is_some_and(|expected| crc32fast::hash(&bytes) != expected);
                match is_other {
                    true => Err(Problem::damaged(
                        member.at,
                        format!("changed bytes of `{}`", shown(&path)),
                        "the bytes of its checksum",
                    )),
                    false => Ok(Some(bytes)),
                }
            }
        }
    }

    /// Names of the subfolders, sorted. Links on disk are excluded, because they may lead out of the store.
    pub(crate) fn folders(&self) -> Result<Vec<String>, Problem> {
        let mut names = BTreeSet::new();
        match self {
            Tree::Folder(folder) => {
                for entry in fs::read_dir(folder).map_err(Problem::io("list"))? {
                    let entry = entry.map_err(Problem::io("list"))?;
                    let is_folder = entry.file_type().map_err(Problem::io("list"))?.is_dir();
                    if let (true, Some(name)) = (is_folder, entry.file_name().to_str()) {
                        names.insert(name.to_owned());
                    }
                }
            }
            Tree::Archive(archive) => {
                for path in archive.below() {
                    names.extend(path.split_once('/').map(|(name, _)| name.to_owned()));
                }
            }
        }
        Ok(names.into_iter().collect())
    }

    /// Stored size of the file `name` in this folder, bytes. In an archive, 0 if the file does not exist.
    pub(crate) fn file_bytes(&self, name: &str) -> Result<u64, Problem> {
        match self {
            Tree::Folder(folder) => {
                let metadata = fs::symlink_metadata(folder.join(name));
                Ok(metadata.map_err(Problem::io("open"))?.len())
            }
            Tree::Archive(archive) => {
                let path = format!("{}{name}", archive.folder);
                let member = archive.members.get(&path);
                Ok(member.map_or(0, |member| member.packed_bytes))
            }
        }
    }

    /// Names of the files in this folder.
    pub(crate) fn files(&self) -> Result<Vec<String>, Problem> {
        match self {
            Tree::Folder(folder) => {
                let mut names = Vec::new();
                for entry in fs::read_dir(folder).map_err(Problem::io("list"))? {
                    let entry = entry.map_err(Problem::io("list"))?;
                    let is_file = entry.file_type().map_err(Problem::io("list"))?.is_file();
                    if let (true, Some(name)) = (is_file, entry.file_name().to_str()) {
                        names.push(name.to_owned());
                    }
                }
                Ok(names)
            }
            Tree::Archive(archive) => {
                let own = archive.below().filter(|path| !path.contains('/'));
                Ok(own.map(str::to_owned).collect())
            }
        }
    }
}

impl Archive {
    /// Paths of the archive members below this folder, relative to the folder.
    fn below(&self) -> impl Iterator<Item = &str> {
        let from = self.members.range(self.folder.clone()..);
        from.map_while(|(path, _)| path.strip_prefix(&self.folder))
    }
}

/// Path of the root of the store: the archive itself, or its only folder if the archive contains nothing else.
fn outermost(members: &BTreeMap<String, Packed>) -> String {
    let is_described = ["zarr.json", ".zgroup", ".zarray"]
        .iter()
        .any(|name| members.contains_key(*name));
    let mut folders = members.keys().map(|path| path.split_once('/'));
    let first = folders.next().flatten().map(|(folder, _)| folder);
    match first {
        Some(first) if !is_described => {
            let is_only = folders.all(|path| path.is_some_and(|(folder, _)| folder == first));
            if is_only {
                format!("{first}/")
            } else {
                String::new()
            }
        }
        _ => String::new(),
    }
}
