//! Submission of jobs to the scheduler.

use super::command::run;
use super::{Submission, Submitted};
use crate::error::SweepError;
use crate::folder::SweepFolder;

/// Submits the arrays, and the job that collects the results after all arrays have ended.
///
/// # Errors
/// [`SweepError::Scheduler`] with the message of `sbatch`. Jobs submitted before the error are cancelled.
pub fn submit(folder: &SweepFolder, submission: &Submission) -> Result<Submitted, SweepError> {
    let mut submitted = Submitted::default();
    let done = submit_all(submission, &mut submitted);
    if let Err(error) = done {
        // A partial sweep without its collecting job would only waste time.
        drop(run("scancel", &submitted.arrays));
        return Err(error);
    }
    submitted.write(folder)?;
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
        // After any end, because the collecting job also reports missing results.
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
