//! Tasks on other machines and by other engines.

use std::process::Command;

use super::{small, text, week};

#[test]
fn a_folder_that_is_not_shared_is_named_by_the_job_that_misses_it() {
    let bench = week();
    bench.refused(
        "sweep task nowhere --tasks nowhere/tasks.json --at 0",
        3,
        "check that the folder of the sweep is shared with this machine",
    );
}

#[test]
fn an_absent_sbatch_is_said_in_the_words_of_the_system_and_the_scripts_stay() {
    let bench = week();
    small(&bench, &[]);
    let mut command = bench.command("sweep which.toml --on slurm -q");
    let output = command
        .env("PATH", bench.path("nothing"))
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("sbatch: cannot be started"), "{said}");
    let script = text(&bench, "which.sweep/slurm/tasks-1.sh");
    assert!(
        script.contains("#SBATCH --array=0-7\n") && script.contains("--requeue"),
        "{script}"
    );
}

#[test]
fn lines_of_a_list_are_words_of_a_shell_whatever_the_folder_is_called() {
    let bench = week();
    small(&bench, &[]);
    let mut command = bench.command("sweep which.toml --on list -q");
    let listed = command.args(["--out", "it's; touch made"]).output();
    let listed = listed.expect("it starts").stdout;
    let script = String::from_utf8(listed).expect("text");
    assert!(script.contains("'\\''s; touch made"), "{script}");
    let harmless = script.replace("taceva sweep", "true");
    let status = Command::new("sh")
        .args(["-c", &harmless])
        .current_dir(bench.path(""))
        .status();
    assert!(status.expect("sh").success());
    assert!(!bench.path("made").exists());
}
