//! Limits decided by rules: exit codes, and results that contradict themselves or were edited.

use std::fs;

use serde_json::Value;

use super::accepted::scored;
use crate::support::Bench;

/// Writes `limits.toml`: the decision rule in the lines `rule`, and the limit `most` on the error of Fz in N.
fn limit(bench: &Bench, rule: &str, most: f64) {
    let text = format!(
        "limits_version = 2\n[decision]\n{rule}\n[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = {most}\n"
    );
    bench.write("limits.toml", &text);
}

fn result(bench: &Bench) -> Value {
    let text = fs::read_to_string(bench.path("r.json")).expect("a result");
    serde_json::from_str(&text).expect("JSON")
}

/// The error of Fz in `r.json`.
fn error_of(bench: &Bench) -> f64 {
    let value = &result(bench)["metrics"]["mae"]["Fz"]["value"];
    value.as_f64().expect("a number")
}

/// Writes the error `value` of Fz into `r.json`, and accepts that edit.
fn resealed(bench: &Bench, value: f64) {
    let text = fs::read_to_string(bench.path("r.json")).expect("a result");
    let (before, mae) = text.split_once("\"mae\"").expect("an error");
    let old = format!("\"value\": {}", error_of(bench));
    assert!(mae.contains(&old), "no `{old}` in {mae}");
    let mae = mae.replacen(&old, &format!("\"value\": {value}"), 1);
    bench.write("r.json", &format!("{before}\"mae\"{mae}"));
    bench.refused("accept r.json --limits limits.toml", 3, "was changed");
    bench.ok("reseal r.json --reason better,so -q");
}

#[test]
fn a_conditional_pass_ends_with_one_unless_it_counts() {
    let bench = Bench::new();
    scored(&bench);
    let most = error_of(&bench) * 1.001;
    limit(&bench, "rule = \"simple\"", most);
    bench.ok("accept r.json --limits limits.toml -q");
    limit(&bench, "rule = \"guarded\"", most);
    let ran = bench.run("accept r.json --limits limits.toml -q");
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("conditional pass"), "{}", ran.out);
    let counted = bench.json("accept r.json --limits limits.toml --conditional pass");
    crate::schema::check("acceptance", &counted);
    let finding = &counted["findings"][0];
    assert_eq!(finding["verdict"], "conditional pass");
    let p = finding["conformance_probability"].as_f64();
    let p = p.expect("an interval");
    assert!((0.5..0.51).contains(&p), "{p}");
    bench.refused(
        "accept r.json --limits limits.toml --conditional fail",
        2,
        "--conditional",
    );
}

#[test]
fn settings_of_no_rule_are_bad_input() {
    let bench = Bench::new();
    scored(&bench);
    for (rule, message) in [
        ("rule = \"gaurded\"", "did you mean `guarded`?"),
        ("rule = \"guarded\"\nr = -1.0", "r is -1"),
        (
            "rule = \"probability\"\np_conformity = 0.5",
            "p_conformity is 0.5",
        ),
        (
            "rule = \"guarded\"\nr = 1.0\np_conformity = 0.9",
            "remove the setting, or change the rule",
        ),
    ] {
        limit(&bench, rule, 1.0);
        bench.refused("accept r.json --limits limits.toml", 3, message);
    }
}

#[test]
fn a_value_outside_its_own_interval_is_bad_input_in_every_format() {
    let bench = Bench::new();
    scored(&bench);
    limit(&bench, "rule = \"simple\"", 1.0);
    resealed(&bench, 0.9);
    for format in ["text", "json", "csv", "md", "tex"] {
        bench.refused(
            &format!("accept r.json --limits limits.toml --format {format}"),
            3,
            "mae Fz: the value 0.9 N is outside its own interval 0.0",
        );
    }
}

#[test]
fn other_units_give_risks_and_few_of_them_a_reason() {
    let bench = Bench::new();
    scored(&bench);
    limit(&bench, "rule = \"guarded\"", 1.0);
    let accepted = bench.json("accept r.json --limits limits.toml --process r.json");
    crate::schema::check("acceptance", &accepted);
    assert_eq!(
        accepted["findings"][0]["process"]["undefined"],
        "the number of units is 1, expected at least 5 units of one process"
    );
    bench.refused(
        "accept r.json --limits limits.toml --process r.json --target-risk 1",
        2,
        "--target-risk 1: expected a share above 0 and below 1",
    );
}

#[test]
fn two_results_of_one_serial_are_one_unit_of_the_process() {
    let bench = Bench::new();
    scored(&bench);
    limit(&bench, "rule = \"guarded\"", 1.0);
    let text = fs::read_to_string(bench.path("r.json")).expect("a result");
    let unknown = "\"serial\": \"unknown\"";
    assert!(text.contains(unknown), "{text}");
    for (name, serial) in [("a.json", "7"), ("b.json", "8"), ("c.json", "7")] {
        let known = text.replace(unknown, &format!("\"serial\": \"{serial}\""));
        bench.write(name, &known);
        bench.ok(&format!("reseal {name} --reason drawn -q"));
    }
    bench.write("d.json", &text);
    let accept = "accept r.json --limits limits.toml";
    for (name, others) in [("a.json", "c.json"), ("b.json", "a.json --process c.json")] {
        bench.refused(
            &format!("{accept} --process {name} --process {others}"),
            2,
            "also occurs in a.json; expected one result of each unit",
        );
    }
    // Results without a serial number may be of several units.
    let units = "--process a.json --process b.json --process r.json --process d.json";
    let accepted = bench.json(&format!("{accept} {units}"));
    assert_eq!(
        accepted["findings"][0]["process"]["undefined"],
        "the number of units is 4, expected at least 5 units of one process"
    );
}

#[test]
fn an_accepted_edit_of_a_result_is_said_in_every_format() {
    let bench = Bench::new();
    scored(&bench);
    limit(&bench, "rule = \"guarded\"", 1.0);
    let value = error_of(&bench);
    resealed(&bench, value * 1.001);
    for (format, words) in [
        ("text", "better,so"),
        ("json", "better,so"),
        ("csv", "1 accepted edit"),
        ("md", "better,so"),
        ("tex", "better,so"),
    ] {
        let words_of = format!("accept r.json --limits limits.toml --format {format} -q");
        let text = bench.ok(&words_of);
        assert!(text.contains(words), "{format}: {text}");
    }
    bench.ok("accept r.json --limits limits.toml --html sheet.html -q");
    let page = fs::read_to_string(bench.path("sheet.html")).expect("written");
    assert!(page.contains("better,so"), "{page}");
}
