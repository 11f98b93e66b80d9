//! A task notices if its inputs changed between submission and execution.

use std::fs;

use super::{small, week};

#[test]
fn a_recording_that_changes_between_submission_and_execution_fails_its_tasks_and_says_so() {
    let bench = week();
    small(&bench, &[]);
    // Planned, and executed by a job later.
    bench.ok("sweep which.toml -q --only model=baseline");
    fs::remove_dir_all(bench.path("monday")).expect("removed");
    bench.record_with_noise("monday", 24, 3);
    let ran = bench.run("sweep task which.sweep --tasks which.sweep/tasks.json --at 0,1");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(
        ran.err
            .contains("the recording has changed since the sweep was planned"),
        "{}",
        ran.err
    );
    let collected = bench.run("sweep collect which.toml");
    assert!(collected.out.contains("2 failed"), "{}", collected.out);
    // A new plan has other keys, so no result of the former recording is reused.
    let out = bench.ok("sweep which.toml -q");
    assert!(out.contains("8 scored, 0 failed"), "{out}");
}

#[test]
fn a_sensor_file_that_changes_between_submission_and_execution_stops_its_tasks_and_says_so() {
    let bench = week();
    let sensor = "model = \"drawn\"\nopaque = true\n";
    bench.write("sensor.toml", sensor);
    small(
        &bench,
        &[("metrics =", "sensor = \"sensor.toml\"\nmetrics =")],
    );
    bench.ok("sweep which.toml -q --only model=baseline");
    bench.write("sensor.toml", &sensor.replace("true", "false"));
    bench.refused(
        "sweep task which.sweep --tasks which.sweep/tasks.json --at 0,1",
        3,
        "sensor.toml: the file has changed since the sweep was planned; start the sweep again",
    );
    // A new plan reuses no result with the former facts.
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("found    0"), "{dry}");
    bench.write("sensor.toml", sensor);
    bench.ok("sweep which.toml -q");
}
