//! Comparisons of results, of runs and of the catalogue.

use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Stdio};

use serde_json::Value;
use taceva_needs::{Need, skip};

use super::json;
use crate::support::Bench;

#[test]
fn predictions_of_the_same_samples_are_compared_one_by_one() {
    let bench = Bench::new();
    bench.record("data", 40);
    // A result finds the table of its samples by the digest, whatever its name.
    for (model, name, table) in [("ridge", "a", "a.samples.csv"), ("pls", "b", "of pls.csv")] {
        let out = format!("--format json --out {name}.json --samples-out");
        let mut command = bench.command(&format!("evaluate data --model {model} --split random --part all --html {name}.html --figures {name} -q {out}"));
        assert!(command.arg(table).status().expect("it starts").success());
        crate::schema::check(
            "evaluation",
            &json(&fs::read_to_string(bench.path(&format!("{name}.json"))).expect("there")),
        );
        assert!(bench.path(&format!("{name}/predicted-1.svg")).is_file());
        assert!(
            fs::read_to_string(bench.path(&format!("{name}.html")))
                .expect("there")
                .contains("data:image/jpeg;base64,")
        );
    }
    let comparison = bench.json("compare a.json b.json --metrics mae --margin mae=1000000");
    crate::schema::check("comparison", &comparison);
    let answers = comparison["answers"].as_array().expect("a list");
    let tests: Vec<&str> = answers
        .iter()
        .filter_map(|answer| answer["difference"]["test"].as_str())
        .collect();
    assert!(
        tests
            .iter()
            .any(|test| test.starts_with("paired sign flip")),
        "{comparison:#}"
    );
    assert!(answers.iter().any(|answer| {
        answer["answer"]
            .as_str()
            .is_some_and(|words| words.starts_with("equivalent within"))
    }));
}

/// Scene of one sensor with the model `model` and a few presses.
fn small(model: &str) -> String {
    format!(
        r#"scene_version = 1
name = "small"
seed = 7
robot = {{ driver = "sim/robot" }}
force = {{ driver = "sim/force-transducer" }}
model = {{ name = "{model}" }}
metrics = {{ want = ["mae", "r2"] }}
protocol = {{ calibration = {{ points = 80, indentations = 1 }} }}
[[study]]
name = "dome"
sensor = {{ driver = "sim/vitactip:reduction=16" }}
"#
    )
}

#[test]
fn runs_are_compared_by_their_folders_and_what_is_missing_is_named() {
    let bench = Bench::new();
    for (model, folder) in [("ridge", "one"), ("pls", "two")] {
        bench.write(&format!("{folder}.toml"), &small(model));
        bench.ok(&format!("run {folder}.toml --out {folder} -q"));
    }
    let is_paired = |comparison: &Value| {
        let answers = comparison["answers"].as_array().expect("a list");
        let mut tests = answers
            .iter()
            .filter_map(|answer| answer["difference"]["test"].as_str());
        tests.any(|test| test.starts_with("paired sign flip"))
    };
    let by_folder = bench.json("compare one two --metrics mae");
    assert!(is_paired(&by_folder), "{by_folder:#}");
    let by_file = bench.json("compare one/results.json two/reports/1-dome.json --metrics mae");
    assert_eq!(by_file, by_folder);
    fs::remove_file(bench.path("two/reports/1-dome.samples.csv")).expect("it was there");
    let ran = bench.run("compare one two --metrics mae --all");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let expected = "two/results.json: no samples of dome in two/reports/1-*.samples.csv: compared by the intervals of both, not sample by \
        sample";
    assert!(ran.err.contains(expected), "{}", ran.err);
    assert!(!ran.out.contains("paired sign flip"), "{}", ran.out);
    bench.refused(
        "compare one two/figures",
        2,
        "two/figures: a folder without results.json; expected the folder of a run",
    );
}

#[test]
fn a_comparison_has_rows_of_the_named_channels() {
    let bench = Bench::new();
    let row = "mae Pz (mm)";
    let all = bench.ok("compare ViTacTip GelSight -q");
    assert!(all.contains(row), "{all}");
    let named = bench.ok("compare ViTacTip GelSight --channels Fz -q");
    assert!(
        named.contains("mae Fz (N)") && !named.contains(row),
        "{named}"
    );
    let csv = bench.ok("compare ViTacTip GelSight --channels Fz --format csv -q");
    let has_value = |channel: &str| {
        let start = format!("mae,lower,{channel},ViTacTip,,");
        csv.lines().any(|line| line.starts_with(&start))
    };
    assert!(has_value("Fz") && !has_value("Pz"), "{csv}");
    bench.refused(
        "compare ViTacTip GelSight --channels Fq",
        2,
        "--channels Fq: no result has this channel, expected one of",
    );
}

#[test]
fn published_numbers_are_compared_and_chosen_from() {
    let bench = Bench::new();
    let compared = bench.json("compare ViTacTip GelSight MagicTac");
    crate::schema::check("comparison", &compared);
    let answers = compared["answers"].as_array().expect("a list");
    let of_fz = |answer: &&Value| {
        answer["metric"] == "mae" && answer["channel"] == "Fz" && answer["b"] == "GelSight"
    };
    let answer = answers.iter().find(of_fz).expect("one");
    assert_eq!(answer["scores"], serde_json::json!([0.0164, 0.0361]));
    assert_eq!(
        answer["answer"],
        "no answer: no interval: its source states no interval"
    );
    bench.write(
        "needs.toml",
        "needs = [\"accurate shear\", \"ambient light\"]\n",
    );
    let choice = bench.json("choose --needs needs.toml");
    crate::schema::check("choice", &choice);
    assert_eq!(choice["ranked"][0]["name"], "GelSight");
    bench.refused(
        "choose --need beauty",
        2,
        "`beauty`: unknown need, expected one of shear",
    );
    bench.refused(
        "compare GelSight",
        2,
        "expected at least two; `taceva catalogue list` names sensors to compare with",
    );
    for (alias, format) in [("latex", "tex"), ("markdown", "md")] {
        let of = |format: &str| bench.ok(&format!("compare ViTacTip GelSight --format {format}"));
        assert_eq!(of(alias), of(format));
    }
    bench.refused(
        "compare ViTacTip Nobody",
        2,
        "`Nobody`: no such file, and no such name in the catalogue",
    );
    bench.refused(
        "compare ViTacTip GelSight --margin mae=-1",
        2,
        "expected METRIC[.CHANNEL]=NUMBER",
    );
}

#[test]
fn names_of_metrics_and_of_margins_that_no_result_has_are_refused_with_the_nearest() {
    let bench = Bench::new();
    for format in ["text", "md", "json"] {
        bench.refused(
            &format!("compare ViTacTip GelSight --metrics mae,smap --format {format}"),
            2,
            "--metrics `smap`: unknown metric, did you mean `smape`? Known are mae, ",
        );
    }
    bench.refused(
        "compare ViTacTip GelSight --margin mea.Fz=0.01",
        2,
        "--margin `mea`: unknown metric, did you mean `mae`?",
    );
    bench.refused(
        "compare ViTacTip GelSight --margin mae.Fq=0.01",
        2,
        "--margin mae.Fq: no result has this score, expected mae or one of mae.Fxy, mae.Fz, ",
    );
    bench.refused(
        "compare ViTacTip GelSight --margin drift=0.01",
        2,
        "--margin drift: no result has this score, expected one of ",
    );
    let ran = bench.run("compare ViTacTip GelSight --metrics mae,drift --format csv");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.err
            .contains("--metrics drift: no result has this score, expected one of "),
        "{}",
        ran.err
    );
    let metrics = |words: &str| {
        let compared = bench.json(&format!("compare ViTacTip GelSight {words}"));
        let answers = compared["answers"].as_array().expect("a list").iter();
        let names: BTreeSet<String> = answers.map(|answer| answer["metric"].to_string()).collect();
        names
    };
    let group = ["mae", "r2", "smape"].map(|name| format!("{name:?}"));
    assert_eq!(metrics("--metrics accuracy"), BTreeSet::from(group));
    assert_eq!(metrics("--metrics all"), metrics(""));
}

#[test]
fn one_result_by_two_names_is_no_comparison() {
    let bench = Bench::new();
    bench.refused(
        "compare GelSight gelsight",
        2,
        "gelsight is named twice, first as GelSight, expected different results",
    );
    bench.refused(
        "compare DIGIT DIGIT",
        2,
        "DIGIT is named twice, expected different results",
    );
    fs::create_dir(bench.path("run")).expect("a folder");
    bench.write("run/results.json", "{}");
    bench.refused(
        "compare run run/results.json",
        2,
        "run/results.json is named twice, first as run, expected different results",
    );
    bench.refused(
        "choose --need shear --results run --results run",
        2,
        "run is named twice, expected different results",
    );
}

#[test]
fn values_stand_first_and_then_what_can_be_compared() {
    let bench = Bench::new();
    bench.record("data", 40);
    for model in ["ridge", "pls"] {
        bench.ok(&format!(
            "evaluate data --model {model} --split random --part all --format json --out {model}.json -q"
        ));
    }
    let order = |text: &str, parts: [&str; 2]| {
        let at = parts.map(|part| {
            let found = text.find(part);
            found.unwrap_or_else(|| panic!("no `{part}`: {text}"))
        });
        assert!(at[0] < at[1], "{text}");
    };
    for (names, shown) in [
        ("GelSight MagicTac", "0.0361"),
        ("ridge.json pls.json", " … "),
        ("ridge.json GelSight", "0.0361"),
    ] {
        for format in ["text", "md"] {
            let text = bench.ok(&format!("compare {names} --format {format} -q"));
            order(&text, ["Values of 2", "of scores: "]);
            order(&text, [shown, "of scores: "]);
        }
    }
    let none = bench.ok("compare DIGIT TacTip -q");
    assert!(none.contains("not in the catalogue"), "{none}");
    order(&none, ["availability", "No test is possible"]);
    assert!(none.contains(
        "No test is possible: no two of these results share a score with a better direction"
    ));
    assert!(none.contains("taceva catalogue show NAME"), "{none}");
    let none = bench.ok("choose --need thin,area>=90000mm2 -q");
    assert!(!none.contains("looked at"), "no table without rows: {none}");
    for format in ["text", "md"] {
        let choice = bench.ok(&format!("choose --need shear,light --format {format} -q"));
        order(&choice, ["Values side by side", "share of the best"]);
        order(&choice, ["dropped", "share of the best"]);
    }
}

#[test]
fn on_a_terminal_of_forty_columns_one_sensor_stands_below_the_other() {
    let bench = Bench::new();
    let program = env!("CARGO_BIN_EXE_taceva");
    for words in [
        "compare GelSight MagicTac -q",
        "compare GelSight MagicTac --all -q",
        "compare GelSight MagicTac --table main -q",
        "choose --need shear -q",
        "choose --need \"shear, rate >= 9000 Hz\" -q",
        "catalogue show GelSight -q",
        "catalogue list -q",
    ] {
        let typed = format!("stty cols 40 rows 24; '{program}' {words}");
        let done = Command::new("script")
            .current_dir(bench.path("."))
            .args(["-qec", &typed, "/dev/null"])
            .stdin(Stdio::null())
            .output();
        let done = match done {
            Ok(done) => done,
            Err(error) => return skip(Need::Terminal, format!("`script`: {error}")),
        };
        let shown = String::from_utf8_lossy(&done.stdout).replace('\r', "");
        // `script` may echo the end of its own empty input.
        let lines = shown.lines().map(|line| line.replace("^D\u{8}\u{8}", ""));
        let lines: Vec<String> = lines.collect();
        assert!(lines.len() > 10, "{shown}");
        for line in &lines {
            assert!(line.chars().count() <= 40, "{words}: {line}\n{shown}");
        }
        assert!(
            shown.contains("0.0361") || shown.contains("0.0245"),
            "{shown}"
        );
    }
}

#[test]
fn json_and_csv_of_a_comparison_hold_the_values_that_text_prints() {
    let bench = Bench::new();
    let compared = bench.json("compare GelSight DIGIT");
    crate::schema::check("comparison", &compared);
    assert!(compared["answers"].as_array().is_some_and(Vec::is_empty));
    let values = compared["values"].as_array().expect("values");
    let of = |quantity: &str| {
        let mut found = values.iter().filter(|of| of["quantity"] == quantity);
        found
            .next()
            .unwrap_or_else(|| panic!("no {quantity}: {values:?}"))
    };
    assert_eq!(of("mae Fz")["values"][0]["value"], 0.0361);
    assert_eq!(of("mae Fz")["values"][1]["text"], "not in the catalogue");
    assert_eq!(of("intrinsic resolution")["origins"], "definitions differ");
    assert_eq!(of("size")["values"][1]["text"], "20 × 27 × 18");
    let csv = bench.ok("compare GelSight DIGIT --format csv -q");
    let rows: Vec<&str> = csv.lines().collect();
    assert!(
        rows.iter()
            .any(|row| row.starts_with("mae,lower,Fz,GelSight,,0.0361,")),
        "{csv}"
    );
    assert!(csv.contains("cost of parts"), "{csv}");
}

#[test]
fn a_sensor_named_by_an_alias_is_said_to_be_listed_by_another_name() {
    let bench = Bench::new();
    let shown = bench.ok("catalogue show DIGIT -q");
    assert!(shown.starts_with("DIGIT (IMM)"), "{shown}");
    let mut command = bench.command("catalogue show -q");
    let done = command
        .arg("GelSight Mini")
        .output()
        .expect("the program starts");
    let shown = String::from_utf8(done.stdout).expect("text");
    assert!(
        shown.starts_with("GelSight Mini: listed as GelSight; "),
        "{shown}"
    );
    let said = bench.run("compare GSMini DIGIT").err;
    assert!(said.contains("GSMini: listed as GelSight; "), "{said}");
}

#[test]
fn every_wrong_need_is_refused_at_once_and_each_example_of_the_help_is_a_need() {
    let bench = Bench::new();
    bench.refused("choose --need beauty,rate", 2, "`beauty`: unknown need");
    bench.refused("choose --need beauty,rate", 2, "`rate`: expected a number");
    let help = bench.ok("choose --help");
    let examples = help.lines().filter_map(|line| {
        let (_, rest) = line.split_once("taceva choose --need \"")?;
        Some(rest.split_once('"')?.0)
    });
    let examples: Vec<&str> = examples.collect();
    assert!(examples.len() >= 2, "{help}");
    for example in examples {
        taceva_report::Need::parse(example).unwrap_or_else(|error| panic!("{error}"));
    }
    let words: Vec<&str> = help.split_whitespace().collect();
    let words = words.join(" ");
    assert!(words.contains("exit code is 0 also if no sensor"), "{help}");
}
