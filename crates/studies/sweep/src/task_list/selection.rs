//! Selects tasks of a list, and counts the progress of a sweep.

use super::TaskList;
use crate::condition::Condition;
use crate::error::SweepError;
use crate::folder::SweepFolder;

/// Progress of a sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counts {
    /// Number of tasks with a result.
    pub scored: usize,
    /// Number of failed tasks.
    pub failed: usize,
    /// Number of tasks not run yet.
    pub left: usize,
}

impl TaskList {
    /// Indices of the tasks that `only` selects; indices of all tasks if `only` is `None`.
    ///
    /// # Errors
    /// [`SweepError::Condition`] for a name that no task has, and for a condition that selects no task.
    pub fn matching(&self, only: Option<&Condition>) -> Result<Vec<usize>, SweepError> {
        let Some(only) = only else {
            return Ok((0..self.tasks.len()).collect());
        };
        let settings = self
            .tasks
            .iter()
            .flat_map(|task| task.settings.keys().cloned());
        only.check_names(&settings.collect())?;
        let matching: Vec<usize> = (0..self.tasks.len())
            .filter(|at| only.holds(&self.tasks[*at]))
            .collect();
        match matching.is_empty() {
            true => Err(SweepError::Condition {
                text: only.text().to_owned(),
                problem: format!("this selects none of the {} tasks", self.tasks.len()),
            }),
            false => Ok(matching),
        }
    }

    /// Indices among `wanted` of the tasks that must still be run.
    ///
    /// # Errors
    /// [`SweepError`] if the folder cannot be read.
    pub fn without_result(
        &self,
        folder: &SweepFolder,
        wanted: &[usize],
        retry_failed: bool,
    ) -> Result<Vec<usize>, SweepError> {
        let (results, failures) = (folder.results()?, folder.failures()?);
        let is_left = |at: &usize| {
            let key = self.tasks[*at].key.as_str();
            !results.contains(key) && (retry_failed || !failures.contains(key))
        };
        Ok(wanted.iter().copied().filter(is_left).collect())
    }

    /// Progress of the sweep, counted from file names in its folder.
    ///
    /// # Errors
    /// [`SweepError`] if the folder cannot be read.
    pub fn counts(&self, folder: &SweepFolder) -> Result<Counts, SweepError> {
        let (results, failures) = (folder.results()?, folder.failures()?);
        let mut counts = Counts::default();
        for task in &self.tasks {
            let key = task.key.as_str();
            match (results.contains(key), failures.contains(key)) {
                (true, _) => counts.scored += 1,
                (false, true) => counts.failed += 1,
                (false, false) => counts.left += 1,
            }
        }
        Ok(counts)
    }
}
