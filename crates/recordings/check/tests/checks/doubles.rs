//! Tests of duplicate labels, normalised labels, and implausible depths.

use taceva_check::CheckReport;

use super::lab::{PICTURES, SENSOR, imported, pictures};
use super::streams::{message, says_nothing};

/// Report of the check `only` on `table`, imported by a map with the channels `columns`.
fn labelled(table: &str, columns: &str, only: &str) -> CheckReport {
    let rows = table.lines().count() - 1;
    let files = [
        ("labels.csv", table.as_bytes().to_vec()),
        ("f.npy", pictures(&vec![0.5; rows])),
    ];
    let map = format!(
        "map_version = 2\ntable = \"labels.csv\"\n{PICTURES}[columns]\n{columns}\n[time]\nclock = \"unknown\"\n{SENSOR}"
    );
    imported(&files, &map, &[only])
}

const TWICE: &str = include_str!("../cases/16-column-mapped-twice/labels.csv");

fn from(channel: &str, column: &str, rest: &str) -> String {
    format!("{channel} = {{ from = \"{column}\", unit = \"N\"{rest} }}\n")
}

#[test]
fn a_column_that_is_mapped_to_two_channels_is_named() {
    let columns = from("Fx", "fx", "") + &from("Fy", "fx", "") + &from("Fz", "fz", "");
    let report = labelled(TWICE, &columns, "TAC038");
    assert_eq!(
        message(&report, "TAC038"),
        "Fx and Fy are equal in all 20 samples: both are read from `fx`"
    );
}

#[test]
fn a_column_that_is_mapped_twice_with_two_signs_or_written_twice_is_named_and_three_axes_are_not() {
    let signs = from("Fx", "fx", ", sign = -1") + &from("Fz", "fx", "");
    assert_eq!(
        message(&labelled(TWICE, &signs, "TAC038"), "TAC038"),
        "Fx and Fz are equal except for their sign in all 20 samples: both are read from `fx`"
    );
    let mut written = String::new();
    for line in TWICE.lines() {
        let cells: Vec<&str> = line.split(',').collect();
        let name = if written.is_empty() { "copy" } else { cells[3] };
        written += &format!("{line},{name}\n");
    }
    let copied = from("Fy", "copy", "") + &from("Fz", "fz", "");
    assert_eq!(
        message(&labelled(&written, &copied, "TAC038"), "TAC038"),
        "Fy and Fz are equal in all 20 samples"
    );
    let axes = from("Fx", "fx", "") + &from("Fy", "fy", "") + &from("Fz", "fz", "");
    says_nothing(&labelled(TWICE, &axes, "TAC038"), "TAC038");
}

/// Table of `rows` rows below the header line `head`. `cells` writes each row.
fn table(rows: u32, head: &str, cells: impl Fn(u32) -> String) -> String {
    let rows = (0..rows).map(cells);
    std::iter::once(head.to_owned())
        .chain(rows)
        .collect::<Vec<_>>()
        .join("\n")
}

/// Number from 0 to 1, including both ends.
fn unit(row: u32, factor: u32) -> f64 {
    f64::from(row * factor % 41) / 40.0
}

#[test]
fn wrenches_that_were_scaled_to_one_are_no_newtons() {
    let both = from("Fx", "a", "") + &from("Fz", "b", "");
    let scaled = table(41, "a,b", |row| {
        format!("{},{}", unit(row, 7), unit(row, 11))
    });
    assert_eq!(
        message(&labelled(&scaled, &both, "TAC040"), "TAC040"),
        "Fx, Fz end at exactly 0 and 1, like normalised labels, but are declared in N"
    );
    let signed = table(41, "a,b", |row| {
        format!("{},{}", 2.0 * unit(row, 7) - 1.0, 2.0 * unit(row, 11) - 1.0)
    });
    let said = labelled(&signed, &both, "TAC040");
    assert!(message(&said, "TAC040").contains("at exactly -1 and 1"));
    let alone = labelled(&scaled, &from("Fz", "b", ""), "TAC040");
    assert!(message(&alone, "TAC040").starts_with("Fz ends at exactly 0 and 1"));
    let newtons = table(41, "a,b", |row| {
        format!("{},{}", 0.7 * unit(row, 7), 1.3 * unit(row, 11))
    });
    says_nothing(&labelled(&newtons, &both, "TAC040"), "TAC040");
}

#[test]
fn a_distance_to_the_camera_is_no_depth() {
    let depth = |of: &dyn Fn(u32) -> f64| {
        let table = table(30, "z", |row| format!("{}", of(row)));
        labelled(&table, "Pz = { from = \"z\", unit = \"mm\" }", "TAC041")
    };
    let far = depth(&|row| 20.0 + 0.05 * f64::from(row));
    assert_eq!(
        message(&far, "TAC041"),
        "the median of Pz is 20.75 mm, more than the thickness of any gel: Pz may be the distance to the camera"
    );
    let height = depth(&|row| 8.0 + 0.05 * f64::from(row));
    assert!(message(&height, "TAC041").contains("never near 0"));
    says_nothing(&depth(&|row| 0.05 * f64::from(row)), "TAC041");
    says_nothing(&depth(&|row| 0.3 * f64::from(row)), "TAC041");
}
