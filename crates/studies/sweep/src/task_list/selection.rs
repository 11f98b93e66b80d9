//! Which tasks of a list are meant, and how far they are.

use super::TaskList;
use crate::condition::Condition;
use crate::error::SweepError;
use crate::folder::SweepFolder;

/// How far a sweep is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counts {
    /// Tasks with a result.
    pub scored: usize,
    /// Tasks that failed.
    pub failed: usize,
    /// Tasks without either.
    pub left: usize,
}

impl TaskList {
    /// The positions of the tasks of which `only` holds; of all without it.
    ///
    /// # Errors
    /// [`SweepError::Condition`] for a word that no task has, and where it holds of none.
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
                problem: format!("none of the {} tasks is meant", self.tasks.len()),
            }),
            false => Ok(matching),
        }
    }

    /// Those of the tasks at `wanted` that are still to be carried out.
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

    /// How far the sweep is, by the names of its files.
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
