//! Pages, figures, tables, comparisons, choices and data sheets, as a person asks for them.

#[path = "../../taceva-report/tests/support/latex.rs"]
mod latex;
mod schema;
mod support;

use std::fs;

use serde_json::Value;
use support::Bench;
use taceva_report::{BenchMachine, BenchRecording, ChannelError, ModelBench, ModelRow};

/// Two sensors, every part of the protocol, a few presses each.
const TWO: &str = r#"scene_version = 1
name = "two"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
lighting = { driver = "sim/lighting" }
model = { name = "ridge", set = { size = "16x16" } }
protocol = { calibration = { points = 90, indentations = 2 }, spatial = { points = 12 }, gratings = { step_mm = 0.75, presses = 2 }, lighting = { points = 3 }, repeatability = { points = 3, trials = 3, depth_step_mm = 0.5 }, hysteresis = { points = 3, depth_step_mm = 0.25 }, surface = { points = 8 }, idle = { frames = 6 } }
[[study]]
name = "dome"
sensor = { driver = "sim/vitactip:reduction=16", units = ["0", "1"] }
[[study]]
name = "grid"
sensor = { driver = "sim/magictac:reduction=16", units = ["0", "1"] }
"#;

/// Commands and files of the tables of docs/figures.md.
fn documented() -> Vec<(String, String)> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/figures.md");
    let text = fs::read_to_string(path).expect("the page is there");
    let rows = text
        .lines()
        .filter(|line| line.starts_with("| ") && line.contains("| `taceva "));
    rows.map(|line| {
        let words: Vec<&str> = line.split('`').collect();
        let [.., command, _, file, _] = words.as_slice() else {
            panic!("{line}");
        };
        ((*command).to_owned(), (*file).to_owned())
    })
    .collect()
}

#[test]
fn every_figure_and_table_of_the_study_is_made_by_its_command() {
    let bench = Bench::new();
    bench.write("two.toml", TWO);
    bench.ok("run two.toml --out study -q");
    let documented = documented();
    assert!(documented.len() >= 24, "{}", documented.len());
    let mut done: Vec<&str> = vec!["taceva run --out study"];
    for (command, file) in &documented {
        if !done.contains(&command.as_str()) {
            let words = command.strip_prefix("taceva ").expect("our command");
            bench.ok(&format!("{words} -q"));
            done.push(command);
        }
        let text =
            fs::read_to_string(bench.path(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(text.len() > 300, "{file}");
        if file.starts_with("study/") && !file.ends_with("scores.csv") {
            let says_so = text.contains("simulated");
            assert!(
                says_so || file.starts_with("study/figures/"),
                "{file} says that nothing was measured"
            );
        }
    }
    schema::check(
        "run",
        &json(&fs::read_to_string(bench.path("study/results.json")).expect("there")),
    );
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn predictions_of_the_same_samples_are_compared_one_by_one() {
    let bench = Bench::new();
    bench.record("data", 40);
    for (model, name) in [("ridge", "a"), ("pls", "b")] {
        let out = format!("--format json --out {name}.json --samples-out {name}.samples.csv");
        bench.ok(&format!("evaluate data --model {model} --split random --part all {out} --html {name}.html --figures {name} -q"));
        schema::check(
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
    schema::check("comparison", &comparison);
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

/// One sensor, pressed a few times; what differs between two of them is the model.
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
    let told = "two/results.json: no samples of dome, looked for two/reports/1-*.samples.csv: compared without pairs, by Welch's test";
    assert!(ran.err.contains(told), "{}", ran.err);
    assert!(!ran.out.contains("paired sign flip"), "{}", ran.out);
    bench.refused(
        "compare one two/figures",
        2,
        "two/figures: a folder without results.json; expected the folder of a run",
    );
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
        read.push(taceva_report::unescape_csv(&record[0]).to_owned());
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
    schema::check("bench-models", &json(&bench.json()));
    bench.rows[0].errors[0].ci95 = None;
    schema::check("bench-models", &json(&bench.json()));
}

#[test]
fn both_readmes_name_every_command() {
    let help = Bench::new().ok("--help");
    let (_, commands) = help.split_once("Commands:\n").expect("a list");
    let (commands, _) = commands.split_once("\n\n").expect("its end");
    let names = commands.lines().filter(|line| !line.starts_with("   "));
    let names: Vec<&str> = names
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(names.len() > 15, "{names:?}");
    for file in ["README.md", "../README.md"] {
        let path = format!("{}/{file}", env!("CARGO_MANIFEST_DIR"));
        let text = fs::read_to_string(path).expect("the page is there");
        for name in names.iter().filter(|name| **name != "help") {
            let is_named =
                text.contains(&format!("`taceva {name}")) || text.contains(&format!("`{name}`"));
            assert!(is_named, "{file}: {name}");
        }
    }
}

#[test]
fn tables_for_papers_compile() {
    let bench = Bench::new();
    bench.record("data", 40);
    for words in [
        "evaluate data --model ridge --split random --part all --format tex",
        "check data --format tex",
        "bench kernels --rows 600 --rounds 1 --format tex",
        "choose --need shear,fast --format tex",
        "catalogue show GelSight --format tex",
    ] {
        latex::assert_compiles(words, &bench.ok(&format!("{words} -q")));
    }
}

#[test]
fn published_numbers_are_compared_and_chosen_from() {
    let bench = Bench::new();
    let compared = bench.json("compare ViTacTip GelSight MagicTac");
    schema::check("comparison", &compared);
    let answers = compared["answers"].as_array().expect("a list");
    let of_fz = |answer: &&Value| {
        answer["metric"] == "mae" && answer["channel"] == "Fz" && answer["b"] == "GelSight"
    };
    let answer = answers.iter().find(of_fz).expect("one");
    assert_eq!(answer["scores"], serde_json::json!([0.0164, 0.0361]));
    assert_eq!(
        answer["answer"],
        "no answer: no interval: published without one"
    );
    bench.write(
        "needs.toml",
        "needs = [\"accurate shear\", \"ambient light\"]\n",
    );
    let choice = bench.json("choose --needs needs.toml");
    schema::check("choice", &choice);
    assert_eq!(choice["ranked"][0]["name"], "GelSight");
    bench.refused(
        "choose --need beauty",
        2,
        "`beauty`: unknown need, expected one of shear",
    );
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

/// A result of one channel.
fn scored(bench: &Bench) {
    bench.write(
        "t.csv",
        "id,point_id,Fz\n1,a,0.1\n2,b,0.2\n3,c,0.3\n4,d,0.4\n5,e,0.5\n6,f,0.6\n",
    );
    bench.write(
        "p.csv",
        "id,Fz\n1,0.11\n2,0.21\n3,0.32\n4,0.41\n5,0.52\n6,0.61\n",
    );
    bench.ok("score --truth t.csv --pred p.csv --metrics mae,r2 --format json --out r.json -q");
}

#[test]
fn limits_as_the_help_shows_them_are_taken_as_they_are_typed() {
    let bench = Bench::new();
    scored(&bench);
    let help = bench.ok("accept --help");
    let limits = help.split("Limits:\n").nth(1).expect("an example");
    let limits = limits.split("\n\n").next().expect("an end");
    assert!(limits.contains("[[limit]]"), "{limits}");
    bench.write("limits.toml", limits);
    bench.ok("accept r.json --limits limits.toml -q");
}

#[test]
fn limits_of_a_result_are_kept_by_it() {
    let bench = Bench::new();
    scored(&bench);
    let limits = bench.ok("accept --template r.json -q");
    assert!(
        limits.contains("# measured: ") && limits.contains("metric = \"mae\""),
        "{limits}"
    );
    bench.ok("accept --template r.json --out limits.toml -q");
    let accepted =
        bench.json("accept r.json --limits limits.toml --date 2024-02-29 --html sheet.html");
    schema::check("acceptance", &accepted);
    assert_eq!(
        (&accepted["passed"], &accepted["date"]),
        (&Value::Bool(true), &Value::String("2024-02-29".to_owned()))
    );
    let sheet = fs::read_to_string(bench.path("sheet.html")).expect("there");
    assert!(sheet.contains("<dt>date</dt><dd>2024-02-29</dd>"));
    bench.refused(
        "accept --template r.json --out limits.toml",
        3,
        "exists already",
    );
    bench.refused(
        "accept r.json --limits limits.toml --date 2026-02-30",
        2,
        "--date `2026-02-30`: expected a day such as 2026-11-22",
    );
    bench.refused("accept r.json", 2, "--limits");
}

#[test]
fn a_unit_that_breaks_a_limit_is_not_accepted() {
    let bench = Bench::new();
    bench.write(
        "t.csv",
        "id,point_id,Fz\n1,a,0.1\n2,b,0.2\n3,c,0.3\n4,d,0.4\n5,e,0.5\n6,f,0.6\n",
    );
    bench.write(
        "p.csv",
        "id,Fz\n1,0.11\n2,0.21\n3,0.32\n4,0.41\n5,0.52\n6,0.61\n",
    );
    bench.ok("score --truth t.csv --pred p.csv --metrics mae,r2 --format json --out r.json --html r.html -q");
    let limit = |most: f64| {
        format!(
            "limits_version = 1\n[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = {most}\n"
        )
    };
    bench.write("wide.toml", &limit(0.05));
    bench.write("narrow.toml", &limit(0.001));
    let accepted = bench.json("accept r.json --limits wide.toml --html sheet.html");
    schema::check("acceptance", &accepted);
    assert_eq!(accepted["passed"], true);
    assert!(
        fs::read_to_string(bench.path("sheet.html"))
            .expect("there")
            .contains("PASS: every limit is kept.")
    );
    assert_eq!(bench.run("accept r.json --limits narrow.toml").code, 1);
    bench.write("odd.toml", "limits_version = 1\n[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"stone\"\nmost = 1\n");
    bench.refused(
        "accept r.json --limits odd.toml",
        3,
        "limit 1: unit `stone`",
    );
    bench.write("old.json", "{\"schema\": \"taceva.evaluation/0\"}");
    bench.refused(
        "accept old.json --limits wide.toml",
        3,
        "schema `taceva.evaluation/0`: expected `taceva.evaluation/1`",
    );
    bench.refused(
        "accept r.json --limits wide.toml --html r.html",
        3,
        "exists already",
    );
}
