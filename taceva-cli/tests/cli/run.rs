//! A scene, end to end on the simulated bench: scores, and a folder that survives any interruption.

mod faults;
mod folds;
mod limits;
mod model_split;
mod overrides;
mod recorded;
mod reduced;
mod resume;
mod slip;
mod tasks;
mod widths;

use std::fs;
use std::path::Path;

use crate::support::Bench;
use serde_json::Value;

/// Scene of one sensor with every part of the protocol, a few presses each.
pub(crate) const SMALL: &str = r#"scene_version = 1
name = "small"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
lighting = { driver = "sim/lighting" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16", units = ["0", "1"] }
protocol = { calibration = { points = 16, indentations = 2 }, spatial = { points = 5 }, gratings = { step_mm = 0.75, presses = 2 }, lighting = { points = 2 }, repeatability = { points = 2, trials = 3, depth_step_mm = 0.5 }, hysteresis = { points = 2, depth_step_mm = 0.5 }, surface = { points = 6 }, idle = { frames = 6 } }
"#;

fn with_small() -> Bench {
    let bench = Bench::new();
    bench.write("small.toml", SMALL);
    bench
}

/// Every file of reports in a folder of a run, with its bytes.
fn reports(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder.join("reports")).expect("a folder");
    let mut files: Vec<(String, Vec<u8>)> = entries
        .map(|entry| {
            let path = entry.expect("readable").path();
            let name = path
                .file_name()
                .expect("named")
                .to_string_lossy()
                .into_owned();
            (name, fs::read(path).expect("reads"))
        })
        .collect();
    files.sort();
    files
}

fn dataset_of(folder: &Path) -> String {
    let (_, bytes) = reports(folder).swap_remove(0);
    let report: Value = serde_json::from_slice(&bytes).expect("JSON");
    report["provenance"]["dataset"]
        .as_str()
        .expect("a digest")
        .to_owned()
}

#[test]
fn a_scene_gives_scores_of_every_part_and_says_that_nothing_was_measured() {
    let bench = with_small();
    let run = bench.json("run small.toml");
    assert_eq!(run["schema"], "taceva.run/1.0");
    let report = &run["studies"][0];
    assert_eq!(report["subject"]["source"], "simulated");
    let gel = report["subject"]["gel"].as_str().expect("a name");
    assert!(
        gel.starts_with("bench ") && gel.ends_with("seed 7"),
        "{gel}"
    );
    let metrics = report["metrics"].as_object().expect("scores");
    for (metric, channel, greatest) in [
        ("mae", "Fz", 0.7),
        ("sensitivity", "Fz", 30.0),
        ("r_spatial", "Fz", 0.7),
        ("r_light", "Fz", 10.0),
        ("repeatability", "Fz", 0.7),
        ("hysteresis", "Fz", 5.0),
        ("inter_sensor", "surface_z", 1.0),
    ] {
        let value = metrics[metric][channel]["value"].as_f64();
        let value = value.unwrap_or_else(|| panic!("{metric}: {}", metrics[metric]));
        assert!(value > 0.0 && value < greatest, "{metric}: {value}");
    }
    // Pictures at rest come at the rate of the camera, so that their times show it.
    let rate = &metrics["intrinsic"]["frame_rate"];
    let rate_hz = rate["value"].as_f64().expect("a rate");
    assert!((rate_hz - 30.0).abs() < 0.1, "{rate}");
    assert_eq!(rate["n"], 6, "times count at rest alone: {rate}");
    // Presses cover the round field of view of 1257 mm² and no more.
    let view = &metrics["intrinsic"]["field_of_view"];
    let area_mm2 = view["value"].as_f64().expect("an area");
    assert!(area_mm2 > 100.0 && area_mm2 < 1257.0, "{view}");
    // Three boards of each relief, pressed twice.
    for kind in ["line", "dot"] {
        assert_eq!(metrics["sr"][kind]["n"], 6, "{}", metrics["sr"]);
    }
    let out = bench.ok("run small.toml -q");
    assert!(out.contains("Nothing here was measured"), "{out}");
}

#[test]
fn a_run_never_writes_over_another_unless_told_to() {
    let bench = with_small();
    bench.ok("run small.toml -q");
    bench.ok("run small.toml -q");
    let first = reports(&bench.path("runs/small-1"));
    assert_eq!(first, reports(&bench.path("runs/small-2")));
    bench.refused("run small.toml --out runs/small-1", 3, "exists already");
    bench.refused(
        "run small.toml --out runs/small-1 --resume --seed 8",
        3,
        "a different plan",
    );
    bench.refused(
        "run small.toml --out nowhere --resume",
        3,
        "no run to resume",
    );
    bench.write("mine/notes.txt", "mine");
    bench.refused(
        "run small.toml --out mine --force",
        3,
        "the folder holds no run",
    );
    bench.ok("run small.toml --out runs/small-1 --force --seed 8 -q");
    assert_ne!(first, reports(&bench.path("runs/small-1")));
}

#[test]
fn the_reports_of_several_sensors_do_not_depend_on_the_number_of_jobs() {
    let bench = Bench::new();
    let sensor = SMALL
        .lines()
        .find(|line| line.starts_with("sensor"))
        .expect("one");
    let studies = r#"[[study]]
name = "one"
sensor = { driver = "sim/gelsight:reduction=16", units = ["0", "1"] }
[[study]]
name = "other"
sensor = { driver = "sim/magictac:reduction=16", units = ["0", "1"] }
"#;
    let scene = SMALL.replace(sensor, "");
    bench.write("two.toml", &format!("{scene}{studies}"));
    bench.ok("run two.toml --out a --jobs 1 -q");
    bench.ok("run two.toml --out b --jobs 3 -q");
    let alone = reports(&bench.path("a"));
    // JSON, text and samples of each study.
    assert_eq!(alone.len(), 6);
    assert_eq!(alone, reports(&bench.path("b")));
    let page = |run: &str| fs::read_to_string(bench.path(run).join("report.html")).expect("a page");
    assert_eq!(page("a"), page("b"));
    assert!(page("a").contains("Nothing here was measured"));
}

#[test]
fn a_scene_of_forces_takes_and_decodes_no_frame() {
    let bench = Bench::new();
    let want = "metrics = { want = [\"sensitivity\", \"hysteresis\", \"inter_sensor\"] }\n";
    bench.write("force.toml", &format!("{SMALL}{want}"));
    let run = bench.json("run force.toml --out f");
    let report = &run["studies"][0];
    assert_eq!(report["provenance"]["frames_decoded"], 0);
    assert_eq!(report["metrics"].as_object().expect("scores").len(), 3);
    let frames = fs::read_dir(bench.path("f/recordings/1-small/frames")).expect("a folder");
    assert_eq!(frames.count(), 0);
}

#[test]
fn what_cannot_be_run_is_refused_before_a_folder_is_made() {
    let bench = Bench::new();
    let cases = [
        (
            SMALL.replace("sim/robot", "sim/rbot"),
            "s.toml, line 4: `sim/rbot`: unknown driver of a robot",
        ),
        (
            format!("{SMALL}limits = {{ Pz_max_mm = 9.0 }}\n"),
            "s.toml, line 10: ",
        ),
        (
            format!("{SMALL}depht = 1\n"),
            "s.toml, line 10: `depht`: unknown key",
        ),
        (
            SMALL.replace("\"ridge\"", "\"rigde\""),
            "s.toml, line 7: no model is called `rigde`",
        ),
        (SMALL.replace("8x8", "8y8"), "s.toml, line 7: "),
    ];
    for (scene, message) in cases {
        bench.write("s.toml", &scene);
        bench.refused("run s.toml --out r", 3, message);
        assert!(!bench.path("r").exists(), "{message}");
    }
}

#[test]
fn a_device_that_fails_stops_the_run_with_a_code_of_its_own() {
    let bench = Bench::new();
    let ball = "protocol = { contact = { indenter_radius_mm = 3.0 }, ";
    bench.write("small.toml", &SMALL.replace("protocol = { ", ball));
    bench.refused("run small.toml --out r", 4, "expected 2, 4 or 10 mm");
    bench.refused(
        "run small.toml --out r --resume",
        4,
        "expected 2, 4 or 10 mm",
    );
}

#[test]
fn a_lit_sensor_without_pictures_is_pressed_without_its_lamps() {
    let bench = Bench::new();
    let scene = r#"scene_version = 1
name = "force"
seed = 7
sensor = { driver = "sim/vitactip:reduction=16" }
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
metrics = { want = ["sensitivity"] }
protocol = { calibration = { points = 3, indentations = 1 } }
"#;
    bench.write("force.toml", scene);
    bench.ok("run force.toml --out pressed -q");
}
