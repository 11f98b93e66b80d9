//! Sweeps over the labels of tasks.

use std::fs;

use super::text;
use crate::dataset_tasks::strokes;

const SLIP: &str = r#"sweep_version = 1
datasets = ["data"]
task = "slip"
models = ["lda", "linfa/logistic"]
metrics = ["class_accuracy", "kappa"]
"#;

/// Rows of the table of a sweep, as cells.
fn rows(table: &str) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let head: Vec<String> = reader
        .headers()
        .expect("a head")
        .iter()
        .map(str::to_owned)
        .collect();
    let wanted = [
        "model", "task", "status", "metric", "channel", "better", "value", "n",
    ];
    let places = wanted.map(|name| head.iter().position(|own| own == name).expect(name));
    let cells = |row: csv::StringRecord| places.map(|place| row[place].to_owned()).to_vec();
    reader
        .records()
        .map(|row| cells(row.expect("a row")))
        .collect()
}

#[test]
fn every_model_has_the_scores_of_its_task_with_intervals_and_the_bytes_of_one_evaluation() {
    let bench = strokes();
    bench.write("which.toml", SLIP);
    let out = bench.ok("sweep which.toml -q");
    assert!(
        out.contains("tasks    2 scored, 0 failed, 0 missing"),
        "{out}"
    );
    let table = text(&bench, "which.sweep/table.csv");
    let rows = rows(&table);
    let accuracy = (110.0_f64 / 120.0).to_string();
    for model in ["lda", "linfa/logistic"] {
        let expected = [
            model,
            "slip",
            "scored",
            "class_accuracy",
            "slip",
            "higher",
            accuracy.as_str(),
            "120",
        ];
        assert!(rows.iter().any(|row| *row == expected), "{table}");
    }
    // Two models, two metrics.
    assert_eq!(rows.len(), 4, "{table}");
    bench.ok("evaluate data --task slip --model lda --no-cache --out lda.json --state-out lda.state --format json -q");
    let [report, state] =
        ["lda.json", "lda.state"].map(|name| fs::read(bench.path(name)).expect(name));
    let files = fs::read_dir(bench.path("which.sweep/evaluations")).expect("a folder");
    let files: Vec<Vec<u8>> = files
        .map(|entry| fs::read(entry.expect("an entry").path()).expect("a file"))
        .collect();
    assert_eq!(files.len(), 4);
    assert!(files.contains(&report) && files.contains(&state));
    let page = text(&bench, "which.sweep/page.html");
    assert!(page.contains("Scores of each task"), "{page}");
    assert!(!page.contains("Best of each question"), "{page}");
    let shown = bench.ok("sweep show which.toml --metric kappa");
    assert!(
        shown.contains("kappa ↑") && shown.contains("slip"),
        "{shown}"
    );
    bench.refused("sweep show which.toml", 2, "such as --metric f1_macro");
}

#[test]
fn a_task_of_each_name_is_an_axis_that_conditions_select() {
    let bench = strokes();
    bench.write(
        "which.toml",
        &SLIP.replace("task = \"slip\"", "task = [\"slip\", \"slip\"]"),
    );
    bench.refused(
        "sweep which.toml",
        3,
        "line 3: `task`: slip is listed twice",
    );
    bench.write(
        "which.toml",
        &SLIP.replace("task = \"slip\"", "task = [\"slip\", \"slpi\"]"),
    );
    bench.refused("sweep which.toml", 3, "did you mean `slip`?");
    bench.write("which.toml", SLIP);
    let dry = bench.ok("sweep which.toml --dry-run --only task=slip");
    assert!(dry.contains("tasks    2,"), "{dry}");
    bench.refused("sweep which.toml --only task=grasp", 2, "selects none");
}

#[test]
fn metrics_of_channels_and_of_tasks_are_refused_in_one_sweep_with_what_to_write() {
    let bench = strokes();
    let with = |metrics: &str| SLIP.replace("\"class_accuracy\", \"kappa\"", metrics);
    bench.write("which.toml", &with("\"kappa\", \"mae\""));
    bench.refused(
        "sweep which.toml",
        3,
        "line 5: `metrics`: mae applies to channels only, but `task` scores labels: write scores of tasks",
    );
    bench.write("which.toml", &with("\"kapa\""));
    bench.refused("sweep which.toml", 3, "did you mean `kappa`?");
    let of_channels = with("\"mae\", \"f1\"").replace("task = \"slip\"\n", "");
    bench.write("which.toml", &of_channels);
    bench.refused(
        "sweep which.toml",
        3,
        "line 4: `metrics`: f1 is a score of tasks, and this sweep scores channels: write `task = \"NAME\"`",
    );
    bench.write("which.toml", &format!("{SLIP}sensor = \"sensor.toml\"\n"));
    bench.refused("sweep which.toml", 3, "`sensor` applies to channels only");
    assert!(!bench.path("which.sweep").exists());
}

#[test]
fn a_score_that_the_task_lacks_has_a_row_with_the_reason() {
    let bench = strokes();
    bench.write("which.toml", &SLIP.replace("\"kappa\"", "\"roc_auc\""));
    bench.ok("sweep which.toml -q");
    let table = text(&bench, "which.sweep/table.csv");
    let lacking = rows(&table).into_iter().filter(|row| row[3] == "roc_auc");
    let lacking: Vec<_> = lacking.collect();
    assert_eq!(lacking.len(), 2, "{table}");
    assert!(lacking.iter().all(|row| row[6].is_empty()), "{table}");
    let reason =
        "not applicable: `slip` has no such score in this table, expected one of class_accuracy";
    assert!(table.contains(reason), "{table}");
    let page = text(&bench, "which.sweep/page.html");
    assert!(page.contains("has no such score in this table"), "{page}");
}

#[test]
fn a_limit_of_a_task_holds_for_each_model_of_a_sweep() {
    let bench = strokes();
    let limits = "limits_version = 2\n[decision]\nrule = \"simple\"\n[[limit]]\nmetric = \"precision\"\nchannel = \"slip\"\nunit = \"1\"\nleast = LEAST\n";
    for (least, code) in [("0.5", 0), ("0.99", 1)] {
        bench.write("limits.toml", &limits.replace("LEAST", least));
        bench.write("which.toml", &format!("{SLIP}limits = \"limits.toml\"\n"));
        let ran = bench.run("sweep which.toml -q");
        assert_eq!(ran.code, code, "{}{}", ran.out, ran.err);
        assert_eq!(ran.out.contains("FAIL"), code == 1, "{}", ran.out);
        assert!(ran.out.contains("lda, task slip"), "{}", ran.out);
    }
}

#[test]
fn a_model_that_predicts_no_class_fails_alone_with_the_models_that_do() {
    let bench = strokes();
    bench.write(
        "which.toml",
        &SLIP.replace("\"linfa/logistic\"", "\"ridge\""),
    );
    let ran = bench.run("sweep which.toml -q");
    assert_eq!(ran.code, 1, "{}", ran.err);
    let table = text(&bench, "which.sweep/table.csv");
    assert!(
        table.contains("expected a classifier, such as --model lda"),
        "{table}"
    );
    let failed = rows(&table).into_iter().filter(|row| row[2] == "failed");
    let failed: Vec<_> = failed.collect();
    assert_eq!(failed.len(), 1, "{table}");
    assert_eq!(failed[0][..2], ["ridge", "slip"]);
}
