//! The recordings of a sweep: found by their names, told apart by what they hold.

use std::collections::BTreeSet;
use std::path::PathBuf;

use taceva_core::shown;
use taceva_dataset::Digest;

use crate::error::SweepError;
use crate::file::SweepFile;
use crate::glob;
use crate::recording::opened;

/// A recording that tasks are of.
pub(super) struct Recording {
    pub(super) name: String,
    pub(super) path: PathBuf,
    pub(super) digest: Digest,
}

/// The recordings that the file names, patterns resolved.
pub(super) fn named(file: &SweepFile) -> Result<Vec<String>, SweepError> {
    let mut names: Vec<String> = Vec::new();
    for text in &file.datasets {
        if !glob::is_pattern(text) {
            names.push(text.clone());
            continue;
        }
        let found = glob::folders(file.folder(), text);
        let found = found.map_err(SweepError::io("list", file.folder()))?;
        if found.is_empty() {
            return Err(file.wrong(
                "datasets",
                format!(
                    "`{}`: no folder matches in {}",
                    shown(text),
                    shown(file.folder())
                ),
            ));
        }
        names.extend(found);
    }
    let mut known = BTreeSet::new();
    names.retain(|name| known.insert(name.clone()));
    Ok(names)
}

/// Opens each, once, for its digest; no frame is read. Two names of one recording are refused: of both there would be one result.
pub(super) fn open(file: &SweepFile, names: Vec<String>) -> Result<Vec<Recording>, SweepError> {
    let mut recordings: Vec<Recording> = Vec::with_capacity(names.len());
    for name in names {
        let path = file.folder().join(&name);
        // Absolute, since a job of a scheduler begins elsewhere.
        let path = std::path::absolute(&path).map_err(SweepError::io("find", &path))?;
        let (_, digest) = opened(&path)?;
        recordings.push(Recording { name, path, digest });
    }
    for (at, one) in recordings.iter().enumerate() {
        let alike = recordings[..at]
            .iter()
            .find(|other| other.digest == one.digest);
        if let Some(other) = alike {
            let problem = format!(
                "`{}` and `{}` are one recording, the same to the last byte of its header; name it once, or give the copy of another unit its serial number",
                shown(&other.name),
                shown(&one.name)
            );
            return Err(file.wrong("datasets", problem));
        }
    }
    Ok(recordings)
}
