//! Failures of tasks, with their reasons.

use std::fs;

use serde::{Deserialize, Serialize};

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::key::TaskKey;

/// Failure of a task, with its reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Failure {
    pub(crate) key: TaskKey,
    pub(crate) reason: String,
}

impl Failure {
    pub(crate) fn write(&self, folder: &SweepFolder) -> Result<(), SweepError> {
        let path = folder.failure(&self.key);
        let text = serde_json::to_string(self).map_err(|error| SweepError::Kept {
            path: path.clone(),
            problem: error.to_string(),
        })?;
        folder.write(&path, text.as_bytes())
    }

    /// Reads the failure of the task with key `key`; `None` if this task did not fail.
    pub(crate) fn read(folder: &SweepFolder, key: &TaskKey) -> Result<Option<Failure>, SweepError> {
        let path = folder.failure(key);
        match fs::read_to_string(&path) {
            Ok(text) => serde_json::from_str(&text)
                .map(Some)
                .map_err(|error| SweepError::Kept {
                    path,
                    problem: format!("{error}; remove the file to run the task again"),
                }),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(SweepError::io("read", &path)(error)),
        }
    }

    /// Removes the failure record of the task with key `key`, if any.
    pub(crate) fn forget(folder: &SweepFolder, key: &TaskKey) -> Result<(), SweepError> {
        let path = folder.failure(key);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(SweepError::io("remove", &path)(error))
            }
            _ => Ok(()),
        }
    }
}
