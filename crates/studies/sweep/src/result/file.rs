//! Results as sealed files.

use std::fs;

use taceva_dataset::Digest;

use super::{SCHEMA, TaskResult};
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::key::TaskKey;
use crate::seal;

impl TaskResult {
    pub(crate) fn text(&self) -> Result<String, SweepError> {
        seal::text(self).map_err(|problem| SweepError::Kept {
            path: format!("results/{}.json", self.key).into(),
            problem,
        })
    }

    /// Reads the result of the task with the key `key`; `None` if the folder has no such result.
    pub(crate) fn read(
        folder: &SweepFolder,
        key: &TaskKey,
    ) -> Result<Option<TaskResult>, SweepError> {
        let path = folder.result(key);
        let Some(text) = seal::read(&path)? else {
            return Ok(None);
        };
        let wrong = |problem: String| SweepError::Kept {
            path: path.clone(),
            problem: format!("{problem}; remove the file to run the task again"),
        };
        let result: TaskResult = seal::value(&text).map_err(wrong)?;
        if result.schema != SCHEMA {
            return Err(wrong(format!(
                "schema `{}`, expected `{SCHEMA}`",
                result.schema
            )));
        }
        if result.taceva != env!("CARGO_PKG_VERSION") {
            return Err(wrong(format!(
                "the file was written by TacEva {}, but this is {}",
                result.taceva,
                env!("CARGO_PKG_VERSION")
            )));
        }
        if &result.key != key {
            return Err(wrong(format!(
                "the file holds the result of another task, {}",
                result.key
            )));
        }
        Ok(Some(result))
    }

    /// Evaluation of this result, checked against its digest.
    pub(crate) fn read_evaluation(&self, folder: &SweepFolder) -> Result<String, SweepError> {
        let path = folder.evaluation(&self.key);
        let text = fs::read_to_string(&path).map_err(SweepError::io("read", &path))?;
        match Digest::of(text.as_bytes()).to_string() == self.evaluation {
            true => Ok(text),
            false => Err(SweepError::Kept {
                path,
                problem: "the file has changed since the task wrote it; remove this file and the file of the same name in `results` to run the task again".to_owned(),
            }),
        }
    }
}
