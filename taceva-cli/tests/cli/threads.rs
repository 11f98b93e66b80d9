//! Systems that start few threads or none, such as limited containers.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt as _;
use std::os::unix::process::CommandExt as _;
use std::path::PathBuf;
use std::process::{Command, Output};

use crate::support::Bench;

/// Id of a user who has no other processes. Limits do not apply to root.
const NOBODY: u32 = 65_534;

/// Copies the program to a path from which every user may start it.
fn program(bench: &Bench) -> PathBuf {
    let path = bench.path("taceva");
    fs::copy(env!("CARGO_BIN_EXE_taceva"), &path).expect("copied");
    fs::set_permissions(bench.path("."), Permissions::from_mode(0o755)).expect("a folder");
    path
}

/// Runs `taceva WORDS` as a user limited to `processes`, threads included.
fn limited(bench: &Bench, words: &str, processes: u32) -> Output {
    let mut shell = Command::new("bash");
    shell
        .arg("-c")
        .arg(format!("ulimit -u {processes} && exec \"$@\""))
        .arg("bash")
        .arg(bench.path("taceva"))
        .args(words.split_whitespace())
        .env("HOME", bench.path("."))
        .env_remove("XDG_CONFIG_HOME")
        .current_dir(bench.path("."));
    if rustix::process::getuid().is_root() {
        shell.uid(NOBODY).gid(NOBODY);
    }
    shell.output().expect("a shell")
}

#[test]
fn a_system_that_starts_no_thread_gives_the_same_report_with_a_word_about_it() {
    let bench = Bench::imported();
    program(&bench);
    let words =
        "evaluate data --model ridge --set size=8 --split by-point --format json --no-cache";
    let free = bench.ok(&format!("{words} -q"));
    for processes in [1, 2] {
        for words in ["check data", words] {
            let found = limited(&bench, words, processes);
            let error = String::from_utf8_lossy(&found.stderr);
            let code = found.status.code();
            assert!(code == Some(0), "{processes} {words}: {code:?} {error}");
            assert!(!error.contains("panicked"), "{error}");
            if processes == 1 {
                assert!(error.contains("the system started 0 of "), "{error}");
            }
            if words.starts_with("evaluate") {
                assert_eq!(String::from_utf8_lossy(&found.stdout), free);
            }
        }
    }
}
