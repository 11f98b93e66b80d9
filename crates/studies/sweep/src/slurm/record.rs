//! Sealed record of submitted jobs, and their cancellation.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::command::run;
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::seal;

/// Schema of the record.
const SCHEMA: &str = "taceva.sweep-jobs/1.0";

/// Submitted jobs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Submitted {
    /// Job ids of the arrays.
    pub arrays: Vec<String>,
    /// Job id of the job that collects the results, if submitted.
    pub collect: Option<String>,
}

/// Content of the record file.
#[derive(Serialize, Deserialize)]
struct Record {
    schema: String,
    #[serde(flatten)]
    submitted: Submitted,
}

impl Submitted {
    pub(super) fn write(&self, folder: &SweepFolder) -> Result<(), SweepError> {
        let path = path_in(folder);
        let record = Record {
            schema: SCHEMA.to_owned(),
            submitted: self.clone(),
        };
        let text = seal::text(&record).map_err(|problem| SweepError::Kept {
            path: path.clone(),
            problem,
        })?;
        folder.write(&path, text.as_bytes())
    }

    /// Reads the last submission; `None` if there was none.
    ///
    /// # Errors
    /// [`SweepError`] if the record cannot be read or was edited, because cancelling by an edited record could cancel other jobs.
    pub fn read(folder: &SweepFolder) -> Result<Option<Submitted>, SweepError> {
        let path = path_in(folder);
        let Some(text) = seal::read(&path)? else {
            return Ok(None);
        };
        let wrong = |problem: String| SweepError::Kept {
            path: path.clone(),
            problem: format!(
                "{problem}; remove the file, and check with `squeue --me` for remaining jobs"
            ),
        };
        let record: Record = seal::value(&text).map_err(wrong)?;
        match record.schema == SCHEMA {
            true => Ok(Some(record.submitted)),
            false => Err(wrong(format!(
                "schema `{}`, expected `{SCHEMA}`",
                record.schema
            ))),
        }
    }

    pub(super) fn numbers(&self) -> Vec<String> {
        self.arrays.iter().chain(&self.collect).cloned().collect()
    }

    /// Cancels all jobs.
    ///
    /// # Errors
    /// [`SweepError::Scheduler`] with the message of `scancel`.
    pub fn cancel(&self) -> Result<(), SweepError> {
        run("scancel", &self.numbers()).map(drop)
    }
}

fn path_in(folder: &SweepFolder) -> PathBuf {
    folder.slurm().join("jobs.json")
}
