//! Jobs in the queue of the scheduler.

use super::Submitted;
use super::command::run;
use crate::error::SweepError;

/// Job as listed by the scheduler.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct JobState {
    /// Job number, such as `17_3`.
    pub id: String,
    /// State in the terms of Slurm: `RUNNING`, `PENDING`, …
    pub state: String,
    /// Host that runs the job, or the reason why it waits.
    pub place: String,
}

/// Jobs of `submitted` that are still in the queue of the scheduler.
///
/// # Errors
/// [`SweepError::Scheduler`] with the message of `squeue`.
pub fn queue_of(submitted: &Submitted) -> Result<Vec<JobState>, SweepError> {
    // Lists all jobs of the user, because asking for a forgotten job number is an error.
    let words = ["--noheader", "--array", "--me", "--format=%i|%T|%R"].map(str::to_owned);
    let text = run("squeue", &words)?;
    let own = submitted.numbers();
    let jobs = text.lines().filter_map(|line| {
        let mut parts = line.trim().splitn(3, '|');
        let (id, state, place) = (parts.next()?, parts.next()?, parts.next()?);
        let number = id.split('_').next()?;
        own.iter().any(|known| known == number).then(|| JobState {
            id: id.to_owned(),
            state: state.to_owned(),
            place: place.to_owned(),
        })
    });
    Ok(jobs.collect())
}
