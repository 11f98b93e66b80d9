//! Runs that reuse cached stages: the same reports, and no repeated work.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::support::Bench;
use serde_json::Value;

/// Scene of one sensor with a fitted model and classified gratings, a few presses each.
const SMALL: &str = r#"scene_version = 1
name = "small"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16" }
metrics = { want = ["mae", "sensitivity", "uniformity", "sr", "intrinsic"] }
protocol = { calibration = { points = 8, indentations = 2 }, gratings = { step_mm = 0.75, presses = 2 }, surface = { points = 6 }, idle = { frames = 6 } }
"#;

/// The stages of [`SMALL`], in order.
const STAGES: [&str; 4] = ["acquire", "fit", "predict", "classify"];

fn with_small() -> Bench {
    let bench = Bench::with_cache();
    bench.write("small.toml", SMALL);
    bench
}

/// Every file of reports and of recordings in the folder of a run, with its bytes.
fn written(bench: &Bench, run: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let root = bench.path(run);
    let mut files = files(&root.join("reports"));
    files.extend(self::files(&root.join("recordings")));
    let read = files.into_iter().map(|path| {
        let bytes = fs::read(&path).expect("reads");
        (path.strip_prefix(&root).expect("in it").to_owned(), bytes)
    });
    read.collect()
}

/// Every file below a folder, in order.
fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for entry in entries {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Stages that a run took from the cache.
fn reused(bench: &Bench, run: &str) -> Vec<String> {
    let text = fs::read_to_string(bench.path(run).join("stages.json")).expect("there");
    let written: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(written["schema"], "taceva.stages/1");
    let stages = written["stages"].as_array().expect("a list");
    let names = stages.iter().map(|stage| stage["stage"].as_str());
    assert_eq!(names.collect::<Vec<_>>(), STAGES.map(Some));
    let found = stages.iter().filter(|stage| stage["reused"] == true);
    found
        .map(|stage| stage["stage"].as_str().expect("a name").to_owned())
        .collect()
}

/// The only entry of a stage in the cache `cache`.
fn entry(cache: &Path, stage: &str) -> PathBuf {
    let entries = fs::read_dir(cache.join("2").join(stage)).expect("a folder");
    let mut entries: Vec<PathBuf> = entries
        .map(|entry| entry.expect("readable").path())
        .collect();
    assert_eq!(entries.len(), 1, "{stage}");
    entries.remove(0)
}

#[test]
fn an_unchanged_run_finds_every_stage_and_gives_the_bytes_of_one_without_a_cache() {
    let bench = with_small();
    bench.ok("run small.toml --out bare --no-cache -q");
    assert!(!bench.path("bare/stages.json").exists());
    assert!(!bench.path("user-cache").exists(), "nothing is kept");
    bench.ok("run small.toml --out first -q");
    assert_eq!(reused(&bench, "first"), [""; 0]);
    let second = bench.run("run small.toml --out second -v");
    assert_eq!(second.code, 0, "{}", second.err);
    assert_eq!(reused(&bench, "second"), STAGES);
    for stage in STAGES {
        let line = format!("small: {stage} reused sha256:");
        assert!(second.err.contains(&line), "{}", second.err);
    }
    let bare = written(&bench, "bare");
    // Three files of reports; header, table, pack and reference of the recording.
    assert_eq!(bare.len(), 7);
    assert_eq!(written(&bench, "first"), bare);
    assert_eq!(written(&bench, "second"), bare);
    // Even if other runs have cached everything.
    bench.ok("run small.toml --out again --no-cache -q");
    assert!(!bench.path("again/stages.json").exists());
}

#[test]
fn another_setting_of_a_metric_or_form_of_report_carries_out_no_stage() {
    let bench = with_small();
    bench.ok("run small.toml --out first -q");
    let map = "metrics = { settings = { gate_N = 0.4, bins = 3 }, ";
    let other = SMALL.replace("metrics = { ", map) + "report = { formats = [\"csv\"] }\n";
    bench.write("other.toml", &other);
    bench.ok("run other.toml --out other -q");
    assert_eq!(reused(&bench, "other"), STAGES);
    assert!(bench.path("other/reports/1-small.csv").exists());
    bench.ok("run other.toml --out bare --no-cache -q");
    assert_eq!(written(&bench, "other"), written(&bench, "bare"));
    let report = |run: &str| fs::read(bench.path(run).join("reports/1-small.json")).expect("there");
    assert_ne!(report("first"), report("other"), "the setting counts");
}

#[test]
fn another_setting_of_the_model_presses_nothing_again() {
    let bench = with_small();
    bench.ok("run small.toml --out first -q");
    bench.write("other.toml", &SMALL.replace("8x8", "6x6"));
    bench.ok("run other.toml --out other -q");
    assert_eq!(reused(&bench, "other"), ["acquire", "classify"]);
    bench.ok("run other.toml --out bare --no-cache -q");
    assert_eq!(written(&bench, "other"), written(&bench, "bare"));
}

#[test]
fn another_setting_of_the_model_alone_takes_its_features_from_the_cache_and_decodes_no_frame() {
    let bench = with_small();
    bench.ok("run small.toml --out first -q");
    let kept = files(&bench.path("user-cache/taceva/2/features"));
    // One entry for the training presses, one for the predicted ones.
    assert_eq!(kept.len(), 2);
    let with_strength = |name: &str, strength: &str| {
        let size = "size = \"8x8\"";
        let settings = format!("{size}, strength = \"{strength}\"");
        bench.write(&format!("{name}.toml"), &SMALL.replace(size, &settings));
        bench.ok(&format!("run {name}.toml --out {name} -q"));
        assert_eq!(reused(&bench, name), ["acquire", "classify"]);
        bench.ok(&format!("run {name}.toml --out {name}-bare --no-cache -q"));
        assert_eq!(files(&bench.path("user-cache/taceva/2/features")), kept);
        (
            written(&bench, name),
            written(&bench, &format!("{name}-bare")),
        )
    };
    let (found, bare) = with_strength("weak", "0.001");
    assert_eq!(found, bare);
    // Replaced features are used as they are, because no frame is read.
    for path in &kept {
        let bytes = fs::read(path).expect("kept");
        // The digest is followed by height, width and depth, then the features.
        let mut others = bytes[72..84].to_vec();
        others.resize(bytes.len() - 72, 0);
        let digest = taceva_dataset::Digest::of(&others);
        fs::write(path, [format!("{digest}\n").into_bytes(), others].concat()).expect("altered");
    }
    let (found, bare) = with_strength("strong", "1000");
    assert_ne!(found, bare);
}

#[test]
fn a_run_stores_no_features_as_large_as_their_frames_and_its_bytes_are_those_without_a_cache() {
    let bench = with_small();
    // 4,096 bytes of features for a picture of 45×45 pixels in 16 bits, which has 4,050 bytes before compression.
    let large = SMALL.replace("8x8", "32x32");
    let with = |place: &str, setting| large.replace(place, &format!("{place}, {setting}"));
    for (name, scene) in [
        ("plain", large.clone()),
        ("strong", with("\"32x32\"", "strength = \"1000\"")),
        ("folded", with("name = \"ridge\"", "folds = 4")),
    ] {
        bench.write("large.toml", &scene);
        bench.ok(&format!("run large.toml --out {name} -q"));
        let kept = files(&bench.path("user-cache/taceva/2/features"));
        assert_eq!(kept, Vec::<PathBuf>::new(), "{name}");
        bench.ok(&format!("run large.toml --out {name}-bare --no-cache -q"));
        assert_eq!(
            written(&bench, name),
            written(&bench, &format!("{name}-bare"))
        );
    }
}

#[test]
fn another_seed_press_or_parameter_finds_nothing() {
    let bench = with_small();
    bench.ok("run small.toml --out first -q");
    bench.ok("run small.toml --out seed --seed 8 -q");
    assert_eq!(reused(&bench, "seed"), [""; 0]);
    let table = include_str!("../../../plugins/sim/parameters/vitactip.toml").replace(
        "conditioning_fraction = { value = 0.0",
        "conditioning_fraction = { value = 0.4",
    );
    let driver = "\"sim/vitactip:reduction=16\"";
    let softened = format!(
        "'''sim/vitactip:reduction=16;table={}'''",
        table.replace(';', ";;")
    );
    for (name, scene) in [
        ("press", SMALL.replace("points = 8", "points = 9")),
        ("parameter", SMALL.replace(driver, &softened)),
    ] {
        bench.write("other.toml", &scene);
        bench.ok(&format!("run other.toml --out {name} -q"));
        assert_eq!(reused(&bench, name), [""; 0], "{name}");
    }
}

#[test]
fn a_damaged_entry_is_removed_and_made_again() {
    let bench = with_small();
    let run = |name: &str| bench.run(&format!("run small.toml --out {name} --cache kept"));
    assert_eq!(run("first").code, 0);
    let whole = written(&bench, "first");
    let cache = bench.path("kept");
    let of_run = |file: &str| PathBuf::from(format!("recordings/1-small/{file}"));
    let damages = [
        ("acquire", of_run("dataset.toml")),
        ("acquire", of_run("samples.parquet")),
        ("acquire", of_run("frames/0000.pack")),
        ("acquire", of_run("frames/reference.png")),
        ("fit", entry(&cache, "fit")),
        ("predict", entry(&cache, "predict")),
        ("classify", entry(&cache, "classify")),
    ];
    let mut last = "first".to_owned();
    for (number, (stage, file)) in damages.iter().enumerate() {
        for way in ["cut", "gone"] {
            let name = format!("{way}-{number}");
            // A cache entry, or a file of the only remaining run.
            let file = &bench.path(&last).join(file);
            let bytes = fs::read(file).expect("kept");
            // The file is removed first, because it may be linked to another one.
            fs::remove_file(file).expect("removed");
            if way == "cut" {
                fs::write(file, &bytes[..bytes.len() / 2]).expect("cut");
            }
            let ran = run(&name);
            assert_eq!(ran.code, 0, "{}", ran.err);
            let is_noted =
                ran.err.contains("computed again") || ran.err.contains("simulated again");
            let is_absent = way == "gone" && *stage != "acquire";
            assert_eq!(is_noted, !is_absent, "{name}: {}", ran.err);
            let expected = STAGES.iter().filter(|other| *other != stage);
            assert_eq!(reused(&bench, &name), expected.copied().collect::<Vec<_>>());
            assert_eq!(written(&bench, &name), whole, "{name}");
            fs::remove_dir_all(bench.path(&last)).expect("removed");
            last = name;
        }
    }
}

#[test]
fn a_recording_that_its_run_took_along_or_exchanged_is_pressed_again() {
    let bench = with_small();
    bench.ok("run small.toml --out first --cache kept -q");
    let whole = written(&bench, "first");
    fs::rename(bench.path("first"), bench.path("elsewhere")).expect("moved");
    let gone = bench.run("run small.toml --out second --cache kept");
    assert!(!gone.err.contains("simulated again"), "{}", gone.err);
    assert_eq!(reused(&bench, "second"), ["fit", "predict", "classify"]);
    assert_eq!(written(&bench, "second"), whole);
    // Another complete recording at the noted place.
    bench.ok("run small.toml --out second --force --seed 8 --cache kept -q");
    let exchanged = bench.run("run small.toml --out third --cache kept");
    assert!(
        exchanged.err.contains("simulated again"),
        "{}",
        exchanged.err
    );
    assert_eq!(reused(&bench, "third"), ["fit", "predict", "classify"]);
    assert_eq!(written(&bench, "third"), whole);
    // The same file, not a copy.
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        bench.ok("run small.toml --out fourth --cache kept -q");
        assert_eq!(reused(&bench, "fourth"), STAGES);
        let pack =
            |run: &str| fs::metadata(bench.path(run).join("recordings/1-small/frames/0000.pack"));
        let inode = |run: &str| MetadataExt::ino(&pack(run).expect("there"));
        assert_eq!(inode("third"), inode("fourth"));
    }
}

#[test]
fn an_entry_of_another_layout_and_a_half_written_one_are_never_read() {
    let bench = with_small();
    bench.ok("run small.toml --out first --cache kept -q");
    fs::rename(bench.path("kept/2"), bench.path("kept/1")).expect("moved");
    bench.ok("run small.toml --out second --cache kept -q");
    assert_eq!(reused(&bench, "second"), [""; 0]);
    // State left by a run that was stopped while it noted a recording.
    let recording = entry(&bench.path("kept"), "acquire");
    fs::rename(
        recording,
        bench.path("kept/2/partial/.taceva-staged-a1b2c3"),
    )
    .expect("moved");
    bench.ok("run small.toml --out third --cache kept -q");
    assert_eq!(reused(&bench, "third"), ["fit", "predict", "classify"]);
    assert_eq!(written(&bench, "first"), written(&bench, "third"));
}

#[test]
fn a_cache_that_cannot_be_written_is_said_once_and_the_run_goes_on() {
    let bench = with_small();
    bench.write("file", "mine");
    let ran = bench.run("run small.toml --out run --cache file");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert_eq!(
        ran.err.matches("cannot write to the cache").count(),
        1,
        "{}",
        ran.err
    );
    assert_eq!(reused(&bench, "run"), [""; 0]);
    assert_eq!(fs::read(bench.path("file")).expect("there"), b"mine");
}

#[test]
fn runs_at_once_with_one_cache_do_not_disturb_each_other() {
    let bench = with_small();
    let runs = ["a", "b", "c"];
    let started = runs.map(|run| {
        let words = format!("run small.toml --out {run} --cache kept -q");
        bench
            .command(&words)
            .stdout(Stdio::null())
            .spawn()
            .expect("starts")
    });
    for mut run in started {
        assert!(run.wait().expect("ends").success());
    }
    let first = written(&bench, "a");
    assert!(runs.iter().all(|run| written(&bench, run) == first));
    assert!(files(&bench.path("kept/2/partial")).is_empty());
    bench.ok("run small.toml --out d --cache kept -q");
    assert_eq!(reused(&bench, "d"), STAGES);
}

#[test]
fn a_run_that_is_gone_on_with_keeps_its_own_recording() {
    let bench = with_small();
    bench.ok("run small.toml --out first --no-cache -q");
    let left = "first/recordings/.taceva-staged-a1b2c3";
    bench.write(&format!("{left}/.taceva-temporary"), "");
    bench.write(&format!("{left}/recording/dataset.toml"), "half");
    bench.ok("run small.toml --out first --resume -q");
    assert_eq!(reused(&bench, "first"), [""; 0]);
    assert!(!bench.path(left).exists());
    bench.ok("run small.toml --out second -q");
    assert_eq!(reused(&bench, "second"), STAGES);
}

#[test]
fn a_cache_and_none_are_not_asked_for_together() {
    let bench = with_small();
    bench.refused(
        "run small.toml --cache kept --no-cache",
        2,
        "cannot be used with",
    );
}
