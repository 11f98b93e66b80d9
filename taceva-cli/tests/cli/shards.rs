//! States of shards are merged to the scores of one run; tables with more columns give more scores.

use crate::support::Bench;
use serde_json::Value;

/// Table of truth and table of predictions of presses on a grid, with a header.
fn tables(rows: std::ops::Range<u32>) -> [String; 2] {
    let mut truth = "id,point_id,Px,Py,Pz,Fz\n".to_owned();
    let mut prediction = "id,Px,Py,Pz,Fz\n".to_owned();
    for row in rows {
        let (x, y) = (f64::from(row % 10) - 4.5, f64::from(row / 10 % 10) - 4.5);
        let depth = 0.2 + 0.1 * f64::from(row % 4);
        let force = depth * (1.0 + 0.02 * x);
        truth += &format!("{row},p{},{x},{y},{depth},{force}\n", row % 100);
        let error = 0.01 * f64::from(row * 7919 % 13) - 0.06;
        prediction += &format!(
            "{row},{},{},{},{}\n",
            x + error,
            y - error,
            depth + error / 9.0,
            force - error / 7.0
        );
    }
    [truth, prediction]
}

const SENSOR: &str = "model = \"drawn\"\nopaque = true\n\n[footprint]\nshape = \"rect\"\nhalf_x_mm = 5.0\nhalf_y_mm = 5.0\ndepth_max_mm = 1.0\n";

fn bench() -> Bench {
    let bench = Bench::new();
    bench.write("sensor.toml", SENSOR);
    for (name, rows) in [("all", 0..400), ("a", 0..131), ("b", 131..400)] {
        let [truth, prediction] = tables(rows);
        bench.write(&format!("truth_{name}.csv"), &truth);
        bench.write(&format!("pred_{name}.csv"), &prediction);
    }
    bench
}

fn score(name: &str, more: &str) -> String {
    format!("score --truth truth_{name}.csv --pred pred_{name}.csv --sensor sensor.toml {more}")
}

#[test]
fn states_of_two_shards_join_to_the_scores_of_all() {
    let bench = bench();
    bench.ok(&score("a", "--state-out a.state -q"));
    bench.ok(&score("b", "--state-out b.state -q"));
    let all = bench.json(&score("all", "--state-out all.state"));
    for order in ["a.state b.state", "b.state a.state"] {
        let joined = bench.json(&format!("merge {order} --state-out joined.state --force"));
        assert_eq!(joined["metrics"], all["metrics"]);
        assert_eq!(joined["skipped"], all["skipped"]);
        let states = |name: &str| {
            let text = std::fs::read_to_string(bench.path(name)).expect("written");
            let file: Value = serde_json::from_str(&text).expect("JSON");
            file["states"].clone()
        };
        assert_eq!(states("joined.state"), states("all.state"));
    }
}

#[test]
fn states_that_do_not_belong_together_are_refused_by_name() {
    let bench = bench();
    bench.ok(&score("a", "--state-out a.state -q"));
    bench.ok(&score("b", "--metrics mae --state-out b.state -q"));
    bench.refused("merge a.state b.state", 3, "b.state: another plan");
    bench.write("torn.state", "{\"schema\": \"taceva.state/1\", \"sub");
    bench.refused(
        "merge a.state torn.state",
        3,
        "torn.state: not a state file of an evaluation",
    );
    bench.write("new.state", "{\"schema\": \"taceva.state/9\"}");
    bench.refused(
        "merge new.state",
        3,
        "its schema is `taceva.state/9`, expected `taceva.state/1.0`",
    );
    bench.refused("merge nowhere.state", 3, "nowhere.state: ");
    let text = std::fs::read_to_string(bench.path("a.state")).expect("written");
    bench.write("bad.state", &text.replacen("\"n_min\":1", "\"n_min\":0", 1));
    bench.ok("reseal bad.state --reason mistyped");
    bench.refused("merge bad.state", 3, "setting `n_min`");
}

#[test]
fn a_state_that_was_changed_is_refused_by_its_key_and_one_of_another_schema_by_both() {
    let bench = bench();
    bench.ok(&score("a", "--state-out a.state -q"));
    let text = std::fs::read_to_string(bench.path("a.state")).expect("written");
    bench.write("bad.state", &text.replacen("\"seed\":", "\"seed\":1", 1));
    bench.refused(
        "merge bad.state",
        3,
        "`plan.seed` was changed after it was sealed",
    );
    let (body, _) = text.split_once(",\"seal\":").expect("a seal");
    bench.write("bare.state", &format!("{body}}}"));
    bench.refused("merge bare.state", 3, "the seal is missing");
    bench.write(
        "older.state",
        &text.replacen("taceva.state/1.0", "taceva.state/1.2", 1),
    );
    bench.refused(
        "merge older.state",
        3,
        "its schema is `taceva.state/1.2`, expected `taceva.state/1.0`",
    );
}

#[test]
fn rows_that_were_taken_already_are_refused_by_name() {
    let bench = bench();
    bench.ok(&score("a", "--state-out a.state -q"));
    bench.ok(&score("b", "--state-out b.state -q"));
    bench.refused(
        "merge a.state a.state",
        3,
        "a.state: the same state as a.state",
    );
    bench.ok("merge a.state b.state --state-out ab.state -q");
    bench.refused("merge ab.state b.state", 3, "269 rows of sha256:");
    bench.refused("merge ab.state b.state", 3, "are already in ab.state");
    bench.ok(&score("a", "--state-out again.state -q"));
    bench.refused("merge a.state again.state", 3, "again.state: ");
}

#[test]
fn facts_about_the_sensor_bring_scores_that_are_skipped_without_them() {
    let bench = bench();
    let with = bench.json(&score("all", ""));
    let uniformity = &with["metrics"]["uniformity"];
    assert!(
        uniformity
            .as_object()
            .is_some_and(|scores| !scores.is_empty()),
        "{with}"
    );
    let without = bench.json("score --truth truth_all.csv --pred pred_all.csv");
    assert!(without["metrics"].get("uniformity").is_none());
    let skipped = without["skipped"].to_string();
    assert!(
        skipped.contains("the sensor's `footprint` is not declared"),
        "{skipped}"
    );
    bench.write("bad.toml", "[footprint]\nshape = \"disc\"\nradius = 3\n");
    bench.refused(
        "score --truth truth_all.csv --pred pred_all.csv --sensor bad.toml",
        3,
        "did you mean `radius_mm`?",
    );
}

#[test]
fn cells_beside_the_channels_are_refused_by_place() {
    let bench = Bench::new();
    bench.write("pred.csv", "Pz,Fz\n0.1,1\n0.2,2\n");
    let names = [
        "Pz",
        "Fz",
        "point_id",
        "phase",
        "repeat",
        "depth_step",
        "t_s",
    ];
    let good = ["0.1", "1", "p", "load", "1", "1", "0.5"];
    for (column, cell, expected) in [
        ("phase", "up", "expected `load` or `unload`"),
        ("repeat", "-1", "expected a whole number from 0"),
        ("depth_step", "2.5", "expected a whole number from 0"),
        ("t_s", "noon", "is not a finite number"),
    ] {
        let bad: Vec<&str> = names
            .iter()
            .zip(good)
            .map(|(name, value)| if *name == column { cell } else { value })
            .collect();
        let table = [names.join(","), good.join(","), bad.join(",")].join("\n");
        bench.write("truth.csv", &format!("{table}\n"));
        let ran = bench.run("score --truth truth.csv --pred pred.csv -q");
        assert_eq!(ran.code, 3, "{column}: {}{}", ran.out, ran.err);
        let place = format!("truth.csv, line 3, column `{column}`");
        let said = ran.err.contains(expected) && ran.err.contains(&place);
        assert!(said, "{}", ran.err);
    }
}

#[test]
fn the_race_of_kernels_says_who_is_right_in_any_order() {
    let bench = Bench::new();
    let race = bench.json("bench kernels --rows 3000 --rounds 1 --svg race.svg");
    assert_eq!(race["schema"], "taceva.bench/1");
    assert!(
        race["floor"]["ns_per_pair"]["best"]
            .as_f64()
            .is_some_and(|time| time > 0.0)
    );
    let rows = race["rows"].as_array().expect("rows");
    let exact: Vec<&Value> = rows.iter().filter(|row| row["isa"].is_string()).collect();
    assert!(!exact.is_empty());
    for row in &exact {
        assert_eq!(row["order_free"], true, "{row}");
        assert!(
            row["digits_min"]
                .as_f64()
                .is_some_and(|digits| digits > 17.0),
            "{row}"
        );
    }
    let naive = rows
        .iter()
        .find(|row| row["name"] == "naive f64")
        .expect("there");
    assert_eq!(naive["order_free"], false);
    assert!(
        naive["digits_min"]
            .as_f64()
            .is_some_and(|digits| digits < 3.0),
        "{naive}"
    );
    assert!(rows.iter().any(|row| row["pareto"] == true));
    let drawing = std::fs::read_to_string(bench.path("race.svg")).expect("written");
    assert!(drawing.starts_with("<svg ") && drawing.contains("naive f64"));
    bench.refused("bench kernels --rows 0", 2, "at least one row");
}

#[test]
#[expect(clippy::print_stdout, reason = "says what was not compared")]
fn an_instruction_set_that_is_not_there_is_refused_and_any_other_gives_the_same_bytes() {
    let bench = bench();
    let run = |isa: &str| {
        let mut command = bench.command(&score("all", "--format json -q"));
        command
            .env("TACEVA_ISA", isa)
            .output()
            .expect("the program starts")
    };
    let portable = run("portable");
    assert!(portable.status.success());
    for isa in ["avx2", "avx512"] {
        let other = run(isa);
        match other.status.code() {
            Some(0) => assert_eq!(other.stdout, portable.stdout, "{isa}"),
            code => {
                assert_eq!(code, Some(2), "{isa}");
                println!("not compared: this machine has no {isa}");
            }
        }
    }
    let unknown = run("mmx");
    let message = String::from_utf8_lossy(&unknown.stderr).into_owned();
    assert_eq!(unknown.status.code(), Some(2), "{message}");
    assert!(message.contains("TACEVA_ISA"), "{message}");
}
