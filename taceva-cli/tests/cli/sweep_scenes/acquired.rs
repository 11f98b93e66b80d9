//! The recording of a scene is used like any other recording of the sweep.

use std::fs;

use super::{RECORDING, SWEEP, TINY, bytes, claims, header, reference, scored, tiny};

#[test]
fn a_scene_is_acquired_once_as_by_a_run_and_its_recordings_are_datasets_beside_others() {
    let bench = tiny();
    bench.record("monday", 24);
    // Two sensors, in one scene.
    let sensor = "sensor = { driver = \"sim/vitactip:reduction=16\" }\n";
    let studies = "[[study]]\nname = \"One\"\nsensor = { driver = \"sim/vitactip:reduction=16\" }\n[[study]]\nname = \"Other\"\nsensor = { driver = \"sim/magictac:reduction=16\" }\n";
    let pair = TINY.replace(sensor, "").replace("\"tiny\"", "\"pair\"");
    assert!(!pair.contains("vitactip"));
    bench.write("scenes/pair.toml", &format!("{pair}{studies}"));
    let scenes = "scenes = \"scenes/pair.toml\"\ndatasets = \"monday\"";
    let sweep = SWEEP.replace("scenes = [\"tiny.toml\"]", scenes);
    bench.write("which.toml", &sweep);

    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("tasks    6, 0"), "{dry}");
    let plan = "scene    pair: 2 recordings to be acquired, 24 presses, ";
    assert!(dry.contains(plan), "{dry}");
    assert!(dry.contains("min of motion on a rig"), "{dry}");
    assert!(!bench.path("which.sweep").exists());

    let ran = bench.run("sweep which.toml");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.out.contains("6 scored, 0 failed, 0 missing"),
        "{}",
        ran.out
    );
    let acquired = "scene pair: acquired into which.sweep/scenes/pair";
    assert!(ran.err.contains(acquired), "{}", ran.err);
    assert!(ran.err.contains("press (24)"), "{}", ran.err);
    let table = fs::read_to_string(bench.path("which.sweep/table.csv")).expect("a table");
    for words in [",pair/One,", ",pair/Other,", ",monday,"] {
        assert!(table.contains(words), "{words}: {table}");
    }
    let simulated = table.lines().filter(|line| line.contains(",pair/"));
    assert!(simulated.clone().count() > 4, "{table}");
    for line in simulated {
        assert!(line.contains(",simulated,"), "{line}");
    }
    let page = fs::read_to_string(bench.path("which.sweep/page.html")).expect("a page");
    assert!(page.contains("Nothing here was measured"), "{page}");

    // Equal to the recording of a run, to the last byte of the headers.
    bench.ok("run scenes/pair.toml --out run -q");
    for recording in ["1-one", "2-other"] {
        let folders = ["which.sweep/scenes/pair", "run"];
        let headers =
            folders.map(|folder| header(&bench, &format!("{folder}/recordings/{recording}")));
        assert_eq!(headers[0], headers[1]);
    }

    // Nothing is acquired or computed again.
    let again = bench.run("sweep which.toml");
    assert_eq!(again.code, 0, "{}", again.err);
    assert_eq!(again.err, "");
    let dry = bench.ok("sweep which.toml --dry-run");
    let there = "scene    pair: 2 recordings, already acquired";
    assert!(dry.contains("found    6") && dry.contains(there), "{dry}");

    // The time of another scene is estimated from the presses of the first.
    let more = sweep.replace(
        "\"scenes/pair.toml\"",
        "[\"scenes/pair.toml\", \"tiny.toml\"]",
    );
    bench.write("which.toml", &more);
    let dry = bench.ok("sweep which.toml --dry-run");
    let time = "scene    tiny: 1 recording to be acquired, 12 presses, about ";
    assert!(dry.contains("tasks    8, 0") && dry.contains(time), "{dry}");
}

#[test]
fn what_is_acquired_twice_has_the_same_keys_and_the_same_bytes() {
    let bench = scored();
    // Neither existing recordings nor the cache are used.
    bench.ok("sweep which.toml --out other --no-cache -q");
    assert_eq!(bytes(&bench, "other"), reference());
    let own = header(&bench, RECORDING);
    assert_eq!(own, header(&bench, "other/scenes/tiny/recordings/1-tiny"));
    let keys = |folder: &str| {
        let results = fs::read_dir(bench.path(folder).join("results")).expect("results");
        let mut keys: Vec<_> = results.flatten().map(|entry| entry.file_name()).collect();
        keys.sort();
        keys
    };
    assert_eq!(keys("other"), keys("which.sweep"));
}

#[test]
fn two_sweeps_at_once_acquire_a_scene_once() {
    let bench = tiny();
    let both: Vec<_> = (0..2)
        .map(|_| {
            let mut command = bench.command("sweep which.toml --jobs 1");
            command.stderr(std::process::Stdio::piped());
            command.stdout(std::process::Stdio::null());
            command.spawn().expect("it starts")
        })
        .collect();
    let mut acquired = 0;
    for one in both {
        let output = one.wait_with_output().expect("it ends");
        let said = String::from_utf8(output.stderr).expect("text");
        assert!(output.status.success(), "{said}");
        acquired += said.matches("acquired into").count();
    }
    assert_eq!(acquired, 1);
    assert_eq!(bytes(&bench, "which.sweep"), reference());
    assert_eq!(claims(&bench), 0);
}

#[test]
fn for_other_engines_a_scene_is_acquired_before_its_tasks_are_listed() {
    let bench = tiny();
    let lines = bench.ok("sweep which.toml --on list -q");
    assert_eq!(lines.lines().count(), 3, "{lines}");
    let before = header(&bench, RECORDING);
    // A task needs neither the scene nor its devices.
    fs::remove_file(bench.path("tiny.toml")).expect("removed");
    bench.ok("sweep task which.sweep --tasks which.sweep/tasks.json --at 0,1 -q");
    bench.ok("sweep collect which.sweep -q");
    assert_eq!(bytes(&bench, "which.sweep"), reference());
    assert_eq!(header(&bench, RECORDING), before);
}

#[test]
fn a_scene_that_changed_is_not_taken_for_the_one_that_was_acquired() {
    let bench = scored();
    bench.write("tiny.toml", &TINY.replace("seed = 7", "seed = 8"));
    bench.refused(
        "sweep which.toml",
        3,
        "which.toml, line 2: `tiny.toml`: which.sweep/scenes/tiny: the run in this folder has a different plan",
    );
    // The remedy of the message.
    fs::remove_dir_all(bench.path("which.sweep/scenes/tiny")).expect("removed");
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("found    0"), "{dry}");
    let out = bench.ok("sweep which.toml -q");
    assert!(out.contains("2 scored, 0 failed, 0 missing"), "{out}");
    assert_ne!(bytes(&bench, "which.sweep"), reference());
}
