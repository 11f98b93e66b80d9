//! Scores of tasks of two tables.

mod compared;
mod depth;
mod input;
mod page;
mod public_programs;
mod states;

use std::fmt::Write as _;

use serde_json::Value;

use crate::support::Bench;

/// Arguments that score the tables which [`slip`] writes.
const SLIP: &str =
    "score --truth truth.csv --pred pred.csv --task slip=event:positive=slip --cluster stroke";

/// Number of frames of a stroke, 40 ms apart. Slip begins at the fifth frame.
const FRAMES: u32 = 10;

/// Writes tables of six strokes. The predicted score of slip rises one frame late, and stays low in the last stroke.
fn slip(bench: &Bench) {
    let mut truth = "id,stroke,t_s,slip\n".to_owned();
    let mut prediction = "id,slip.p.no_slip,slip.p.slip\n".to_owned();
    for stroke in 0..6_u32 {
        for frame in 0..FRAMES {
            let id = stroke * FRAMES + frame;
            let label = if frame >= 4 { "slip" } else { "no_slip" };
            let time = f64::from(frame) * 0.04;
            writeln!(truth, "{id},s{stroke},{time},{label}").expect("text");
            let score = match (frame >= 5, stroke) {
                (true, 0..5) => 0.75,
                _ => 0.25,
            };
            writeln!(prediction, "{id},{},{score}", 1.0 - score).expect("text");
        }
    }
    bench.write("truth.csv", &truth);
    bench.write("pred.csv", &prediction);
}

/// Estimate of a metric without a variant, or with `variant`.
fn estimate<'r>(report: &'r Value, metric: &str, variant: Option<&str>) -> &'r Value {
    let scores = report["tasks"][0]["scores"].as_array().expect("a list");
    let found = scores
        .iter()
        .find(|score| score["metric"] == metric && score["variant"].as_str() == variant);
    &found.unwrap_or_else(|| panic!("no {metric} in {report:#}"))["estimate"]
}

#[test]
fn slip_has_its_scores_with_intervals_by_stroke_and_its_onsets() {
    let bench = Bench::new();
    slip(&bench);
    let report = bench.json(SLIP);
    crate::schema::check("tasks", &report);
    // 36 frames slip. 25 of them are predicted, and no other.
    let f1 = estimate(&report, "f1", None);
    assert_eq!(f1["value"], 50.0 / 61.0);
    assert_eq!(
        (f1["n"].as_u64(), f1["clusters"].as_u64()),
        (Some(60), Some(6))
    );
    assert_eq!(f1["of_constant"], 0.75);
    let ends = f1["ci95"].as_array().expect("six strokes");
    assert!(ends[0].as_f64() < f1["value"].as_f64() && f1["value"].as_f64() < ends[1].as_f64());
    assert_eq!(estimate(&report, "onset_f1", None)["value"], 10.0 / 11.0);
    let delay = estimate(&report, "onset_delay", None)["value"].as_f64();
    assert!((delay.expect("a delay") - 0.04).abs() < 1e-12);
    assert_eq!(
        estimate(&report, "brier", None)["value"],
        0.0625 * 49.0 / 60.0 + 0.5625 * 11.0 / 60.0
    );
    assert_eq!(report["paired"], "by `id`");
}

#[test]
fn a_threshold_and_a_debounce_are_applied_and_stand_in_the_definitions() {
    let bench = Bench::new();
    slip(&bench);
    let rules = "--threshold slip=0.4 --debounce slip=3";
    let report = bench.json(&format!("{SLIP} {rules}"));
    // Two frames later: 15 of 36 frames are predicted.
    assert_eq!(estimate(&report, "f1", None)["value"], 30.0 / 51.0);
    let text = report.to_string();
    assert!(
        text.contains("threshold 0.4 strict, debounce 3"),
        "{report:#}"
    );
}

#[test]
fn the_table_has_the_confusion_and_programs_get_a_row_for_each_score() {
    let bench = Bench::new();
    slip(&bench);
    let text = bench.run(SLIP).out;
    assert!(text.contains("slip: 11 as no_slip, 25 as slip"), "{text}");
    assert!(
        text.contains("intervals by 6 clusters of the column `stroke`"),
        "{text}"
    );
    let csv = bench.run(&format!("{SLIP} --format csv")).out;
    assert!(
        csv.starts_with("task,kind,metric,variant,value,unit,ci95_low,"),
        "{csv}"
    );
    assert!(
        csv.lines()
            .any(|line| line.starts_with("slip,event,kappa,,")),
        "{csv}"
    );
}

#[test]
fn a_class_that_is_not_among_the_names_is_refused_with_the_nearest() {
    let bench = Bench::new();
    bench.write("truth.csv", "id,clip,cloth\n1,a,denim\n2,a,silk\n");
    bench.write("pred.csv", "id,cloth\n1,denim\n2,slik\n");
    let ran = bench.run(
        "score --truth truth.csv --pred pred.csv --task cloth=class:names=denim|silk --cluster clip",
    );
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(
        ran.err.contains("line 3") && ran.err.contains("did you mean `silk`?"),
        "{}",
        ran.err
    );
}

#[test]
fn frames_without_a_stated_cluster_are_refused_with_the_option_to_write() {
    let bench = Bench::new();
    bench.write("truth.csv", "id,clip,cloth\n1,a,denim\n2,b,silk\n");
    bench.write("pred.csv", "id,cloth\n1,denim\n2,silk\n");
    let ran = bench.run("score --truth truth.csv --pred pred.csv --task cloth=class");
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(ran.err.contains("--cluster COLUMN"), "{}", ran.err);
}

#[test]
fn scores_of_some_classes_only_are_refused_by_column() {
    let bench = Bench::new();
    bench.write(
        "truth.csv",
        "id,point_id,cloth\n1,a,denim\n2,b,silk\n3,c,wool\n",
    );
    bench.write(
        "pred.csv",
        "id,cloth.p.denim,cloth.p.silk\n1,0.5,0.5\n2,0.5,0.5\n3,0.5,0.5\n",
    );
    let ran = bench.run("score --truth truth.csv --pred pred.csv --task cloth=class");
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(ran.err.contains("no column `cloth.p.wool`"), "{}", ran.err);
}

#[test]
fn one_class_in_the_truth_leaves_the_accuracy_and_says_why_the_ranks_are_undefined() {
    let bench = Bench::new();
    bench.write("truth.csv", "id,point_id,held\n1,a,yes\n2,b,yes\n");
    bench.write(
        "pred.csv",
        "id,held.p.no,held.p.yes\n1,0.25,0.75\n2,0.75,0.25\n",
    );
    let report = bench.json(
        "score --truth truth.csv --pred pred.csv --task held=outcome:positive=yes:names=no|yes",
    );
    assert_eq!(estimate(&report, "class_accuracy", None)["value"], 0.5);
    assert!(estimate(&report, "roc_auc", None)["undefined"].is_string());
}

#[test]
fn a_change_of_pose_has_errors_in_millimetres_and_degrees() {
    let bench = Bench::new();
    let head = "id,point_id,moved.x,moved.y,moved.z,moved.qx,moved.qy,moved.qz,moved.qw\n";
    bench.write(
        "truth.csv",
        &format!("{head}1,a,0,0,0,0,0,0,1\n2,b,1,0,0,0,0,0.6,0.8\n"),
    );
    bench.write(
        "pred.csv",
        &format!("{head}1,a,0,0,0.5,0,0,0,1\n2,b,1,0,0,0,0,-0.6,-0.8\n"),
    );
    let report = bench.json("score --truth truth.csv --pred pred.csv --task moved=pose");
    assert_eq!(estimate(&report, "pose_translation", None)["value"], 0.25);
    assert_eq!(estimate(&report, "pose_rotation", None)["value"], 0.0);
    // No column has points of an object.
    assert!(!report.to_string().contains("\"add"), "{report:#}");
    bench.write(
        "pred.csv",
        &format!("{head}1,a,0,0,0.5,0,0,0,0.9\n2,b,1,0,0,0,0,0.6,0.8\n"),
    );
    let ran = bench.run("score --truth truth.csv --pred pred.csv --task moved=pose");
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(ran.err.contains("norm 0.9"), "{}", ran.err);
}

#[test]
fn options_of_channels_and_unknown_kinds_are_refused_with_tasks() {
    let bench = Bench::new();
    slip(&bench);
    let ran = bench.run(&format!("{SLIP} --metrics mae"));
    assert_eq!(ran.code, 2, "{}", ran.err);
    let ran = bench.run("score --truth truth.csv --pred pred.csv --task slip=evnt");
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert!(ran.err.contains("did you mean event?"), "{}", ran.err);
}

#[test]
fn classes_that_both_tables_write_differently_are_refused_with_both() {
    let bench = Bench::new();
    bench.write("truth.csv", "id,point_id,held\n1,a,yes\n2,b,no\n");
    bench.write("pred.csv", "id,held\n1,Yes\n2,No\n");
    bench.refused(
        "score --truth truth.csv --pred pred.csv --task held=outcome:positive=yes",
        3,
        "has no class of the truth: No, Yes, expected some of no, yes",
    );
}
