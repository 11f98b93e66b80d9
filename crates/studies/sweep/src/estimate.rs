//! Estimated cost of a sweep, from the cost of finished tasks.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::task_list::TaskList;
use crate::times::TaskTime;

/// State of a sweep, and the estimated cost of the remaining tasks.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// Number of selected tasks.
    pub tasks: usize,
    /// Number of selected tasks with a result.
    pub found: usize,
    /// Number of selected tasks that failed earlier.
    pub failed: usize,
    /// Time of the remaining tasks on one worker; `None` before any task was timed.
    pub time: Option<Duration>,
    /// Bytes that the remaining tasks will write; `None` before any task was timed.
    pub bytes: Option<u64>,
}

impl Estimate {
    /// Estimates the cost of the tasks at the indices `wanted` from tasks with the same configuration. Without such tasks, uses the mean of all timed
    /// tasks.
    ///
    /// # Errors
    /// [`SweepError`] if the folder cannot be read.
    pub fn of(
        folder: &SweepFolder,
        list: &TaskList,
        wanted: &[usize],
        retry_failed: bool,
    ) -> Result<Estimate, SweepError> {
        let (results, failures) = (folder.results()?, folder.failures()?);
        let mut known: BTreeMap<String, (f64, u64)> = BTreeMap::new();
        let (mut all, mut bytes) = ((0.0, 0_u64), (0_u64, 0_u64));
        for task in &list.tasks {
            if !results.contains(task.key.as_str()) {
                continue;
            }
            if let Some(time) = TaskTime::read(folder, &task.key) {
                let of = known.entry(task.configuration()).or_default();
                for sum in [of, &mut all] {
                    sum.0 += time.seconds;
                    sum.1 += 1;
                }
                bytes.0 += time.bytes;
                bytes.1 += 1;
            }
        }
        let mean = |(seconds, count): (f64, u64)| seconds / count as f64;
        let mut estimate = Estimate {
            tasks: wanted.len(),
            ..Estimate::default()
        };
        let (mut seconds, mut left) = (0.0, 0_u64);
        for &at in wanted {
            let task = &list.tasks[at];
            if results.contains(task.key.as_str()) {
                estimate.found += 1;
                continue;
            }
            if failures.contains(task.key.as_str()) {
                estimate.failed += 1;
                if !retry_failed {
                    continue;
                }
            }
            left += 1;
            seconds += mean(known.get(&task.configuration()).copied().unwrap_or(all));
        }
        if all.1 > 0 || left == 0 {
            estimate.time = Duration::try_from_secs_f64(seconds).ok();
            estimate.bytes = Some(bytes.0.checked_div(bytes.1).unwrap_or(0) * left);
        }
        Ok(estimate)
    }
}
