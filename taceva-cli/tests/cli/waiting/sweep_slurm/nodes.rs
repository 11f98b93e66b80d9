//! Sweep on two nodes whose results have the same bytes, even if a node is lost and the controller restarts.

use std::fs;
use std::time::{Duration, Instant};

use super::cluster::{Cluster, PATIENCE};
use super::power::{cut_power, restart_controller};
use super::week;
use crate::support::sweeps::bytes;

#[test]
fn a_node_lost_a_controller_started_anew_and_a_sweep_cancelled_and_submitted_again_at_once_give_the_same_bytes_as_here()
 {
    let Some(cluster) = Cluster::start() else {
        return;
    };
    let bench = week();
    bench.ok("sweep which.toml -q --out here");
    let reference = bytes(&bench, "here");

    // Two nodes. 48 tasks in jobs of three are 16 jobs, more than the ten that an array of this site may have.
    let said = cluster.ok(&bench, "sweep which.toml --on slurm");
    assert!(said.contains("submitted 48 tasks in 16 jobs"), "{said}");
    let script =
        fs::read_to_string(bench.path("which.sweep/slurm/tasks-2.sh")).expect("a second array");
    for line in [
        "--array=0-5\n",
        "--partition=main\n",
        "--time=00:10:00\n",
        "--mem=200M\n",
        "export SET_UP=yes\n",
    ] {
        assert!(script.contains(line), "{line}: {script}");
    }
    cluster.wait(&bench);
    assert_eq!(
        bytes(&bench, "which.sweep"),
        reference,
        "{}",
        cluster.logs(&bench)
    );
    let times = fs::read_to_string(bench.path("which.sweep/times.csv")).expect("times");
    assert!(
        times.contains(",one,") && times.contains(",two,"),
        "both nodes took part: {times}"
    );
    let again = cluster.ok(&bench, "sweep which.toml --on slurm");
    assert!(again.contains("48 scored, 0 failed"), "{again}");

    // Cancelled, and submitted again at once.
    fs::remove_dir_all(bench.path("which.sweep")).expect("removed");
    cluster.ok(&bench, "sweep which.toml --on slurm");
    cluster.ok(&bench, "sweep cancel which.toml");
    cluster.ok(&bench, "sweep which.toml --on slurm");
    // The controller is restarted while jobs wait and run.
    restart_controller(&cluster);
    // A node is lost with its jobs.
    let began = Instant::now();
    while fs::read_dir(bench.path("which.sweep/results")).map_or(0, Iterator::count) == 0 {
        assert!(
            began.elapsed() < PATIENCE,
            "nothing was scored\n{}",
            cluster.logs(&bench)
        );
        std::thread::sleep(Duration::from_millis(50));
    }
    cut_power(&cluster, "two");
    cluster.wait(&bench);
    assert_eq!(
        bytes(&bench, "which.sweep"),
        reference,
        "{}",
        cluster.logs(&bench)
    );
}
