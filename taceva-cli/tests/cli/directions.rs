//! The direction of a metric is shown beside its name in every kind of table, and in a field of output for programs.

use std::fs;

use crate::support::Bench;
use serde_json::Value;
use taceva_metrics::Better;
use taceva_report::{BenchMachine, BenchRecording, ChannelError, Layout, ModelBench, ModelRow};

/// Scene of one sensor with gratings and light, and a few presses.
const SCENE: &str = r#"scene_version = 1
name = "small"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
lighting = { driver = "sim/lighting" }
model = { name = "ridge", set = { size = "16x16" } }
metrics = { want = ["mae", "rmse", "r2", "r_light", "sensitivity", "uniformity"] }
protocol = { calibration = { points = 80, indentations = 1 }, lighting = { points = 3 }, surface = { points = 8 } }
[[study]]
name = "dome"
sensor = { driver = "sim/vitactip:reduction=16" }
[[study]]
name = "grid"
sensor = { driver = "sim/magictac:reduction=16" }
"#;

/// Arrow that must follow the name of a metric; `None` for descriptive metrics and for other names.
fn sign(name: &str) -> Option<String> {
    let sign = Better::of(name)?.beside("");
    (!sign.is_empty()).then_some(sign)
}

/// Checks the sign in every line of `text` that begins with a metric. Returns the number of lines.
fn lines(text: &str, whence: &str) -> usize {
    let mut found = 0;
    for line in text.lines() {
        let Some(sign) = line.split_whitespace().next().and_then(sign) else {
            continue;
        };
        assert!(line.contains(&sign), "{whence}: {line}");
        found += 1;
    }
    found
}

/// Checks signs like [`lines`] in a Markdown table, whose names are escaped.
fn markdown(text: &str, whence: &str) -> usize {
    let plain = text.replace(['\\', '|'], " ");
    let plain: String = plain.replace(" _", "_");
    lines(&plain, whence)
}

/// Checks signs in a LaTeX table: each row with a name has a sign, unless the metric is descriptive. Returns the number of signs.
fn latex(text: &str, whence: &str) -> usize {
    // If metrics are columns, their heads have the signs.
    let heads = text.lines().take_while(|line| !line.contains("midrule"));
    let heads: String = heads.filter(|line| line.contains(" & ")).collect();
    let in_heads = heads.matches("arrow$").count();
    if in_heads > 0 {
        return in_heads;
    }
    let rows = text.lines().skip_while(|line| !line.contains("midrule"));
    // If a metric has its own line, the rows below it name channels.
    let headings = rows.clone().filter(|line| line.contains("\\multicolumn"));
    let headings: Vec<&str> = headings.collect();
    let names = rows.filter_map(|line| line.split_once(" & "));
    let names = names.map(|(name, _)| name.trim());
    let names: Vec<&str> = match headings.is_empty() {
        true => names.collect(),
        false => headings,
    };
    let names = names.into_iter();
    let mut found = 0;
    let describes = |name: &str| {
        let id = name.replace("\\_", "_");
        // The maximum load is a property of the sensor, and the symbol of the sensitivity is descriptive.
        let is_descriptive =
            id.starts_with("$S$") || sign(&id).is_none() && Better::of(&id).is_some();
        ["greatest", "size", "price", "availability", "gel_thickness"].contains(&id.as_str())
            || is_descriptive
    };
    for name in names.filter(|name| !name.is_empty() && !describes(name)) {
        let signs = ["$\\downarrow$", "$\\uparrow$", "$\\to$0"];
        assert!(
            signs.iter().any(|sign| name.contains(sign)),
            "{whence}: {name}"
        );
        found += 1;
    }
    found
}

/// Checks that an arrow follows every link to the meaning of a metric. Returns the number of links with an arrow.
fn links(text: &str, whence: &str) -> usize {
    let mut found = 0;
    for part in text.split("<a class=\"metric\"").skip(1) {
        let (link, rest) = part.split_once("</a>").expect("a link that ends");
        let (_, name) = link.split_once('>').expect("its name");
        let Some(sign) = sign(name) else { continue };
        let behind = rest.split('<').next().unwrap_or_default();
        assert!(
            behind.ends_with(&sign) || behind.contains(&format!("{sign})")),
            "{whence}: {name}{behind}"
        );
        found += 1;
    }
    found
}

/// Checks the column `better` of a CSV table against its column `metric`. Returns the number of rows with a direction.
fn csv(text: &str, whence: &str) -> usize {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let head = reader.headers().expect("a head").clone();
    let column = |name: &str| {
        let found = head.iter().position(|known| known == name);
        found.unwrap_or_else(|| panic!("{whence}: no column {name}"))
    };
    let [metric, better] = ["metric", "better"].map(column);
    let mut found = 0;
    for record in reader.records() {
        let record = record.expect("a row");
        let expected = Better::of(&record[metric]).map_or("", Better::name);
        assert_eq!(&record[better], expected, "{whence}: {}", &record[metric]);
        found += usize::from(!expected.is_empty());
    }
    found
}

/// Kind of table: its format, and the function that checks and counts its signs.
type Kind = (&'static str, fn(&str, &str) -> usize);
const KINDS: [Kind; 4] = [
    ("text", lines),
    ("md", markdown),
    ("tex", latex),
    ("csv", csv),
];

fn hold(bench: &Bench, words: &str, kinds: &[Kind]) {
    for (format, count) in kinds {
        let text = bench.ok(&format!("{words} --format {format} -q"));
        let found = count(&text, &format!("{words} --format {format}"));
        assert!(found > 0, "{words} --format {format}: no metric\n{text}");
    }
}

#[test]
fn no_table_names_a_metric_without_its_direction() {
    let bench = Bench::new();
    bench.record("data", 40);
    let evaluate = "evaluate data --model ridge --split random --part all";
    hold(&bench, &format!("{evaluate} --metrics all"), &KINDS);
    bench.ok(&format!(
        "{evaluate} --metrics all --format json --out r.json --html r.html --state-out r.state -q"
    ));
    let json: Value =
        serde_json::from_str(&fs::read_to_string(bench.path("r.json")).expect("there"))
            .expect("JSON");
    assert_eq!(json["metrics"]["mae"]["Fz"]["better"], "lower");
    hold(&bench, "merge r.state", &KINDS);
    bench.ok("accept --template r.json --out limits.toml -q");
    hold(
        &bench,
        "accept r.json --limits limits.toml --html sheet.html --force",
        &KINDS,
    );
    let accepted = bench.json("accept r.json --limits limits.toml");
    assert!(accepted["findings"][0]["better"].is_string());
    hold(&bench, "catalogue show GelSight", &KINDS);
    hold(
        &bench,
        "compare ViTacTip GelSight --html compare.html --force",
        &KINDS[1..],
    );
    assert!(
        lines(
            &bench.ok("compare ViTacTip GelSight --all -q"),
            "compare --all"
        ) > 5
    );
    for page in ["r.html", "sheet.html", "compare.html"] {
        let text = fs::read_to_string(bench.path(page)).expect("there");
        assert!(links(&text, page) > 5, "{page}");
    }
    bench.ok("catalogue site --out site -q");
    let page = fs::read_to_string(bench.path("site/gelsight.html")).expect("there");
    assert!(links(&page, "catalogue site") > 5);
    for format in ["text", "md"] {
        let list = bench.ok(&format!("catalogue list --format {format} -q"));
        assert_eq!(list.matches(") ↓").count(), 4, "{list}");
        let choice = bench.ok(&format!("choose --need shear,fast --format {format} -q"));
        assert!(
            choice.contains("MAE of Fxy ↓") && choice.contains("frame rate ↑"),
            "{choice}"
        );
    }
    let choice = bench.json("choose --need shear");
    assert_eq!(choice["ranked"][0]["steps"][0]["better"], "lower");
}

#[test]
fn what_a_run_writes_names_no_metric_without_its_direction() {
    let bench = Bench::new();
    bench.write("small.toml", SCENE);
    let summary = bench.ok("run small.toml --out run -q");
    assert!(lines(&summary, "run") > 5, "{summary}");
    let kinds: [Kind; 6] = [
        ("scores.csv", csv),
        ("scores.md", markdown),
        ("scores.tex", latex),
        ("scores-main.tex", latex),
        ("reports/1-dome.txt", lines),
        ("report.html", links),
    ];
    for (file, count) in kinds {
        let text = fs::read_to_string(bench.path(&format!("run/{file}"))).expect("there");
        let least = if file == "scores-main.tex" { 1 } else { 5 };
        assert!(count(&text, file) > least, "{file}");
    }
}

#[test]
fn benchmarks_say_that_less_is_better() {
    let mut bench = ModelBench::new(BenchMachine::default(), BenchRecording::default());
    let error = ChannelError {
        channel: "Fz".to_owned(),
        unit: taceva_core::Unit::Newton,
        mae: 0.25,
        ci95: Some([0.2, 0.3]),
        n: 40,
        beaten_by: Vec::new(),
    };
    bench.rows.push(ModelRow {
        errors: vec![error],
        ..ModelRow::default()
    });
    let table = bench.table();
    for form in [table.text(), table.markdown()] {
        assert!(
            form.contains("MAE Fz (N) ↓") && form.contains("fit (s) ↓"),
            "{form}"
        );
    }
    assert!(
        table
            .latex(Layout::Float)
            .contains("MAE Fz (N) $\\downarrow$")
    );
    assert!(table.csv().starts_with("model,fit (s),"), "{}", table.csv());
}
