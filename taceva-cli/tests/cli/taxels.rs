//! A sensor of taxels from its table to its scores, by the program alone.

use std::fmt::Write as _;
use std::fs;

use crate::support::Bench;

const MAP: &str = r#"
map_version = 2
source = "synthetic"
table = { file = "skin.csv", header = false }
[columns]
Fz = { from = 0, unit = "N" }
[time]
clock = "unknown"
[signals]
from = "1..4"
unit = "mV"
places = [2, 2]
channels = ["pressure"]
rest = "0..9"
[sensor]
model = "drawn skin"
serial = "unknown"
gel = "unknown"
opaque = true
"#;

/// Table of presses on four taxels: a force, and voltages in mV that rise with the force and have a little noise. The first rows are untouched.
fn table() -> String {
    let mut state = 7_u32;
    let mut draw = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / 16_777_216.0
    };
    let mut text = String::new();
    for row in 0..200 {
        let drawn = 5.0 * draw();
        let force = if row < 10 { 0.0 } else { drawn };
        write!(text, "{force}").expect("text");
        for gain in [100.0, 60.0, 30.0, 10.0] {
            write!(text, ",{}", 500.0 + gain * force + 4.0 * draw()).expect("text");
        }
        text.push('\n');
    }
    text
}

#[test]
fn taxels_are_imported_checked_fitted_and_evaluated() {
    let bench = Bench::new();
    let lab = bench.path("lab");
    fs::create_dir(&lab).expect("made");
    fs::write(lab.join("skin.csv"), table()).expect("written");
    fs::write(lab.join("map.toml"), MAP).expect("written");
    let said = bench.ok("import lab --map lab/map.toml --out data");
    assert!(
        said.contains("signals  200 samples of 2×2 places of 1 in V"),
        "{said}"
    );
    let checked = bench.ok("check data");
    assert!(
        !checked.contains("TAC016") && !checked.contains("TAC018"),
        "{checked}"
    );
    let found = bench.json("evaluate data --model ridge --metrics r2");
    let model = &found["provenance"]["model"];
    assert_eq!(
        model["settings"]["features"], "signals of 2×2 places of 1",
        "{model}"
    );
    assert_eq!(found["provenance"]["frames_decoded"], 0);
    bench.ok("fit data --model auto --set difference=true --out skin.safetensors");
    bench.ok("evaluate data --with skin.safetensors --metrics r2");
    bench.ok("predict data --with skin.safetensors --out predicted.csv");
    bench.refused(
        "evaluate data --model cnn",
        3,
        "a network needs a grid of at least 8×8 places, found 2×2 places of 1 in V",
    );
    bench.refused(
        "evaluate data --model ridge --set size=8",
        3,
        "`size=8` applies to frames, but the recording has only signals",
    );
    bench.record("pictures", 64);
    bench.refused(
        "evaluate pictures --model ridge --set input=signals",
        3,
        "the recording has no signals; set `input=frame`",
    );
    bench.refused(
        "evaluate pictures --with skin.safetensors",
        3,
        "the model needs signals, which the dataset lacks",
    );
}

#[path = "../../examples/draw_taxels.rs"]
mod draw_taxels;

/// Checks the examples of taxel sensors against the program that draws them.
#[test]
fn the_drawn_examples_are_what_their_program_draws_and_are_evaluated() {
    // A separate program; only its tables are needed here.
    let _: fn() -> std::process::ExitCode = draw_taxels::main;
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/taxels");
    for (name, drawn, least) in [
        ("magnetic", draw_taxels::magnetic(), 0.9),
        ("capacitive", draw_taxels::capacitive(), 0.9),
    ] {
        let table = fs::read_to_string(format!("{examples}/{name}/presses.csv")).expect("there");
        assert_eq!(table, drawn, "{name}: draw it anew");
        let bench = Bench::new();
        bench.ok(&format!(
            "import {examples}/{name} --map {examples}/{name}/map.toml --out {name} -q"
        ));
        let report = bench.json(&format!("evaluate {name} --model ridge --metrics accuracy"));
        assert_eq!(report["subject"]["source"], "synthetic");
        let r2 = report["metrics"]["r2"]["Fz"]["value"].as_f64().expect("R²");
        assert!(r2 > least, "{name}: {r2}");
        let check = bench.run(&format!("check {name} -q"));
        assert_eq!(check.code, 0, "{name}: {}", check.out);
    }
}
