//! Finds tables and images within a foreign folder.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::error::ImportError;
use crate::source_folder::SourceFolder;
use taceva_dataset::internal::{limits, shown};

/// Files that match `pattern`, sorted. `*` matches any characters within one file or folder name.
pub(crate) fn matching_files(
    folder: &SourceFolder,
    pattern: &str,
) -> Result<Vec<PathBuf>, ImportError> {
    if !pattern.contains('*') {
        return Ok(vec![folder.file(folder.path(), pattern)?]);
    }
    let mut found: Vec<String> = vec![String::new()];
    for part in pattern.split('/').filter(|part| !part.is_empty()) {
        let mut next = Vec::new();
        for before in &found {
            for name in names_like(&folder.path().join(before), part) {
                next.push(if before.is_empty() {
                    name
                } else {
                    format!("{before}/{name}")
                });
            }
        }
        found = next;
    }
    found.sort_unstable();
    if found.is_empty() {
        return Err(ImportError::path(
            pattern,
            format!(
                "matches no file in {}: correct the pattern",
                shown(&folder.path().to_string_lossy())
            ),
        ));
    }
    let found: Result<Vec<PathBuf>, ImportError> = found
        .iter()
        .map(|relative| folder.file(folder.path(), relative))
        .collect();
    let found = found?;
    each_once(folder, pattern, &found)?;
    Ok(found)
}

/// Checks that no two links lead to the same file, whose rows would then count twice.
fn each_once(folder: &SourceFolder, pattern: &str, found: &[PathBuf]) -> Result<(), ImportError> {
    let mut known: BTreeMap<PathBuf, &PathBuf> = BTreeMap::new();
    for path in found {
        let real = path.canonicalize().unwrap_or_else(|_| path.clone());
        if let Some(first) = known.insert(real, path) {
            let [first, again] = [first, path].map(|path| folder.inside(path, ""));
            return Err(ImportError::path(
                pattern,
                format!(
                    "matches one file twice, as {} and through a link as {}: narrow the pattern, or its rows are read twice",
                    shown(&first),
                    shown(&again)
                ),
            ));
        }
    }
    Ok(())
}

/// True if a file or folder matches `pattern`. Stops at the first match.
pub(crate) fn has_match(folder: &Path, pattern: &str) -> bool {
    let (part, rest) = match pattern.split_once('/') {
        Some((part, rest)) => (part, Some(rest)),
        None => (pattern, None),
    };
    let mut names = names_like(folder, part).into_iter();
    names.any(|name| rest.is_none_or(|rest| has_match(&folder.join(name), rest)))
}

fn names_like(folder: &Path, pattern: &str) -> Vec<String> {
    if !pattern.contains('*') {
        let exists = folder.join(pattern).exists();
        return exists.then(|| pattern.to_owned()).into_iter().collect();
    }
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .filter(|name| !name.starts_with('.') && is_like(name, pattern))
        .collect()
}

/// True if `name` matches `pattern`, in which `*` matches any characters.
fn is_like(name: &str, pattern: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or("");
    let Some(mut rest) = name.strip_prefix(first) else {
        return false;
    };
    let middle: Vec<&str> = parts.collect();
    let Some((last, middle)) = middle.split_last() else {
        return rest.is_empty();
    };
    for part in middle {
        match rest.find(part) {
            Some(at) => rest = &rest[at + part.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

/// Images that no row names.
pub(super) struct Unnamed {
    pub(super) images: Vec<PathBuf>,
    /// True if the search ended at the maximum number of files.
    pub(super) has_more: bool,
}

/// Images below `folder` that are not in `named`. Does not follow links.
pub(super) fn unnamed_images(folder: &Path, named: &BTreeSet<PathBuf>) -> Unnamed {
    let mut unnamed = Vec::new();
    let mut folders = vec![folder.to_owned()];
    let mut looked_at = 0;
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            looked_at += 1;
            if looked_at > limits::WALKED_FILES {
                return Unnamed {
                    images: unnamed,
                    has_more: true,
                };
            }
            let path = entry.path();
            match entry.file_type() {
                // A dataset made by TacEva is not part of the lab's recording.
                Ok(kind) if kind.is_dir() && path.join("dataset.toml").is_file() => {}
                Ok(kind) if kind.is_dir() => folders.push(path),
                Ok(kind) if kind.is_file() && is_image(&path) && !named.contains(&path) => {
                    unnamed.push(path);
                }
                _ => {}
            }
        }
    }
    Unnamed {
        images: unnamed,
        has_more: false,
    }
}

fn is_image(path: &Path) -> bool {
    path.extension().is_some_and(|extension| {
        ["png", "jpg", "jpeg", "tif", "tiff"]
            .iter()
            .any(|known| extension.eq_ignore_ascii_case(known))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_match_is_found_at_any_depth() {
        let lab = tempfile::tempdir().expect("a folder");
        fs::create_dir_all(lab.path().join("a/x")).expect("made");
        fs::create_dir_all(lab.path().join("b/x")).expect("made");
        fs::write(lab.path().join("b/x/1.png"), "x").expect("written");
        for (pattern, expected) in [
            ("*/x/*.png", true),
            ("a/x/*.png", false),
            ("b", true),
            ("*/y", false),
        ] {
            assert_eq!(has_match(lab.path(), pattern), expected, "{pattern}");
        }
    }

    #[test]
    fn a_star_stands_for_any_characters_within_a_name() {
        for (name, pattern, expected) in [
            ("run_1.csv", "run_*.csv", true),
            ("run_1.csv", "*", true),
            ("run_1.txt", "run_*.csv", false),
            ("a-b-c", "a*b*c", true),
            ("a-c", "a*b*c", false),
            ("ab", "ab*b", false),
            ("aa", "a*a", true),
            ("a", "a*a", false),
        ] {
            assert_eq!(is_like(name, pattern), expected, "{name} {pattern}");
        }
    }
}
