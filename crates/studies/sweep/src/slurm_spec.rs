//! Resources that jobs request from a site.

use serde::{Deserialize, Serialize};

/// Resources that Slurm jobs request; absent values are left to the defaults of the site.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SlurmSpec {
    /// The partition.
    pub partition: Option<String>,
    /// Time limit of a job, in the format of Slurm: `00:30:00`.
    pub time: Option<String>,
    /// The memory of a job: `4G`.
    pub memory: Option<String>,
    /// Processors of a job, and the number of tasks it runs at once.
    pub cpus: Option<u16>,
    /// Devices of a job whose tasks need one, in the format of Slurm: `gpu:1`.
    pub gres: Option<String>,
    /// Tasks for each job, run in turn or as many at once as it has processors.
    pub tasks_a_job: Option<u32>,
    /// Maximum jobs that run at once.
    pub most_jobs: Option<u32>,
    /// Shell lines to run before the program.
    pub setup: Vec<String>,
    /// The program [default: the one that submits].
    pub program: Option<String>,
}
