//! One worker: claims a task, runs it, and records its outcome.

use std::num::NonZeroUsize;
use std::time::Duration;

use taceva_core::caught;
use taceva_dataset::SensorFile;
use taceva_evaluate::{Claim, Watch, Work};

use super::log::TaskLog;
use super::{Runner, Shared, lock};
use crate::error::SweepError;
use crate::failure::Failure;
use crate::outcome::{Common, Outcome, carry_out, is_stop};
use crate::task::Task;
use crate::times::Timer;

/// Interval at which a worker checks if another worker has finished a task.
const LOOK_EVERY: Duration = Duration::from_millis(200);

impl Runner<'_> {
    /// Runs tasks that no other worker has claimed, until no task is left.
    pub(super) fn work(&self, shared: &Shared, sensor: Option<&SensorFile>, threads: NonZeroUsize) {
        let mut others: Vec<(usize, Watch)> = Vec::new();
        while !self.progress.is_cancelled() {
            let next = lock(&shared.left).pop_front();
            let Some(at) = next else {
                // Waits for tasks that other workers have claimed, here or on another machine, because they may end without a result.
                let Some((at, mut watch)) = others.pop() else {
                    return;
                };
                let task = &self.list.tasks[at];
                if self.folder.result(&task.key).exists() {
                    self.done(shared, at, Outcome::Scored);
                } else if self.folder.failure(&task.key).exists() && !self.retry_failed {
                    let failure = Failure::read(self.folder, &task.key);
                    let reason = failure
                        .ok()
                        .flatten()
                        .map_or_else(String::new, |failure| failure.reason);
                    self.done(shared, at, Outcome::Failed(reason));
                } else if watch.clear().unwrap_or(true) {
                    lock(&shared.left).push_back(at);
                } else {
                    others.insert(0, (at, watch));
                    std::thread::sleep(LOOK_EVERY);
                }
                continue;
            };
            let task = &self.list.tasks[at];
            let path = self.folder.claim(&task.key);
            match Claim::take(&path) {
                Err(error) => {
                    let error = SweepError::io("claim", &path)(error);
                    self.done(shared, at, Outcome::Failed(error.to_string()));
                }
                Ok(None) => others.push((at, Watch::new(&path))),
                Ok(Some(claim)) => {
                    let outcome = self.attempt(task, sensor, threads);
                    drop(claim);
                    match outcome {
                        Outcome::Stopped => lock(&shared.left).push_front(at),
                        outcome => self.done(shared, at, outcome),
                    }
                }
            }
        }
        let mut left = lock(&shared.left);
        left.extend(others.into_iter().map(|(at, _)| at));
    }

    fn done(&self, shared: &Shared, at: usize, outcome: Outcome) {
        let mut ran = lock(&shared.ran);
        match outcome {
            Outcome::Scored => ran.scored += 1,
            Outcome::Failed(reason) => ran.failed.push((at, reason)),
            Outcome::Stopped => {}
        }
        drop(ran);
        self.progress.advance(1);
    }

    fn attempt(&self, task: &Task, sensor: Option<&SensorFile>, threads: NonZeroUsize) -> Outcome {
        // Another worker may have finished it after the folder was read and before the claim.
        if self.folder.result(&task.key).exists() {
            return Outcome::Scored;
        }
        let log = TaskLog::new(self.folder, task, self.progress);
        let timer = Timer::start();
        let common = Common {
            folder: self.folder,
            models: self.models,
            list: self.list,
            sensor,
        };
        let work = Work {
            jobs: threads,
            progress: &log,
            cache: self.cache,
        };
        let done = caught(|| carry_out(task, common, work));
        let reason = match done {
            Ok(Ok(())) => {
                log.say("scored");
                timer.keep(self.folder, &task.key);
                // Removes the failure record of an earlier attempt, if any.
                drop(Failure::forget(self.folder, &task.key));
                return Outcome::Scored;
            }
            Ok(Err(error)) if is_stop(&error) => {
                log.say("stopped");
                return Outcome::Stopped;
            }
            Ok(Err(error @ SweepError::Io { .. })) => {
                // A full disk or a missing folder is not the fault of the task, so it is retried next time.
                log.say(&format!("not run: {error}"));
                return Outcome::Failed(error.to_string());
            }
            Ok(Err(error)) => task.without_folders(&error.to_string(), self.folder),
            Err(panic) => format!("internal error, a bug of TacEva: {panic}"),
        };
        log.say(&format!("failed: {reason}"));
        timer.keep(self.folder, &task.key);
        let failure = Failure {
            key: task.key.clone(),
            reason,
        };
        match failure.write(self.folder) {
            Ok(()) => Outcome::Failed(failure.reason),
            // As for a full disk, the collector finds neither a result nor a failure.
            Err(error) => Outcome::Failed(format!("{}; {error}", failure.reason)),
        }
    }
}
