//! A dataset goes out in every form and comes in again, by the program alone.

use std::fs;

use crate::support::Bench;

#[test]
fn every_form_is_exported_and_imported_again_by_its_own_map() {
    let bench = Bench::new();
    bench.record("data", 16);
    let scores = bench
        .json("evaluate data --model ridge --split by-point --set size=8x8 --metrics r2")["metrics"]
        .clone();
    assert!(scores.is_object() || scores.is_array(), "{scores}");
    for form in ["csv", "huggingface", "hdf5", "lerobot"] {
        let said = bench.ok(&format!("export data --format {form} --out {form}"));
        assert!(
            said.contains("samples  60") && said.contains("pictures 60"),
            "{said}"
        );
        let again = format!("taceva import {form} --map {form}/map.toml --out DATASET");
        assert!(said.contains(&again), "{said}");
        bench.ok(&format!(
            "import {form} --map {form}/map.toml --out {form}-again"
        ));
        let found = bench.json(&format!(
            "evaluate {form}-again --model ridge --split by-point --set size=8x8 --metrics r2"
        ));
        assert_eq!(found["metrics"], scores, "{form}");
        bench.refused(
            &format!("export data --format {form} --out {form}"),
            3,
            "exists already",
        );
    }
    let header = fs::read_to_string(bench.path("csv/map.toml")).expect("a map");
    assert!(header.starts_with("# The dataset again:"), "{header}");
}
