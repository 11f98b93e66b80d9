//! Shards as the tasks of a sweep.

use std::fs;

use super::drawn::{SWEEP, bench};
use super::{CSV, one_pass};
use crate::support::list::carry_out;
use crate::support::sweeps::tables;

#[test]
fn a_sweep_of_shards_here_and_by_a_list_ends_in_the_bytes_of_one_pass() {
    let bench = bench(400, true);
    let [whole, _] = one_pass(&bench, CSV);
    let out = bench.ok("sweep which.toml --jobs 2 -q");
    assert!(out.contains("7 scored, 0 failed, 0 missing"), "{out}");
    let read =
        |folder: &str| fs::read_to_string(bench.path(folder).join("score.json")).expect("scores");
    assert_eq!(read("which.sweep"), whole);
    let digest = taceva_dataset::Digest::of(whole.as_bytes()).to_string();
    assert!(out.contains(&format!("digest   {digest}")), "{out}");
    let part = bench.run("sweep which.toml --out parts -q --only shard=2/7");
    assert!(
        part.out.contains("1 scored, 0 failed, 6 missing"),
        "{}",
        part.out
    );
    assert!(
        part.out.contains("follow when every shard is scored"),
        "{}",
        part.out
    );
    let lines = bench.ok("sweep which.toml --out parts -q --on list");
    assert_eq!(
        lines.lines().count(),
        7,
        "six tasks and one that collects: {lines}"
    );
    carry_out(&bench, &lines);
    assert_eq!(read("parts"), whole);
    bench.refused("sweep show which.toml", 2, "score.json");
}

#[test]
fn a_table_that_changes_between_submission_and_execution_fails_its_tasks_and_says_so() {
    let bench = bench(400, false);
    bench.run("sweep which.toml -q --only shard=1/7");
    let [truth, prediction] = tables(400, false);
    bench.write("pred.csv", &prediction.replacen("\n", "\n1,1,1,1\n", 1));
    let ran = bench.run("sweep task which.sweep --tasks which.sweep/tasks.json --at 1");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(
        ran.err
            .contains("the table has changed since the sweep was planned"),
        "{}",
        ran.err
    );
    // Written again with the same bytes, it is the same table.
    bench.write("pred.csv", &prediction);
    bench.write("truth.csv", &truth);
    bench.ok("sweep task which.sweep --tasks which.sweep/tasks.json --at 1,2 --retry-failed -q");
}

#[test]
fn tables_beside_recordings_and_tables_that_do_not_fit_are_refused_at_the_start() {
    let bench = bench(10, false);
    for (more, message) in [
        (
            "datasets = [\"monday\"]\n",
            "line 1: `datasets` cannot be combined with `[score]`",
        ),
        (
            "models = [\"ridge\"]\n",
            "line 1: `models` cannot be combined with `[score]`",
        ),
        (
            "seeds = [1]\n",
            "line 1: `seeds` cannot be combined with `[score]`",
        ),
        (
            "limits = \"limits.toml\"\n",
            "line 1: `limits` cannot be combined with `[score]`",
        ),
    ] {
        bench.write("which.toml", &format!("{more}{SWEEP}"));
        bench.refused("sweep which.toml", 3, message);
    }
    for (old, new, message) in [
        (
            "shards = 7",
            "shards = 0",
            "line 6: `shards = 0`: expected a number from 1",
        ),
        ("shards = 7", "shard = 7", "did you mean `shards`?"),
        (
            "shards = 7",
            "shards = 7\nunits = { Fz = \"stone\" }",
            "unknown unit `stone`",
        ),
        ("truth.csv", "sensor.toml", "sensor.toml"),
    ] {
        bench.write("which.toml", &SWEEP.replace(old, new));
        bench.refused("sweep which.toml", 3, message);
    }
    bench.write("which.toml", SWEEP);
    let [_, prediction] = tables(9, false);
    bench.write("pred.csv", &prediction);
    bench.refused("sweep which.toml", 3, "9 rows, but");
    assert!(!bench.path("which.sweep").exists());
}
