//! Limits and data sheets.

use std::fs;

use serde_json::Value;

use crate::support::Bench;

/// Writes the result `r.json`, which has scores of Fz alone.
pub(super) fn scored(bench: &Bench) {
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
        limits.contains("# result: ") && limits.contains("metric = \"mae\""),
        "{limits}"
    );
    assert!(
        limits.contains("limits_version = 2") && limits.contains("rule = \"guarded\""),
        "{limits}"
    );
    bench.ok("accept --template r.json --out limits.toml -q");
    let accepted =
        bench.json("accept r.json --limits limits.toml --date 2024-02-29 --html sheet.html");
    crate::schema::check("acceptance", &accepted);
    assert_eq!(
        (&accepted["passed"], &accepted["date"]),
        (&Value::Bool(true), &Value::String("2024-02-29".to_owned()))
    );
    assert_eq!(accepted["findings"][0]["rule"]["rule"], "guarded");
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
    crate::schema::check("acceptance", &accepted);
    assert_eq!(accepted["passed"], true);
    assert!(
        fs::read_to_string(bench.path("sheet.html"))
            .expect("there")
            .contains("PASS: every limit is met.")
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
        "schema `taceva.evaluation/0`, written by TacEva of an unknown version: expected `taceva.evaluation/1.0`; run `taceva evaluate …` again",
    );
    bench.refused(
        "accept r.json --limits wide.toml --html r.html",
        3,
        "exists already",
    );
}
