//! What a site is asked for.

use serde::{Deserialize, Serialize};

/// How jobs are asked for from Slurm; what is absent is left to the site.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SlurmSpec {
    /// The partition.
    pub partition: Option<String>,
    /// The most time that a job may take, as Slurm writes it: `00:30:00`.
    pub time: Option<String>,
    /// The memory of a job: `4G`.
    pub memory: Option<String>,
    /// Processors of a job, and tasks that it carries out at once.
    pub cpus: Option<u16>,
    /// Devices of a job whose tasks ask for one, as Slurm writes them: `gpu:1`.
    pub gres: Option<String>,
    /// Tasks a job carries out, one after the other or as many at once as it has processors.
    pub tasks_a_job: Option<u32>,
    /// Jobs that may run at once.
    pub most_jobs: Option<u32>,
    /// Lines of the shell before the program is started.
    pub setup: Vec<String>,
    /// The program [default: the one that submits].
    pub program: Option<String>,
}
