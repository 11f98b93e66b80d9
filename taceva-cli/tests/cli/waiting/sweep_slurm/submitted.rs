//! Other submissions: shards of tables, scenes, and refusals of `sbatch`.

use std::fs;

use super::cluster::Cluster;
use super::{SLURM, week};
use crate::support::Bench;
use crate::support::sweeps::{SWEEP, TINY, TINY_SWEEP, bytes, tables};

#[test]
fn shards_of_tables_on_two_nodes_end_in_the_scores_of_one_pass() {
    let Some(cluster) = Cluster::start() else {
        return;
    };
    let bench = Bench::new();
    let [truth, prediction] = tables(500, true);
    bench.write("truth.csv", &truth);
    bench.write("pred.csv", &prediction);
    let score = "[score]\ntruth = \"truth.csv\"\npred = \"pred.csv\"\nshards = 5\n";
    bench.write("which.toml", &format!("sweep_version = 1\n{score}{SLURM}"));
    let said = cluster.ok(&bench, "sweep which.toml --on slurm");
    assert!(said.contains("submitted 5 tasks in 2 jobs"), "{said}");
    cluster.wait(&bench);
    let joined = fs::read_to_string(bench.path("which.sweep/score.json"));
    let whole = bench.ok("score --truth truth.csv --pred pred.csv --format json -q");
    assert_eq!(
        joined.unwrap_or_else(|_| panic!("{}", cluster.logs(&bench))),
        whole
    );
}

#[test]
fn a_scene_is_acquired_before_its_tasks_are_submitted_and_scored_on_the_nodes() {
    let Some(cluster) = Cluster::start() else {
        return;
    };
    let bench = Bench::new();
    bench.write("tiny.toml", TINY);
    bench.write("which.toml", &format!("{TINY_SWEEP}{SLURM}"));
    bench.ok("sweep which.toml -q --out here");
    let said = cluster.ok(&bench, "sweep which.toml --on slurm");
    assert!(said.contains("submitted 2 tasks in 1 job: "), "{said}");
    cluster.wait(&bench);
    assert_eq!(
        bytes(&bench, "which.sweep"),
        bytes(&bench, "here"),
        "{}",
        cluster.logs(&bench)
    );
}

#[test]
fn a_refusing_sbatch_is_quoted_and_nothing_of_the_sweep_is_left_in_the_queue() {
    let Some(cluster) = Cluster::start() else {
        return;
    };
    let bench = week();
    bench.write(
        "which.toml",
        &format!("{SWEEP}{}", SLURM.replace("\"main\"", "\"nowhere\"")),
    );
    let (code, said) = cluster.run(&bench, "sweep which.toml --on slurm");
    assert_eq!(code, 3, "{said}");
    assert!(
        said.contains("sbatch: ") && said.contains("invalid partition"),
        "{said}"
    );
    let status = cluster.ok(&bench, "sweep status which.toml");
    assert!(status.contains("none were submitted"), "{status}");
}
