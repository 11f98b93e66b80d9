//! Tasks carried out by workers of this process.

use std::any::Any;
use std::collections::VecDeque;
use std::fs::File;
use std::io::Write as _;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use taceva_core::Progress;
use taceva_dataset::SensorFile;
use taceva_models::Models;
use taceva_study::{Cache, Claim, Watch, Work};

use crate::error::SweepError;
use crate::failure::Failure;
use crate::folder::SweepFolder;
use crate::outcome::{Common, Outcome, carry_out, is_stop};
use crate::task::Task;
use crate::task_list::TaskList;
use crate::times::Timer;

/// How often a worker looks whether somebody else is done with a task.
const LOOK_EVERY: Duration = Duration::from_millis(200);

/// Carries tasks out.
#[derive(Clone, Copy)]
pub struct Runner<'a> {
    /// The sweep.
    pub list: &'a TaskList,
    /// Where results are found and kept.
    pub folder: &'a SweepFolder,
    /// The models that there are.
    pub models: &'a Models,
    /// Where tasks find what they have in common.
    pub cache: Option<&'a Cache>,
    /// Tasks at once.
    pub jobs: NonZeroUsize,
    /// Whether tasks that failed before are tried again.
    pub retry_failed: bool,
    /// Receives progress, and may cancel.
    pub progress: &'a dyn Progress,
}

/// What came of the tasks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Ran {
    /// Results that were there before.
    pub found: usize,
    /// Tasks that were scored now, here or by others in the meantime.
    pub scored: usize,
    /// Tasks without a result: the position in the list, and why.
    pub failed: Vec<(usize, String)>,
    /// Whether it was asked to stop, with tasks left.
    pub is_stopped: bool,
}

impl Runner<'_> {
    /// Carries out those of the tasks at `wanted` that have no result yet. A task that fails leaves its reason, and the others go on.
    ///
    /// # Errors
    /// [`SweepError`] if the folder cannot be used.
    pub fn run(&self, wanted: &[usize]) -> Result<Ran, SweepError> {
        self.folder.make()?;
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

    /// One worker: the next task that nobody is at, until there is none.
    fn work(&self, shared: &Shared, sensor: Option<&SensorFile>, threads: NonZeroUsize) {
        let mut others: Vec<(usize, Watch)> = Vec::new();
        while !self.progress.is_cancelled() {
            let next = lock(&shared.left).pop_front();
            let Some(at) = next else {
                // What others are at, here or on another machine, is waited for: they may end without a result.
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
        // Somebody may have made it between the look at the folder and the claim.
        if self.folder.result(&task.key).exists() {
            return Outcome::Scored;
        }
        let log = TaskLog::new(self.folder, task, self.progress);
        let timer = Timer::start();
        let common = Common {
            folder: self.folder,
            models: self.models,
            metrics: &self.list.metrics,
            sensor,
        };
        let work = Work {
            jobs: threads,
            progress: &log,
            cache: self.cache,
        };
        let done = catch_unwind(AssertUnwindSafe(|| carry_out(task, common, work)));
        let reason = match done {
            Ok(Ok(())) => {
                log.say("scored");
                timer.keep(self.folder, &task.key);
                // Of an attempt before.
                drop(Failure::forget(self.folder, &task.key));
                return Outcome::Scored;
            }
            Ok(Err(error)) if is_stop(&error) => {
                log.say("stopped");
                return Outcome::Stopped;
            }
            Ok(Err(error @ SweepError::Io { .. })) => {
                // A full disk, or a folder that is not there, says nothing of the task: it is tried again next time.
                log.say(&format!("not carried out: {error}"));
                return Outcome::Failed(error.to_string());
            }
            Ok(Err(error)) => error.to_string(),
            Err(panic) => format!(
                "an internal error, which is a bug of TacEva: {}",
                words_of(&*panic)
            ),
        };
        log.say(&format!("failed: {reason}"));
        timer.keep(self.folder, &task.key);
        let failure = Failure {
            key: task.key.clone(),
            reason,
        };
        match failure.write(self.folder) {
            Ok(()) => Outcome::Failed(failure.reason),
            // As on a full disk: who collects finds neither a result nor a reason.
            Err(error) => Outcome::Failed(format!("{}; {error}", failure.reason)),
        }
    }
}

/// What workers share.
struct Shared {
    left: Mutex<VecDeque<usize>>,
    ran: Mutex<Ran>,
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn words_of(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned())
}

/// The log of a task: its stages, and how it ended.
struct TaskLog<'a> {
    file: Mutex<Option<File>>,
    whole: &'a dyn Progress,
}

impl<'a> TaskLog<'a> {
    fn new(folder: &SweepFolder, task: &Task, whole: &'a dyn Progress) -> TaskLog<'a> {
        let log = TaskLog {
            file: Mutex::new(
                File::options()
                    .create(true)
                    .append(true)
                    .open(folder.log(&task.key))
                    .ok(),
            ),
            whole,
        };
        let split = task.split.as_deref().unwrap_or("as recorded");
        log.say(&format!(
            "task {} {} {} split {split} seed {}",
            task.key,
            task.dataset,
            task.configuration(),
            task.seed
        ));
        log
    }

    /// Adds a line; a log that cannot be written costs no result.
    fn say(&self, line: &str) {
        if let Some(file) = lock(&self.file).as_mut() {
            drop(writeln!(file, "{}", taceva_core::shown(line)));
        }
    }
}

impl Progress for TaskLog<'_> {
    fn begin(&self, stage: &str, steps: Option<u64>) {
        match steps {
            Some(steps) => self.say(&format!("{stage} ({steps})")),
            None => self.say(stage),
        }
    }

    fn advance(&self, _steps: u64) {}

    fn end(&self) {}

    fn is_cancelled(&self) -> bool {
        self.whole.is_cancelled()
    }

    fn is_insisted(&self) -> bool {
        self.whole.is_insisted()
    }
}
