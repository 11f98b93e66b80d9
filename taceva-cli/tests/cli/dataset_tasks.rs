//! Classifiers fitted to the tasks of a dataset.

use std::fmt::Write as _;

use serde_json::Value;

use crate::support::Bench;

const MAP: &str = r#"map_version = 2
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

/// Twelve strokes of ten rows, of which five slip. A taxel senses slip, except in the last stroke, where it senses the contrary.
fn strokes() -> Bench {
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
fn estimate<'r>(report: &'r Value, metric: &str) -> &'r Value {
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

/// Twelve strokes whose signal rises by one at each row that slips, from another level in each stroke.
fn rising_strokes() -> Bench {
    let bench = Bench::new();
    let mut table = String::from("fz,stroke,slip,c0,c1,c2,c3");
    for stroke in 0..12_u32 {
        let mut level = f64::from(stroke * 37 % 11) * 0.5;
        for row in 0..10_u32 {
            let slips = row > 0 && (stroke * 7 + row * 5 + stroke * row % 4).is_multiple_of(3);
            level += f64::from(u8::from(slips));
            let word = if slips { "slip" } else { "no_slip" };
            let noise = |at: u32| f64::from((stroke * 5 + row * 3 + at * 7) % 11) * 0.01;
            write!(
                table,
                "\n{},s{stroke},{word},{:.2},{:.2},{:.2},{:.2}",
                f64::from(row) * 0.1,
                level + noise(0),
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

#[test]
fn a_slip_that_only_the_change_between_two_frames_shows_is_learnt_with_a_window_alone() {
    let bench = rising_strokes();
    let accuracy = |options: &str| {
        let report = bench.json(&format!("evaluate data --task slip {options} --no-cache"));
        crate::schema::check("tasks", &report);
        let value = estimate(&report, "class_accuracy")["value"].as_f64();
        let notes = report["tasks"][0]["notes"].to_string();
        (value.expect("a number"), notes)
    };
    let (alone, _) = accuracy("");
    let (of_two, notes) = accuracy("--window 2");
    assert!(alone < 0.7, "{alone}");
    assert!(of_two > 0.95, "{of_two}");
    assert!(notes.contains("2 frames with stride 1"), "{notes}");
}

#[test]
fn a_window_is_refused_without_a_task_and_out_of_range() {
    let bench = rising_strokes();
    bench.refused(
        "evaluate data --model ridge --set window=3 --no-cache",
        2,
        "name the task by --task",
    );
    bench.refused(
        "evaluate data --task slip --window 65 --no-cache",
        2,
        "from 1 to 64",
    );
}

#[test]
fn a_model_of_a_task_is_fitted_once_and_predicts_names_of_classes_that_score_reads() {
    let bench = strokes();
    let fitted =
        bench.ok("fit data --task slip --model lda --window 2 --out slip.model --no-cache -q");
    assert!(fitted.contains("task     slip: no_slip, slip"), "{fitted}");
    assert!(fitted.contains("windows of 2 frames"), "{fitted}");
    bench.ok(
        "predict data --with slip.model --part all --out pred.csv --truth-out truth.csv --no-cache -q",
    );
    let predicted = std::fs::read_to_string(bench.path("pred.csv")).expect("a table");
    let classes = predicted.matches("slip").count() - predicted.matches("no_slip").count();
    assert!(classes > 40, "{predicted}");
    let truth = std::fs::read_to_string(bench.path("truth.csv")).expect("a table");
    assert!(
        truth.lines().next().expect("a head").contains("stroke"),
        "{truth}"
    );
    let report = bench.json(
        "score --truth truth.csv --pred pred.csv --task slip=outcome:positive=slip --cluster stroke",
    );
    let accuracy = estimate(&report, "class_accuracy");
    assert_eq!(accuracy["n"], 120);
    assert_eq!(accuracy["clusters"], 12);
    assert!(
        accuracy["value"].as_f64().expect("a number") > 0.8,
        "{report:#}"
    );
}

#[test]
fn a_fit_of_a_task_by_folds_is_refused_with_a_split_to_name() {
    let bench = strokes();
    bench.refused(
        "fit data --task slip --model lda --split cv:5 --out slip.model --no-cache",
        2,
        "expected `by-column:stroke`",
    );
    bench.refused(
        "fit data --task slip --model ridge --out slip.model --no-cache",
        2,
        "--model lda",
    );
}

#[test]
fn auto_takes_a_classifier_by_the_validation_part_and_states_the_errors_of_all() {
    let bench = strokes();
    let ran = bench.run("fit data --task slip --model auto --out slip.model --no-cache");
    assert_eq!(ran.code, 0, "{}", ran.err);
    for words in ["by the validation part", "lda 0.", "linfa/logistic 0."] {
        assert!(ran.err.contains(words), "{words}: {}", ran.err);
    }
    assert!(!ran.out.contains("model    auto"), "{}", ran.out);
    bench.json("evaluate data --task slip --model auto --no-cache");
}

/// Ten strokes of twelve rows on 8 × 8 taxels, of which the left half rises at a slip.
fn broad_strokes() -> Bench {
    let bench = Bench::new();
    let mut table = String::from("fz,stroke,slip");
    (0..64).for_each(|taxel| write!(table, ",c{taxel}").expect("written"));
    for stroke in 0..10_u32 {
        for row in 0..12_u32 {
            let word = if row % 3 == 2 { "slip" } else { "no_slip" };
            write!(table, "\n{},s{stroke},{word}", f64::from(row) * 0.1).expect("written");
            for taxel in 0..64_u32 {
                let noise = f64::from((stroke * 5 + row * 3 + taxel * 7) % 11) * 0.05;
                let rise = f64::from(u8::from(row % 3 == 2 && taxel % 8 < 4));
                write!(table, ",{:.2}", noise + rise).expect("written");
            }
        }
    }
    table.push('\n');
    bench.write("lab/strokes.csv", &table);
    let map = MAP.replace("c0..3", "c0..63").replace("[2, 2]", "[8, 8]");
    bench.write("lab/map.toml", &map);
    bench.ok("import lab --map lab/map.toml --out data -q");
    bench
}

#[test]
fn a_network_learns_classes_and_its_probabilities_are_scored() {
    let bench = broad_strokes();
    let network = "--model cnn --set epochs=40 --set batch=16";
    let report = bench.json(&format!("evaluate data --task slip {network} --no-cache"));
    let accuracy = estimate(&report, "balanced_accuracy")["value"].as_f64();
    assert!(accuracy.expect("a number") > 0.9, "{report:#}");
    bench.ok(&format!(
        "fit data --task slip {network} --out slip.model --no-cache -q"
    ));
    bench.ok(
        "predict data --with slip.model --part all --out pred.csv --truth-out truth.csv --no-cache -q",
    );
    let report = bench.json(
        "score --truth truth.csv --pred pred.csv --task slip=outcome:positive=slip --cluster stroke",
    );
    assert!(
        estimate(&report, "log_loss")["value"].is_number(),
        "{report:#}"
    );
    let area = estimate(&report, "roc_auc")["value"].as_f64();
    assert!(area.expect("a number") > 0.95, "{report:#}");
}

/// Eight strokes of eight rows in which an object moves along x and y and turns about z, as three taxels sense.
fn moving_strokes() -> Bench {
    let bench = Bench::new();
    let mut table = String::from("fz,stroke,x,y,z,qx,qy,qz,qw,c0,c1,c2,c3");
    for stroke in 0..8_u32 {
        for row in 0..8_u32 {
            let part = |factor: u32| f64::from((stroke * 3 + row * factor) % 17) / 8.0 - 1.0;
            let [x, y, turn] = [part(5), part(7), part(11)];
            let half = (5.0 * turn).to_radians();
            write!(
                table,
                "\n0.5,s{stroke},{x},{y},0,0,0,{:.9},{:.9},{x},{y},{turn},0.1",
                half.sin(),
                half.cos()
            )
            .expect("written");
        }
    }
    table.push('\n');
    bench.write("lab/strokes.csv", &table);
    let (map, rest) = MAP.split_once("[task.slip]").expect("a task");
    let (_, sensor) = rest.split_once("[sensor]").expect("a sensor");
    let task = "[task.moved]\nkind = \"pose\"\nunit = [\"mm\"]\ncluster = \"stroke\"\n\
        from = { t = [\"x\", \"y\", \"z\"], q = [\"qx\", \"qy\", \"qz\", \"qw\"] }\n";
    bench.write("lab/map.toml", &format!("{map}{task}[sensor]{sensor}"));
    bench.ok("import lab --map lab/map.toml --out data -q");
    bench
}

#[test]
fn poses_of_unseen_strokes_are_predicted_by_a_model_of_numbers_and_scored() {
    let bench = moving_strokes();
    let report = bench.json("evaluate data --task moved --no-cache");
    crate::schema::check("tasks", &report);
    let shift = estimate(&report, "pose_translation")["value"].as_f64();
    assert!(shift.expect("a number") < 0.1, "{report:#}");
    let turn = estimate(&report, "pose_rotation")["value"].as_f64();
    assert!(turn.expect("a number") < 0.5, "{report:#}");
    assert!(report.to_string().contains("model ridge"), "{report:#}");
    bench.refused(
        "evaluate data --task moved --model lda --no-cache",
        2,
        "--model ridge",
    );
}

#[test]
fn a_model_of_poses_writes_the_seven_columns_that_score_reads() {
    let bench = moving_strokes();
    bench.ok("fit data --task moved --model ridge --out moved.model --no-cache -q");
    bench.ok(
        "predict data --with moved.model --part all --out pred.csv --truth-out truth.csv --no-cache -q",
    );
    let report =
        bench.json("score --truth truth.csv --pred pred.csv --task moved=pose --cluster stroke");
    let turn = estimate(&report, "pose_rotation");
    assert_eq!(turn["n"], 64, "{report:#}");
    assert!(
        turn["value"].as_f64().expect("a number") < 0.5,
        "{report:#}"
    );
}
