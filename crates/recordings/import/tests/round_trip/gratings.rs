//! Tests of gratings in an imported table.

use std::fs;

use taceva_core::{GratingKind, Nanometre};
use taceva_dataset::Dataset;

use crate::lab::{Lab, MAP};

/// Lab in which presses touch gratings.
fn gratings(kind: &str, spacing: &str) -> Lab {
    let lab = Lab::new();
    let map = MAP.replace(
        "[ids]",
        "[ids]\nkind = \"relief\"\nspacing_mm = \"spacing\"",
    );
    lab.write("map.toml", map.as_bytes());
    let table = fs::read_to_string(lab.path("source/labels.csv")).expect("there");
    let mut lines = table.lines();
    let header = lines.next().expect("a header");
    let rows = lines.map(|line| format!("{line},{kind},{spacing}\n"));
    let table = format!("{header},relief,spacing\n{}", rows.collect::<String>());
    lab.write("source/labels.csv", table.as_bytes());
    lab
}

#[test]
fn gratings_are_whole_nanometres_and_frames_say_how_bright_they_are() {
    let lab = gratings("dot", "0.35");
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let table = dataset.table();
    assert_eq!(table.kind()[2], Some(GratingKind::Dot));
    assert_eq!(table.spacing()[2], Some(Nanometre(350_000)));
    let frame = dataset.frame(2).expect("decodes").expect("there");
    assert_eq!(table.intensity()[2], Some(frame.mean_luma()));
}

#[test]
fn a_grating_of_no_kind_or_no_spacing_is_refused() {
    gratings("wave", "0.35").is_refused_with(&["column `relief`", "expected `line` or `dot`"]);
    for spacing in ["0", "-0.3", "0.3 mm", "nan", "1e99"] {
        let expected = ["column `spacing`", "expected a spacing in mm, such as 0.35"];
        gratings("line", spacing).is_refused_with(&expected);
    }
}
