//! Tests that a recorder killed at any moment loses no acknowledged sample.
#![cfg(unix)]

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use taceva_dataset::{Dataset, Recorder};
use taceva_needs::{Need, skip};

use crate::support::Random;

/// Path of the example recorder beside this test; `None` if it was not built.
fn example() -> Option<PathBuf> {
    let here = std::env::current_exe().ok()?;
    let built = here.parent()?.parent()?.join("examples/record");
    built.exists().then_some(built)
}

fn start(example: &Path, folder: &Path) -> Child {
    Command::new(example)
        .arg(folder)
        .arg("60")
        .stdout(Stdio::piped())
        .spawn()
        .expect("the example runs")
}

#[test]
fn nothing_acknowledged_is_lost_when_the_recorder_is_killed() {
    let Some(example) = example() else {
        let why = "`record` is built by `cargo test` of the whole package";
        skip(Need::Example, why);
        return;
    };
    let mut random = Random::new(6);
    for _ in 0..6 {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("set");
        let mut acknowledged = 0;
        for _ in 0..3 {
            let mut child = start(&example, &path);
            let output = child.stdout.take().expect("piped");
            let mut lines = BufReader::new(output);
            let patience = 1 + random.below(15);
            for _ in 0..patience {
                let mut line = String::new();
                lines.read_line(&mut line).expect("read");
                if let Some(number) = line.trim().strip_prefix("ACK ") {
                    acknowledged = number.parse().expect("a number");
                }
            }
            child.kill().expect("killed");
            child.wait().expect("gone");
            let mut rest = String::new();
            lines.read_to_string(&mut rest).expect("read");
            // Acknowledgements printed before the kill count, even if they were not read.
            for number in rest.lines().filter_map(|line| line.strip_prefix("ACK ")) {
                acknowledged = number.parse().unwrap_or(acknowledged);
            }
            if !path.join("dataset.toml").exists() {
                let rows = Recorder::resume(&path).map_or(0, |recorder| recorder.table().rows());
                assert!(
                    rows >= acknowledged,
                    "{rows} of {acknowledged} acknowledged"
                );
            }
        }
        let finished = start(&example, &path).wait_with_output().expect("finishes");
        assert!(finished.status.success());
        let dataset = Dataset::open(&path).expect("opens");
        assert_eq!(dataset.table().rows(), 60);
        for row in dataset.all_rows() {
            assert!(dataset.frame(row).expect("whole").is_some());
        }
    }
}
