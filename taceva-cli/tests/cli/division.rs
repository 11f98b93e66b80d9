//! Division of recordings with similar neighbouring samples, cross-validation, and pairing of tables, by the program.

use std::fs;
use std::path::Path;

use crate::support::{Bench, SAMPLES};

/// Stream of sixteen taxels at 50 Hz, which are unrelated to the force in the same rows.
const STREAM: &str = "../crates/studies/evaluate/tests/data/division/tax.csv";

const MAP: &str = r#"map_version = 2
table = "tax.csv"
[columns]
Fz = { from = "fz", unit = "N" }
[signals]
from = "c0..15"
unit = "uT"
places = [4, 4]
channels = ["p"]
order = "place-first"
[time]
clock = "monotonic"
column = "t"
unit = "s"
[sensor]
model = "lab gel"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

fn stream(map: &str) -> Bench {
    let bench = Bench::new();
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join(STREAM);
    bench.write("lab/map.toml", map);
    fs::copy(table, bench.path("lab/tax.csv")).expect("copied");
    bench.ok("import lab --map lab/map.toml --out data -q");
    bench
}

#[test]
fn a_stream_is_divided_by_blocks_of_time_and_says_so_first() {
    let points = MAP.replace("[signals]", "[ids]\npoint_id = \"t\"\n[signals]");
    for map in [MAP, &points] {
        let bench = stream(map);
        let report = bench.json("evaluate data --model knn --metrics mae,r2");
        let r2 = report["metrics"]["r2"]["Fz"]["value"]
            .as_f64()
            .expect("a number");
        assert!(r2 < 0.6, "{r2}");
        let split = report["provenance"]["split"].as_str().expect("divided");
        assert_eq!(split, "cv:5 by-block");
        let text = bench.ok("evaluate data --model knn --metrics mae,r2");
        let said = "neighbours in time resemble each other (Fz by ";
        assert!(text.lines().any(|line| line.starts_with(said)), "{text}");
    }
}

#[test]
fn a_stream_that_is_divided_at_random_by_hand_is_marked_in_every_output() {
    let bench = stream(MAP);
    for format in ["text", "json", "md", "tex", "tex --table all"] {
        let words =
            format!("evaluate data --model knn --metrics r2 --split random --format {format}");
        let out = bench.ok(&words);
        assert!(out.contains("the scores are optimistic"), "{format}: {out}");
    }
    bench.ok("evaluate data --model knn --metrics r2 --split random --html page.html -q");
    let page = fs::read_to_string(bench.path("page.html")).expect("written");
    assert!(page.contains("the scores are optimistic"));
    let report = bench.json("evaluate data --model knn --metrics r2 --split random");
    let standing = &report["metrics"]["r2"]["Fz"]["standing"];
    assert_eq!(standing, "skill not known: no interval", "{report}");
}

#[test]
fn samples_in_the_gaps_between_blocks_are_counted_with_the_reason_and_the_remedy() {
    let bench = stream(MAP);
    let said = "of a validation or test block, and neighbours resemble each other; --split 'cv:5 by-block' tests every sample";
    let fitted = bench.ok("fit data --model ridge --split by-block --out m.taceva");
    let split = fitted.lines().find(|line| line.starts_with("split "));
    let split = split.unwrap_or_else(|| panic!("{fitted}"));
    assert!(split.contains(", left out "), "{fitted}");
    assert!(fitted.contains(said), "{fitted}");
    let words = "evaluate data --model ridge --metrics r2 --split by-block";
    let text = bench.ok(words);
    assert!(text.contains(said), "{text}");
    // The map states neither serial number nor gel.
    assert!(text.contains("lab gel   recorded\n"), "{text}");
    let split = text.lines().find(|line| line.starts_with("split "));
    assert!(
        split.is_some_and(|line| line.contains(" left out ")),
        "{text}"
    );
    let report = bench.json(words);
    let unused = &report["provenance"]["samples"]["left_out"];
    let notes = report["provenance"]["notes"].to_string();
    assert!(
        notes.contains(&format!(
            "{unused} of 900 samples are left out: they lie within "
        )),
        "{notes}"
    );
    let table = bench.ok(&format!("{words} --format md"));
    assert!(
        table.contains(&format!(", with {unused} samples in no part.")),
        "{table}"
    );
    bench.ok(&format!("{words} --html page.html -q"));
    let page = fs::read_to_string(bench.path("page.html")).expect("written");
    assert!(
        page.contains("samples are left out: they lie within"),
        "{page}"
    );
}

#[test]
fn few_points_are_each_tested_on_once_and_no_frame_is_decoded_twice() {
    let bench = Bench::new();
    bench.record("data", 32);
    let report = bench.json("evaluate data --model ridge --set size=8 --metrics mae");
    assert_eq!(report["provenance"]["split"], "cv:5 by-point");
    let ran = bench.run("evaluate data --model ridge --set size=8 --metrics mae");
    let fits: Vec<&str> = ran
        .err
        .lines()
        .filter(|line| line.starts_with("taceva: fit ridge, fold "))
        .collect();
    assert_eq!(fits.len(), 5, "{}", ran.err);
    assert_eq!(fits[1], "taceva: fit ridge, fold 2 of 5");
    assert!(!ran.err.contains("(1)"), "{}", ran.err);
    let text = bench.ok("evaluate data --model ridge --set size=8 --metrics mae -q");
    let folds = format!(
        "split cv:5 by-point, seed 0: {SAMPLES} samples, each predicted once by one of 5 models\n"
    );
    assert!(text.contains(&folds), "{text}");
    assert!(!text.contains("scored on the part"), "{text}");
    let table = bench.ok("evaluate data --model ridge --set size=8 --format tex -q");
    let caption = "each held out once (5-fold cross-validation by point)";
    assert!(table.contains(caption), "{table}");
    assert_eq!(report["metrics"]["mae"]["Fz"]["n"], SAMPLES);
    assert_eq!(report["provenance"]["frames_decoded"], SAMPLES);
    bench.refused(
        "evaluate data --model ridge --split cv:11",
        2,
        "11 folds, but the recording has 10 groups",
    );
    bench.refused(
        "evaluate data --model ridge --split 35/20/10",
        2,
        "expected shares that add up to 100",
    );
}

#[test]
fn a_model_file_says_how_it_was_validated() {
    let bench = Bench::new();
    bench.record("data", 32);
    let said = bench.ok("fit data --model ridge --set size=8 --split cv:5 --out m.taceva");
    assert!(said.contains("validated by cv:5 by-point"), "{said}");
    let file = fs::read(bench.path("m.taceva")).expect("written");
    let text = String::from_utf8_lossy(&file);
    assert!(text.contains("cv:5 by-point") && text.contains("validation"));
    bench.refused("evaluate data --with m.taceva", 2, "split all");
}

#[test]
fn what_predict_writes_is_paired_with_the_recording_in_any_order() {
    let bench = Bench::new();
    bench.record("data", 32);
    bench.ok("fit data --model ridge --set size=8 --split by-point --out m.taceva -q");
    bench.ok("predict data --with m.taceva --part all --out p.csv --truth-out t.csv -q");
    let expected = bench.json("score --truth t.csv --pred p.csv --metrics mae");
    let text = fs::read_to_string(bench.path("p.csv")).expect("written");
    let mut lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].starts_with("sample,"), "{}", lines[0]);
    lines[1..].reverse();
    bench.write("reversed.csv", &(lines.join("\n") + "\n"));
    for truth in ["t.csv", "data/samples.parquet"] {
        let words = format!("score --truth {truth} --pred reversed.csv --metrics mae");
        let report = bench.json(&words);
        let value = |report: &serde_json::Value| report["metrics"]["mae"]["Fz"]["value"].clone();
        assert_eq!(value(&report), value(&expected), "{truth}");
        let notes = report["provenance"]["notes"].to_string();
        assert!(notes.contains("paired by `sample`"), "{notes}");
    }
}

#[test]
fn presses_are_independent_by_the_word_of_the_caller() {
    let bench = Bench::new();
    let rows: String = (0..50).map(|row| format!("{row}\n")).collect();
    bench.write("truth.csv", &format!("Fz\n{rows}"));
    bench.write("pred.csv", &format!("Fz\n{}", rows.replace("1\n", "1.5\n")));
    let report = bench.json("score --truth truth.csv --pred pred.csv --metrics mae --independent");
    let mae = &report["metrics"]["mae"]["Fz"];
    assert!(
        mae["method"]
            .to_string()
            .contains("samples taken as independent"),
        "{mae}"
    );
    let notes = report["provenance"]["notes"].to_string();
    assert!(
        notes.contains("the caller declared the samples independent"),
        "{notes}"
    );
}

#[test]
fn an_interval_names_its_samples_its_groups_and_its_metrics() {
    let bench = Bench::new();
    let rows = |by: f64| -> String {
        let row = |row: i32| format!("{}\n", f64::from(row) + by * f64::from(row % 7));
        (0..400).map(row).collect()
    };
    bench.write("truth.csv", &format!("Fz\n{}", rows(0.0)));
    bench.write("pred.csv", &format!("Fz\n{}", rows(0.125)));
    let words = "score --truth truth.csv --pred pred.csv --metrics mae,tolerance --independent";
    let method = "jackknife, 400 samples taken as independent in 32 groups, logarithmic (mae";
    let text = bench.ok(&format!("{words} -q"));
    assert!(text.contains(&format!("intervals  {method}")), "{text}");
    let tex = bench.ok(&format!("{words} --format tex --table all -q"));
    assert!(tex.contains("400 samples taken as independent"), "{tex}");
    let page = bench.path("page.html");
    bench.ok(&format!("{words} --html {} -q", page.display()));
    let page = fs::read_to_string(page).expect("written");
    assert!(page.contains(method), "{page}");
}
