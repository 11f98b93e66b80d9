//! `taceva show`: the content of a dataset, and the instruments that measured it.

use crate::support::Bench;

#[test]
fn one_command_says_what_a_dataset_holds_and_that_no_instrument_is_stated() {
    let bench = Bench::imported();
    let shown = bench.ok("show data");
    for begin in [
        "sensor    ",
        "holds     ",
        "labels    ",
        "origin    measured",
        "measured  by instruments that the dataset does not state",
        "digest    sha256:",
    ] {
        let is_there = shown.lines().any(|line| line.starts_with(begin));
        assert!(is_there, "no `{begin}` in\n{shown}");
    }
    bench.refused("show nowhere", 3, "nowhere");
}

#[test]
fn an_instrument_that_a_dataset_does_not_state_is_shown_without_a_certificate() {
    let bench = Bench::new();
    bench.lab();
    let map = std::fs::read_to_string(bench.path("map.toml")).expect("a map");
    let certificate = "[force.certificate]\nnumber = \"D-K-1\"\nlaboratory = \"a laboratory\"\nissued = 2026-05-12\nserial = \"42\"\nk = 2.0\nU = { Fz = \"3.0 mN\" }\n";
    bench.write("certified.toml", &format!("{map}\n{certificate}"));
    bench.ok("import lab --map certified.toml --out data -q");
    let shown = bench.ok("show data");
    for line in [
        "measured  force: certificate D-K-1 of a laboratory, 2026-05-12, serial 42",
        "measured  robot: no certificate; the dataset does not state it",
    ] {
        let is_there = shown.lines().any(|shown| shown.starts_with(line));
        assert!(is_there, "no `{line}` in\n{shown}");
    }
}
