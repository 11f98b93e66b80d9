//! Run times and hosts of tasks, stored outside the table because these values differ between runs.

use std::fs;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::key::TaskKey;
use crate::task::Task;

/// Run time and host of a task.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct TaskTime {
    pub(crate) seconds: f64,
    /// Total size of the result and the evaluation, in bytes.
    pub(crate) bytes: u64,
    pub(crate) host: String,
    /// Start time in s since 1970, by the clock of the host.
    pub(crate) began: u64,
    /// Job id of the scheduler, if any.
    pub(crate) job: Option<String>,
}

/// Timer of a running task.
pub(crate) struct Timer {
    instant: Instant,
    began: u64,
}

impl Timer {
    pub(crate) fn start() -> Timer {
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        Timer {
            instant: Instant::now(),
            began: now.unwrap_or(Duration::ZERO).as_secs(),
        }
    }

    /// Stores the time of the task with the key `key`. A failed write is ignored, because no result needs the time.
    pub(crate) fn keep(&self, folder: &SweepFolder, key: &TaskKey) {
        let size = |path: &std::path::Path| fs::metadata(path).map_or(0, |facts| facts.len());
        let time = TaskTime {
            seconds: self.instant.elapsed().as_secs_f64(),
            bytes: size(&folder.result(key)) + size(&folder.evaluation(key)),
            host: host(),
            began: self.began,
            job: job(),
        };
        if let Ok(text) = serde_json::to_string(&time) {
            drop(folder.write(&folder.times(key), text.as_bytes()));
        }
    }
}

impl TaskTime {
    pub(crate) fn read(folder: &SweepFolder, key: &TaskKey) -> Option<TaskTime> {
        let text = fs::read_to_string(folder.times(key)).ok()?;
        serde_json::from_str(&text).ok()
    }
}

fn host() -> String {
    let name = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    match std::env::var("SLURMD_NODENAME") {
        Ok(node) => node,
        Err(_) => name.trim().to_owned(),
    }
}

fn job() -> Option<String> {
    let of = |name: &str| std::env::var(name).ok();
    let array = of("SLURM_ARRAY_JOB_ID").zip(of("SLURM_ARRAY_TASK_ID"));
    array
        .map(|(job, task)| format!("{job}_{task}"))
        .or_else(|| of("SLURM_JOB_ID"))
}

/// Content of `times.csv`: one row for each timed task.
pub(crate) fn csv(folder: &SweepFolder, tasks: &[Task]) -> Result<Vec<u8>, SweepError> {
    let path = folder.path().join("times.csv");
    let failed = |error: csv::Error| SweepError::io("write", &path)(std::io::Error::other(error));
    let mut out = csv::Writer::from_writer(Vec::new());
    let head = [
        "key", "dataset", "model", "split", "seed", "seconds", "bytes", "host", "began", "job",
        "log",
    ];
    out.write_record(head).map_err(failed)?;
    for task in tasks {
        let Some(time) = TaskTime::read(folder, &task.key) else {
            continue;
        };
        out.write_record([
            task.key.as_str(),
            &task.dataset,
            &task.configuration(),
            task.split.as_deref().unwrap_or_default(),
            &task.seed.to_string(),
            &format!("{:.3}", time.seconds),
            &time.bytes.to_string(),
            &time.host,
            &time.began.to_string(),
            time.job.as_deref().unwrap_or_default(),
            &format!("logs/{}.log", task.key),
        ])
        .map_err(failed)?;
    }
    out.into_inner()
        .map_err(|error| SweepError::io("write", &path)(error.into_error()))
}
