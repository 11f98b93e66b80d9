//! The uncertainty of fitted zeros as a source of a budget of depths.

use super::{near, number, source};
use crate::support::Bench;

/// Budget file for Pz at 0.5 mm with a source for each of `figures`, named like the figure.
fn of_depth(figures: &[&str]) -> String {
    let sources = figures
        .iter()
        .map(|figure| format!("[[source]]\nname = \"{figure}\"\nfrom = \"{figure}\"\n"));
    let sources: String = sources.collect();
    format!("budget_version = 1\nmeasurand = \"Pz\"\nat = [\"0.5 mm\"]\n{sources}")
}

#[test]
fn the_zero_of_depths_is_a_source_with_its_file_and_counts_once() {
    let bench = Bench::new();
    bench.record_depths("data", 0.004);
    bench.ok(
        "evaluate data --model ridge --set size=8x8 --format json --out r.json --samples-out r.samples.csv -q",
    );
    let table = std::fs::read_to_string(bench.path("r.samples.csv")).expect("there");
    let head = table.lines().next().expect("a head");
    assert!(
        head.split(',').any(|column| column == "zero_u_mm"),
        "{head}"
    );
    bench.write("budget.toml", &of_depth(&["zero_u_mm"]));
    let budget = bench.json("budget budget.toml --results r.json --mc 0");
    crate::schema::check("budget", &budget);
    let zero = source(&budget, "zero_u_mm");
    near(number(&zero["u"]), 0.004, 1e-12);
    assert_eq!(zero["from"], "zero_u_mm");
    let digest = taceva_files::seal::digest_of_bytes(table.as_bytes());
    assert_eq!(zero["digest"], digest);
    bench.write("both.toml", &of_depth(&["zero_u_mm", "error.within"]));
    bench.refused(
        "budget both.toml --results r.json",
        3,
        "both.toml: line 5, `from`: `zero_u_mm` is inside `error.within` (line 8); remove one of them",
    );
    let template = bench.ok("budget --template r.json --channel Pz");
    let comment = "# zero_u_mm: measured, and inside `error.within`";
    assert!(template.contains(comment), "{template}");
    bench.write("budget.toml", &template);
    let budget = bench.json("budget budget.toml --results r.json --mc 0");
    let missing = budget["missing"].to_string();
    assert!(!missing.contains("zero_u_mm"), "{missing}");
}

#[test]
fn a_budget_of_depths_from_the_first_contact_says_that_their_zero_has_no_uncertainty() {
    let bench = super::evaluated();
    bench.write("budget.toml", &of_depth(&["zero_u_mm"]));
    bench.refused(
        "budget budget.toml",
        3,
        "`zero_u_mm` is not measured here: no result is given",
    );
    // The result has no depths.
    bench.refused("budget budget.toml --results r.json", 3, "zero_u_mm");
}
