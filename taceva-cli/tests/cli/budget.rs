//! Uncertainty budgets, from a file of sources and from a result.

mod depth_zero;
mod refusals;

use serde_json::Value;

use crate::support::Bench;

/// Every format, each with its own escapes.
const FORMATS: [&str; 5] = ["text", "json", "csv", "md", "tex"];

/// Budget file of the worked example GUM H.1, the calibration of an end gauge.
const END_GAUGE: &str = r#"budget_version = 1
measurand = "l"
unit = "nm"
coverage = 0.99
expression = "l_s + d0 + d1 + d2 - l_s * (delta_alpha * (theta_bar + Delta) + alpha_s * delta_theta)"
source = [
  { name = "l_s", value = 50000623.0, u = 25, dof = 18 },
  { name = "d0", value = 215, u = 5.8, dof = 24 },
  { name = "d1", u = 3.9, dof = 5 },
  { name = "d2", u = 6.7, dof = 8 },
  { name = "alpha_s", value = 11.5e-6, half_width = 2e-6 },
  { name = "delta_alpha", half_width = 1e-6, reliability = "10 %" },
  { name = "delta_theta", half_width = 0.05, dof = 2 },
  { name = "theta_bar", value = -0.1, u = 0.2 },
  { name = "Delta", half_width = 0.5, shape = "arcsine" },
]
"#;

/// Budget file for Fz at 0.5 N with the text `sources`.
fn of_force(sources: &str) -> String {
    format!("budget_version = 1\nmeasurand = \"Fz\"\nat = [\"0.5 N\"]\n{sources}")
}

/// Test folder with the result `r.json` of a synthetic recording, and its samples.
fn evaluated() -> Bench {
    let bench = Bench::new();
    bench.record("data", 32);
    bench.ok(
        "evaluate data --model ridge --set size=8x8 --format json --out r.json --samples-out r.samples.csv -q",
    );
    bench
}

fn number(of: &Value) -> f64 {
    of.as_f64().unwrap_or_else(|| panic!("no number: {of}"))
}

fn near(found: f64, expected: f64, relative: f64) {
    let off = (found - expected).abs() / expected.abs();
    assert!(off <= relative, "{found} is not {expected}");
}

/// Source of a budget by its name.
fn source<'b>(budget: &'b Value, name: &str) -> &'b Value {
    let mut sources = budget["sources"].as_array().expect("a list").iter();
    let found = sources.find(|of| of["name"] == name);
    found.unwrap_or_else(|| panic!("no {name} in {budget:#}"))
}

#[test]
fn the_end_gauge_has_the_uncertainty_of_the_gum_and_its_json_is_sealed() {
    let bench = Bench::new();
    bench.write("gauge.toml", END_GAUGE);
    let text = bench.ok("budget gauge.toml --format json --mc 0");
    taceva_files::seal::json::check(&text).expect("sealed");
    let budget: Value = serde_json::from_str(&text).expect("JSON");
    crate::schema::check("budget", &budget);
    near(number(&budget["u"]), 31.663_879_111_008_633, 1e-12);
    near(number(&budget["nu_eff"]), 16.751_855_737_627_245, 1e-12);
    let text = bench.ok("budget gauge.toml --mc 0");
    let statement = "l = 50000838 nm, U = 92 nm (k = 2.921, p = 99 %, nu_eff 16.7)";
    assert!(text.contains(statement), "{text}");
    let row = "source,delta_theta,B,rectangular,0.0,";
    let csv = bench.ok("budget gauge.toml --mc 0 --format csv");
    assert!(csv.contains(row), "no `{row}` in\n{csv}");
}

#[test]
fn draws_that_contradict_the_first_order_give_the_interval_and_every_format_says_why() {
    let bench = Bench::new();
    let wide = |name: &str, half_width: &str| {
        format!("[[source]]\nname = \"{name}\"\nhalf_width = \"{half_width} N\"\n")
    };
    let narrow: String = ["a", "b", "c"].map(|name| wide(name, "1.7")).concat();
    bench.write(
        "budget.toml",
        &of_force(&format!("{narrow}{}", wide("d", "17"))),
    );
    let words = "budget budget.toml --mc 100000 --seed 3";
    for format in FORMATS {
        let written = bench.ok(&format!("{words} --format {format}"));
        let reason = "the interval is taken from the Monte Carlo draws: the distribution of the value is neither normal";
        assert!(written.contains(reason), "{format}: {written}");
    }
    let budget = bench.json(words);
    crate::schema::check("budget", &budget);
    assert_eq!(budget["method"], "monte_carlo");
    assert_eq!(budget["interval"], budget["mcm"]["symmetric"]);
    assert_eq!(budget["mcm"]["seed"], 3);
    // U of first order is 19.5 N, the half-width of the draws 16.7 N.
    let text = bench.ok(&format!("{words} --most-U 18N --html page.html"));
    let compared = "U is at most 18.00 N for the sources named here; not traceable. Compared: 16.";
    let stated = "U = 17 N (half-width of the Monte Carlo interval, p = 95 %)";
    let page = std::fs::read_to_string(bench.path("page.html")).expect("there");
    for written in [&text, &page] {
        assert!(
            written.contains(compared) && written.contains(stated),
            "{written}"
        );
        assert!(!written.contains("(k = "), "{written}");
    }
    let csv = bench.ok(&format!("{words} --format csv"));
    let row = |name: &str| {
        let head = format!("0.5,result,{name},,,");
        let mut rows = csv.lines().filter_map(|line| line.strip_prefix(&head));
        let cells = rows.next().expect(name);
        cells.split(',').next().map(str::to_owned)
    };
    let half: f64 = row("U").expect("a cell").parse().expect("a number");
    near(half, 16.7, 0.01);
    assert_eq!(row("k").as_deref(), Some(""));
    let confirmed = of_force("[[source]]\nname = \"a\"\nu = \"10 mN\"\n");
    bench.write("budget.toml", &confirmed);
    let text = bench.ok(words);
    assert!(
        text.contains("it confirms the first-order interval"),
        "{text}"
    );
}

#[test]
fn a_template_names_what_a_result_lacks_and_is_read_back_without_a_change() {
    let bench = evaluated();
    let template = bench.ok("budget --template r.json");
    for figure in ["bias", "error.between", "error.within"] {
        let line = format!("\nfrom = \"{figure}\"\n");
        assert!(template.contains(&line), "no {figure} in\n{template}");
    }
    for comment in [
        "# Nothing here was measured: the samples are synthetic.",
        "# not in this recording: unloading (hysteresis)",
        "# not in this recording: other units (gauge)",
        "# no certificate: ",
    ] {
        assert!(template.contains(comment), "no `{comment}` in\n{template}");
    }
    bench.write("budget.toml", &template);
    let budget = bench.json("budget budget.toml --results r.json --mc 0");
    assert_eq!(budget["sources"].as_array().expect("a list").len(), 3);
    bench.ok("budget --template r.json --channel Px --out px.toml");
    let budget = bench.json("budget px.toml --results r.json --mc 0");
    assert_eq!(budget["unit"], "mm");
    bench.refused(
        "budget --template r.json --channel Fy",
        2,
        "--channel Fy: the result has no score of this channel, expected one of Fz, Px",
    );
}

#[test]
fn a_budget_of_a_result_holds_the_components_of_its_residuals_by_contact_point() {
    let bench = evaluated();
    bench.write(
        "budget.toml",
        &of_force("[[source]]\nname = \"one\"\nfrom = \"error.within\"\n"),
    );
    let budget = bench.json("budget budget.toml --results r.json --mc 0");
    crate::schema::check("budget", &budget);
    let table = std::fs::read_to_string(bench.path("r.samples.csv")).expect("there");
    let mut lines = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().expect("a head");
    let column = |name: &str| head.iter().position(|of| *of == name).expect(name);
    let columns = ["point_id", "Fz", "Fz_predicted"].map(column);
    let mut points: std::collections::BTreeMap<String, Vec<f64>> = Default::default();
    for cells in lines {
        let [point, truth, prediction] = columns.map(|column| cells[column]);
        let number = |cell: &str| cell.parse::<f64>().expect("a number");
        let residuals = points.entry(point.to_owned()).or_default();
        residuals.push(number(truth) - number(prediction));
    }
    let (mut squares, mut freedom) = (0.0, 0.0);
    for residuals in points.values() {
        let n = residuals.len() as f64;
        let mean = residuals.iter().sum::<f64>() / n;
        squares += residuals.iter().map(|of| (of - mean).powi(2)).sum::<f64>();
        freedom += n - 1.0;
    }
    let within = source(&budget, "one");
    near(number(&within["u"]), (squares / freedom).sqrt(), 1e-9);
    near(number(&within["nu"]), freedom, 1e-12);
    assert_eq!(within["clusters"], points.len());
    let digest = taceva_files::seal::digest_of_bytes(table.as_bytes());
    assert_eq!(within["digest"], digest);
    for format in FORMATS {
        let written = bench.ok(&format!(
            "budget budget.toml --results r.json --mc 0 --format {format}"
        ));
        for words in ["synthetic", "hysteresis", "not traceable"] {
            assert!(written.contains(words), "{format}: {written}");
        }
    }
    bench.ok("budget budget.toml --results r.json --mc 0 --html page.html");
    let page = std::fs::read_to_string(bench.path("page.html")).expect("there");
    for words in [
        "Nothing here was measured",
        "figure-contributions-1",
        "Missing: hysteresis",
    ] {
        assert!(page.contains(words), "no `{words}`");
    }
}

/// Test folder with a result `r.json` that has repeatability and drift, and its samples under two lights.
fn scored() -> Bench {
    let bench = Bench::new();
    let result = r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "drawn", "source": "recorded"}, "metrics": {
        "repeatability": {"Fz": {"value": 0.02, "unit": "N", "n": 40, "definition": "repeatability/1",
            "counts": {"cells_valid": 10, "cells_total": 10}, "pooled": {"value": 0.03, "unit": "N"}}},
        "drift": {"Fz": {"value": -0.002, "unit": "N/h", "n": 40, "definition": "drift/1"}}}}"#;
    let sealed = taceva_files::seal::json::seal(result).expect("JSON");
    bench.write("r.json", &sealed);
    let mut table = String::from("sample,protocol,point_id,scene,Fz,Fz_predicted\n");
    let residuals = [
        ("dim", 0.01),
        ("dim", 0.03),
        ("bright", 0.05),
        ("bright", 0.07),
    ];
    for (at, (scene, residual)) in residuals.into_iter().enumerate() {
        let predicted = 0.5 - residual;
        table.push_str(&format!("s{at},light-sweep,a,{scene},0.5,{predicted:?}\n"));
    }
    bench.write("r.samples.csv", &table);
    bench
}

#[test]
fn repeats_drift_and_lights_of_a_result_are_sources() {
    let bench = scored();
    bench.write(
        "budget.toml",
        &of_force(
            "[[source]]\nname = \"repeats\"\nfrom = \"repeatability\"\nreadings = 4\n\
             [[source]]\nname = \"time\"\nfrom = \"drift\"\nhours = 8\n\
             [[source]]\nname = \"light\"\nfrom = \"r_light\"\n",
        ),
    );
    let budget = bench.json("budget budget.toml --results r.json --mc 0");
    let repeats = source(&budget, "repeats");
    near(number(&repeats["u"]), 0.015, 1e-12);
    near(number(&repeats["nu"]), 30.0, 1e-12);
    let time = source(&budget, "time");
    near(number(&time["u"]), 0.016 / 3_f64.sqrt(), 1e-12);
    assert_eq!(time["type"], "B");
    assert_eq!(time["shape"], "rectangular");
    // Mean squares 0.0016 and 0.0002, two samples under each light.
    let light = source(&budget, "light");
    near(number(&light["u"]), 0.0007_f64.sqrt(), 1e-9);
    let missing = budget["missing"].as_array().expect("a list").iter();
    let missing: Vec<&str> = missing.filter_map(|of| of["source"].as_str()).collect();
    assert_eq!(missing, ["hysteresis", "gauge", "certificate"]);
    // Repeats are live in a template without residuals; nobody measured the hours.
    let template = bench.ok("budget --template r.json");
    let open = "# [[source]]\n# name = \"drift since calibration\"\n# from = \"drift\"\n\
        # hours = ?   # hours since the calibration of the zero\n";
    assert!(template.contains(open), "{template}");
    bench.write("drafted.toml", &template);
    bench.ok("budget drafted.toml --results r.json --mc 0");
    let stated = open
        .replace("# [", "[")
        .replace("\n# ", "\n")
        .replace('?', "8");
    bench.write("drafted.toml", &template.replace(open, &stated));
    let drafted = bench.json("budget drafted.toml --results r.json --mc 0");
    near(
        number(&source(&drafted, "drift since calibration")["u"]),
        number(&time["u"]),
        1e-12,
    );
    assert!(
        template.contains("\nfrom = \"repeatability\"\n"),
        "{template}"
    );
    assert!(
        template.contains("# error.within: 0 rows of 0 points"),
        "{template}"
    );
    bench.write("cert.toml", refusals::CERTIFICATE);
    let template = bench.ok("budget --template r.json --certificate cert.toml");
    assert!(
        template.contains("\nfrom = \"certificate\"\n") && !template.contains("# certificate: "),
        "{template}"
    );
}

#[test]
fn an_uncertainty_above_the_greatest_allowed_one_ends_with_exit_code_1() {
    let bench = Bench::new();
    let lamp = of_force("[[source]]\nname = \"lamp\"\nu = \"10 mN\"\n");
    bench.write("budget.toml", &lamp);
    let text = bench.ok("budget budget.toml --mc 0 --most-U 20mN");
    assert!(text.contains("U is at most 0.02"), "{text}");
    let ran = bench.run("budget budget.toml --mc 0 --most-U 19mN");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(
        ran.out.contains("U is not shown to be at most 0.019"),
        "{}",
        ran.out
    );
    bench.refused(
        "budget budget.toml --most-U 1mm",
        2,
        "--most-U 1mm: Fz is in N, expected an amount in this unit",
    );
    bench.write(
        "budget.toml",
        &lamp.replace("[\"0.5 N\"]", "[\"0.5 N\", \"1 N\"]"),
    );
    let text = bench.ok("budget budget.toml --mc 0");
    assert!(
        text.contains("Fz = 0.500 N") && text.contains("Fz = 1.000 N"),
        "{text}"
    );
    bench.refused(
        "budget budget.toml --mc 0 --format json",
        2,
        "--format json writes one budget: add --at with one value, such as 0.5N",
    );
    let budget = bench.json("budget budget.toml --mc 0 --at 1000mN");
    near(number(&budget["at"]), 1.0, 1e-15);
}

#[test]
fn units_of_a_gauge_study_are_a_source_with_their_own_degrees_of_freedom() {
    let bench = crate::gauge::tables::simulated_units();
    bench.ok("gauge units.csv --channels Fz --format json --out gauge.json");
    let study: Value =
        serde_json::from_str(&std::fs::read_to_string(bench.path("gauge.json")).expect("there"))
            .expect("JSON");
    let mut components = study["components"].as_array().expect("a list").iter();
    let operator = components.find(|of| of["name"] == "operator");
    let unit = "[[source]]\nname = \"units\"\nfrom = \"gauge.json#unit\"\n";
    bench.write("budget.toml", &of_force(unit));
    let budget = bench.json("budget budget.toml --mc 0");
    let units = source(&budget, "units");
    let expected = number(&operator.expect("there")["sd"]);
    near(number(&units["u"]), expected, 1e-12);
    // Two units have at most one degree of freedom, less what their interaction takes.
    let freedom = number(&units["nu"]);
    assert!(freedom > 0.0 && freedom <= 1.0, "{freedom}");
    let missing = budget["missing"].as_array().expect("a list");
    assert!(
        missing.iter().all(|of| of["source"] != "gauge"),
        "{missing:?}"
    );
    for format in FORMATS {
        let written = bench.ok(&format!("budget budget.toml --mc 0 --format {format}"));
        assert!(written.contains("simulated"), "{format}: {written}");
    }
    bench.write(
        "budget.toml",
        &of_force(&unit.replace("#unit", "#reproducibilty")),
    );
    bench.refused(
        "budget budget.toml",
        3,
        "budget.toml: line 6, `from`: `gauge.json#reproducibilty` is not measured here: `reproducibilty` is not a component; did you mean `reproducibility`?",
    );
}
