//! Models of tasks: windows of frames, model files, networks, automatic choice and poses.

use std::fmt::Write as _;

use crate::dataset_tasks::{MAP, estimate, strokes};
use crate::support::Bench;

/// Test folder with twelve strokes. A taxel rises by one in each row with slip; its start value differs between strokes.
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

/// Test folder with ten strokes of twelve rows on 8 × 8 taxels. The taxels of the left half rise at a slip.
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
fn a_network_learns_classes_and_its_probabilities_are_scored_by_evaluate_and_by_score() {
    let bench = broad_strokes();
    let network = "--model cnn --set epochs=40 --set batch=16";
    let report = bench.json(&format!("evaluate data --task slip {network} --no-cache"));
    let accuracy = estimate(&report, "balanced_accuracy")["value"].as_f64();
    assert!(accuracy.expect("a number") > 0.9, "{report:#}");
    crate::schema::check("tasks", &report);
    let area = estimate(&report, "roc_auc");
    assert_eq!(area["n"], 120, "{report:#}");
    assert_eq!(area["clusters"], 10, "{report:#}");
    assert!(
        area["value"].as_f64().expect("a number") > 0.95,
        "{report:#}"
    );
    for metric in ["average_precision", "brier", "log_loss", "ece"] {
        assert!(
            estimate(&report, metric)["value"].is_number(),
            "{metric}: {report:#}"
        );
    }
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

/// Test folder with eight strokes of eight rows. An object moves along x and y and turns about z; three taxels measure these motions.
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
    let report = bench.json("evaluate data --task moved --no-cache --html page.html");
    let page = std::fs::read_to_string(bench.path("page.html")).expect("written");
    assert!(page.contains("Greatest errors"), "{page}");
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
