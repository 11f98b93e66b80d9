//! Workers that run tasks in this process.

mod log;
mod worker;

use std::collections::VecDeque;
use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};

use taceva_core::Progress;
use taceva_evaluate::Cache;
use taceva_models::Models;

use crate::error::SweepError;
use crate::failure::Failure;
use crate::folder::SweepFolder;
use crate::task_list::TaskList;

/// Runner of tasks, with several workers in this process.
#[derive(Clone, Copy)]
pub struct Runner<'a> {
    /// Tasks of the sweep.
    pub list: &'a TaskList,
    /// Folder in which results are stored.
    pub folder: &'a SweepFolder,
    /// Available models.
    pub models: &'a Models,
    /// Cache shared by all tasks, if any.
    pub cache: Option<&'a Cache>,
    /// Number of concurrent tasks.
    pub jobs: NonZeroUsize,
    /// True if failed tasks are retried.
    pub retry_failed: bool,
    /// Observer that receives progress, and can cancel the run.
    pub progress: &'a dyn Progress,
}

/// Outcome of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Ran {
    /// Number of tasks that already had a result.
    pub found: usize,
    /// Number of tasks scored during this run, by this or another process.
    pub scored: usize,
    /// Failed tasks: index in the list, and reason.
    pub failed: Vec<(usize, String)>,
    /// True if the run was cancelled before all tasks were done.
    pub is_stopped: bool,
}

impl Runner<'_> {
    /// Runs the tasks at the indices `wanted` that have no result yet. If a task fails, its reason is stored, and the other tasks continue.
    ///
    /// # Errors
    /// [`SweepError`] if the folder cannot be used.
    pub fn run(&self, wanted: &[usize]) -> Result<Ran, SweepError> {
        self.folder.make()?;
        taceva_evaluate::clear_dead_claims(&self.folder.claims());
        let results = self.folder.results()?;
        let failures = self.folder.failures()?;
        let mut ran = Ran::default();
        let mut left = VecDeque::new();
        for &at in wanted {
            let key = self.list.tasks[at].key.as_str();
            if results.contains(key) {
                ran.found += 1;
            } else if failures.contains(key) && !self.retry_failed {
                let failure = Failure::read(self.folder, &self.list.tasks[at].key)?;
                ran.failed.push((
                    at,
                    failure.map_or_else(String::new, |failure| failure.reason),
                ));
            } else {
                left.push_back(at);
            }
        }
        if left.is_empty() {
            return Ok(ran);
        }
        let sensor = self.list.read_sensor()?;
        self.progress.begin("tasks", Some(left.len() as u64));
        let workers = self.jobs.get().min(left.len());
        let threads = NonZeroUsize::new(self.jobs.get() / workers).unwrap_or(NonZeroUsize::MIN);
        let shared = Shared {
            left: Mutex::new(left),
            ran: Mutex::new(ran),
        };
        std::thread::scope(|scope| {
            for _ in 0..workers {
                scope.spawn(|| self.work(&shared, sensor.as_ref(), threads));
            }
        });
        self.progress.end();
        let mut ran = shared
            .ran
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        let left = shared
            .left
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        ran.is_stopped |= !left.is_empty();
        ran.failed.sort();
        Ok(ran)
    }
}

/// State that workers share.
struct Shared {
    left: Mutex<VecDeque<usize>>,
    ran: Mutex<Ran>,
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
