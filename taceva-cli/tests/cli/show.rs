//! `taceva show`: what a dataset holds, and what measured it.

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
