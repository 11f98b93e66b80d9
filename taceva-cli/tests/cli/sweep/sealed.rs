//! Changed files in the folder of a sweep are refused by name.

use std::fs;

use super::store::{scored, small_bytes};
use super::{small, text, week};
use crate::support::sweeps::bytes;

#[test]
fn a_result_of_another_version_or_one_that_was_changed_is_refused_by_name() {
    let bench = scored();
    let results = bench.path("which.sweep/results");
    let first = fs::read_dir(&results)
        .expect("results")
        .next()
        .expect("one")
        .expect("readable")
        .path();
    let whole = fs::read_to_string(&first).expect("text");
    let mut json: serde_json::Value = serde_json::from_str(&whole).expect("JSON");
    json["taceva"] = "0.0.9".into();
    fs::write(&first, json.to_string()).expect("changed");
    bench.refused(
        "sweep collect which.toml",
        3,
        "was changed after it was sealed",
    );
    // As that version wrote it, sealed.
    json.as_object_mut().expect("an object").remove("seal");
    let sealed = taceva_files::seal::json::seal(&json.to_string()).expect("JSON");
    fs::write(&first, sealed).expect("written");
    bench.refused(
        "sweep collect which.toml",
        3,
        "the file was written by TacEva 0.0.9",
    );
    fs::remove_file(&first).expect("removed");
    bench.ok("sweep which.toml -q");
}

#[test]
fn a_flipped_bit_of_the_list_of_tasks_or_of_an_evaluation_is_noticed() {
    let bench = scored();
    bench.ok("sweep which.toml -q");
    let list = text(&bench, "which.sweep/tasks.json");
    bench.write(
        "which.sweep/tasks.json",
        &list.replacen("\"seed\":1", "\"seed\":2", 1),
    );
    for words in ["collect which.toml", "status which.toml", "show which.toml"] {
        bench.refused(
            &format!("sweep {words}"),
            3,
            "`tasks[0].seed` was changed after it was sealed",
        );
    }
    bench.ok("sweep which.toml -q");
    let evaluations = fs::read_dir(bench.path("which.sweep/evaluations")).expect("evaluations");
    let path = evaluations.flatten().next().expect("one").path();
    let mut evaluation = fs::read(&path).expect("bytes");
    let middle = evaluation.len() / 2;
    evaluation[middle] ^= 1;
    fs::write(&path, evaluation).expect("changed");
    bench.refused(
        "sweep collect which.toml",
        3,
        "the file has changed since the task wrote it",
    );
    // The remedy of the message.
    let name = path.file_name().expect("a name").to_owned();
    fs::remove_file(&path).expect("removed");
    fs::remove_file(bench.path("which.sweep/results").join(name)).expect("removed");
    bench.ok("sweep which.toml -q");
    bench.ok("sweep collect which.toml");
}

#[test]
fn a_flipped_bit_of_what_was_collected_is_noticed_before_it_is_printed() {
    let bench = scored();
    bench.ok("sweep which.toml -q");
    let path = bench.path("which.sweep/collected.json");
    let whole = fs::read_to_string(&path).expect("text");
    let counts = whole.replacen("\"scored\":8", "\"scored\":9", 1);
    assert_ne!(counts, whole);
    fs::write(&path, counts).expect("changed");
    bench.refused(
        "sweep which.toml",
        3,
        "collected.json: `scored` was changed after it was sealed",
    );
    let mut flipped = whole.clone().into_bytes();
    let at = whole.find("made_of").expect("a digest") + 20;
    flipped[at] ^= 1;
    fs::write(&path, flipped).expect("changed");
    bench.refused(
        "sweep which.toml",
        3,
        "run `taceva sweep collect` to make it again",
    );
    // The remedy of the message; the table does not depend on the file.
    bench.ok("sweep collect which.toml -q");
    bench.ok("sweep which.toml -q");
    assert_eq!(fs::read_to_string(&path).expect("text"), whole);
    assert_eq!(bytes(&bench, "which.sweep"), small_bytes());
}

#[cfg(unix)]
#[test]
fn a_flipped_bit_of_the_record_of_jobs_is_noticed_and_no_job_of_others_is_cancelled() {
    use std::os::unix::fs::PermissionsExt;

    let bench = week();
    small(&bench, &[]);
    // Programs in place of a scheduler.
    for (name, line) in [
        ("sbatch", "echo 17"),
        ("squeue", "true"),
        ("scancel", "touch cancelled"),
        ("scontrol", "true"),
    ] {
        let path = format!("scheduler/{name}");
        bench.write(&path, &format!("#!/bin/sh\n{line}\n"));
        let mode = fs::Permissions::from_mode(0o755);
        fs::set_permissions(bench.path(&path), mode).expect("made");
    }
    let taceva = |words: &str| {
        let path = format!(
            "{}:{}",
            bench.path("scheduler").display(),
            std::env::var("PATH").expect("a path")
        );
        let mut command = bench.command(words);
        let output = command.env("PATH", path).output().expect("it starts");
        let said = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8(said).expect("text"))
    };
    let (code, said) = taceva("sweep which.toml --on slurm -q");
    assert_eq!(code, Some(0), "{said}");
    let (code, said) = taceva("sweep status which.toml");
    assert!(code == Some(0) && said.contains("none are left"), "{said}");
    let record = text(&bench, "which.sweep/slurm/jobs.json");
    let other = record.replacen("[\"17\"]", "[\"16\"]", 1);
    assert_ne!(other, record);
    bench.write("which.sweep/slurm/jobs.json", &other);
    for words in ["sweep status which.toml", "sweep cancel which.toml"] {
        let (code, said) = taceva(words);
        assert_eq!(code, Some(3), "{said}");
        assert!(
            said.contains("jobs.json: `arrays") && said.contains("was changed after it was sealed"),
            "{said}"
        );
    }
    assert!(!bench.path("cancelled").exists());
    bench.write("which.sweep/slurm/jobs.json", &record);
    let (code, said) = taceva("sweep cancel which.toml");
    assert_eq!(code, Some(0), "{said}");
    assert!(bench.path("cancelled").exists());
}
