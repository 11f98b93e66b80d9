//! Recordings of a sweep: found by name, identified by content.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_dataset::{DatasetError, Digest};

use crate::error::SweepError;
use crate::file::SweepFile;
use crate::glob;
use crate::recording::opened;
use crate::scene_recording::SceneRecording;

/// Recording that is named but not opened yet.
pub(super) struct Named {
    name: String,
    path: PathBuf,
    /// Placeholder for the digest until the scene has been acquired; `None` for a recording that the file names.
    planned: Option<Digest>,
}

/// An opened recording, for tasks.
pub(super) struct Recording {
    pub(super) name: String,
    pub(super) path: PathBuf,
    pub(super) digest: Digest,
}

impl Named {
    /// Key of the sweep file under which the recording is named.
    fn key(&self) -> &'static str {
        match self.planned {
            None => "datasets",
            Some(_) => "scenes",
        }
    }

    /// Digest of the recording at `path`, or its placeholder. Rejects a recording without a task that `file` names.
    fn digest(&self, path: &Path, file: &SweepFile) -> Result<Digest, SweepError> {
        match (opened(path, file.view.as_deref()), self.planned) {
            (Err(SweepError::Dataset(DatasetError::NoDataset { .. })), Some(planned)) => {
                Ok(planned)
            }
            (found, _) => {
                let (dataset, digest) = found?;
                for name in &file.labels {
                    dataset.of_task(name)?;
                }
                Ok(digest)
            }
        }
    }
}

/// Recordings that the file names, with patterns expanded, and recordings of its scenes.
pub(super) fn named(file: &SweepFile, scenes: &[SceneRecording]) -> Result<Vec<Named>, SweepError> {
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
    for SceneRecording { name, .. } in scenes {
        if !known.insert(name.clone()) {
            let problem = format!(
                "a folder and a recording of a scene are both called `{name}`: write the folder as `./{name}`, or give the scene another \
                 `name`",
                name = shown(name)
            );
            return Err(file.wrong("scenes", problem));
        }
    }
    let folders = names.into_iter().map(|name| Named {
        path: file.folder().join(&name),
        name,
        planned: None,
    });
    let of_scenes = scenes.iter().map(|scene| Named {
        path: scene.path.clone(),
        name: scene.name.clone(),
        planned: Some(scene.planned),
    });
    Ok(folders.chain(of_scenes).collect())
}

/// Opens each recording once for its digest, without reading frames. Rejects two names for one recording, because they would share a result.
pub(super) fn open(file: &SweepFile, all: &[Named]) -> Result<Vec<Recording>, SweepError> {
    let mut recordings: Vec<Recording> = Vec::with_capacity(all.len());
    for one in all {
        // Absolute, because jobs of a scheduler have another working folder.
        let path = std::path::absolute(&one.path).map_err(SweepError::io("find", &one.path))?;
        let digest = one.digest(&path, file)?;
        let alike = recordings.iter().find(|other| other.digest == digest);
        if let Some(other) = alike {
            let problem = format!(
                "`{}` and `{}` are the same recording by their headers: name one of them; for two sensor units, give each its own serial number",
                shown(&other.name),
                shown(&one.name)
            );
            return Err(file.wrong(one.key(), problem));
        }
        recordings.push(Recording {
            name: one.name.clone(),
            path,
            digest,
        });
    }
    Ok(recordings)
}
