//! `taceva cache list` and `prune`, on a cache made by hand.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn taceva(words: &[&str], cache: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_taceva"))
        .args(words)
        .arg("--cache")
        .arg(cache)
        .current_dir(cache)
        .output()
        .expect("the program runs")
}

fn said(output: &Output) -> String {
    let all = [output.stdout.as_slice(), output.stderr.as_slice()].concat();
    String::from_utf8_lossy(&all).into_owned()
}

/// Writes a cache with three entries of two kinds and a foreign file. A run uses one of the entries.
fn laid_out(cache: &Path) {
    for (layout, kind, number, bytes) in [
        ("2", "fit", 1, 1000),
        ("2", "fit", 2, 500),
        ("2", "features", 3, 250),
    ] {
        let folder = cache.join(layout).join(kind);
        fs::create_dir_all(&folder).expect("made");
        fs::write(folder.join(format!("{number:064x}")), vec![0; bytes]).expect("written");
    }
    fs::write(cache.join("2/fit/thesis.tex"), "mine").expect("written");
    let run = cache.join("runs/quick-1");
    fs::create_dir_all(&run).expect("made");
    let stages = format!(
        r#"{{"schema": "taceva.stages/1", "stages": [{{"study": "a", "stage": "fit", "key": "sha256:{:064x}", "reused": false}}]}}"#,
        1
    );
    fs::write(run.join("stages.json"), stages).expect("written");
}

#[test]
fn what_is_kept_is_listed_by_kind_with_size_and_run() {
    let folder = tempfile::tempdir().expect("a folder");
    laid_out(folder.path());
    let listed = said(&taceva(&["cache", "list"], folder.path()));
    assert!(
        listed.contains("1.50 kB") && listed.contains("250 B"),
        "{listed}"
    );
    let output = taceva(&["cache", "list", "--format", "json"], folder.path());
    let read: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let entries = read["entries"].as_array().expect("a list");
    assert_eq!(entries.len(), 3, "{read}");
    let of_run = entries
        .iter()
        .filter(|entry| entry["runs"] != serde_json::json!([]));
    let of_run: Vec<_> = of_run.map(|entry| entry["bytes"].as_u64()).collect();
    assert_eq!(of_run, [Some(1000)]);
}

#[test]
fn pruning_removes_what_was_asked_for_and_nothing_of_others() {
    let folder = tempfile::tempdir().expect("a folder");
    laid_out(folder.path());
    let dry = taceva(
        &["cache", "prune", "--keep", "0", "--explain"],
        folder.path(),
    );
    assert!(
        said(&dry).starts_with("would remove 3 of 3 entries"),
        "{}",
        said(&dry)
    );
    let features = taceva(
        &["cache", "prune", "--keep", "0", "--kind", "features"],
        folder.path(),
    );
    assert!(
        said(&features).starts_with("removed 1 of 3 entries"),
        "{}",
        said(&features)
    );
    let all = taceva(&["cache", "prune", "--keep", "0"], folder.path());
    assert!(
        said(&all).starts_with("removed 2 of 2 entries"),
        "{}",
        said(&all)
    );
    assert!(folder.path().join("2/fit/thesis.tex").exists());
    let again = taceva(&["cache", "list"], folder.path());
    assert!(
        said(&again).contains("The cache is empty."),
        "{}",
        said(&again)
    );
}

#[test]
fn pruning_without_saying_what_and_amounts_that_are_none_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for words in [
        &["cache", "prune"][..],
        &["cache", "prune", "--keep", "much"],
        &["cache", "prune", "--older-than", "3"],
        &["cache", "prune", "--keep", "0", "--kind", "thesis"],
    ] {
        let output = taceva(words, folder.path());
        assert_eq!(
            output.status.code(),
            Some(2),
            "{words:?}: {}",
            said(&output)
        );
    }
}

#[test]
fn a_name_that_was_mistyped_is_answered_with_the_one_that_was_meant() {
    let output = Command::new(env!("CARGO_BIN_EXE_taceva"))
        .args(["catalogue", "show", "gelsigt"])
        .output()
        .expect("the program runs");
    assert_eq!(output.status.code(), Some(2));
    assert!(
        said(&output).contains("did you mean `GelSight`?"),
        "{}",
        said(&output)
    );
}
