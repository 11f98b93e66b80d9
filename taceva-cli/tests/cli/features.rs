//! Settings choose the input of a model.

use std::fs;
use std::path::PathBuf;

use crate::support::Bench;

/// Scene of a gel without markers, whose light changes little.
const PRESSED: &str = r#"
scene_version = 1
name = "press"
seed = 1
metrics = { want = ["r2"] }
report = { formats = [] }
[robot]
driver = "sim/robot"
[force]
driver = "sim/force-transducer"
[protocol.contact]
threshold_N = 0.02
step_mm = 0.1
[protocol.calibration]
points = 60
indentations = 4
[model]
name = "baseline"
[[study]]
name = "wm"
limits = { Pz_max_mm = 1.0, Fz_max_N = 1.83 }
[study.sensor]
driver = "sim/gelsight-wm"
units = ["0"]
"#;

#[test]
fn kinds_of_features_are_chosen_by_a_setting() {
    let bench = Bench::new();
    bench.record("data", 64);
    let found =
        bench.json("evaluate data --model ridge --split by-point --set features=pixels+statistics --metrics mae");
    let model = &found["provenance"]["model"];
    assert_eq!(
        model["settings"]["features"], "8×8 gray pixels+statistics",
        "{model}"
    );
    bench.refused(
        "evaluate data --model ridge --set features=smells",
        2,
        "expected pixels, markers, gradients, statistics, or several joined by +",
    );
    // The recording is gray and has no untouched frame.
    for kind in ["markers", "gradients"] {
        bench.refused(
            &format!("evaluate data --model ridge --set features={kind}"),
            3,
            "needs a no-contact reference frame, but the recording names none; import it with `reference = \"rest.png\"`, or `reference = { frame = 0 }`",
        );
    }
}

/// Cached features, sorted by name.
fn kept(bench: &Bench) -> Vec<PathBuf> {
    let folder = bench.path("user-cache/taceva/2/features");
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut entries: Vec<PathBuf> = entries
        .map(|entry| entry.expect("readable").path())
        .collect();
    entries.sort();
    entries
}

#[test]
fn features_are_made_once_for_every_model_and_found_by_what_they_are_made_of() {
    let bench = Bench::new();
    bench.record("data", 64);
    let evaluate = |words: &str| {
        bench.json(&format!(
            "evaluate data --metrics mae --split by-point {words}"
        ))
    };
    let bare = evaluate("--model knn --no-cache");
    assert!(kept(&bench).is_empty());
    evaluate("--model ridge");
    let of_ridge = kept(&bench);
    // Features of the training part and of the test part.
    assert_eq!(of_ridge.len(), 2);
    assert_eq!(evaluate("--model knn"), bare);
    assert_eq!(
        evaluate("--model ridge --set pca=4")["provenance"]["frames_decoded"],
        60
    );
    assert_eq!(kept(&bench), of_ridge);
    bench.ok("fit data --model pls --out pls.model");
    bench.ok("predict data --with pls.model --out predicted.csv");
    assert_eq!(kept(&bench), of_ridge);
    // Other settings give other features.
    evaluate("--model knn --set size=8");
    assert_eq!(kept(&bench).len(), 4);
    // Altered features are computed again.
    for path in of_ridge {
        let mut bytes = fs::read(&path).expect("kept");
        let last = bytes.len() - 1;
        bytes[last] ^= 1;
        fs::write(&path, bytes).expect("altered");
    }
    let ran = bench.run("evaluate data --metrics mae --model knn --split by-point --format json");
    assert!(ran.err.contains("computed again"), "{}", ran.err);
    let found: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(found, bare);
}

#[test]
fn the_size_of_features_is_chosen_by_what_it_costs_and_the_model_says_how() {
    let bench = Bench::new();
    bench.record("data", 64);
    let found =
        bench.json("evaluate data --model ridge --split by-point --set size=auto --metrics mae");
    let settings = &found["provenance"]["model"]["settings"];
    assert_eq!(settings["size"], "auto");
    let notes = found["provenance"]["notes"].as_array().expect("a list");
    let mut notes = notes.iter().filter_map(|note| note.as_str());
    let note = notes.find(|note| note.starts_with("features "));
    let note = note.expect("it says how");
    let chosen = note.trim_start_matches("features ").split(':').next();
    assert_eq!(chosen, settings["features"].as_str());
    assert!(note.contains("8×8 ") && note.contains("32×32 "), "{note}");
    // A model that reads no frame has nothing to choose.
    bench.ok("evaluate data --model baseline --split by-point --set size=auto --metrics mae");
    bench.refused(
        "evaluate data --model ridge --set size=fine",
        2,
        "auto in fit, evaluate and models of scenes",
    );
}

#[test]
fn a_difference_is_tried_beside_the_picture_itself_and_taken_only_if_it_shows_more() {
    let bench = Bench::new();
    bench.write("press.toml", PRESSED);
    bench.ok("run press.toml --out run -q");
    let evaluate = |words: &str| {
        let command = format!("evaluate run/recordings/1-wm --model ridge --metrics r2 {words}");
        bench.json(&command)
    };
    // A linear model ignores constant features.
    let found = evaluate("--set difference=auto");
    let features = &found["provenance"]["model"]["settings"]["features"];
    assert_eq!(features, "32×32 gray");
    let notes = found["provenance"]["notes"].to_string();
    let error = |name: &str| {
        let after = notes.split(&format!("{name} ")).last().expect("some");
        after.chars().take(5).collect::<String>()
    };
    assert_eq!(
        error("32×32 gray"),
        error("32×32 gray, difference from the reference"),
        "{notes}"
    );
    // A recording of the bench has an untouched frame, so gradients are available too.
    let found = evaluate("--set features=gradients");
    let features = &found["provenance"]["model"]["settings"]["features"];
    assert_eq!(features, "32×32 gray gradients");
}

#[test]
fn a_size_is_not_chosen_on_a_handful_of_samples() {
    let bench = Bench::new();
    bench.record("data", 64);
    let mut command = bench.command("evaluate data --model ridge --set size=auto -q");
    let ran = command.args(["--split", "random 30/30/40"]).output();
    let ran = ran.expect("the program starts");
    assert_eq!(ran.status.code(), Some(2));
    let error = String::from_utf8(ran.stderr).expect("UTF-8");
    let expected = "18 training samples: `auto` needs at least 30 to choose features";
    assert!(error.contains(expected), "{error}");
}

#[test]
fn features_that_no_model_can_be_fitted_to_are_told_beside_those_that_were_tried() {
    let bench = Bench::new();
    bench.record("data", 64);
    let mut command = bench.command("evaluate data --model ridge --set size=auto --metrics mae -q");
    // A grid of 2×2 has 28 statistics, fewer than the thirty requested components.
    let command = command.args(["--set", "features=statistics", "--set", "pca=30"]);
    let ran = command.args(["--split", "random 80/10/10"]).output();
    let ran = ran.expect("the program starts");
    let text = String::from_utf8(ran.stdout).expect("UTF-8");
    assert_eq!(
        ran.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&ran.stderr)
    );
    assert!(
        text.contains("2×2 gray statistics, 30 principal components not fitted (`pca=30`"),
        "{text}"
    );
}
