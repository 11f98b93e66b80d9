//! Resources that Slurm jobs request.

use serde::{Deserialize, Serialize};

/// Resources that Slurm jobs request. `None` leaves the default of the site.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SlurmSpec {
    /// Partition of the cluster.
    pub partition: Option<String>,
    /// Time limit of a job, in the format of Slurm: `00:30:00`.
    pub time: Option<String>,
    /// Memory of a job: `4G`.
    pub memory: Option<String>,
    /// Number of processors of a job, which is also its number of concurrent tasks.
    pub cpus: Option<u16>,
    /// Generic resources of a job whose tasks need a device, in the format of Slurm: `gpu:1`.
    pub gres: Option<String>,
    /// Number of tasks per job. A job runs as many tasks at once as it has processors.
    pub tasks_a_job: Option<u32>,
    /// Greatest number of concurrent jobs.
    pub most_jobs: Option<u32>,
    /// Shell lines to run before the program.
    pub setup: Vec<String>,
    /// Program that jobs run; `None` for the program that submits the jobs.
    pub program: Option<String>,
}
