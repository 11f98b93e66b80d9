//! Digests of the source files in the format of `sha256sum`, and files that differ from them.

use std::collections::BTreeMap;
use std::fmt;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::Progress;
use taceva_dataset::internal::{layout, limits, open_regular, ordered_map, shown};
use taceva_dataset::{Dataset, DatasetError, Digest};

use crate::error::{ImportError, table_error};
use crate::source_folder::{SourceFolder, files_below};

/// Maximum number of differences named in a message.
const NAMED: usize = 8;

/// Digests of files by name, for one source folder or for several from which rows were added.
///
/// ```
/// use taceva_import::SourceSums;
///
/// let lab = tempfile::tempdir()?;
/// std::fs::write(lab.path().join("labels.csv"), "Fz\n1\n")?;
/// let list = lab.path().join("SHA256SUMS");
/// std::fs::write(&list, format!("{}  labels.csv\n", "0".repeat(64)))?;
/// let sums = SourceSums::read(&list)?;
/// let jobs = std::num::NonZeroUsize::MIN;
/// let differences = sums.differences_of_all(lab.path(), jobs, &taceva_core::SilentProgress)?;
/// assert!(differences[0].to_string().starts_with("labels.csv has changed"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceSums {
    /// Path of the list.
    list: PathBuf,
    folders: Vec<BTreeMap<String, Digest>>,
}

/// Difference between a file and its recorded digest.
///
/// ```
/// use taceva_import::SourceDifference;
///
/// let absent = SourceDifference::Absent { name: "labels.csv".to_owned() };
/// assert_eq!(absent.to_string(), "labels.csv is absent");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum SourceDifference {
    /// File whose bytes have a different digest.
    Changed {
        /// Name within the folder.
        name: String,
        /// Digest in the list.
        expected: Digest,
        /// Digest of the present bytes.
        found: Digest,
    },
    /// File that is in the list, but not in the folder.
    Absent {
        /// Name within the folder.
        name: String,
    },
    /// File that is in the folder, but not in the list.
    Unnamed {
        /// Name within the folder.
        name: String,
    },
}

impl fmt::Display for SourceDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SourceDifference::Changed {
                name,
                expected,
                found,
            } => write!(
                f,
                "{} has changed: expected {expected}, found {found}",
                shown(name)
            ),
            SourceDifference::Absent { name } => write!(f, "{} is absent", shown(name)),
            SourceDifference::Unnamed { name } => {
                write!(f, "{} is not named in the list", shown(name))
            }
        }
    }
}

impl SourceSums {
    /// Reads a list in the format of `sha256sum`.
    ///
    /// # Errors
    /// [`ImportError::Table`] naming the invalid line; [`ImportError::Dataset`] if the list cannot be read.
    pub fn read(list: &Path) -> Result<SourceSums, ImportError> {
        let bytes = taceva_dataset::internal::read_capped(list, limits::SOURCES_BYTES)?;
        let text = taceva_dataset::internal::utf8(list, bytes)?;
        SourceSums::parse(list, &text)
    }

    /// Digests of the source files that the dataset stores; `None` if it stores none.
    ///
    /// # Errors
    /// Errors of [`Dataset::source_sums`].
    pub fn of_dataset(dataset: &Dataset) -> Result<Option<SourceSums>, ImportError> {
        let list = dataset.path().join(layout::SOURCES);
        let text = dataset.source_sums()?;
        text.map(|text| SourceSums::parse(&list, &text)).transpose()
    }

    fn parse(list: &Path, text: &str) -> Result<SourceSums, ImportError> {
        let mut folders = vec![BTreeMap::new()];
        for (number, line) in text.lines().enumerate() {
            if line.starts_with('#') {
                folders.push(BTreeMap::new());
                continue;
            }
            let (name, digest) = entry(line).ok_or_else(|| {
                table_error!(
                    list,
                    "line {}: `{}` is not a line of sha256sum; expected 64 hexadecimal digits, two spaces and a name: write the list with `sha256sum FILES > SHA256SUMS`",
                    number + 1,
                    shown(line)
                )
            })?;
            let folder = folders.last_mut().expect("the list begins with a folder");
            folder.insert(name, digest);
        }
        folders.retain(|folder| !folder.is_empty());
        Ok(SourceSums {
            list: list.to_owned(),
            folders,
        })
    }

    /// Differences between the listed files and the files in `folder`. For rows added from several folders, compares with the most similar list.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] if a file cannot be read, or the work is cancelled.
    pub fn differences(
        &self,
        folder: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<Vec<SourceDifference>, ImportError> {
        let names = self.folders.iter().flat_map(BTreeMap::keys);
        let names: Vec<&String> = names.collect();
        let paths: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
        let found = digests(&paths, jobs, progress)?;
        let found: BTreeMap<&String, Option<Digest>> = names.into_iter().zip(found).collect();
        let of_each = self.folders.iter().map(|expected| {
            let differing = expected.iter().filter_map(|(name, expected)| {
                let name = name.clone();
                match found.get(&name).copied().flatten() {
                    None => Some(SourceDifference::Absent { name }),
                    Some(found) if found != *expected => Some(SourceDifference::Changed {
                        name,
                        expected: *expected,
                        found,
                    }),
                    Some(_) => None,
                }
            });
            differing.collect::<Vec<_>>()
        });
        Ok(of_each.min_by_key(Vec::len).unwrap_or_default())
    }

    /// Same as [`differences`](SourceSums::differences), plus every unlisted file below `folder`, except the list itself and datasets in
    /// `folder`.
    ///
    /// # Errors
    /// Errors of [`differences`](SourceSums::differences).
    pub fn differences_of_all(
        &self,
        folder: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<Vec<SourceDifference>, ImportError> {
        let mut differences = self.differences(folder, jobs, progress)?;
        let own = self.list.canonicalize().ok();
        for path in files_below(folder) {
            let name = inside(folder, &path);
            let is_named = self.folders.iter().any(|named| named.contains_key(&name));
            if !is_named && path.canonicalize().ok() != own {
                differences.push(SourceDifference::Unnamed { name });
            }
        }
        differences.sort();
        Ok(differences)
    }

    /// Checks that the files in `folder` match the list.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] naming the files that differ; otherwise errors of [`differences_of_all`](SourceSums::differences_of_all).
    pub fn verify(
        &self,
        folder: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<(), ImportError> {
        let differences = self.differences_of_all(folder, jobs, progress)?;
        if differences.is_empty() {
            return Ok(());
        }
        let mut named: Vec<String> = differences
            .iter()
            .take(NAMED)
            .map(ToString::to_string)
            .collect();
        if differences.len() > NAMED {
            named.push(format!("and {} more", differences.len() - NAMED));
        }
        Err(ImportError::request(
            folder,
            format!(
                "differs from {}: {}; copy the recording again, or write a new list if the files are right",
                shown(&self.list.to_string_lossy()),
                named.join("; ")
            ),
        ))
    }

    /// Number of listed files.
    pub fn files(&self) -> usize {
        self.folders.iter().map(BTreeMap::len).sum()
    }
}

/// List of the files read in `folder`, each with its digest. Files whose path is not valid UTF-8 are left out.
pub(crate) fn list_of(
    folder: &SourceFolder,
    jobs: NonZeroUsize,
    progress: &dyn Progress,
) -> Result<String, ImportError> {
    let mut paths: Vec<PathBuf> = folder.files_read();
    paths.retain(|path| path.to_str().is_some());
    let found = digests(&paths, jobs, progress)?;
    let lines = paths.iter().zip(found).filter_map(|(path, digest)| {
        let digest = digest?.to_string();
        let digits = digest.strip_prefix("sha256:")?;
        let name = folder.inside(path, "");
        let escaped = name.replace('\\', "\\\\").replace('\n', "\\n");
        let mark = if escaped == name { "" } else { "\\" };
        Some(format!("{mark}{digits}  {escaped}\n"))
    });
    Ok(lines.collect())
}

/// Name and digest on a line; `None` for an invalid line.
fn entry(line: &str) -> Option<(String, Digest)> {
    let (line, is_escaped) = match line.strip_prefix('\\') {
        Some(line) => (line, true),
        None => (line, false),
    };
    let (digits, name) = line.split_at_checked(64)?;
    let name = name
        .strip_prefix("  ")
        .or_else(|| name.strip_prefix(" *"))?;
    let name = match is_escaped {
        true => name.replace("\\n", "\n").replace("\\\\", "\\"),
        false => name.to_owned(),
    };
    let name = name.strip_prefix("./").unwrap_or(&name).to_owned();
    let digest = format!("sha256:{}", digits.to_ascii_lowercase());
    Some((name, digest.parse().ok()?))
}

/// Digest of each path; `None` if the path is not a file.
fn digests(
    paths: &[PathBuf],
    jobs: NonZeroUsize,
    progress: &dyn Progress,
) -> Result<Vec<Option<Digest>>, ImportError> {
    let mut digests = Vec::with_capacity(paths.len());
    let digest = |item: usize| -> Result<Option<Digest>, ImportError> {
        let path = &paths[item];
        if !path.is_file() {
            return Ok(None);
        }
        let (mut file, _) = open_regular(path, u64::MAX)?;
        let digest = Digest::of_reader(&mut file);
        digest.map(Some).map_err(ImportError::io("read", path))
    };
    ordered_map(paths.len(), jobs, digest, |_, digest| {
        if progress.is_cancelled() {
            return Err(ImportError::from(DatasetError::Cancelled));
        }
        digests.push(digest?);
        Ok(())
    })?;
    Ok(digests)
}

fn inside(folder: &Path, path: &Path) -> String {
    let inside = path.strip_prefix(folder).unwrap_or(path);
    inside.to_string_lossy().replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use std::fs;

    use taceva_core::SilentProgress;

    use super::*;

    #[test]
    fn changed_absent_and_unnamed_files_are_named_and_the_list_itself_is_not() {
        let lab = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| {
            fs::write(lab.path().join(name), text).expect("written");
        };
        fs::create_dir(lab.path().join("frames")).expect("made");
        write("labels.csv", "Fz\n");
        write("frames/0.png", "picture");
        let line = |name: &str, text: &str| {
            let digest = Digest::of(text.as_bytes()).to_string();
            format!("{}  {name}\n", &digest[7..])
        };
        let whole = line("labels.csv", "Fz\n") + &line("./frames/0.png", "picture");
        write("SHA256SUMS", &whole);
        let verify = || {
            let sums = SourceSums::read(&lab.path().join("SHA256SUMS"))?;
            sums.verify(lab.path(), NonZeroUsize::MIN, &SilentProgress)
        };
        verify().expect("as the list says");
        write("notes.txt", "mine");
        write("labels.csv", "Fx\n");
        fs::remove_file(lab.path().join("frames/0.png")).expect("removed");
        let refused = verify().expect_err("three differ").to_string();
        for part in [
            "labels.csv has changed: expected sha256:",
            "frames/0.png is absent",
            "notes.txt is not named in the list",
        ] {
            assert!(refused.contains(part), "{part}: {refused}");
        }
        write("SHA256SUMS", "labels.csv\n");
        let refused = verify().expect_err("no list").to_string();
        assert!(refused.contains("line 1"), "{refused}");
    }
}
