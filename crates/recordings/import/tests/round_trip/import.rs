//! Tests of imported tables and frames of a lab.

use std::fs;

use taceva_dataset::{Dataset, DatasetError};
use taceva_import::{ImportError, ImportMap, export_csv};

use super::jobs;
use crate::lab::{Lab, MAP, import, png};
use crate::support::contents;

#[test]
fn labels_are_converted_and_frames_keep_their_bytes() {
    let lab = Lab::new();
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let table = dataset.table();
    let position = |name| table.channels().position(name).expect("there");
    assert_eq!(table.truth(position("Fz")).get(1), Some(1.6005));
    assert_eq!(table.truth(position("Pz")).get(1), Some(1.2355));
    assert_eq!(table.samples()[1], "press 1");
    assert_eq!(table.point_id()[1].as_deref(), Some("1:1"));
    assert_eq!(table.repeat()[1], Some(1));
    assert_eq!(table.t_s()[1], Some(1.001));
    assert_eq!(
        table.attribute("video").expect("kept")[1].as_deref(),
        Some("clip, 1")
    );
    let copy = fs::read(lab.path("set/frames/0000/000001.png")).expect("there");
    assert_eq!(copy, png(8, 6, 1));
}

#[test]
fn import_export_and_import_give_the_same_digest() {
    let lab = Lab::new();
    // Rows do not store the name of their source table.
    lab.replace("map.toml", "[drop]", "[origin]\n\n[drop]");
    let first = lab.import().expect("imported").digest;
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let mut csv = Vec::new();
    export_csv(&dataset, &mut csv).expect("exported");
    fs::write(lab.path("set/export.csv"), csv).expect("written");
    let map = MAP
        .replace("[drop]", "[origin]\n\n[drop]")
        .replace("labels.csv", "export.csv")
        .replace("\"file\"", "\"frame\"")
        .replace(
            "{ from = \"force\", unit = \"mN\", sign = -1 }",
            "{ from = \"Fz\", unit = \"N\" }",
        )
        .replace(
            "{ from = \"depth\", unit = \"um\" }",
            "{ from = \"Pz\", unit = \"mm\" }",
        )
        .replace("\"name\"", "\"sample\"")
        .replace("[\"x\", \"y\"]", "\"point_id\"")
        .replace(
            "column = \"t\"\nunit = \"ms\"",
            "column = \"t_s\"\nunit = \"s\"",
        )
        .replace("quality_flags = [\"bad\"]", "");
    let map = ImportMap::parse("again.toml".as_ref(), &map).expect("a map");
    let again = import(&lab.path("set"), &map, &lab.path("again"), 2).expect("imported");
    assert_eq!(again.digest, first);
    let [once, twice] = ["set/samples.parquet", "again/samples.parquet"].map(|p| lab.path(p));
    assert_eq!(
        fs::read(once).expect("read"),
        fs::read(twice).expect("read")
    );
}

#[test]
fn any_number_of_threads_writes_the_same_bytes() {
    let lab = Lab::new();
    lab.import_to("one", 1).expect("imported");
    for count in [2, 3, 16] {
        let target = format!("set {count}");
        lab.import_to(&target, count).expect("imported");
        assert_eq!(contents(&lab.path(&target)), contents(&lab.path("one")));
    }
}

#[test]
fn frames_of_an_array_are_kept_bit_for_bit() {
    let lab = Lab::new();
    let header = "{'descr': '<u2', 'fortran_order': False, 'shape': (6, 3, 4), }";
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend_from_slice(&u16::try_from(header.len()).expect("short").to_le_bytes());
    file.extend_from_slice(header.as_bytes());
    let numbers: Vec<u16> = (0..72).map(|number| number * 911).collect();
    file.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    lab.write("source/frames.npy", &file);
    lab.replace(
        "map.toml",
        "column = \"file\"",
        "array = { file = \"frames.npy\" }\nindex = \"x\"",
    );
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    for row in 0..5 {
        let frame = dataset.frame(row).expect("decodes").expect("there");
        assert_eq!(
            frame.samples().collect::<Vec<_>>(),
            numbers[row * 12..][..12]
        );
    }
    lab.replace("source/labels.csv", "press 3,3,", "press 3,6,");
    let error = lab.import_to("other", 1).expect_err("beyond");
    let message = error.to_string();
    assert!(
        message.contains("line 5, column `x`") && message.contains("no frame 6: there are 6"),
        "{message}"
    );
}

#[test]
fn tables_of_several_runs_join_and_name_frames_by_a_pattern() {
    let lab = Lab::new();
    for run in ["run_a", "run_b"] {
        fs::create_dir_all(lab.path(&format!("source/{run}/images"))).expect("created");
        lab.write(
            &format!("source/{run}/labels.csv"),
            b"n,force\n1,1000\n2,2000\n",
        );
        for n in 1..=2 {
            lab.write(&format!("source/{run}/images/image_{n}.png"), &png(8, 6, n));
        }
    }
    lab.write(
        "map.toml",
        br#"
map_version = 2
table = "run_*/labels.csv"
[frame]
pattern = "images/image_{n}.png"
channel_order = "gray"
reference = "unknown"
[columns]
Fz = { from = "force", unit = "mN" }
[time]
clock = "unknown"
[sensor]
model = "drawn"
serial = "unknown"
gel = "unknown"
opaque = false
"#,
    );
    let report = lab.import().expect("imported");
    assert_eq!(
        (report.summary.tables.len(), report.summary.unnamed_images),
        (2, 0)
    );
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    assert_eq!(dataset.table().samples(), ["0", "1", "2", "3"]);
    assert_eq!(
        dataset.frame(0).expect("decodes"),
        dataset.frame(2).expect("decodes")
    );
}

#[test]
fn placeholders_are_left_out_only_where_all_of_them_stand() {
    let lab = Lab::new();
    lab.write("source/plain.csv", b"Fx,Fz\n0.0,0.0\n0.0,1.0\n0,0\n2,0\n");
    lab.write(
        "map.toml",
        br#"
map_version = 2
table = "plain.csv"
[columns]
Fx = { from = "Fx", unit = "N" }
Fz = { from = "Fz", unit = "N" }
[drop]
placeholders = { Fx = 0.0, Fz = 0.0 }
[time]
clock = "unknown"
[sensor]
model = "drawn"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#,
    );
    let summary = lab.import().expect("imported").summary;
    assert_eq!(
        (summary.rows_kept, summary.dropped.get("placeholders")),
        (2, Some(&2))
    );
    assert!(
        Dataset::open(&lab.path("set"))
            .expect("opens")
            .header()
            .frames
            .is_none()
    );
}

#[test]
fn a_cancelled_import_leaves_nothing() {
    struct Stop;
    impl taceva_core::Progress for Stop {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let lab = Lab::new();
    let map = ImportMap::read(&lab.path("map.toml")).expect("a map");
    let plan = taceva_import::ImportPlan::new(&lab.path("source"), &map).expect("a plan");
    let outcome = plan.run(&lab.path("set"), jobs(2), &Stop);
    assert!(matches!(
        outcome,
        Err(ImportError::Dataset(DatasetError::Cancelled))
    ));
    assert_eq!(fs::read_dir(lab.folder.path()).expect("listed").count(), 2);
}

#[test]
fn the_leftover_of_a_killed_import_is_cleared() {
    let lab = Lab::new();
    let left = lab.path(".taceva-staged-a1b2c3");
    fs::create_dir_all(left.join("set/frames")).expect("created");
    fs::write(left.join("set/frames/junk"), b"x").expect("written");
    fs::write(left.join(".taceva-temporary"), b"").expect("written");
    lab.import().expect("imported");
    assert!(!left.exists());
}
