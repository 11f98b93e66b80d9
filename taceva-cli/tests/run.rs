//! A scene, end to end on the simulated bench: scores, and a folder that survives whatever ends the program.

mod support;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use serde_json::Value;
use support::Bench;

/// One sensor, every part of the protocol, a few presses each.
const SMALL: &str = r#"scene_version = 1
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
    assert_eq!(run["schema"], "taceva.run/1.2");
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
    // Pictures at rest come as fast as the camera gives them, so that their times say how fast that is.
    let rate = &metrics["intrinsic"]["frame_rate"];
    let rate_hz = rate["value"].as_f64().expect("a rate");
    assert!((rate_hz - 30.0).abs() < 0.1, "{rate}");
    assert_eq!(rate["n"], 6, "times count at rest alone: {rate}");
    // Presses reach over the round field of view of 1257 mm² and not beyond.
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
        "other plans",
    );
    bench.refused(
        "run small.toml --out nowhere --resume",
        3,
        "no run to go on with",
    );
    bench.write("mine/notes.txt", "mine");
    bench.refused("run small.toml --out mine --force", 3, "no run");
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
    // JSON, text and samples of each.
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

/// A run that was started and is ended from outside.
struct Started {
    child: Child,
    journal: PathBuf,
}

impl Started {
    fn new(bench: &Bench, folder: &str) -> Started {
        let mut command = bench.command(&format!("run small.toml --out {folder} -q"));
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn();
        Started {
            child: child.expect("starts"),
            journal: bench.path(folder).join("recordings/1-small/journal"),
        }
    }

    /// Waits until so many bytes are recorded.
    fn reaches(&mut self, bytes: u64) {
        loop {
            let length = fs::metadata(&self.journal).map_or(0, |journal| journal.len());
            if length >= bytes {
                return;
            }
            let ended = self.child.try_wait().expect("asked");
            assert!(ended.is_none(), "it ended with {length} bytes recorded");
            std::thread::yield_now();
        }
    }
}

/// Kills a run each time so many bytes are recorded, goes on, and compares with the run that nobody killed.
fn survives(bench: &Bench, moments: &[u64]) {
    bench.ok("run small.toml --out whole -q");
    let whole = reports(&bench.path("whole"));
    for bytes in moments {
        let mut killed = Started::new(bench, "killed");
        killed.reaches(*bytes);
        killed.child.kill().expect("killed");
        killed.child.wait().expect("ended");
        bench.ok("run small.toml --out killed --resume -q");
        let datasets = ["killed", "whole"].map(|run| dataset_of(&bench.path(run)));
        assert_eq!(datasets[0], datasets[1], "killed at {bytes} bytes");
        assert_eq!(reports(&bench.path("killed")), whole);
        fs::remove_dir_all(bench.path("killed")).expect("removed");
    }
}

#[test]
fn whatever_ends_a_run_it_goes_on_to_the_same_bytes() {
    // Between two presses at one place, in another light, on a board: wherever it happens to be.
    survives(&with_small(), &[3_000, 20_000, 45_000]);
}

#[test]
fn a_gel_that_is_softened_by_use_is_brought_back_to_where_it_was() {
    let bench = Bench::new();
    let table = include_str!("../../plugins/sim/parameters/vitactip.toml")
        .replace(
            "conditioning_fraction = { value = 0.0",
            "conditioning_fraction = { value = 0.4",
        )
        .replace(';', ";;");
    assert!(table.contains("value = 0.4"));
    let driver = "\"sim/vitactip:reduction=16\"";
    let softened = format!("'''sim/vitactip:reduction=16;table={table}'''");
    bench.write("small.toml", &SMALL.replace(driver, &softened));
    survives(&bench, &[30_000, 45_000]);
}

#[cfg(unix)]
#[test]
fn a_signal_stops_a_run_between_motions_and_it_says_how_to_go_on() {
    let bench = with_small();
    let mut stopped = Started::new(&bench, "stopped");
    stopped.reaches(10_000);
    let id = stopped.child.id().to_string();
    let sent = Command::new("kill").args(["-TERM", &id]).status();
    assert!(sent.expect("there is a kill").success());
    let ended = stopped.child.wait_with_output().expect("ended");
    assert_eq!(ended.status.code(), Some(5));
    let message = String::from_utf8(ended.stderr).expect("UTF-8");
    assert!(
        message.contains("--resume --out stopped goes on"),
        "{message}"
    );
    assert!(reports(&bench.path("stopped")).is_empty());
    bench.ok("run small.toml --out stopped --resume -q");
    bench.ok("run small.toml --out whole -q");
    assert_eq!(
        reports(&bench.path("stopped")),
        reports(&bench.path("whole"))
    );
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
fn what_was_recorded_is_scored_again_without_a_press() {
    let bench = with_small();
    bench.ok("run small.toml --out first -q");
    let again = "scene_version = 1\nname = \"again\"\nmodel = { name = \"ridge\", set = { size = \"8x8\" } }\n\
                 sensor = { dataset = \"../first/recordings/1-small\" }\n";
    bench.write("scenes/again.toml", again);
    let run = bench.json("run scenes/again.toml --out again");
    let report = &run["studies"][0];
    assert_eq!(report["subject"]["source"], "simulated");
    assert!(
        report["metrics"]["mae"]["Fz"]["value"].is_number(),
        "{report}"
    );
    assert!(
        report["metrics"]["sr"]["line"]["value"].is_number(),
        "{report}"
    );
    assert!(
        fs::read_dir(bench.path("again/recordings"))
            .expect("a folder")
            .next()
            .is_none()
    );
}

#[test]
fn presses_that_a_limit_ends_are_counted_by_their_limit_in_every_report_of_them() {
    let bench = Bench::new();
    bench.write("s.toml", &format!("{SMALL}limits = {{ Fz_max_N = 0.3 }}\n"));
    let (limited, _) = limited_presses(&bench);
    assert!(limited > 5, "{limited}");
}

#[test]
fn a_press_that_a_limit_ends_before_its_first_sample_is_counted_too() {
    let bench = Bench::new();
    let scene = SMALL
        .replace("vitactip", "gelsight")
        .replace("lighting = { driver = \"sim/lighting\" }\n", "")
        .replace("lighting = { points = 2 }, ", "")
        .replace(
            "protocol = { ",
            "protocol = { contact = { step_mm = 0.5 }, ",
        );
    let metrics = "metrics = { want = [\"sensitivity\", \"inter_sensor\"] }\n";
    bench.write(
        "s.toml",
        &format!("{scene}limits = {{ Fz_max_N = 0.2 }}\n{metrics}"),
    );
    let (limited, presses) = limited_presses(&bench);
    let exported = fs::read_to_string(bench.path("r/recordings/1-small/dataset.toml"));
    let rows = exported.expect("reads");
    let rows = rows.lines().find_map(|line| line.strip_prefix("rows = "));
    let rows: u64 = rows.expect("counted").parse().expect("a number");
    assert!(
        limited > 5 && rows < presses,
        "{limited}, {rows} rows, {presses}"
    );
}

/// The presses of `s.toml` that the limit of normal force ended, and all of them, by what every report says.
fn limited_presses(bench: &Bench) -> (u64, u64) {
    let run = bench.json("run s.toml --out r");
    let provenance = &run["studies"][0]["provenance"];
    let dataset = provenance["dataset"].as_str().expect("a digest");
    let presses = &provenance["presses"][dataset];
    let counts = presses.as_object().expect("counts").values();
    let all = counts.map(|count| count.as_u64().expect("a count")).sum();
    let limited = presses["normal-force-limit"].as_u64().expect("a count");
    let said = format!("{limited} ended by the limit of normal force");
    let text = fs::read_to_string(bench.path("r/reports/1-small.txt"));
    assert!(text.expect("reads").contains(&said), "{said}");
    let evaluated = bench.ok("evaluate r/recordings/1-small --model baseline --channels Fz");
    assert!(evaluated.contains(&said), "{evaluated}");
    (limited, all)
}

#[test]
fn a_recording_of_a_run_is_evaluated_with_the_channels_and_the_split_of_its_plan() {
    let bench = with_small();
    bench.ok("run small.toml --out r -q");
    let report = bench.json("evaluate r/recordings/1-small --model ridge --set size=8x8");
    let provenance = &report["provenance"];
    let ran: Value = serde_json::from_slice(&reports(&bench.path("r"))[0].1).expect("JSON");
    assert_eq!(provenance["split"], ran["provenance"]["split"]);
    assert_eq!(provenance["samples"], ran["provenance"]["samples"]);
    assert_eq!(provenance["seed"], 7);
    let notes = provenance["notes"].to_string();
    assert!(notes.contains("as its plan does"), "{notes}");
    bench.ok("fit r/recordings/1-small --model ridge --set size=8x8 --out m.taceva -q");
    let again = bench.json("evaluate r/recordings/1-small --with m.taceva");
    assert_eq!(again["metrics"], report["metrics"]);
    // A model that looks at no picture, on the same channels and presses.
    let constant = bench.json("evaluate r/recordings/1-small --model baseline --metrics accuracy");
    assert_eq!(constant["provenance"]["samples"], provenance["samples"]);
    let channels = |report: &Value| {
        let scores = report["metrics"]["mae"].as_object().expect("scores");
        scores.keys().cloned().collect::<Vec<_>>()
    };
    assert_eq!(channels(&constant), channels(&report));
    bench.ok("fit r/recordings/1-small --model baseline --out b.taceva -q");
    bench.ok("evaluate r/recordings/1-small --with b.taceva -q");
    bench.ok("check r/recordings/1-small -q");
    fs::rename(bench.path("r/recordings/1-small"), bench.path("moved")).expect("moved");
    bench.refused(
        "evaluate moved --with m.taceva",
        2,
        "in the folder of that run",
    );
}

#[test]
fn a_run_takes_another_model_settings_and_seeds_than_its_scene_names() {
    let bench = with_small();
    let words =
        "run small.toml --out run --model cnn --set size=16x16 --set epochs=2 --seeds 3,1,2";
    let run = bench.json(words);
    let study = &run["studies"][0];
    let model = &study["provenance"]["model"];
    assert_eq!(model["name"], "cnn");
    // The report is that of the first.
    let settings = &model["settings"];
    assert_eq!(
        (&settings["seed"], &settings["epochs"]),
        (&"3".into(), &"2".into())
    );
    let over = &study["over_seeds"];
    assert_eq!(over["seeds"], serde_json::json!([3, 1, 2]));
    let scores = over["scores"].as_array().expect("a list");
    let mae = |channel: &str| {
        let mut scores = scores.iter();
        let found = scores.find(|score| score["metric"] == "mae" && score["channel"] == channel);
        found.expect("predicted").clone()
    };
    let pz = mae("Pz");
    let values: Vec<f64> = pz["values"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    assert_eq!(values.len(), 3);
    assert!(
        values
            .windows(2)
            .all(|pair| pair[0].to_bits() != pair[1].to_bits()),
        "{values:?}"
    );
    let of_report = &study["metrics"]["mae"]["Pz"]["value"];
    assert_eq!(
        of_report.as_f64(),
        Some(values[0]),
        "{}",
        study["metrics"]["mae"]
    );
    let mean = values.iter().sum::<f64>() / 3.0;
    assert!((pz["mean"].as_f64().expect("a number") - mean).abs() < 1e-12);
    let ends: Vec<f64> = pz["interval"]
        .as_array()
        .expect("two")
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    assert!(
        0.0 <= ends[0] && ends[0] < mean && mean < ends[1],
        "{ends:?}"
    );
    // What is measured without a model does not go up and down with its seed.
    assert!(scores.iter().all(|score| score["metric"] != "sensitivity"));
    let text = fs::read_to_string(bench.path("run/reports/1-small.txt")).expect("there");
    assert!(
        text.contains("over the seeds 3, 1, 2 of the training"),
        "{text}"
    );
}

#[test]
fn seeds_of_a_model_that_draws_nothing_and_settings_of_none_are_refused_before_a_press() {
    let bench = with_small();
    bench.refused(
        "run small.toml --out a --seeds 1-3",
        2,
        "the model ridge draws nothing",
    );
    bench.refused("run small.toml --out a --set strenth=1", 2, "strenth");
    bench.refused("run small.toml --out a --model rigde", 2, "rigde");
    bench.refused("run small.toml --out a --seeds 1", 2, "2 to 100 different");
    let unnamed = SMALL.replace(
        "model = { name = \"ridge\", set = { size = \"8x8\" } }\n",
        "",
    );
    bench.write("none.toml", &unnamed);
    bench.refused(
        "run none.toml --out a --set size=8x8",
        2,
        "name one with --model",
    );
    assert!(!bench.path("a").exists());
}
