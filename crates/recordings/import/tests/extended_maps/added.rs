//! Tests of rows added by a map with different joins, pictures, class names or placeholders.

use std::num::NonZeroUsize;
use std::path::Path;

use super::arrays::{bytes_of, npy};
use super::{NO_TIME, lab, planned};
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::Addition;

/// Two folders with the same tables and different numbers: a camera, a transducer, raw pictures.
fn folders() -> [tempfile::TempDir; 2] {
    [0.0_f32, 100.0].map(|start| {
        let times = |step: f32| {
            let rows = (0..3_u8).map(|row| f32::from(row) * step + start);
            rows.collect::<Vec<f32>>()
        };
        let camera: Vec<String> = times(1.0)
            .iter()
            .zip(["smooth", "rough", "rough"])
            .map(|(time, class)| format!("{time},{},{class}\n", time - start))
            .collect();
        let force: Vec<String> = times(0.5)
            .iter()
            .chain(&[start + 2.0])
            .map(|time| format!("{time},{},{}\n", time + 0.25, 7.0 * time))
            .collect();
        let folder = lab(&[
            ("camera.csv", &format!("t,n,class\n{}", camera.concat())),
            ("ft.csv", &format!("t,later,Fz\n{}", force.concat())),
        ]);
        let pixels: Vec<f32> = (0..6_u8)
            .map(|pixel| f32::from(pixel) / 8.0 + start / 800.0)
            .collect();
        let frames = npy("<f4", "(3, 1, 2)", &bytes_of(&pixels));
        std::fs::write(folder.path().join("frames.npy"), frames).expect("written");
        folder
    })
}

const MAP: &str = r#"table = "camera.csv"
[frame]
array = { file = "frames.npy" }
index = "n"
range = [0, 1]
bits = 8
channel_order = "gray"
reference = "unknown"
[columns]
Fz = { from = "ft.Fz", unit = "N" }
[[join]]
name = "ft"
table = "ft.csv"
time = { column = "t", unit = "s" }
pick = "nearest"
tolerance_ms = 300
lag_ms = 0
unmatched = "drop"
skip = { Fz = -1 }
[classes]
texture = { from = "class", names = ["smooth", "rough"] }
[drop]
placeholders = { Fz = -2 }
[time]
clock = "monotonic"
column = "t"
unit = "s"
"#;

fn imported(folder: &Path, map: &str, target: &Path) {
    let plan = planned(folder, map).expect("planned");
    plan.run(target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
}

fn added(folder: &Path, map: &str, target: &Path) -> Result<(), String> {
    let plan = planned(folder, map)?;
    let addition = Addition::new("2026-11-26", "second");
    let outcome = plan.extend(target, &addition, NonZeroUsize::MIN, &SilentProgress);
    outcome.map(drop).map_err(|error| error.to_string())
}

/// Checks that adding rows by `map`, with `from` replaced by `to`, is rejected. The message must name `key`, the value `own` of the dataset and the value
/// `other` of the map.
fn refused(from: &str, to: &str, [key, own, other]: [&str; 3]) {
    let [first, second] = folders();
    let target = first.path().join("dataset");
    imported(first.path(), MAP, &target);
    let before = std::fs::read(target.join("dataset.toml")).expect("a header");
    assert!(MAP.contains(from), "{from}");
    let problem = added(second.path(), &MAP.replacen(from, to, 1), &target).expect_err(key);
    let words = format!("`{key}` is {own} in the dataset and {other} in the map");
    assert!(problem.contains(&words), "{words}: {problem}");
    assert!(
        problem.contains("import these rows as a separate dataset"),
        "{problem}"
    );
    let after = std::fs::read(target.join("dataset.toml")).expect("a header");
    assert_eq!(after, before, "{key}");
}

#[test]
fn the_same_map_adds_rows_and_the_header_says_once_how_they_were_read() {
    let [first, second] = folders();
    let target = first.path().join("dataset");
    imported(first.path(), MAP, &target);
    let before = Dataset::open(&target).expect("opens").header().clone();
    added(second.path(), MAP, &target).expect("added");
    let header = Dataset::open(&target).expect("opens").header().clone();
    assert_eq!(header.joins, before.joins);
    assert_eq!(header.pictures, before.pictures);
    assert_eq!(header.classes, before.classes);
    let [join] = &header.joins[..] else {
        panic!("{:?}", header.joins);
    };
    assert_eq!(
        (join.lag_ms, join.tolerance_ms, join.pick.as_deref()),
        (Some(0.0), Some(300.0), Some("nearest"))
    );
    assert_eq!(join.skip, ["Fz = -1"]);
    assert_eq!(header.pictures[0].range, Some([0.0, 1.0]));
    assert_eq!(header.classes[0].names, ["smooth", "rough"]);
    assert_eq!(header.columns[0].placeholder, Some(-2.0));
    assert_eq!(
        (header.table.rows, header.format.to_string()),
        (6, "1.0".to_owned())
    );
}

/// Creates tests in which a text of the map is replaced, each with the expected words of the rejection.
macro_rules! refusals {
    ($($name:ident: $text:expr => $other:expr, $words:expr;)+) => {$(
        #[test]
        fn $name() {
            refused($text, $other, $words);
        }
    )+};
}

refusals! {
    another_lag_of_a_joined_clock_is_refused:
        "lag_ms = 0" => "lag_ms = 12.5", ["join.ft.lag_ms", "0", "12.5"];
    another_pick_of_a_joined_row_is_refused:
        "pick = \"nearest\"" => "pick = \"linear\"", ["join.ft.pick", "`nearest`", "`linear`"];
    another_tolerance_of_a_joined_row_is_refused:
        "tolerance_ms = 300" => "tolerance_ms = 400", ["join.ft.tolerance_ms", "300", "400"];
    another_fate_of_rows_without_a_joined_one_is_refused:
        "unmatched = \"drop\"" => "unmatched = \"refuse\"", ["join.ft.unmatched", "drop", "refuse"];
    another_column_of_the_time_of_a_joined_table_is_refused:
        "time = { column = \"t\"" => "time = { column = \"later\"", ["join.ft.time.column", "`t`", "`later`"];
    a_table_that_is_joined_by_row_and_no_longer_by_time_is_refused:
        "time = { column = \"t\", unit = \"s\" }\npick = \"nearest\"\ntolerance_ms = 300\nlag_ms = 0\n" => "on = \"row\"\n", ["join.ft", "by time", "by row"];
    other_rows_of_a_joined_table_that_are_no_candidates_are_refused:
        "skip = { Fz = -1 }" => "skip = { Fz = -9 }", ["join.ft.skip", "`Fz = -1`", "`Fz = -9`"];
    another_range_of_numbers_that_become_pixels_is_refused:
        "range = [0, 1]" => "range = [0, 2]", ["frame.range", "[0, 1]", "[0, 2]"];
    another_column_of_the_position_of_a_picture_is_refused:
        "index = \"n\"" => "index = \"row\"", ["frame.index", "`n`", "`row`"];
}

#[test]
fn another_depth_of_pixels_is_refused() {
    let [first, second] = folders();
    let target = first.path().join("dataset");
    imported(first.path(), MAP, &target);
    let other = MAP.replacen("bits = 8", "bits = 16", 1);
    let problem = added(second.path(), &other, &target).expect_err("other bits");
    assert!(
        problem.contains("`frame.bits` is 8 in the dataset and 16 in the map"),
        "{problem}"
    );
}

#[test]
fn other_axes_of_an_array_of_pictures_are_refused() {
    // Three rows, three columns and three colours: the lengths fit both layouts.
    let folders = [0_u8, 50].map(|start| {
        let folder = lab(&[("labels.csv", &format!("Fz\n{start}\n"))]);
        let pixels: Vec<u8> = (0..27).map(|pixel| pixel + start).collect();
        let frames = npy("|u1", "(1, 3, 3, 3)", &pixels);
        std::fs::write(folder.path().join("frames.npy"), frames).expect("written");
        folder
    });
    let map = |layout: &str| {
        format!(
            "table = \"labels.csv\"\n[frame]\narray = {{ file = \"frames.npy\" }}\n{layout}channel_order = \"rgb\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
        )
    };
    let target = folders[0].path().join("dataset");
    imported(folders[0].path(), &map(""), &target);
    let nchw = map("layout = \"nchw\"\n");
    let problem = added(folders[1].path(), &nchw, &target).expect_err("other axes");
    let words = "`frame.layout` is nhwc or nhw in the dataset and nchw in the map";
    assert!(problem.contains(words), "{problem}");
    // A stated layout equal to the inferred one is accepted.
    added(folders[1].path(), &map("layout = \"nhwc\"\n"), &target).expect("the same axes");
}

#[test]
fn another_list_of_classes_is_refused_and_a_longer_one_is_not() {
    refused(
        "[\"smooth\", \"rough\"]",
        "[\"rough\", \"smooth\"]",
        ["classes.texture.names[0]", "`smooth`", "`rough`"],
    );
    let [first, second] = folders();
    let target = first.path().join("dataset");
    imported(first.path(), MAP, &target);
    let longer = MAP.replacen("\"rough\"]", "\"rough\", \"ribbed\"]", 1);
    added(second.path(), &longer, &target).expect("added");
}

#[test]
fn another_number_that_stands_for_nothing_measured_is_refused() {
    refused(
        "placeholders = { Fz = -2 }",
        "placeholders = { Fz = -3 }",
        ["drop.placeholders.Fz", "-2", "-3"],
    );
    refused(
        "placeholders = { Fz = -2 }",
        "",
        ["drop.placeholders.Fz", "-2", "none"],
    );
}

#[test]
fn a_join_of_another_name_may_have_another_lag() {
    let [first, second] = folders();
    let target = first.path().join("dataset");
    imported(first.path(), MAP, &target);
    let renamed = MAP
        .replace("name = \"ft\"", "name = \"new_transducer\"")
        .replace("ft.Fz", "new_transducer.Fz")
        .replace("lag_ms = 0", "lag_ms = 12");
    added(second.path(), &renamed, &target).expect("added");
    let header = Dataset::open(&target).expect("opens").header().clone();
    let lags: Vec<Option<f64>> = header.joins.iter().map(|join| join.lag_ms).collect();
    assert_eq!(lags, [Some(0.0), Some(12.0)]);
}

#[test]
fn a_dataset_that_does_not_say_how_it_was_read_is_not_extended() {
    let [first, second] = folders();
    let target = first.path().join("dataset");
    imported(first.path(), MAP, &target);
    let header = target.join("dataset.toml");
    let text = std::fs::read_to_string(&header).expect("a header");
    let (body, _) = text.split_once("\n[seal]").expect("sealed");
    let mut kept = String::new();
    let mut is_left_out = false;
    for line in body.lines() {
        if line.starts_with('[') {
            let mut tables = ["columns", "joins", "pictures", "classes"].iter();
            is_left_out = tables.any(|table| line == format!("[[{table}]]"));
        }
        if !is_left_out {
            kept += &format!("{line}\n");
        }
    }
    let kept = taceva_files::seal::toml_text::seal(&kept).expect("TOML");
    std::fs::write(&header, kept).expect("written");
    let problem = added(second.path(), MAP, &target).expect_err("no map is known");
    assert!(problem.contains("recorded, not imported"), "{problem}");
}
