//! Gauge studies of tables of readings.

pub(crate) mod tables;

use serde_json::Value;
use taceva_report::FormattedValue;

use tables::{AIAG, aiag, golden, rows_of, simulated_units};

const OBLIGATORY: &str = "reproducibility has only 2 degrees of freedom, from 3 operators";

/// Component of a report by its name.
fn component<'r>(report: &'r Value, name: &str) -> &'r Value {
    let mut components = report["components"].as_array().expect("a list").iter();
    let found = components.find(|of| of["name"] == name);
    found.unwrap_or_else(|| panic!("no {name} in {report:#}"))
}

fn number(of: &Value) -> f64 {
    of.as_f64().unwrap_or_else(|| panic!("no number: {of}"))
}

fn ends(of: &Value) -> [f64; 2] {
    [number(&of[0]), number(&of[1])]
}

fn close(found: f64, expected: f64, relative: f64, name: &str) {
    let off = (found - expected).abs() / expected.abs();
    assert!(
        off <= relative,
        "{name}: {found} is not {expected}, off by {off:.1e}"
    );
}

#[test]
fn the_worked_example_has_the_printed_components_and_categories_with_intervals() {
    let bench = aiag();
    let report = bench.json(AIAG);
    crate::schema::check("gauge", &report);
    let golden = golden("msa");
    let printed = &golden["published_AIAG"]["components_sd"];
    let names = [
        ("repeatability", "EV"),
        ("reproducibility", "AV"),
        ("gauge", "GRR"),
        ("part", "PV"),
    ];
    for (name, short) in names {
        let of_name = match name {
            "gauge" => "grr",
            name => name,
        };
        let found = component(&report, name);
        let expected = number(&golden["pooled"]["sd"][of_name]);
        close(number(&found["sd"]), expected, 1e-13, name);
        close(number(&found["sd"]), number(&printed[short]), 6e-6, name);
        let [low, high] = ends(&found["ci95"]);
        assert!(low < expected && expected < high, "{found}");
    }
    let intervals = &golden["intervals_95"];
    let near = |found: &Value, name: &str| {
        let [low, high] = ends(found);
        close(low, number(&intervals[name][0]), 0.01, name);
        close(high, number(&intervals[name][1]), 0.01, name);
    };
    let share = &component(&report, "gauge")["percent_study_ci95"];
    near(share, "percent_study_grr_GPQ");
    near(&report["ndc"]["ci95"], "ndc_GPQ");
    close(
        number(&report["ndc"]["value"]),
        4.875_041_362_678_109,
        1e-13,
        "ndc",
    );
    assert_eq!(report["ndc"]["floor"], 4);
    assert_eq!(report["band"], "conditional");
    assert_eq!(report["response"], "prediction");
}

#[test]
fn text_and_csv_print_the_numbers_of_the_json() {
    let bench = aiag();
    let (report, text) = (bench.json(AIAG), bench.ok(AIAG));
    let csv = bench.ok(&format!("{AIAG} --format csv"));
    for of in report["components"].as_array().expect("a list") {
        let [sd, share] = [number(&of["sd"]), number(&of["percent_study"])];
        let [of_sd, of_share] = [ends(&of["ci95"]), ends(&of["percent_study_ci95"])];
        for printed in [
            FormattedValue::number(sd, Some(of_sd)),
            FormattedValue::number(share, Some(of_share)),
        ] {
            let phrase = printed.phrase("");
            assert!(text.contains(&phrase), "no `{phrase}` in\n{text}");
        }
        let [low, high] = of_sd;
        let row = format!("sd,{sd:?},,{low:?},{high:?}");
        assert!(csv.contains(&row), "no `{row}` in\n{csv}");
    }
    let ndc = number(&report["ndc"]["value"]);
    let [low, high] = ends(&report["ndc"]["ci95"]);
    let row = format!("ndc,{ndc:?},1,{low:?},{high:?}");
    assert!(csv.contains(&row), "no `{row}` in\n{csv}");
    let phrase = FormattedValue::number(ndc, Some([low, high])).phrase("");
    let phrase = format!("length: {phrase} distinct categories, rounded down to 4.");
    assert!(text.contains(&phrase), "no `{phrase}` in\n{text}");
}

#[test]
fn every_form_says_that_three_operators_have_two_degrees_of_freedom() {
    let bench = aiag();
    for format in ["text", "json", "csv", "md", "tex"] {
        let written = bench.ok(&format!("{AIAG} --format {format}"));
        let written = written.replace('\n', " ");
        let count = written.matches(OBLIGATORY).count();
        assert_eq!(count, 1, "{format}: {written}");
    }
}

#[test]
fn a_nested_study_has_its_own_components_and_flags_a_negative_one() {
    let bench = aiag();
    let report = bench.json(&format!("{AIAG} --nested"));
    crate::schema::check("gauge", &report);
    let golden = &golden("nested")["nested"]["variance_raw"];
    for (name, key) in [
        ("repeatability", "repeatability"),
        ("part", "part_in_operator"),
        ("operator", "operator"),
    ] {
        let found = number(&component(&report, name)["variance_raw"]);
        close(found, number(&golden[key]), 1e-13, name);
    }
    assert_eq!(component(&report, "operator")["sd"], 0.0);
    let text = bench.ok(&format!("{AIAG} --nested"));
    assert!(text.contains("10 parts of each operator"), "{text}");
    assert!(text.contains("counted as 0"), "{text}");
}

#[test]
fn the_range_method_and_a_share_of_the_tolerance_are_computed_on_request() {
    let bench = aiag();
    let report = bench.json(&format!("{AIAG} --method range --tolerance 4mm"));
    crate::schema::check("gauge", &report);
    let equipment = component(&report, "repeatability");
    close(number(&equipment["sd"]), 0.201_88, 1e-3, "EV");
    let share = number(&equipment["percent_tolerance"]);
    close(share, 150.0 * number(&equipment["sd"]), 1e-14, "tolerance");
    assert_eq!(report["unit"], "mm");
    assert_eq!(report["method"], "range");
}

#[test]
fn a_missing_reading_is_refused_by_its_cell_or_its_part_is_left_out_and_counted() {
    let bench = aiag();
    let complete = rows_of(&bench);
    let mut rows = complete.lines();
    let row = rows.find(|row| row.starts_with("p03,B,2,")).expect("there");
    bench.write("study.csv", &complete.replace(&format!("{row}\n"), ""));
    let message = "study.csv, channel length, by `part`, `appraiser`, `trial`: part p03, operator B: 2 readings, expected 3 as in most cells; `--drop-incomplete`";
    bench.refused(AIAG, 3, message);
    let report = bench.json(&format!("{AIAG} --drop-incomplete"));
    crate::schema::check("gauge", &report);
    assert_eq!(report["parts"], 9);
    assert_eq!(report["dropped"], 1);
    let text = bench.ok(&format!("{AIAG} --drop-incomplete"));
    assert!(text.contains("parts left out as incomplete: 1"), "{text}");
}

#[test]
fn a_wrong_cell_is_refused_by_its_line_and_column() {
    let bench = aiag();
    let complete = rows_of(&bench);
    bench.write("study.csv", &complete.replacen("0.29", "NaN", 1));
    bench.refused(AIAG, 3, "study.csv, line 2, column `length`: `NaN`");
    bench.write("study.csv", &format!("{complete}p01,A,1,0.3\n"));
    let message = "study.csv, line 92, column `length`: part p01, operator A, trial 1: two readings, expected one";
    bench.refused(AIAG, 3, message);
    bench.refused(
        "gauge study.csv --channels length",
        3,
        "no column `point_id`",
    );
    bench.refused(
        "gauge study.csv --part part --by appraiser --trial trial --channels width",
        3,
        "no column `width`",
    );
}

#[test]
fn rows_without_a_label_or_a_reading_are_left_out_and_counted() {
    let bench = aiag();
    let complete = rows_of(&bench);
    bench.write("study.csv", &format!("{complete},A,1,0.3\np01,A,4,\n"));
    let report = bench.json(AIAG);
    assert_eq!(report["rows_left_out"], 2);
    let text = bench.ok(AIAG);
    assert!(
        text.contains("length: 2 rows left out, without a reading"),
        "{text}"
    );
    bench.write("study.csv", "part,appraiser,trial,length\np01,A,1,\n");
    bench.refused(AIAG, 3, "study.csv: no row has a reading of channel length");
}

#[test]
fn one_operator_and_options_that_contradict_each_other_are_refused() {
    let bench = aiag();
    bench.refused(
        &format!("{AIAG} --pool 2"),
        2,
        "--pool 2: expected a p value from 0 to 1",
    );
    bench.refused(
        &format!("{AIAG} --nested --method range"),
        2,
        "`--method anova`",
    );
    bench.refused(
        &format!("{AIAG} --response error"),
        3,
        "no column `length_predicted`",
    );
    bench.refused(
        &format!("{AIAG} --tolerance 4"),
        2,
        "--tolerance `4`: expected a unit",
    );
    bench.refused(
        &format!("{AIAG} --tolerance 0.4cm"),
        2,
        "--tolerance 0.4cm: the unit of channel length is unknown, expected a width in mm",
    );
    let complete = rows_of(&bench);
    let is_of_one = |row: &&str| !row.contains(",B,") && !row.contains(",C,");
    let of_one: Vec<&str> = complete.lines().filter(is_of_one).collect();
    bench.write("study.csv", &of_one.join("\n"));
    bench.refused(AIAG, 3, "1 operator, expected at least 2");
}

#[test]
fn simulated_units_are_studied_by_the_error_and_every_form_says_that_they_are_simulated() {
    let bench = simulated_units();
    let words = "gauge units.csv --tolerance 100mN";
    let report = bench.json(words);
    crate::schema::check("gauge", &report);
    let found = ["channel", "response", "unit"].map(|key| report[key].as_str().expect(key));
    assert_eq!(found, ["Fz", "error", "N"]);
    close(number(&report["tolerance"]), 0.1, 1e-15, "tolerance");
    assert_eq!(report["parts"], 6);
    assert_eq!(report["operators"], 2);
    assert_eq!(report["ndc"]["undefined"], "errors");
    assert_eq!(report["band"], Value::Null);
    // The force itself differs far more between places than its error.
    let predictions = bench.json(&format!("{words} --response prediction"));
    let part = |of: &Value| number(&component(of, "part")["sd"]);
    assert!(part(&predictions) > 5.0 * part(&report), "{predictions:#}");
    assert!(
        number(&predictions["ndc"]["value"]) > 5.0,
        "{predictions:#}"
    );
    for format in ["text", "json", "csv", "md", "tex"] {
        let written = bench.ok(&format!("{words} --format {format}"));
        assert!(written.contains("simulated"), "{format}: {written}");
    }
    bench.refused(
        "gauge units.csv --format json",
        2,
        "--format json writes one channel: add --channels with one of Fz, Pz",
    );
    bench.refused(
        "gauge units.csv --channels Fz --tolerance 1mm",
        2,
        "--tolerance 1mm: channel Fz is in N",
    );
    let both = bench.ok("gauge units.csv");
    assert!(
        both.contains("Fz: errors") && both.contains("Pz: errors"),
        "{both}"
    );
}

#[test]
fn the_result_beside_a_table_of_samples_states_their_origin() {
    let bench = simulated_units();
    let table = std::fs::read_to_string(bench.path("units.csv")).expect("there");
    bench.write("units.samples.csv", &table.replace(",source", ",origin"));
    let words = "gauge units.samples.csv --channels Fz";
    assert_eq!(bench.json(words)["sources"][0], "unknown");
    let result = r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "drawn", "source": "simulated"}, "metrics": {"mae": {"Fz": {"value": 0.1, "unit": "N", "n": 24, "definition": "mae/1"}}}}"#;
    let sealed = taceva_files::seal::json::seal(result).expect("JSON");
    bench.write("units.json", &sealed);
    let report = bench.json(words);
    assert_eq!(report["sources"][0], "simulated");
    let sentence = "Nothing here was measured: the samples are simulated.";
    assert_eq!(report["not_measured"], sentence);
}

#[test]
fn a_table_in_parquet_has_the_components_of_the_same_table_in_csv() {
    let bench = aiag();
    tables::write_parquet(&bench);
    let of_parquet = bench.json(&AIAG.replace("study.csv", "study.parquet"));
    assert_eq!(of_parquet["components"], bench.json(AIAG)["components"]);
}
