//! A dataset is exported in every form and imported again, by the program alone.

use std::fs;
use std::path::Path;

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
    assert!(header.starts_with("# Restores the dataset:"), "{header}");
}

#[test]
fn the_line_that_imports_an_export_again_runs_in_a_shell_whatever_the_folder_is_called() {
    let bench = Bench::new();
    bench.record("data", 16);
    for (number, name) in ["two words", "it's $HOME; echo", "a&b (1)"]
        .into_iter()
        .enumerate()
    {
        let output = bench
            .command("export data --format csv --out")
            .arg(name)
            .output()
            .expect("the program starts");
        let said = String::from_utf8(output.stdout).expect("UTF-8");
        let (_, line) = said.split_once("again    ").expect(&said);
        let line = line.lines().next().expect("a line");
        let line = line.replace("DATASET", &format!("again-{number}"));
        let program = Path::new(env!("CARGO_BIN_EXE_taceva"));
        let folder = program.parent().expect("a folder").display();
        let found = std::process::Command::new("sh")
            .args(["-c", &format!("PATH='{folder}':$PATH; {line}")])
            .current_dir(bench.path("."))
            .output()
            .expect("a shell");
        let error = String::from_utf8_lossy(&found.stderr);
        assert_eq!(found.status.code(), Some(0), "{line}: {error}");
        assert!(bench.path(&format!("again-{number}/dataset.toml")).exists());
    }
}
