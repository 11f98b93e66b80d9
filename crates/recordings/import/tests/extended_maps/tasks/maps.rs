//! Tests of depth maps and places: read, kept in millimetres, added, exported, and refused.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use super::super::arrays::npy;
use super::super::{lab, planned};
use super::imported_to;
use taceva_core::{Frame, FrameInfo, PixelFormat, SilentProgress};
use taceva_dataset::internal::encode_png;
use taceva_dataset::{Dataset, TaskLabel};
use taceva_import::{Addition, ExportForm, ExportPlan, ImportMap, ImportPlan};

const TABLE: &str = "force,press,file\n1,a,one.npy\n2,a,\n3,b,two.npy\n";
const COLUMNS: &str = "table = \"labels.csv\"\n[columns]\nFz = { from = \"force\", unit = \"N\" }\n\
    [ids]\npoint_id = \"press\"\n[time]\nclock = \"unknown\"\n";
const ARRAY: &str = "[task.shape]\nkind = \"depth\"\narray = \"depth.npy\"\nunit = \"um\"\npixel_mm = [0.0634, 0.0634]\ninvalid = \"nan\"\n";
const FILES: &str =
    "[task.shape]\nkind = \"depth\"\nfrom = \"file\"\nunit = \"um\"\ninvalid = -1\n";

fn singles(shape: &str, numbers: &[f32]) -> Vec<u8> {
    let bytes: Vec<u8> = numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    npy("<f4", shape, &bytes)
}

/// Folder with the table, an array of three maps of 1 × 2 pixels, and two files of one map each.
fn folder_of_maps() -> tempfile::TempDir {
    let lab = lab(&[("labels.csv", TABLE)]);
    let numbers = [0.0, 250.0, f32::NAN, f32::NAN, 1000.0, -2.0];
    fs::write(lab.path().join("depth.npy"), singles("(3, 1, 2)", &numbers)).expect("written");
    fs::write(
        lab.path().join("one.npy"),
        singles("(1, 2)", &[500.0, -1.0]),
    )
    .expect("written");
    fs::write(lab.path().join("two.npy"), singles("(1, 2)", &[0.0, 750.0])).expect("written");
    lab
}

fn dataset_of(lab: &Path, tasks: &str, target: &Path) -> Dataset {
    imported_to(lab, &format!("{COLUMNS}{tasks}"), target)
}

/// Depths of the map of a row, mm, as texts, with `-` for an invalid pixel; `None` without a map.
fn depths(dataset: &Dataset, row: usize) -> Option<Vec<String>> {
    let map = dataset.depth_map("shape", row).expect("whole")?;
    let word = |depth: &f64| match depth.is_nan() {
        true => "-".to_owned(),
        false => depth.to_string(),
    };
    Some(map.mm.iter().map(word).collect())
}

#[track_caller]
fn refused(lab: &Path, tasks: &str) -> String {
    let target = tempfile::tempdir().expect("a folder");
    let plan = match planned(lab, &format!("{COLUMNS}{tasks}")) {
        Ok(plan) => plan,
        Err(message) => return message,
    };
    let run = plan.run(
        &target.path().join("set"),
        NonZeroUsize::MIN,
        &SilentProgress,
    );
    run.expect_err("refused").to_string()
}

#[test]
fn maps_of_an_array_are_kept_in_millimetres_with_their_invalid_pixels() {
    let (lab, folder) = (folder_of_maps(), tempfile::tempdir().expect("a folder"));
    let dataset = dataset_of(lab.path(), ARRAY, &folder.path().join("set"));
    assert_eq!(depths(&dataset, 0).expect("a map"), ["0", "0.25"]);
    assert_eq!(depths(&dataset, 1).expect("a map"), ["-", "-"]);
    assert_eq!(depths(&dataset, 2).expect("a map"), ["1", "-0.002"]);
    let task = dataset.tasks()[0].task();
    let facts = task.maps.as_ref().expect("facts");
    assert_eq!(
        (facts.unit.as_str(), facts.pixel_mm),
        ("um", Some([0.0634; 2]))
    );
    assert!(matches!(
        dataset.tasks()[0].label(0),
        Some(TaskLabel::Map(_))
    ));
    dataset.verify_frames().expect("whole");
    // A changed byte of the pack is found.
    let pack = folder.path().join("set/maps/shape.pack");
    let mut bytes = fs::read(&pack).expect("read");
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    fs::write(&pack, bytes).expect("written");
    assert!(dataset.depth_map("shape", 2).is_err());
    assert!(
        Dataset::open(dataset.path())
            .expect("opened")
            .verify_frames()
            .is_err()
    );
}

#[test]
fn a_row_with_an_empty_cell_has_no_map_and_the_number_of_invalid_pixels_is_that_of_the_map_file() {
    let (lab, folder) = (folder_of_maps(), tempfile::tempdir().expect("a folder"));
    let dataset = dataset_of(lab.path(), FILES, &folder.path().join("set"));
    assert_eq!(depths(&dataset, 0).expect("a map"), ["0.5", "-"]);
    assert_eq!(depths(&dataset, 1), None);
    assert_eq!(depths(&dataset, 2).expect("a map"), ["0", "0.75"]);
}

#[test]
fn pictures_of_sixteen_bits_are_maps_with_a_scale() {
    let (lab, folder) = (folder_of_maps(), tempfile::tempdir().expect("a folder"));
    let info = FrameInfo {
        width: 2,
        height: 1,
        format: PixelFormat::Gray16,
    };
    let pixels = [0_u16, 40_000].map(u16::to_le_bytes).concat();
    let frame = Frame::new(info, pixels).expect("two pixels");
    let png = encode_png(&frame).expect("a PNG");
    fs::write(lab.path().join("one.png"), png).expect("written");
    let table = TABLE
        .replace("one.npy", "one.png")
        .replace("two.npy", "one.png");
    fs::write(lab.path().join("labels.csv"), table).expect("written");
    let map = FILES.replace("invalid = -1", "invalid = 0\nscale = 0.1");
    let dataset = dataset_of(lab.path(), &map, &folder.path().join("set"));
    assert_eq!(depths(&dataset, 2).expect("a map"), ["-", "4"]);
}

#[test]
fn every_form_of_export_brings_maps_back_with_the_same_digest() {
    let (lab, folder) = (folder_of_maps(), tempfile::tempdir().expect("a folder"));
    for (name, tasks) in [("array", ARRAY), ("files", FILES)] {
        let dataset = dataset_of(lab.path(), tasks, &folder.path().join(name));
        for form in ExportForm::ALL {
            let to = folder.path().join(format!("{name}-{}", form.name()));
            let plan = ExportPlan::new(&dataset, form).expect("a plan");
            let report = plan.run(&to, NonZeroUsize::MIN, &SilentProgress);
            let map = ImportMap::read(&report.expect("exported").map).expect("a map");
            let plan = ImportPlan::new(&to, &map).expect("planned");
            let target = to.with_extension("again");
            plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
                .expect("imported");
            let again = Dataset::open(&target).expect("a dataset");
            for row in 0..3 {
                assert_eq!(
                    depths(&again, row),
                    depths(&dataset, row),
                    "{}",
                    form.name()
                );
            }
            assert_eq!(again.digest(), dataset.digest(), "{name} {}", form.name());
        }
    }
}

#[test]
fn added_rows_bring_their_maps_and_the_former_maps_stay() {
    let (lab, folder) = (folder_of_maps(), tempfile::tempdir().expect("a folder"));
    let before = dataset_of(lab.path(), FILES, &folder.path().join("set"));
    fs::write(
        lab.path().join("labels.csv"),
        "force,press,file\n4,c,two.npy\n",
    )
    .expect("written");
    let plan = planned(lab.path(), &format!("{COLUMNS}{FILES}")).expect("planned");
    let added = Addition::new("2026-11-29", "tuesday");
    plan.extend(before.path(), &added, NonZeroUsize::MIN, &SilentProgress)
        .expect("added");
    let after = Dataset::open(before.path()).expect("a dataset");
    assert_eq!(depths(&after, 0).expect("a map"), ["0.5", "-"]);
    assert_eq!(depths(&after, 3).expect("a map"), ["0", "0.75"]);
    after.verify_frames().expect("whole");
}

#[test]
fn rows_with_the_maps_of_the_dataset_are_not_added_twice() {
    let (lab, folder) = (folder_of_maps(), tempfile::tempdir().expect("a folder"));
    let dataset = dataset_of(lab.path(), FILES, &folder.path().join("set"));
    let plan = planned(lab.path(), &format!("{COLUMNS}{FILES}")).expect("planned");
    let added = Addition::new("2026-11-29", "monday");
    let message = plan
        .extend(dataset.path(), &added, NonZeroUsize::MIN, &SilentProgress)
        .expect_err("the same rows")
        .to_string();
    assert!(
        message.contains("3 of 3 rows are already in it"),
        "{message}"
    );
}

#[test]
fn maps_of_joined_recordings_are_those_of_each_recording() {
    let (lab, folder) = (folder_of_maps(), tempfile::tempdir().expect("a folder"));
    let one = dataset_of(lab.path(), FILES, &folder.path().join("one"));
    fs::write(
        lab.path().join("labels.csv"),
        "force,press,file\n4,c,two.npy\n",
    )
    .expect("written");
    let other = dataset_of(lab.path(), FILES, &folder.path().join("other"));
    let both = Dataset::joined(vec![one, other]).expect("alike");
    assert_eq!(depths(&both, 3).expect("a map"), ["0", "0.75"]);
}

#[test]
fn maps_of_another_size_without_a_unit_or_fewer_than_rows_are_refused() {
    let lab = folder_of_maps();
    let two = lab.path().join("two.npy");
    fs::write(two, singles("(2, 1)", &[0.0, 1.0])).expect("written");
    let message = refused(lab.path(), FILES);
    assert!(
        message.contains("labels.csv, line 4")
            && message.contains("a map of 2 x 1 pixels, expected 1 x 2 as in the first map"),
        "{message}"
    );
    let message = refused(lab.path(), &ARRAY.replace("unit = \"um\"\n", ""));
    assert!(
        message.contains("[task.shape] needs `unit` of its depths"),
        "{message}"
    );
    let message = refused(lab.path(), &ARRAY.replace("\"um\"", "\"N\""));
    assert!(message.contains("not a unit of length"), "{message}");
    let array = lab.path().join("depth.npy");
    fs::write(&array, singles("(2, 1, 2)", &[0.0; 4])).expect("written");
    let message = refused(lab.path(), ARRAY);
    assert!(
        message.contains("has 2 depth maps in its array"),
        "{message}"
    );
    fs::write(&array, singles("(4, 1, 2)", &[0.0; 8])).expect("written");
    let message = refused(lab.path(), ARRAY);
    assert!(message.contains("4 depth maps for 3 rows"), "{message}");
    let numbers = [0.0, f32::INFINITY, 0.0, 0.0, 0.0, 0.0];
    fs::write(&array, singles("(3, 1, 2)", &numbers)).expect("written");
    let message = refused(lab.path(), ARRAY);
    assert!(message.contains("column 1, row 0 is inf"), "{message}");
    let message = refused(lab.path(), &format!("{ARRAY}names = [\"a\", \"b\"]\n"));
    assert!(
        message.contains("with the maps of all rows, or `from`"),
        "{message}"
    );
    let message = refused(lab.path(), &FILES.replace("\"depth\"", "\"pose\""));
    assert!(
        message.contains("apply to `kind = \"depth\"` only"),
        "{message}"
    );
}

#[test]
fn a_task_of_maps_that_is_named_like_a_path_is_refused_before_a_file_is_read() {
    let (lab, folder) = (folder_of_maps(), tempfile::tempdir().expect("a folder"));
    let dataset = dataset_of(lab.path(), FILES, &folder.path().join("set"));
    let header = dataset.path().join("dataset.toml");
    let text = fs::read_to_string(&header).expect("read");
    let (body, _) = text.split_once("\n[seal]").expect("sealed");
    let named = body.replace("[task.shape", "[task.\"../shape\"");
    let named = taceva_files::seal::toml_text::seal(&format!("{named}\n")).expect("TOML");
    fs::write(&header, named).expect("written");
    let message = Dataset::open(dataset.path())
        .expect_err("refused")
        .to_string();
    assert!(
        message.contains("the name `../shape` of a task"),
        "{message}"
    );
}

#[test]
fn maps_too_large_to_be_held_are_refused_before_they_are_read() {
    let lab = folder_of_maps();
    let array = lab.path().join("depth.npy");
    fs::write(&array, singles("(3, 1, 20000)", &[0.0; 60_000])).expect("written");
    let message = refused(lab.path(), ARRAY);
    assert!(
        message.contains("depth maps of 1 x 20000 pixels, expected sides up to 16384"),
        "{message}"
    );
}

#[test]
fn a_place_has_three_positions_in_millimetres() {
    let table = "x,y,z,press\n0.001,0,-0.5,a\n,,,b\n";
    let map = "table = \"labels.csv\"\n[ids]\npoint_id = \"press\"\n[time]\nclock = \"unknown\"\n\
        [task.contact]\nkind = \"place\"\nfrom = { t = [\"x\", \"y\", \"z\"] }\nunit = \"m\"\nframe = \"mesh\"\n";
    let folder = tempfile::tempdir().expect("a folder");
    let lab = lab(&[("labels.csv", table)]);
    let dataset = imported_to(lab.path(), map, &folder.path().join("set"));
    let contact = &dataset.tasks()[0];
    assert_eq!(contact.label(0), Some(TaskLabel::Place([1.0, 0.0, -500.0])));
    assert_eq!(contact.label(1), None);
    fs::write(
        lab.path().join("labels.csv"),
        table.replace(",,,b", ",1,,b"),
    )
    .expect("written");
    let message = planned(lab.path(), map).expect_err("an empty cell");
    assert!(
        message.contains("all three numbers of a place"),
        "{message}"
    );
    let to = folder.path().join("exported");
    let plan = ExportPlan::new(&dataset, ExportForm::Csv).expect("a plan");
    let report = plan
        .run(&to, NonZeroUsize::MIN, &SilentProgress)
        .expect("exported");
    let plan = ImportPlan::new(&to, &ImportMap::read(&report.map).expect("a map"));
    let again = folder.path().join("again");
    let report = plan
        .expect("planned")
        .run(&again, NonZeroUsize::MIN, &SilentProgress);
    assert_eq!(report.expect("imported").digest, dataset.digest());
}

#[test]
fn poses_may_have_a_rotation_matrix_and_reflections_are_refused_by_row() {
    let table = "x,y,z,a,b,c,d,e,f,g,h,i,press\n1,2,3,-1,0,0,0,-1,0,0,0,1,a\n";
    let map = "table = \"labels.csv\"\n[ids]\npoint_id = \"press\"\n[time]\nclock = \"unknown\"\n\
        [task.moved]\nkind = \"pose\"\nunit = \"mm\"\n\
        from = { t = [\"x\", \"y\", \"z\"], m = [\"a\", \"b\", \"c\", \"d\", \"e\", \"f\", \"g\", \"h\", \"i\"] }\n";
    let folder = tempfile::tempdir().expect("a folder");
    let lab = lab(&[("labels.csv", table)]);
    let dataset = imported_to(lab.path(), map, &folder.path().join("set"));
    let half_turn = TaskLabel::Pose([1.0, 2.0, 3.0, 0.0, 0.0, 1.0, 0.0]);
    assert_eq!(dataset.tasks()[0].label(0), Some(half_turn));
    let mirror = table.replace("-1,0,0,0,-1,0,0,0,1", "1,0,0,0,1,0,0,0,-1");
    fs::write(lab.path().join("labels.csv"), mirror).expect("written");
    let message = planned(lab.path(), map).expect_err("a reflection");
    for words in ["labels.csv, line 2", "not a rotation", "the determinant 1"] {
        assert!(message.contains(words), "{message}");
    }
}
