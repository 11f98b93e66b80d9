//! Jobs submitted, remembered and cancelled.

use std::fs;

use serde::{Deserialize, Serialize};

use super::Submission;
use super::command::run;
use crate::error::SweepError;
use crate::folder::SweepFolder;

/// The record of what was submitted.
const RECORD: &str = "jobs.json";

/// What was submitted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Submitted {
    /// The numbers of the arrays.
    pub arrays: Vec<String>,
    /// The number of the job that collects.
    pub collect: Option<String>,
}

/// Submits the arrays, and the job that collects once all of them have ended.
///
/// # Errors
/// [`SweepError::Scheduler`] with the words of `sbatch`; what was submitted before is cancelled then.
pub fn submit(folder: &SweepFolder, submission: &Submission) -> Result<Submitted, SweepError> {
    let mut submitted = Submitted::default();
    let done = submit_all(submission, &mut submitted);
    if let Err(error) = done {
        // Half a sweep that nobody collects would only take time.
        drop(run("scancel", &submitted.arrays));
        return Err(error);
    }
    let path = folder.slurm().join(RECORD);
    let text = serde_json::to_string(&submitted).map_err(|error| SweepError::Kept {
        path: path.clone(),
        problem: error.to_string(),
    })?;
    folder.write(&path, text.as_bytes())?;
    Ok(submitted)
}

fn submit_all(submission: &Submission, submitted: &mut Submitted) -> Result<(), SweepError> {
    let number = |words: String| {
        // `17` or `17;cluster`.
        let first = words.trim().split(';').next().unwrap_or_default();
        first.to_owned()
    };
    for array in &submission.arrays {
        let said = run(
            "sbatch",
            &[
                "--parsable".to_owned(),
                array.to_string_lossy().into_owned(),
            ],
        )?;
        submitted.arrays.push(number(said));
    }
    let mut words = vec!["--parsable".to_owned()];
    if !submitted.arrays.is_empty() {
        // After any end: who collects knows what is missing.
        words.push(format!(
            "--dependency=afterany:{}",
            submitted.arrays.join(":")
        ));
        words.push("--kill-on-invalid-dep=yes".to_owned());
    }
    words.push(submission.collect.to_string_lossy().into_owned());
    submitted.collect = Some(number(run("sbatch", &words)?));
    Ok(())
}

impl Submitted {
    /// What was submitted last; `None` if nothing was.
    ///
    /// # Errors
    /// [`SweepError`] if the record cannot be read.
    pub fn read(folder: &SweepFolder) -> Result<Option<Submitted>, SweepError> {
        let path = folder.slurm().join(RECORD);
        match fs::read_to_string(&path) {
            Ok(text) => serde_json::from_str(&text)
                .map(Some)
                .map_err(|error| SweepError::Kept {
                    path,
                    problem: error.to_string(),
                }),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(SweepError::io("read", &path)(error)),
        }
    }

    pub(super) fn numbers(&self) -> Vec<String> {
        self.arrays.iter().chain(&self.collect).cloned().collect()
    }

    /// Cancels all of it.
    ///
    /// # Errors
    /// [`SweepError::Scheduler`] with the words of `scancel`.
    pub fn cancel(&self) -> Result<(), SweepError> {
        run("scancel", &self.numbers()).map(drop)
    }
}
