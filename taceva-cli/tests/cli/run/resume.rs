//! Killed or stopped runs resume to the same bytes.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

use super::reduced::REDUCED;
use super::{SMALL, dataset_of, reports, with_small};
use crate::support::Bench;

/// Process of a run, which the test kills or stops.
struct Started {
    child: Child,
    journal: PathBuf,
}

impl Started {
    fn new(bench: &Bench, folder: &str) -> Started {
        Started::of(
            bench.command(&format!("run small.toml --out {folder} -q")),
            bench,
            folder,
        )
    }

    fn of(mut command: Command, bench: &Bench, folder: &str) -> Started {
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn();
        Started {
            child: child.expect("starts"),
            journal: bench.path(folder).join("recordings/1-small/journal"),
        }
    }

    /// Waits until `bytes` bytes are recorded.
    fn reaches(&mut self, bytes: u64) {
        loop {
            let length = fs::metadata(&self.journal).map_or(0, |journal| journal.len());
            if length >= bytes {
                return;
            }
            let ended = self.child.try_wait().expect("asked");
            assert!(ended.is_none(), "it ended with {length} bytes recorded");
            std::thread::yield_now();
        }
    }
}

/// Kills a run when its recording has each of these numbers of bytes, resumes it, and compares it with an uninterrupted run.
pub(super) fn survives(bench: &Bench, moments: &[u64]) {
    survives_in(bench, "1-small", moments);
}

/// Does the work of [`survives`] for the recording in the folder `recording` of the run.
fn survives_in(bench: &Bench, recording: &str, moments: &[u64]) {
    bench.ok("run small.toml --out whole -q");
    let whole = reports(&bench.path("whole"));
    for bytes in moments {
        let mut killed = Started::new(bench, "killed");
        killed.journal = bench.path(&format!("killed/recordings/{recording}/journal"));
        killed.reaches(*bytes);
        killed.child.kill().expect("killed");
        killed.child.wait().expect("ended");
        bench.ok("run small.toml --out killed --resume -q");
        let datasets = ["killed", "whole"].map(|run| dataset_of(&bench.path(run)));
        assert_eq!(datasets[0], datasets[1], "killed at {bytes} bytes");
        assert_eq!(reports(&bench.path("killed")), whole);
        fs::remove_dir_all(bench.path("killed")).expect("removed");
    }
}

#[test]
fn whatever_ends_a_run_it_goes_on_to_the_same_bytes() {
    // Between two presses at one place, in another light, or on a grating.
    survives(&with_small(), &[3_000, 20_000, 45_000]);
}

#[test]
fn a_run_that_keeps_reduced_frames_goes_on_to_the_same_bytes() {
    let bench = Bench::new();
    bench.write("small.toml", &format!("{SMALL}{REDUCED}"));
    survives(&bench, &[3_000, 45_000]);
}

#[test]
fn a_gel_that_is_softened_by_use_is_brought_back_to_where_it_was() {
    let bench = Bench::new();
    let table = include_str!("../../../../plugins/sim/parameters/vitactip.toml")
        .replace(
            "conditioning_fraction = { value = 0.0",
            "conditioning_fraction = { value = 0.4",
        )
        .replace(';', ";;");
    assert!(table.contains("value = 0.4"));
    let driver = "\"sim/vitactip:reduction=16\"";
    let softened = format!("'''sim/vitactip:reduction=16;table={table}'''");
    bench.write("small.toml", &SMALL.replace(driver, &softened));
    survives(&bench, &[30_000, 45_000]);
}

#[test]
fn a_run_that_is_killed_between_cycles_of_a_load_goes_on_to_the_same_bytes() {
    let bench = Bench::new();
    bench.write(
        "small.toml",
        r#"scene_version = 1
name = "small"
seed = 7
sensor = { driver = "sim/vitactip:reduction=16" }
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
metrics = { want = ["sensitivity"] }
[protocol]
calibration = { points = 6, indentations = 1 }
wear = { load = "compression", cycles = [0, 200], force_N = 0.2 }
"#,
    );
    // The second stage has begun, and its 200 cycles are not all stored.
    survives_in(&bench, "2-small-after-200-cycles", &[2_500, 10_000]);
}

#[test]
fn a_resumed_run_is_named_with_the_option_that_chooses_another() {
    let bench = with_small();
    bench.ok("run small.toml -q");
    let resumed = bench.run("run small.toml --resume");
    assert_eq!(resumed.code, 0, "{}", resumed.err);
    let named = "small-1, the last run of this scene; --out FOLDER resumes another";
    assert!(resumed.err.contains(named), "{}", resumed.err);
}

#[cfg(unix)]
#[test]
fn a_signal_stops_a_run_between_motions_and_it_says_how_to_go_on() {
    let bench = with_small();
    bench.write("my plugins/none.txt", "no plugin");
    let mut command = bench.command("run small.toml --out stopped -q");
    command.args(["--plugin-dir", "my plugins"]);
    let mut stopped = Started::of(command, &bench, "stopped");
    stopped.reaches(10_000);
    let id = stopped.child.id().to_string();
    let sent = Command::new("kill").args(["-TERM", &id]).status();
    assert!(sent.expect("there is a kill").success());
    let ended = stopped.child.wait_with_output().expect("ended");
    assert_eq!(ended.status.code(), Some(5));
    let message = String::from_utf8(ended.stderr).expect("UTF-8");
    let (_, line) = message.split_once("continue with: ").expect(&message);
    let (line, _) = line.split_once(": ").unwrap_or((line.trim(), ""));
    assert!(line.contains("--plugin-dir 'my plugins'"), "{line}");
    assert!(reports(&bench.path("stopped")).is_empty());
    let resumed = bench.shell(line);
    assert_eq!(resumed.code, 0, "{line}: {}", resumed.err);
    bench.ok("run small.toml --out whole -q");
    assert_eq!(
        reports(&bench.path("stopped")),
        reports(&bench.path("whole"))
    );
}
