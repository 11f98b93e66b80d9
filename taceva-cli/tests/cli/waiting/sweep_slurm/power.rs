//! Loss of power on a node or the controller, by killing the daemons.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::cluster::{Cluster, PATIENCE};

/// Kills the processes of a node as a power cut would. Kills the processes that report the end of a job before the jobs.
pub(crate) fn cut_power(cluster: &Cluster, node: &str) {
    let daemon = cluster.pid(&format!("slurmd-{node}.pid"));
    let ours = [
        format!("SLURM_CONF={}", cluster.configuration().display()),
        format!("SLURMD_NODENAME={node}"),
    ];
    let mut jobs = Vec::new();
    let mut reporters = vec![daemon];
    for entry in fs::read_dir("/proc").expect("processes").flatten() {
        let folder = entry.path();
        let Ok(environment) = fs::read(folder.join("environ")) else {
            continue;
        };
        let of = |wanted: &String| {
            environment
                .split(|byte| *byte == 0)
                .any(|word| word == wanted.as_bytes())
        };
        if !ours.iter().all(of) {
            continue;
        }
        jobs.push(entry.file_name().to_string_lossy().into_owned());
        let stat = fs::read_to_string(folder.join("stat")).unwrap_or_default();
        let parent = stat
            .rsplit_once(')')
            .and_then(|(_, rest)| rest.split_whitespace().nth(1).map(str::to_owned));
        let is_reporter = |pid: &String| {
            fs::read_to_string(format!("/proc/{pid}/comm"))
                .is_ok_and(|name| name.starts_with("slurmstepd"))
        };
        reporters.extend(parent.filter(is_reporter));
    }
    for pid in reporters.iter().chain(&jobs) {
        drop(
            Command::new("kill")
                .args(["-9", pid])
                .stderr(Stdio::null())
                .status(),
        );
    }
}

/// Kills the controller and restarts it, while jobs wait or run.
pub(crate) fn restart_controller(cluster: &Cluster) {
    let controller = cluster.pid("slurmctld.pid");
    Command::new("kill")
        .arg(&controller)
        .status()
        .expect("sent");
    let began = Instant::now();
    while Path::new(&format!("/proc/{controller}")).exists() {
        assert!(began.elapsed() < PATIENCE, "the controller did not end");
        std::thread::sleep(Duration::from_millis(50));
    }
    let configuration = cluster.configuration();
    let started = Command::new("slurmctld")
        .arg("-f")
        .arg(&configuration)
        .env("SLURM_CONF", &configuration)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    assert!(started.expect("slurmctld").success());
}
