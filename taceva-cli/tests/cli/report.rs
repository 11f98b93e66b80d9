//! Pages, figures, tables, comparisons, choices and data sheets, requested as by a user.

mod accepted;
mod compared;
mod decisions;
mod documents;
#[path = "../../../crates/results/report/tests/report/paper.rs"]
mod latex;
mod written_again;

use std::fs;

use crate::support::Bench;
use serde_json::Value;
use taceva_report::{BenchMachine, BenchRecording, ChannelError, ModelBench, ModelRow};

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn names_that_begin_like_a_formula_are_words_in_tables_and_the_same_names_when_read() {
    let begins = |text: &&&str| text.starts_with(['=', '+', '-', '@']);
    let mut names: Vec<&str> = naughty_strings::BLNS
        .iter()
        .filter(begins)
        .copied()
        .collect();
    names.sort_unstable();
    // A number is one key with and without `.0`.
    names.retain(|name| !name.ends_with(".0"));
    names.dedup();
    names.extend(["=1+1", "=cmd|' /C calc'!A0", "'=quoted", "plain"]);
    assert!(names.len() > 12, "{}", names.len());
    let bench = Bench::new();
    let table = |off: f64| {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer
            .write_record(["id", "point_id", "Fz"])
            .expect("memory");
        for (name, at) in names.iter().zip(1_u32..) {
            let value = (f64::from(at) * 0.1 + off * f64::from(at % 3)).to_string();
            writer
                .write_record([name, name, value.as_str()])
                .expect("memory");
        }
        String::from_utf8(writer.into_inner().expect("memory")).expect("texts")
    };
    bench.write("t.csv", &table(0.0));
    for (name, off) in [("a", 0.01), ("b", 0.02)] {
        bench.write("p.csv", &table(off));
        bench.ok(&format!(
            "score --truth t.csv --pred p.csv --metrics mae --format json --out {name}.json --samples-out {name}.samples.csv -q"
        ));
    }
    let text = fs::read_to_string(bench.path("a.samples.csv")).expect("written");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut read: Vec<String> = Vec::new();
    for record in reader.records() {
        let record = record.expect("a row");
        assert!(!record[0].starts_with(['=', '+', '-', '@']), "{record:?}");
        assert!(!record[1].starts_with(['=', '+', '-', '@']), "{record:?}");
        read.push(taceva_results::unescape_csv(&record[0]).to_owned());
    }
    assert_eq!(read, names);
    let comparison = bench.json("compare a.json b.json --metrics mae");
    let test = comparison["answers"][0]["difference"]["test"].as_str();
    assert!(
        test.is_some_and(|test| test.starts_with("paired sign flip")),
        "{comparison:#}"
    );
    let scores = bench.ok("score --truth t.csv --pred p.csv --metrics mae --format csv -q");
    for record in csv::Reader::from_reader(scores.as_bytes()).records() {
        let record = record.expect("a row");
        let words = [0, 1, 2, 4, 7, 10, 11].map(|column| &record[column]);
        assert!(
            words
                .iter()
                .all(|word| !word.starts_with(['=', '+', '-', '@']))
        );
    }
}

#[test]
fn a_benchmark_of_models_is_what_its_schema_says() {
    let mut bench = ModelBench::new(BenchMachine::default(), BenchRecording::default());
    let error = ChannelError {
        channel: "Fz".to_owned(),
        unit: taceva_core::Unit::Newton,
        mae: 0.25,
        ci95: Some([0.2, 0.3]),
        n: 40,
        beaten_by: Vec::new(),
    };
    bench.rows = vec![
        ModelRow {
            errors: vec![error],
            ..ModelRow::default()
        },
        ModelRow {
            failed: Some("no memory".to_owned()),
            ..ModelRow::default()
        },
    ];
    crate::schema::check("bench-models", &json(&bench.json()));
    bench.rows[0].errors[0].ci95 = None;
    crate::schema::check("bench-models", &json(&bench.json()));
}

#[test]
fn tables_for_papers_compile() {
    let bench = Bench::new();
    bench.record("data", 40);
    for words in [
        "evaluate data --model ridge --split random --part all --format tex --table all",
        "check data --format tex",
        "bench kernels --rows 600 --rounds 1 --format tex",
        "choose --need shear,fast --format tex",
        "catalogue show GelSight --format tex",
    ] {
        latex::assert_compiles(words, &bench.ok(&format!("{words} -q")));
    }
}
