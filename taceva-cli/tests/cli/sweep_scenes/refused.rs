//! Scenes that a sweep cannot acquire are refused before any acquisition, by file and line.

use std::fs;

use super::{SWEEP, TINY, tiny};
use crate::support::Bench;

/// Writes the file of the sweep with the text `scenes` instead of its list of scenes.
fn with(bench: &Bench, scenes: &str) {
    let text = SWEEP.replace("scenes = [\"tiny.toml\"]", scenes);
    assert_ne!(text, SWEEP);
    bench.write("which.toml", &text);
}

#[test]
fn a_scene_that_is_not_there_is_refused_with_those_that_are_built_in() {
    let bench = tiny();
    with(&bench, "scenes = [\n    \"tiny.toml\",\n    \"quik\",\n]");
    bench.refused(
        "sweep which.toml",
        3,
        "which.toml, line 2: `quik`: no such scene in ., expected a file or one of quick, paper; did you mean `quick`?",
    );
    with(&bench, "scenes = \"tinny.toml\"");
    bench.refused("sweep which.toml", 3, "`tinny.toml`: no such scene in .");
    // A built-in scene is known from any folder.
    with(&bench, "scenes = \"quick\"");
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("quick: 4 recordings to be acquired"), "{dry}");
    assert!(!bench.path("which.sweep").exists());
}

#[test]
fn neither_scenes_nor_datasets_and_a_scene_that_is_named_twice_are_refused() {
    let bench = tiny();
    with(&bench, "scenes = []");
    bench.refused(
        "sweep which.toml",
        3,
        "which.toml, line 2: an empty grid: neither `datasets` nor `scenes` has an entry",
    );
    with(&bench, "datasets = []");
    bench.refused("sweep which.toml", 3, "which.toml, line 2: an empty grid");
    with(&bench, "");
    bench.refused("sweep which.toml", 3, "which.toml: an empty grid");
    with(&bench, "scenes = [\"tiny.toml\", \"tiny.toml\"]");
    bench.refused("sweep which.toml", 3, "`scenes`: tiny.toml is listed twice");
    with(&bench, "scene = \"tiny.toml\"");
    bench.refused("sweep which.toml", 3, "did you mean `scenes`?");
}

#[test]
fn names_that_stand_for_two_things_are_refused() {
    let bench = tiny();
    // Names of scenes become names of folders.
    bench.write("again.toml", &TINY.replace("\"tiny\"", "\"Tiny\""));
    with(&bench, "scenes = [\"tiny.toml\", \"again.toml\"]");
    bench.refused(
        "sweep which.toml",
        3,
        "line 2: `tiny.toml` and `again.toml` would be acquired into one folder, which.sweep/scenes/tiny",
    );
    fs::create_dir(bench.path("tiny")).expect("made");
    bench.record("tiny/tiny", 24);
    with(&bench, "datasets = \"tiny/tiny\"\nscenes = \"tiny.toml\"");
    bench.refused(
        "sweep which.toml",
        3,
        "line 3: a folder and a recording of a scene are both called `tiny/tiny`: write the folder as `./tiny/tiny`",
    );
    with(&bench, "datasets = \"./tiny/tiny\"\nscenes = \"tiny.toml\"");
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("tasks    4, 0"), "{dry}");
}

#[test]
fn a_scene_of_a_real_rig_or_of_a_recording_is_left_to_a_run() {
    let bench = tiny();
    bench.write("lab.toml", LAB);
    bench.write("real.toml", REAL);
    with(&bench, "scenes = [\"tiny.toml\", \"real.toml\"]");
    bench.refused(
        "sweep which.toml",
        3,
        "line 2: `real.toml`: study `real` uses a real rig, which a person must supervise; a sweep acquires only scenes of the simulated bench: run the scene with `taceva run`, and name its recordings under `datasets`",
    );
    bench.record("monday", 24);
    let driver = "driver = \"sim/vitactip:reduction=16\"";
    let recorded = TINY.replace(driver, "dataset = \"monday\"");
    let recorded = recorded.split("protocol").next().expect("a scene");
    bench.write("recorded.toml", recorded);
    with(&bench, "scenes = \"recorded.toml\"");
    bench.refused(
        "sweep which.toml",
        3,
        "`recorded.toml`: study `tiny` uses a recording and acquires no data",
    );
    assert!(!bench.path("which.sweep").exists());
}

#[test]
fn a_scene_that_cannot_be_meant_and_a_sweep_that_cannot_are_refused_before_any_press() {
    let bench = tiny();
    bench.write("tiny.toml", &TINY.replace("sim/robot", "sim/robott"));
    bench.refused("sweep which.toml", 3, "tiny.toml, line 4");
    bench.write("tiny.toml", TINY);
    bench.write("which.toml", &SWEEP.replace("\"ridge\"", "\"rigde\""));
    bench.refused("sweep which.toml", 3, "did you mean `ridge`?");
    bench.write("which.toml", &SWEEP.replace("size = [", "sise = ["));
    bench.refused("sweep which.toml", 3, "did you mean `size`?");
    bench.write("which.toml", SWEEP);
    bench.refused("sweep which.toml --only modell=ridge", 2, "`model`?");
    let score = "[score]\ntruth = \"t.csv\"\npred = \"p.csv\"\nshards = 2\n";
    let beside = format!("sweep_version = 1\nscenes = [\"tiny.toml\"]\n{score}");
    bench.write("which.toml", &beside);
    bench.refused(
        "sweep which.toml",
        3,
        "which.toml, line 2: `scenes` cannot be combined with `[score]`",
    );
    assert!(!bench.path("which.sweep").exists());
}

/// Rig of real devices, none of which is opened.
pub(crate) const LAB: &str = r#"rig_version = 1
[robot]
driver = "ufactory/xarm:host=127.0.0.1"
carries = "indenter"
origin_mm = [300.0, 0.0, 251.3]
axes = ["x", "-y", "-z"]
[force]
driver = "sri/m8128:host=127.0.0.1"
axes = ["x", "-y", "-z"]
latency_ms = 4.0
[sensor]
driver = "camera/mjpeg:url=http://127.0.0.1:9/"
latency_ms = 38.0
[limits]
speed_max_mm_s = 20.0
"#;
/// Scene on the rig [`LAB`].
pub(crate) const REAL: &str = r#"scene_version = 1
name = "real"
seed = 7
rig = "lab.toml"
sensor = { opaque = true, markers = true, footprint = { shape = "rect", half_x_mm = 8.0, half_y_mm = 10.0 } }
limits = { Pz_max_mm = 1.0, Fz_max_N = 1.8 }
model = { name = "ridge" }
metrics = { want = ["accuracy"] }
protocol = { contact = { speed_mm_s = 2.0, threshold_N = 0.05 }, calibration = { points = 6, indentations = 1 } }
"#;
