//! Classifiers fitted to the tasks of a dataset.

use std::fmt::Write as _;

use serde_json::Value;

use crate::support::Bench;

pub(super) const MAP: &str = r#"map_version = 2
table = "strokes.csv"
[columns]
Fz = { from = "fz", unit = "N" }
[signals]
from = "c0..3"
unit = "uT"
places = [2, 2]
channels = ["p"]
order = "place-first"
[time]
clock = "unknown"
[attributes]
stroke = "stroke"
[task.slip]
kind = "outcome"
from = "slip"
names = ["no_slip", "slip"]
positive = "slip"
cluster = "stroke"
[sensor]
model = "lab finger"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

/// Test folder with twelve strokes of ten rows, five of which are slip. One taxel indicates slip, and in the last stroke the absence of slip.
pub(super) fn strokes() -> Bench {
    let bench = Bench::new();
    let mut table = String::from("fz,stroke,slip,c0,c1,c2,c3");
    for stroke in 0..12_u32 {
        for row in 0..10_u32 {
            let slips = row >= 5;
            let senses = slips != (stroke == 11);
            let word = if slips { "slip" } else { "no_slip" };
            let noise = |at: u32| f64::from((stroke * 5 + row * 3 + at * 7) % 11) * 0.01;
            let own = f64::from(u8::from(senses)) + noise(0);
            write!(
                table,
                "\n{},s{stroke},{word},{own:.2},{:.2},{:.2},{:.2}",
                f64::from(row) * 0.1,
                noise(1),
                noise(2),
                noise(3)
            )
            .expect("written");
        }
    }
    table.push('\n');
    bench.write("lab/strokes.csv", &table);
    bench.write("lab/map.toml", MAP);
    bench.ok("import lab --map lab/map.toml --out data -q");
    bench
}

/// Estimate of a metric without a variant.
pub(super) fn estimate<'r>(report: &'r Value, metric: &str) -> &'r Value {
    let scores = report["tasks"][0]["scores"].as_array().expect("a list");
    let found = scores
        .iter()
        .find(|score| score["metric"] == metric && score["variant"].is_null());
    &found.unwrap_or_else(|| panic!("no {metric} in {report:#}"))["estimate"]
}

#[test]
fn slip_of_unseen_strokes_is_predicted_and_scored_with_intervals_by_stroke() {
    let bench = strokes();
    for model in ["lda", "linfa/logistic"] {
        let report = bench.json(&format!(
            "evaluate data --task slip --model {model} --no-cache"
        ));
        crate::schema::check("tasks", &report);
        let accuracy = estimate(&report, "class_accuracy");
        // The last stroke is wrong in all ten rows.
        assert_eq!(accuracy["value"], 110.0 / 120.0, "{model}: {report:#}");
        assert_eq!(accuracy["n"], 120);
        assert_eq!(accuracy["clusters"], 12);
        assert!(accuracy["ci95"].is_array(), "{report:#}");
        // No kappa is below -1, whatever the stroke that is wrong does to its interval.
        assert_eq!(estimate(&report, "kappa")["ci95"][0], -1.0, "{report:#}");
        assert_eq!(report["tasks"][0]["positive"], "slip");
        assert!(
            report.to_string().contains("cv:5 by-column:stroke"),
            "{report:#}"
        );
    }
}

#[test]
fn labelled_rows_that_are_not_scored_are_counted() {
    let bench = strokes();
    let split = "--split by-column:stroke=train:s0,s1,s2,s3,s4,s5;test:s6,s7,s8,s9,s10,s11";
    let report = bench.json(&format!("evaluate data --task slip {split} --no-cache"));
    let notes = report["tasks"][0]["notes"].to_string();
    assert!(
        notes.contains("60 of 120 labelled rows are scored"),
        "{notes}"
    );
}

#[test]
fn a_class_of_a_single_stroke_is_named_because_no_model_has_learnt_it() {
    let bench = strokes();
    let table = std::fs::read_to_string(bench.path("lab/strokes.csv")).expect("a table");
    bench.write("lab/strokes.csv", &table.replace(",s3,slip,", ",s3,stick,"));
    let names = "names = [\"no_slip\", \"slip\", \"stick\"]";
    let map = MAP.replace("names = [\"no_slip\", \"slip\"]", names);
    bench.write("lab/map.toml", &map.replace("\"outcome\"", "\"class\""));
    bench.ok("import lab --map lab/map.toml --out three -q");
    let report = bench.json("evaluate three --task slip --no-cache");
    let notes = report["tasks"][0]["notes"].to_string();
    assert!(
        notes.contains("the class `stick` is in one cluster only"),
        "{notes}"
    );
    assert!(!notes.contains("`slip` is in one"), "{notes}");
}

#[test]
fn a_model_of_numbers_and_a_split_that_divides_strokes_are_refused_with_others_to_name() {
    let bench = strokes();
    bench.refused(
        "evaluate data --task slip --model ridge --no-cache",
        2,
        "--model lda or --model linfa/logistic",
    );
    bench.refused(
        "evaluate data --task slip --split random --no-cache",
        2,
        "cv:5 by-column:stroke",
    );
    bench.refused(
        "evaluate data --task slpi --no-cache",
        3,
        "did you mean `slip`?",
    );
}

#[test]
fn a_recording_without_tasks_says_what_to_write_into_the_map() {
    let bench = strokes();
    let (map, _) = MAP.split_once("[task.slip]").expect("a task");
    let (_, sensor) = MAP.split_once("[sensor]").expect("a sensor");
    bench.write("lab/map.toml", &format!("{map}[sensor]{sensor}"));
    bench.ok("import lab --map lab/map.toml --out plain -q");
    bench.refused("evaluate plain --task slip --no-cache", 3, "`[task.NAME]`");
}

#[test]
fn a_state_of_a_fitted_task_has_its_scores() {
    let bench = strokes();
    let scored = bench.json("evaluate data --task slip --no-cache --state-out slip.state");
    assert_eq!(bench.json("merge slip.state"), scored);
}

#[test]
fn slip_of_the_force_set_of_sparsh_is_imported_by_its_preset_and_scored() {
    let bench = Bench::new();
    let drawn = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/presets/sparsh-slip");
    bench.ok(&format!(
        "import {drawn} --preset sparsh-force --out slips -q"
    ));
    let report = bench.json("evaluate slips --task slip --model lda --set size=16x12 --no-cache");
    crate::schema::check("tasks", &report);
    assert_eq!(report["tasks"][0]["positive"], "slip");
    let f1 = estimate(&report, "f1");
    // Six presses of four pictures, half of which slip. Pictures are bright while the finger slips.
    assert_eq!(
        (f1["n"].as_u64(), f1["clusters"].as_u64()),
        (Some(24), Some(6))
    );
    assert_eq!(f1["of_constant"], 2.0 / 3.0);
    let value = f1["value"].as_f64().expect("defined");
    assert!(value > 0.8, "{report:#}");
}
