//! Surveys a folder: groups files by the pattern of their names.

use std::collections::BTreeMap;
use std::path::Path;

use super::endings::{is_clip, is_picture};
use super::path_parts::{PathParts, varying};
use crate::error::ImportError;
use crate::source_folder::SourceFolder;

/// Maximum number of files and folders examined.
const LOOKED_AT: usize = 100_000;
/// Maximum number of names in a group that are compared to find the varying parts.
const COMPARED: usize = 2_000;

/// Files whose names have a common pattern.
#[derive(Debug)]
pub(super) struct FileGroup {
    /// Paths relative to the folder, sorted.
    pub(super) paths: Vec<String>,
    pub(super) ending: String,
    pub(super) parts: PathParts,
}

impl FileGroup {
    pub(super) fn first(&self) -> &str {
        &self.paths[0]
    }

    /// Path of the group, with `*` for the varying parts.
    pub(super) fn pattern(&self) -> &str {
        match self.paths.as_slice() {
            [only] => only,
            _ => &self.parts.glob,
        }
    }

    /// Name of the first file without its extension.
    pub(super) fn stem(&self) -> &str {
        let name = self.first().rsplit('/').next().unwrap_or_default();
        name.split('.').next().unwrap_or(name)
    }
}

/// Groups of files below `folder`. A zarr or Lance store counts as a file. Hidden files, maps and links are skipped.
pub(super) fn groups(folder: &SourceFolder) -> Result<Vec<FileGroup>, ImportError> {
    let mut files = Vec::new();
    let mut folders = vec![String::new()];
    let mut looked_at = 0;
    while let Some(relative) = folders.pop() {
        let path = folder.path().join(&relative);
        let entries = std::fs::read_dir(&path).map_err(ImportError::io("read", &path))?;
        for entry in entries.flatten() {
            looked_at += 1;
            let (Ok(name), Ok(kind)) = (entry.file_name().into_string(), entry.file_type()) else {
                continue;
            };
            if name.starts_with('.') || looked_at > LOOKED_AT {
                continue;
            }
            let inside = match relative.as_str() {
                "" => name.clone(),
                relative => format!("{relative}/{name}"),
            };
            let is_store = kind.is_dir()
                && Path::new(&name)
                    .extension()
                    .is_some_and(|ending| ending == "zarr" || ending == "lance");
            // A dataset made by TacEva is not part of the lab's recording.
            if kind.is_dir() && entry.path().join("dataset.toml").is_file() {
                continue;
            }
            if kind.is_dir() && !is_store {
                folders.push(inside);
            } else if kind.is_file() || is_store {
                files.push(inside);
            }
        }
    }
    files.sort_unstable();
    Ok(grouped(files))
}

/// Groups of the pictures and clips among `groups`, and a group that contains only `file`.
pub(super) fn beside(mut groups: Vec<FileGroup>, file: &str) -> Vec<FileGroup> {
    groups.retain(|group| is_picture(&group.ending) || is_clip(&group.ending));
    let is_known = groups
        .iter()
        .any(|group| group.paths.iter().any(|path| path == file));
    let parts = varying(&[file]).filter(|_| !is_known);
    groups.extend(parts.map(|parts| FileGroup {
        paths: vec![file.to_owned()],
        ending: ending_of(file),
        parts,
    }));
    groups
}

/// Filename extension of a name, in lower case.
fn ending_of(name: &str) -> String {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    ending.to_ascii_lowercase()
}

/// Groups files of one extension and folder depth whose names differ only in numbers and words.
fn grouped(files: Vec<String>) -> Vec<FileGroup> {
    let mut by_shape: BTreeMap<(String, usize, String), Vec<String>> = BTreeMap::new();
    for path in files {
        let name = path.rsplit('/').next().unwrap_or_default();
        let ending = ending_of(name);
        let shape = match is_table_ending(&ending) {
            true => last_word(name),
            false => String::new(),
        };
        let key = (ending, path.matches('/').count(), shape);
        by_shape.entry(key).or_default().push(path);
    }
    let groups = by_shape.into_iter().filter_map(|((ending, ..), paths)| {
        let compared: Vec<&str> = paths.iter().take(COMPARED).map(String::as_str).collect();
        Some(FileGroup {
            parts: varying(&compared)?,
            paths,
            ending,
        })
    });
    groups.collect()
}

/// True if files with this extension may be tables. Tables whose names differ in the last word usually contain different data.
fn is_table_ending(ending: &str) -> bool {
    !matches!(
        ending,
        "png" | "jpg" | "jpeg" | "tif" | "tiff" | "avi" | "mp4" | "mkv" | "mov"
    )
}

/// Last word of a name before the extension, without digits: `forces` of `cube_1_forces.csv`.
fn last_word(name: &str) -> String {
    let stem = name.split('.').next().unwrap_or(name);
    let last = stem.rsplit(['_', '-', ' ']).next().unwrap_or(stem);
    last.trim_matches(|letter: char| letter.is_ascii_digit())
        .to_owned()
}
