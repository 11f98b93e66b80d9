//! Labels, names and rules as users write them.

use super::{SLIP, estimate, slip};
use crate::support::Bench;

/// Arguments that score the tables which [`cloth`] writes.
const CLOTH: &str = "score --truth truth.csv --pred pred.csv --cluster clip --task cloth=class";

/// Writes tables of the true and the predicted classes of two clips.
fn cloth(bench: &Bench, truth: [&str; 3], prediction: [&str; 3]) {
    let [a, b, c] = truth;
    bench.write(
        "truth.csv",
        &format!("id,clip,cloth\n1,a,{a}\n2,a,{b}\n3,b,{c}\n"),
    );
    let [a, b, c] = prediction;
    bench.write("pred.csv", &format!("id,cloth\n1,{a}\n2,{b}\n3,{c}\n"));
}

#[test]
fn a_debounce_without_a_threshold_delays_an_onset_once() {
    let bench = Bench::new();
    slip(&bench);
    let report = bench.json(&format!("{SLIP} --debounce slip=3"));
    // True from frame 4, predicted from frame 5, debounced from frame 7.
    let delay = estimate(&report, "onset_delay", None)["value"].as_f64();
    assert!((delay.expect("a delay") - 0.12).abs() < 1e-12, "{report:#}");
}

#[test]
fn a_rule_of_three_classes_is_refused_instead_of_replacing_one_of_them() {
    let bench = Bench::new();
    cloth(&bench, ["denim", "silk", "wool"], ["denim", "silk", "wool"]);
    bench.refused(
        &format!("{CLOTH}:positive=silk --debounce cloth=1"),
        2,
        "needs two classes and a positive class, but the classes are denim, silk, wool",
    );
}

#[test]
fn a_rule_of_a_pose_and_a_second_rule_of_a_task_are_refused() {
    let bench = Bench::new();
    slip(&bench);
    bench.refused(
        "score --truth truth.csv --pred pred.csv --task moved=pose --debounce moved=3",
        2,
        "given for `moved`, which is a pose",
    );
    bench.refused(
        &format!("{SLIP} --threshold slip=0.4 --threshold slip=0.5"),
        2,
        "--threshold `slip=0.5`: given twice",
    );
}

#[test]
fn labels_that_a_program_wrote_with_decimals_are_whole_numbers() {
    let bench = Bench::new();
    cloth(&bench, ["1.0", "", "0.0"], ["1", "1", "0"]);
    let report = bench.json(CLOTH);
    assert_eq!(estimate(&report, "class_accuracy", None)["value"], 1.0);
    let names = report["tasks"][0]["names"].as_array().expect("names");
    assert_eq!(names, &["0", "1"]);
    let report = bench.json(&format!("{CLOTH}:names=denim|silk"));
    assert_eq!(estimate(&report, "class_accuracy", None)["value"], 1.0);
    let notes = &report["tasks"][0]["notes"];
    assert_eq!(notes[0], "1 row without a label, left out");
}

#[test]
fn a_class_that_only_a_column_of_scores_names_is_a_class() {
    let bench = Bench::new();
    bench.write("truth.csv", "id,clip,cloth\n1,a,denim\n2,b,silk\n");
    bench.write(
        "pred.csv",
        "id,cloth.p.denim,cloth.p.silk,cloth.p.wool\n1,0.5,0.25,0.25\n2,0.25,0.25,0.5\n",
    );
    let report = bench.json(CLOTH);
    assert_eq!(estimate(&report, "class_accuracy", None)["value"], 0.5);
    let names = report["tasks"][0]["names"].as_array().expect("names");
    assert_eq!(names, &["denim", "silk", "wool"]);
}

#[test]
fn cells_and_names_that_are_no_class_are_refused() {
    let bench = Bench::new();
    cloth(&bench, ["denim", "NaN", "silk"], ["denim"; 3]);
    bench.refused(CLOTH, 3, "`NaN`: expected a class, or an empty cell");
    bench.refused(&format!("{CLOTH}:names=denim||silk"), 2, "an empty name");
    cloth(&bench, ["denim"; 3], ["denim"; 3]);
    bench.refused(CLOTH, 3, "has 1 class, expected two or more");
}

#[test]
fn too_few_clusters_are_the_stated_reason_for_a_missing_interval() {
    let bench = Bench::new();
    cloth(
        &bench,
        ["denim", "silk", "silk"],
        ["denim", "silk", "denim"],
    );
    let text = bench.ok(CLOTH);
    let reason = "no interval by 2 clusters of the column `clip`: 2 clusters, 5 are needed";
    assert!(text.contains(reason), "{text}");
    let csv = bench.ok(&format!("{CLOTH} --format csv"));
    assert!(
        csv.contains("no interval: 2 clusters, 5 are needed"),
        "{csv}"
    );
}

#[test]
fn times_that_go_back_are_refused_with_the_option_that_tells_sequences_apart() {
    let bench = Bench::new();
    bench.write(
        "truth.csv",
        "id,object,t_s,slip\n1,cup,0,no\n2,cup,0.04,yes\n3,cup,0,no\n",
    );
    bench.write("pred.csv", "id,slip\n1,no\n2,yes\n3,no\n");
    bench.refused(
        "score --truth truth.csv --pred pred.csv --task slip=event:positive=yes --cluster object",
        3,
        "tells sequences apart with --cluster COLUMN",
    );
}

#[test]
fn log_odds_are_flagged_in_words() {
    let bench = Bench::new();
    bench.write("truth.csv", "id,point_id,held\n1,a,no\n2,b,yes\n3,c,yes\n");
    bench.write("pred.csv", "id,held.p.yes\n1,-2\n2,3\n3,4.5\n");
    let report = bench.json(
        "score --truth truth.csv --pred pred.csv --task held=outcome:positive=yes --threshold held=0.4",
    );
    crate::schema::check("tasks", &report);
    let scores = report["tasks"][0]["scores"].as_array().expect("a list");
    let auc = scores.iter().find(|score| score["metric"] == "roc_auc");
    let flags = &auc.expect("scores of two classes")["flags"];
    assert_eq!(flags[0], "all scores outside 0 to 1");
}

#[test]
fn predictions_without_classes_and_scores_are_refused_with_both_columns() {
    let bench = Bench::new();
    cloth(&bench, ["denim", "silk", "silk"], ["denim"; 3]);
    bench.write("pred.csv", "id,cloth_p\n1,0.5\n2,0.5\n3,0.5\n");
    let message = "no column `cloth` with classes and no column `cloth.p.CLASS` with scores";
    bench.refused(CLOTH, 3, message);
}

/// Table of predictions of [`slip`] without the scores of the class `no_slip`.
fn of_the_positive(prediction: &str) -> String {
    let rows = prediction.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{},{}\n", cells[0], cells[2])
    });
    rows.collect()
}

#[test]
fn a_wrong_header_of_a_column_of_scores_is_named_beside_the_class_without_scores() {
    let bench = Bench::new();
    slip(&bench);
    let prediction = std::fs::read_to_string(bench.path("pred.csv")).expect("text");
    bench.write(
        "pred.csv",
        &prediction.replacen("slip.p.slip", "slip.p.slp", 1),
    );
    bench.refused(
        SLIP,
        3,
        "`slip`: no column `slip.p.slip` has its scores, and no row has the class of the column `slip.p.slp`: write both alike",
    );
    // Only the positive class has scores.
    let only = of_the_positive(&prediction);
    bench.write("pred.csv", &only.replacen("slip.p.slip", "slip.p.slp", 1));
    bench.refused(
        &format!("{SLIP} --threshold slip=0.5"),
        3,
        "no row has the class of the column `slip.p.slp`",
    );
}

#[test]
fn a_misspelt_label_beside_columns_of_scores_is_refused_at_its_row_with_the_nearest() {
    let bench = Bench::new();
    slip(&bench);
    let truth = std::fs::read_to_string(bench.path("truth.csv")).expect("text");
    let misspelt = truth.replacen("0.36,slip", "0.36,slipp", 1);
    assert_ne!(misspelt, truth);
    bench.write("truth.csv", &misspelt);
    let message =
        "`slipp`: no column `slip.p.slipp` has its scores; did you mean `slip`? Correct the label";
    bench.refused(SLIP, 3, message);
    bench.refused(SLIP, 3, "line 11");
    let prediction = std::fs::read_to_string(bench.path("pred.csv")).expect("text");
    let only = of_the_positive(&prediction);
    bench.write("pred.csv", &only);
    bench.refused(&format!("{SLIP} --threshold slip=0.5"), 3, message);
}

#[test]
fn a_threshold_that_no_probability_crosses_is_refused_and_log_odds_take_any() {
    let bench = Bench::new();
    slip(&bench);
    for threshold in ["1.5", "-0.5"] {
        bench.refused(
            &format!("{SLIP} --threshold slip={threshold}"),
            2,
            &format!("the threshold {threshold} is outside 0 to 1"),
        );
    }
    for threshold in ["0", "1"] {
        bench.ok(&format!("{SLIP} --threshold slip={threshold}"));
    }
    bench.write("truth.csv", "id,point_id,held\n1,a,no\n2,b,yes\n3,c,yes\n");
    bench.write("pred.csv", "id,held.p.yes\n1,-2\n2,3\n3,4.5\n");
    let held = "score --truth truth.csv --pred pred.csv --task held=outcome:positive=yes";
    let report = bench.json(&format!("{held} --threshold held=3.5"));
    assert_eq!(
        estimate(&report, "class_accuracy", None)["value"],
        2.0 / 3.0
    );
    bench.write("pred.csv", "id,held\n1,no\n2,yes\n3,yes\n");
    bench.refused(
        &format!("{held} --threshold held=3.5"),
        2,
        "a threshold needs the scores of the positive class",
    );
}

#[test]
fn the_help_lists_every_option_that_a_task_refuses() {
    let bench = Bench::new();
    slip(&bench);
    let help = bench.ok("score --help");
    let help: String = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let listed = help.split("Refused with --task: ").nth(1);
    let listed = listed.expect("a list").split(" --cluster").next();
    let listed = listed.expect("a list");
    let of_task: Vec<&str> = listed.split(", ").collect();
    assert!(of_task.len() > 8, "{of_task:?}");
    for option in of_task {
        let value = match option {
            "--independent" | "--explain" => "",
            "--units" => " slip=N",
            "--periods" => " slip=360",
            "--table" => " all",
            _ => " x",
        };
        let ran = bench.run(&format!("{SLIP} {option}{value}"));
        assert_eq!(ran.code, 2, "{option}: {}", ran.err);
        assert!(
            ran.err.contains("cannot be used with"),
            "{option}: {}",
            ran.err
        );
    }
}

#[test]
fn the_origin_of_the_truth_is_read_with_its_labels() {
    let bench = Bench::new();
    bench.write(
        "truth.csv",
        "id,clip,cloth,source\n1,a,denim,recorded\n2,b,silk,\n",
    );
    bench.write("pred.csv", "id,cloth\n1,denim\n2,silk\n");
    let report = bench.json(CLOTH);
    assert_eq!(
        report["sources"],
        serde_json::json!(["recorded", "unknown"])
    );
    bench.write("truth.csv", "id,clip,cloth\n1,a,denim\n2,b,silk\n");
    assert_eq!(bench.json(CLOTH)["sources"], serde_json::json!(["unknown"]));
}

#[test]
fn a_score_or_a_place_that_is_not_finite_is_refused_or_its_row_counted_and_left_out() {
    let bench = Bench::new();
    slip(&bench);
    let without_score = std::fs::read_to_string(bench.path("pred.csv")).expect("written");
    let truth = std::fs::read_to_string(bench.path("truth.csv")).expect("written");
    for number in ["nan", "inf", "1e999"] {
        let changed = without_score.replacen("\n3,0.75,0.25", &format!("\n3,0.75,{number}"), 1);
        assert_ne!(changed, without_score);
        bench.write("pred.csv", &changed);
        let ran = bench.run(SLIP);
        assert_eq!(ran.code, 3, "{number}: {}", ran.err);
        let left_out = bench.json(&format!("{SLIP} --allow-invalid"));
        let notes = left_out["tasks"][0]["notes"].to_string();
        let expected = "1 row with a number that is not finite, left out";
        assert!(notes.contains(expected), "{number}: {notes}");
        // The scores of the tables without this row.
        bench.write(
            "truth.csv",
            &truth.replacen("\n3,s0,0.12,no_slip", "\n3,s0,0.12,", 1),
        );
        bench.write("pred.csv", &without_score);
        let unlabelled = bench.json(SLIP);
        assert_eq!(
            left_out["tasks"][0]["scores"],
            unlabelled["tasks"][0]["scores"]
        );
        bench.write("truth.csv", &truth);
    }
    let head = "id,point_id,contact.x,contact.y,contact.z\n";
    bench.write("truth.csv", &format!("{head}1,a,0,0,0\n2,b,1,0,0\n"));
    bench.write("pred.csv", &format!("{head}1,a,0,0,0.5\n2,b,1,inf,0\n"));
    let score = "score --truth truth.csv --pred pred.csv --task contact=place";
    assert_eq!(bench.run(score).code, 3);
    let report = bench.json(&format!("{score} --allow-invalid"));
    let translation = estimate(&report, "pose_translation", None);
    assert_eq!(translation["value"], 0.5);
    assert_eq!(translation["n"], 1);
}
