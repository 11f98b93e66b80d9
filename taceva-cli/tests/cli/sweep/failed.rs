//! Tasks that fail, and units that meet no limit.

use std::fs;

use super::store::scored;
use super::{small, text, week};

#[test]
fn a_failed_task_is_a_row_with_its_reason_and_its_log_and_the_others_go_on() {
    let bench = scored();
    bench.record_nothing("nothing");
    small(&bench, &[("[\"monday\"]", "[\"monday\", \"nothing\"]")]);
    let ran = bench.run("sweep which.toml");
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    assert!(
        ran.out.contains("8 scored, 8 failed, 0 missing"),
        "{}",
        ran.out
    );
    assert!(
        ran.err.contains("failed: ridge size=12x12 of nothing") && ran.err.contains(".log"),
        "{}",
        ran.err
    );
    let table = text(&bench, "which.sweep/table.csv");
    let failed: Vec<&str> = table
        .lines()
        .filter(|line| line.contains(",failed,"))
        .collect();
    assert_eq!(failed.len(), 8);
    assert!(
        failed[0].contains("the dataset has 0 rows"),
        "{}",
        failed[0]
    );
    let key = failed[0].split(',').next().expect("a key");
    let log = text(&bench, &format!("which.sweep/logs/{key}.log"));
    assert!(log.contains("failed: ") && log.contains("0 rows"), "{log}");
    assert!(text(&bench, "which.sweep/page.html").contains("Tasks without a result"));
    // Failed tasks are retried only on request.
    let attempts = || {
        text(&bench, &format!("which.sweep/logs/{key}.log"))
            .matches("failed: ")
            .count()
    };
    assert_eq!(bench.run("sweep which.toml -q").code, 1);
    assert_eq!(attempts(), 1);
    assert_eq!(bench.run("sweep which.toml -q --retry-failed").code, 1);
    assert_eq!(attempts(), 2);
}

#[test]
fn the_reason_of_a_failed_task_is_that_of_its_last_attempt_and_names_no_folder() {
    let bench = week();
    bench.record_nothing("nothing");
    small(
        &bench,
        &[
            ("[\"monday\"]", "[\"nothing\"]"),
            ("\"8x8\", \"12x12\"", "\"8x8\""),
        ],
    );
    assert_eq!(bench.run("sweep which.toml -q").code, 1);
    let table = text(&bench, "which.sweep/table.csv");
    assert!(table.contains("the dataset has 0 rows"), "{table}");
    let folder = bench.path("").to_string_lossy().into_owned();
    assert!(!table.contains(&folder), "{folder}: {table}");
    let key = table
        .lines()
        .nth(1)
        .and_then(|row| row.split(',').next())
        .expect("a key");
    let failure = format!("which.sweep/failed/{key}.json");
    bench.write(
        &failure,
        &format!("{{\"key\":\"{key}\",\"reason\":\"an old reason\"}}"),
    );
    bench.run("sweep collect which.toml");
    assert!(text(&bench, "which.sweep/table.csv").contains("an old reason"));
    assert_eq!(bench.run("sweep which.toml -q --retry-failed").code, 1);
    assert_eq!(text(&bench, "which.sweep/table.csv"), table);
}

#[test]
fn units_are_held_to_limits_one_by_one() {
    let bench = week();
    fs::create_dir(bench.path("units")).expect("made");
    for name in ["monday", "tuesday"] {
        fs::rename(bench.path(name), bench.path("units").join(name)).expect("moved");
    }
    bench.write("limits.toml", "limits_version = 1\nname = \"line 3\"\n[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 100.0\n");
    let units = "sweep_version = 1\ndatasets = \"units/*\"\nmodels = [\"ridge\"]\nlimits = \"limits.toml\"\nmetrics = [\"accuracy\"]\nsplits = [\"by-point 40/10/50\"]\n[vary]\nsize = [\"8x8\"]\n";
    bench.write("units.toml", units);
    let out = bench.ok("sweep units.toml -q");
    assert_eq!(out.matches("pass").count(), 2, "{out}");
    let strict = text(&bench, "limits.toml").replace("100.0", "0.0");
    bench.write("limits.toml", &strict);
    let ran = bench.run("sweep units.toml -q");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert_eq!(ran.out.matches("FAIL").count(), 2, "{}", ran.out);
    assert!(text(&bench, "units.sweep/units.csv").contains("units/tuesday"));
}
