//! Jobs that the scheduler still has.

use super::Submitted;
use super::command::run;
use crate::error::SweepError;

/// A job as the scheduler lists it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct JobState {
    /// Its number: `17_3`.
    pub id: String,
    /// `RUNNING`, `PENDING`, …
    pub state: String,
    /// Where it runs, or why it waits.
    pub place: String,
}

/// The jobs of `submitted` that the scheduler still has.
///
/// # Errors
/// [`SweepError::Scheduler`] with the words of `squeue`.
pub fn queue_of(submitted: &Submitted) -> Result<Vec<JobState>, SweepError> {
    // All of the user, and not those by number: once the scheduler has forgotten a number, asking for it is an error.
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
