//! Task list in a sealed file.

use std::fs;
use std::path::{Path, PathBuf};

use taceva_dataset::{Digest, SensorFile};

use super::{SCHEMA, TaskList};
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::seal;

impl TaskList {
    /// Writes the list into `folder` under a name derived from its content, and again as the latest list. Returns the path of the first file.
    ///
    /// # Errors
    /// [`SweepError::Io`] if the list cannot be written.
    pub fn write(&self, folder: &SweepFolder) -> Result<PathBuf, SweepError> {
        let latest = latest(folder);
        let unwritable = |problem: String| SweepError::Kept {
            path: latest.clone(),
            problem,
        };
        let text = seal::text(self).map_err(unwritable)?;
        let digest = Digest::of(text.as_bytes()).as_bytes()[..8]
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect::<String>();
        let lists = folder.path().join("tasks");
        fs::create_dir_all(&lists).map_err(SweepError::io("make", &lists))?;
        let own = lists.join(format!("{digest}.json"));
        if !own.exists() {
            folder.write(&own, text.as_bytes())?;
        }
        if !fs::read(&latest).is_ok_and(|last| last == text.as_bytes()) {
            folder.write(&latest, text.as_bytes())?;
        }
        Ok(own)
    }

    /// Reads the list at `path`.
    ///
    /// # Errors
    /// [`SweepError::Kept`] if the file is not a list, is of another version, or was edited.
    pub fn read(path: &Path) -> Result<TaskList, SweepError> {
        let wrong = |problem: String| SweepError::Kept {
            path: path.to_owned(),
            problem,
        };
        let text = fs::read_to_string(path).map_err(|error| {
            wrong(format!(
                "cannot read the list of tasks: {error}; check that the folder of the sweep is shared with this machine"
            ))
        })?;
        let again = |problem: String| wrong(format!("{problem}; start the sweep again"));
        let head: Head = serde_json::from_str(&text).map_err(|error| again(error.to_string()))?;
        if head.schema != SCHEMA || head.taceva != env!("CARGO_PKG_VERSION") {
            return Err(again(format!(
                "schema {} planned by TacEva {}, expected a list of TacEva {} with schema {SCHEMA}",
                head.schema,
                head.taceva,
                env!("CARGO_PKG_VERSION")
            )));
        }
        seal::value(&text).map_err(again)
    }

    /// Reads the latest list written into `folder`.
    ///
    /// # Errors
    /// Errors of [`read`](TaskList::read).
    pub fn latest(folder: &SweepFolder) -> Result<TaskList, SweepError> {
        TaskList::read(&latest(folder))
    }

    /// Reads the file of sensor facts, and checks that it has not changed since planning.
    ///
    /// # Errors
    /// [`SweepError::Changed`] if the file has changed since planning; [`SweepError`] if it cannot be read.
    pub(crate) fn read_sensor(&self) -> Result<Option<SensorFile>, SweepError> {
        let Some(path) = &self.sensor else {
            return Ok(None);
        };
        let bytes = fs::read(path).map_err(SweepError::io("read", path))?;
        if self
            .sensor_digest
            .is_some_and(|digest| digest != Digest::of(&bytes))
        {
            return Err(SweepError::Changed {
                path: path.clone(),
                problem: "the file has changed since the sweep was planned".to_owned(),
            });
        }
        Ok(Some(SensorFile::read(path)?))
    }
}

/// Beginning of the file, read first because its schema determines the rest.
#[derive(serde::Deserialize)]
struct Head {
    schema: String,
    taceva: String,
}

fn latest(folder: &SweepFolder) -> PathBuf {
    folder.path().join("tasks.json")
}
