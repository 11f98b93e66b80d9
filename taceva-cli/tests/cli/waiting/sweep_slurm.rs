//! Sweeps on a real Slurm: two virtual nodes on loopback, started and stopped by `tests/slurm`.

mod cluster;
mod nodes;
mod power;
mod submitted;

use crate::support::{Bench, sweeps};

/// Resources requested from the cluster.
const SLURM: &str = r#"[slurm]
partition = "main"
time = "00:10:00"
memory = "200M"
tasks_a_job = 3
setup = ["export SET_UP=yes"]
"#;

fn week() -> Bench {
    sweeps::week(SLURM)
}
