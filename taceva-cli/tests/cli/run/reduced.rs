//! Scenes that state the size of recorded frames.

use std::fs;

use serde_json::Value;
use taceva_dataset::Dataset;
use taceva_models::FrameReduction;

use super::{SMALL, with_small};
use crate::support::Bench;

/// Scene line that records the frames of 45 × 45 pixels at another size.
pub(crate) const REDUCED: &str = "recording = { frames = \"40x36\" }\n";

/// Runs the small scene in the folder `whole`, and the scene with other frames in the folder `reduced`.
fn both() -> Bench {
    let bench = with_small();
    bench.write("reduced.toml", &format!("{SMALL}{REDUCED}"));
    bench.ok("run small.toml --out whole -q");
    bench.ok("run reduced.toml --out reduced -q");
    bench
}

fn recording(bench: &Bench, run: &str) -> Dataset {
    Dataset::open(&bench.path(run).join("recordings/1-small")).expect("opens")
}

fn report(bench: &Bench, run: &str) -> Value {
    let bytes = fs::read(bench.path(run).join("results.json")).expect("reads");
    let run: Value = serde_json::from_slice(&bytes).expect("JSON");
    run["studies"][0].clone()
}

#[test]
fn every_frame_is_the_area_averages_of_the_one_that_came_and_all_else_stays_as_it_was() {
    let bench = both();
    let [whole, reduced] = ["whole", "reduced"].map(|run| recording(&bench, run));
    let frames = |dataset: &Dataset| dataset.header().frames.clone().expect("frames");
    let camera = frames(&whole).info;
    assert_eq!(camera.to_string(), "45×45 gray16");
    assert_eq!(frames(&reduced).info.to_string(), "40×36 gray8");
    assert_eq!(frames(&reduced).of_camera(), camera);
    assert_eq!(whole.header().format.to_string(), "1.0");
    let reduction = FrameReduction::new(camera, [40, 36]).expect("smaller");
    let of = |frame| reduction.reduce(&frame).expect("of the camera");
    let mut seen = 0;
    for row in whole.all_rows() {
        let frame = whole.frame(row).expect("decodes").map(of);
        assert_eq!(frame, reduced.frame(row).expect("decodes"), "row {row}");
        seen += usize::from(frame.is_some());
    }
    assert!(seen > 50, "{seen}");
    let reference = |dataset: &Dataset| dataset.reference().expect("decodes").expect("one");
    assert_eq!(of(reference(&whole)), reference(&reduced));
    // Positions, forces, times and brightness equal those of the recording of whole frames, to the bit.
    let (whole, reduced) = (whole.table(), reduced.table());
    assert_eq!(whole.samples(), reduced.samples());
    assert_eq!(whole.intensity(), reduced.intensity());
    assert_eq!(whole.t_s(), reduced.t_s());
    for channel in 0..whole.channels().len() {
        assert_eq!(whole.truth(channel), reduced.truth(channel));
    }
}

#[test]
fn scores_of_forces_are_the_same_and_reports_say_that_frames_were_reduced() {
    let bench = both();
    let [whole, reduced] = ["whole", "reduced"].map(|run| report(&bench, run));
    for metric in [
        "sensitivity",
        "uniformity",
        "hysteresis",
        "inter_sensor",
        "intrinsic",
    ] {
        assert!(whole["metrics"][metric].is_object(), "{metric}");
        assert_eq!(
            whole["metrics"][metric], reduced["metrics"][metric],
            "{metric}"
        );
    }
    let note = "frames were kept as 40×36 gray8: area averages, rounded to 8 bits, of 45×45 gray16";
    let notes = |report: &Value| report["provenance"]["notes"].to_string();
    assert!(notes(&reduced).contains(note), "{}", notes(&reduced));
    assert!(!notes(&whole).contains("frames were kept"));
    let again =
        "evaluate reduced/recordings/1-small --model ridge --set size=8x8 --metrics mae,intrinsic";
    let again = bench.json(again);
    assert!(notes(&again).contains(note), "{}", notes(&again));
    let resolution = &again["metrics"]["intrinsic"]["resolution"];
    assert_eq!(resolution["value"], f64::from(45 * 45), "{resolution}");
}

#[test]
fn a_recording_of_reduced_frames_is_checked_exported_and_imported_again() {
    let bench = Bench::new();
    // Every sample then has a picture, as a map requires of every row.
    let want = "metrics = { want = [\"mae\"] }\n";
    bench.write("reduced.toml", &format!("{SMALL}{REDUCED}{want}"));
    bench.ok("run reduced.toml --out reduced -q");
    let path = "reduced/recordings/1-small";
    bench.ok(&format!("check {path} -q"));
    let ask = "--model ridge --set size=8x8 --metrics mae --split by-point";
    let scores = bench.json(&format!("evaluate {path} {ask}"))["metrics"].clone();
    for form in ["csv", "hdf5"] {
        bench.ok(&format!("export {path} --format {form} --out {form}"));
        let map = fs::read_to_string(bench.path(form).join("map.toml")).expect("a map");
        let said = "# The frames were reduced before recording: area averages, rounded to 8 bits, from 45×45 gray16.";
        assert!(map.contains(said), "{map}");
        bench.ok(&format!(
            "import {form} --map {form}/map.toml --out {form}-again"
        ));
        let found = bench.json(&format!("evaluate {form}-again {ask}"));
        assert_eq!(found["metrics"], scores, "{form}");
    }
}

#[test]
fn a_size_beyond_that_of_the_frames_is_refused_before_a_folder_is_made() {
    let bench = Bench::new();
    bench.write(
        "large.toml",
        &format!("{SMALL}recording = {{ frames = \"46x36\" }}\n"),
    );
    bench.refused(
        "run large.toml --out r",
        3,
        "large.toml, line 10: `frames` is `46x36`, but the frames of study `small` are 45×45 gray16: expected at most `45x45`",
    );
    assert!(!bench.path("r").exists());
}

#[test]
fn a_size_below_the_cells_that_a_model_looks_at_is_refused_before_a_folder_is_made() {
    let bench = Bench::new();
    let small = |size: &str| format!("{SMALL}recording = {{ frames = \"{size}\" }}\n");
    for size in ["7x36", "40x7"] {
        bench.write("small.toml", &small(size));
        let message = format!(
            "small.toml, line 10: `frames` is `{size}`, but model `ridge` of study `small` divides each frame into 8×8 cells: expected at least `8x8`"
        );
        bench.refused("run small.toml --out r", 3, &message);
        assert!(!bench.path("r").exists());
    }
    let gratings = "gratings = { classified_by = \"cnn\", set = { size = \"16x16\" }, ";
    let text = small("12x12").replace("gratings = { ", gratings);
    bench.write("small.toml", &text);
    bench.refused(
        "run small.toml --out r",
        3,
        "but the classifier of gratings of study `small` divides each frame into 16×16 cells: expected at least `16x16`",
    );
}

#[test]
fn a_run_with_other_frames_is_not_gone_on_with() {
    let bench = with_small();
    bench.ok("run small.toml --out r -q");
    bench.write("small.toml", &format!("{SMALL}{REDUCED}"));
    bench.refused("run small.toml --out r --resume", 3, "a different plan");
}
