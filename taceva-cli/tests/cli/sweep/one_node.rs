//! Node of a cluster that differs from the others: its disk is full, or its clock is an hour ahead.

use std::process::{Command, Output, Stdio};
use std::time::Duration;

use taceva_needs::{Need, skip};

use super::store::{small_bytes, whole};
use super::{count, small, week};
use crate::support::Bench;
use crate::support::sweeps::bytes;

/// Shell command that mounts a disk of 4 kB at the folder of evaluations, visible only to this process, and runs the arguments.
const FULL_DISK: &str =
    "mount -t tmpfs -o size=4k tmpfs which.sweep/evaluations || exit 99; exec \"$@\"";

/// Runs the tasks of the sweep on a node with a full disk; `None` if this needs more rights.
fn on_a_full_disk(bench: &Bench) -> Option<Output> {
    let mut node = Command::new("unshare");
    node.args(["--mount", "sh", "-c", FULL_DISK, "sh"]);
    node.arg(env!("CARGO_BIN_EXE_taceva"));
    node.args(["sweep", "task", "which.sweep", "--tasks"]);
    node.args(["which.sweep/tasks.json", "--at", "0,1,2,3,4,5,6,7"]);
    let problem = match node.current_dir(bench.path(".")).output() {
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            let may_not = output.status.code() == Some(99) || said.starts_with("unshare:");
            if !may_not {
                return Some(output);
            }
            said
        }
        Err(error) => error.to_string(),
    };
    skip(Need::Mount, problem);
    None
}

#[test]
fn a_full_disk_on_one_node_fails_its_tasks_in_words_and_another_node_carries_them_out() {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q --only model=baseline");
    let Some(output) = on_a_full_disk(&bench) else {
        return;
    };
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("No space left"), "{said}");
    // Nothing is lost or partial, and no task counts as failed for good.
    assert_eq!(count(&bench.path("which.sweep/results")), 2);
    assert_eq!(count(&bench.path("which.sweep/evaluations")), 2);
    assert_eq!(count(&bench.path("which.sweep/claims")), 0);
    let out = bench.ok("sweep which.toml -q");
    assert!(out.contains("8 scored, 0 failed, 0 missing"), "{out}");
    assert_eq!(bytes(&bench, "which.sweep"), small_bytes());
}

/// Command `taceva WORDS` on a node whose clock and file times are an hour ahead.
fn an_hour_ahead(bench: &Bench, words: &str) -> Command {
    let here = bench.command(words);
    let mut ahead = Command::new("faketime");
    ahead.args(["-f", "+1h"]).arg(here.get_program());
    ahead.args(here.get_args()).current_dir(bench.path("."));
    for (name, value) in here.get_envs() {
        match value {
            Some(value) => ahead.env(name, value),
            None => ahead.env_remove(name),
        };
    }
    ahead.stdout(Stdio::null()).stderr(Stdio::null());
    ahead
}

#[test]
fn clocks_that_differ_by_an_hour_double_no_task_and_leave_no_claim_that_nobody_ends() {
    let date = |words: &[&str]| {
        let output = Command::new("faketime").args(words).output();
        output.is_ok_and(|output| output.status.success())
    };
    if !date(&["-f", "+1h", "date"]) {
        skip(Need::Faketime, "there is no faketime");
        return;
    }
    let bench = whole();
    let reference = bytes(&bench, "one");
    let words = "sweep which.toml --out both --jobs 1 -q";
    let mut ahead = an_hour_ahead(&bench, words).spawn().expect("it starts");
    let mut here = bench.command(words);
    let mut here = here.stdout(Stdio::null()).spawn().expect("it starts");
    for one in [&mut ahead, &mut here] {
        assert!(one.wait().expect("it ends").success());
    }
    bench.ok("sweep which.toml --out both -q");
    assert_eq!(bytes(&bench, "both"), reference);
    for entry in std::fs::read_dir(bench.path("both/logs")).expect("logs") {
        let log = std::fs::read_to_string(entry.expect("readable").path()).expect("text");
        assert_eq!(log.matches("\nscored").count(), 1, "{log}");
    }

    // A claim from an hour ahead, of a node that is gone, is not younger than any other.
    let words = "sweep which.toml --out left --jobs 1 -q";
    let mut ahead = an_hour_ahead(&bench, words).spawn().expect("it starts");
    let claims = bench.path("left/claims");
    while count(&claims) == 0 && ahead.try_wait().expect("it runs").is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    drop(ahead.kill());
    ahead.wait().expect("it ended");
    bench.ok("sweep which.toml --out left -q");
    assert_eq!(bytes(&bench, "left"), reference);
    assert_eq!(count(&claims), 0);
}
