//! Presses that a limit ends are counted in every report.

use std::fs;

use super::SMALL;
use crate::support::Bench;

#[test]
fn presses_that_a_limit_ends_are_counted_by_their_limit_in_every_report_of_them() {
    let bench = Bench::new();
    bench.write("s.toml", &format!("{SMALL}limits = {{ Fz_max_N = 0.3 }}\n"));
    let (limited, _) = limited_presses(&bench);
    assert!(limited > 5, "{limited}");
}

#[test]
fn a_press_that_a_limit_ends_before_its_first_sample_is_counted_too() {
    let bench = Bench::new();
    let scene = SMALL
        .replace("vitactip", "gelsight")
        .replace("lighting = { driver = \"sim/lighting\" }\n", "")
        .replace("lighting = { points = 2 }, ", "")
        .replace(
            "protocol = { ",
            "protocol = { contact = { step_mm = 0.5 }, ",
        );
    let metrics = "metrics = { want = [\"sensitivity\", \"inter_sensor\"] }\n";
    bench.write(
        "s.toml",
        &format!("{scene}limits = {{ Fz_max_N = 0.2 }}\n{metrics}"),
    );
    let (limited, presses) = limited_presses(&bench);
    let exported = fs::read_to_string(bench.path("r/recordings/1-small/dataset.toml"));
    let rows = exported.expect("reads");
    let rows = rows.lines().find_map(|line| line.strip_prefix("rows = "));
    let rows: u64 = rows.expect("counted").parse().expect("a number");
    assert!(
        limited > 5 && rows < presses,
        "{limited}, {rows} rows, {presses}"
    );
}

/// Number of presses that the limit of normal force ended, and number of all presses. Runs `s.toml`, and checks that every report states them.
fn limited_presses(bench: &Bench) -> (u64, u64) {
    let run = bench.json("run s.toml --out r");
    let provenance = &run["studies"][0]["provenance"];
    let dataset = provenance["dataset"].as_str().expect("a digest");
    let presses = &provenance["presses"][dataset];
    let counts = presses.as_object().expect("counts").values();
    let all = counts.map(|count| count.as_u64().expect("a count")).sum();
    let limited = presses["normal-force-limit"].as_u64().expect("a count");
    let said = format!("{limited} ended by the limit of normal force");
    let text = fs::read_to_string(bench.path("r/reports/1-small.txt"));
    assert!(text.expect("reads").contains(&said), "{said}");
    let evaluated = bench.ok("evaluate r/recordings/1-small --model baseline --channels Fz");
    assert!(evaluated.contains(&said), "{evaluated}");
    (limited, all)
}
