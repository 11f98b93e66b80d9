//! Output of `--on list`, executed by a shell.

use std::path::Path;
use std::process::Command;

use super::Bench;

/// Runs the `lines` of a script in the folder of `bench`, with the program on the path.
pub(crate) fn carry_out(bench: &Bench, lines: &str) {
    let program = Path::new(env!("CARGO_BIN_EXE_taceva"));
    let folder = program.parent().expect("a folder").display();
    let path = std::env::var("PATH").expect("a path");
    let mut shell = Command::new("sh");
    shell.args(["-c", lines]).current_dir(bench.path("."));
    let output = shell
        .env("PATH", format!("{folder}:{path}"))
        .output()
        .expect("a shell");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
