//! A sweep that is interrupted during the acquisition of a scene resumes there.

use std::fs;
use std::process::{Child, Command, Stdio};

use super::{RECORDING, TINY, bytes, claims, tiny};
use crate::support::Bench;

/// Starts the sweep, and waits until `bytes` bytes are recorded.
fn recorded(bench: &Bench, bytes: u64) -> Child {
    let mut command = bench.command("sweep which.toml --jobs 1");
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("it starts");
    let journal = bench.path(RECORDING).join("journal");
    while fs::metadata(&journal).map_or(0, |journal| journal.len()) < bytes {
        let ended = child.try_wait().expect("asked");
        assert!(ended.is_none(), "it ended before {bytes} bytes");
        std::thread::yield_now();
    }
    child
}

#[cfg(unix)]
#[test]
fn a_signal_stops_a_sweep_between_presses_and_a_kill_loses_none_that_was_recorded() {
    let bench = tiny();
    // Enough presses for a slow machine.
    bench.write("tiny.toml", &TINY.replace("points = 12", "points = 160"));
    bench.ok("sweep which.toml --out whole --no-cache -q");
    let child = recorded(&bench, 2000);
    let pid = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &pid]).status();
    assert!(sent.expect("there is a kill").success());
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(5), "{said}");
    assert!(
        said.contains("stopped while a scene was acquired; the same command continues from here"),
        "{said}"
    );
    assert_eq!(claims(&bench), 0);
    assert!(!bench.path("which.sweep/tasks.json").exists());
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("tiny: 1 recording to be acquired"), "{dry}");

    let mut child = recorded(&bench, 8000);
    child.kill().expect("killed");
    child.wait().expect("it ended");
    assert_eq!(claims(&bench), 1, "the claim of a dead process");
    bench.ok("sweep which.toml -q");
    assert_eq!(claims(&bench), 0);
    assert_eq!(bytes(&bench, "which.sweep"), bytes(&bench, "whole"));
}
