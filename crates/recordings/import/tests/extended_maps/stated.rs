//! Tests that compare attributes of files with the map, and numbers of pictures with numbers of rows.

use super::arrays::{bytes_of, npy};
use super::{NO_TIME, imported_from, planned};
use taceva_arrays::{Hdf5Writer, WrittenElement};

/// Folder with an HDF5 file of two forces, whose array has `attributes`.
fn forces(attributes: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.h5");
    let mut writer = Hdf5Writer::create(&path).expect("made");
    writer
        .begin("force", WrittenElement::F64, &[2], attributes)
        .expect("begun");
    for force in [100.0_f64, 200.0] {
        writer.write(&force.to_le_bytes()).expect("written");
    }
    writer.finish(&[]).expect("written");
    folder
}

fn map(column: &str) -> String {
    format!("table = \"run.h5\"\n[columns]\nFz = {{ from = \"force\", {column} }}\n{NO_TIME}")
}

#[test]
fn a_unit_that_the_file_states_is_not_overruled_by_the_map_without_a_word() {
    let folder = forces(&[("unit", "mN")]);
    let problem = planned(folder.path(), &map("unit = \"N\"")).expect_err("ten times a hundred");
    for word in [
        "run.h5, column `force`",
        "is `mN` in the file",
        "but `N` in the map",
    ] {
        assert!(problem.contains(word), "{word}: {problem}");
    }
    for (column, expected) in [
        ("unit = \"mN\"", "0.1"),
        ("unit = \"N\", scale = 1", "100.0"),
    ] {
        let (_, found) = imported_from(folder.path(), &map(column), &["Fz"]);
        assert_eq!(found[0][0], expected, "{column}");
    }
    // The same for a joined table.
    std::fs::write(folder.path().join("t.csv"), "k\n0\n1\n").expect("written");
    let joined = map("unit = \"N\"")
        .replace("\"run.h5\"", "\"t.csv\"")
        .replace("from = \"force\"", "from = \"j.force\"")
        + "[[join]]\nname = \"j\"\ntable = \"run.h5\"\non = \"row\"\n";
    let problem = planned(folder.path(), &joined).expect_err("the same");
    assert!(problem.contains("is `mN` in the file"), "{problem}");
}

#[test]
fn packed_numbers_are_not_read_as_they_lie_unless_the_map_unpacks_them() {
    let folder = forces(&[("scale_factor", "0.01"), ("add_offset", "5.0")]);
    let problem = planned(folder.path(), &map("unit = \"N\"")).expect_err("packed");
    let remedy = "scale = 0.01, offset = -500.0";
    assert!(problem.contains(remedy), "{problem}");
    let (_, found) = imported_from(
        folder.path(),
        &map(&format!("unit = \"N\", {remedy}")),
        &["Fz"],
    );
    assert_eq!(found[0], ["6.0", "7.0"]);
    let unpacked = forces(&[("scale_factor", "1.0"), ("add_offset", "0")]);
    planned(unpacked.path(), &map("unit = \"N\"")).expect("as they lie");
}

#[test]
fn more_pictures_than_rows_belong_to_nobody_knows_which_unless_the_map_says_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let forces = npy("<f4", "(3,)", &bytes_of(&[1.0, 2.0, 3.0]));
    std::fs::write(folder.path().join("ft.npy"), forces).expect("written");
    // Height, width and number: four pictures of 2 × 3 if the first axis is taken for the number.
    let frames = npy("|u1", "(4, 2, 3)", &[7; 24]);
    std::fs::write(folder.path().join("frames.npy"), frames).expect("written");
    let map = |index: &str| {
        format!(
            "table = \"ft.npy\"\n[frame]\narray = {{ file = \"frames.npy\" }}\n{index}channel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"value\", unit = \"N\" }}\n{NO_TIME}"
        )
    };
    let problem = planned(folder.path(), &map("")).expect_err("which?");
    for word in [
        "frames.npy: 4 pictures for 3 rows",
        "`index = \"row\"` if the first 3",
        "`layout`",
    ] {
        assert!(problem.contains(word), "{word}: {problem}");
    }
    let plan = planned(folder.path(), &map("index = \"row\"\n")).expect("said");
    assert_eq!(plan.summary().unused_frames["frames.npy"], 1);
}

#[test]
fn a_unit_in_the_name_of_a_column_is_held_against_the_map_of_either_version() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("t.csv"), "Fz [mN],n\n1500,0\n").expect("written");
    let map = |unit: &str| {
        format!(
            "table = \"t.csv\"\n[columns]\nFz = {{ from = \"Fz [mN]\", unit = \"{unit}\" }}\n{NO_TIME}"
        )
    };
    let problem = planned(folder.path(), &map("N")).expect_err("a thousand times too much");
    assert!(problem.contains("is `mN` by its name"), "{problem}");
    planned(folder.path(), &map("mN")).expect("as it says");
}

#[test]
fn files_that_are_counted_through_are_refused_where_10_stands_before_2() {
    let folder = tempfile::tempdir().expect("a folder");
    let forces = npy("<f4", "(12,)", &bytes_of(&[1.0; 12]));
    std::fs::write(folder.path().join("ft.npy"), forces).expect("written");
    let map = format!(
        "table = \"ft.npy\"\n[frame]\narray = {{ file = \"frames_*.npy\" }}\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"value\", unit = \"N\" }}\n{NO_TIME}"
    );
    let write = |name: String, level: u8| {
        let frame = npy("|u1", "(1, 1, 2)", &[level; 2]);
        std::fs::write(folder.path().join(name), frame).expect("written");
    };
    for number in 0..12_u8 {
        write(format!("frames_{number}.npy"), number);
    }
    let problem = planned(folder.path(), &map).expect_err("which order?");
    for word in [
        "`frames_*.npy`",
        "frames_11.npy sorts before frames_2.npy",
        "same count of digits",
    ] {
        assert!(problem.contains(word), "{word}: {problem}");
    }
    for number in 0..12_u8 {
        let old = folder.path().join(format!("frames_{number}.npy"));
        std::fs::rename(old, folder.path().join(format!("frames_{number:02}.npy")))
            .expect("renamed");
    }
    planned(folder.path(), &map).expect("padded");
}

/// Folder with a table, and an HDF5 file of two rows of three taxels, whose array has `attributes`.
fn taxels(attributes: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = super::lab(&[("labels.csv", "Fz\n1\n2\n")]);
    let path = folder.path().join("skin.h5");
    let mut writer = Hdf5Writer::create(&path).expect("made");
    writer
        .begin("field", WrittenElement::F32, &[2, 3], attributes)
        .expect("begun");
    for number in 1..=6_u8 {
        writer
            .write(&f32::from(number).to_le_bytes())
            .expect("written");
    }
    writer.finish(&[]).expect("written");
    folder
}

fn taxels_map(from: &str, unit: &str) -> String {
    format!(
        "table = \"labels.csv\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[signals]\nfrom = {from}\nunit = \"{unit}\"\nplaces = [1, 1]\nchannels = [\"x\", \"y\", \"z\"]\n{NO_TIME}"
    )
}

#[test]
fn a_unit_that_an_array_of_taxels_states_is_not_overruled_by_the_map_without_a_word() {
    let from = "{ file = \"skin.h5\", path = \"/field\" }";
    let folder = taxels(&[("units", "mT")]);
    let problem = planned(folder.path(), &taxels_map(from, "uT")).expect_err("a thousand times");
    for word in [
        "skin.h5",
        "`/field`",
        "is `mT` in the file",
        "but `uT` in the map",
        "correct the wrong one",
    ] {
        assert!(problem.contains(word), "{word}: {problem}");
    }
    assert!(!problem.contains("scale = 1"), "{problem}");
    planned(folder.path(), &taxels_map(from, "mT")).expect("as the file says");
    // As columns of the table itself; [signals] has no scale there either.
    let column = taxels_map("\"skin.field\"", "uT")
        + "[[join]]\nname = \"skin\"\ntable = \"skin.h5\"\non = \"row\"\n";
    let problem = planned(folder.path(), &column).expect_err("the same");
    assert!(problem.contains("is `mT` in the file"), "{problem}");
    assert!(!problem.contains("scale = 1"), "{problem}");
}

#[test]
fn packed_numbers_of_taxels_are_refused_with_what_unpacks_them() {
    let folder = taxels(&[("scale_factor", "0.5")]);
    let from = "{ file = \"skin.h5\" }";
    let problem = planned(folder.path(), &taxels_map(from, "uT")).expect_err("packed");
    assert!(
        problem.contains("numbers × 0.5 + 0.0 without these attributes"),
        "{problem}"
    );
    let plain = taxels(&[("scale_factor", "1.0")]);
    planned(plain.path(), &taxels_map(from, "uT")).expect("as they lie");
}

#[test]
fn a_unit_that_a_later_group_states_is_looked_at_as_that_of_the_first() {
    let mut files = vec![
        (
            "run.zarr/.zgroup".to_owned(),
            "{\"zarr_format\": 2}".to_owned(),
        ),
        (
            "run.zarr/data/.zgroup".to_owned(),
            "{\"zarr_format\": 2}".to_owned(),
        ),
    ];
    for (name, unit) in [("a", "N"), ("b", "mN")] {
        let of = |file: &str| format!("run.zarr/data/{name}/{file}");
        let array = "{\"zarr_format\": 2, \"shape\": [1], \"chunks\": [1], \"dtype\": \"|u1\", \"compressor\": null, \"fill_value\": 0, \"order\": \"C\", \"filters\": null}";
        files.push((of(".zgroup"), "{\"zarr_format\": 2}".to_owned()));
        files.push((of("force/.zarray"), array.to_owned()));
        files.push((of("force/.zattrs"), format!("{{\"unit\": \"{unit}\"}}")));
        files.push((of("force/0"), "\u{7}".to_owned()));
    }
    let files: Vec<(&str, &str)> = files
        .iter()
        .map(|(path, text)| (path.as_str(), text.as_str()))
        .collect();
    let folder = super::lab(&files);
    let groups = |unit: &str| {
        map(&format!("unit = \"{unit}\""))
            .replace("\"run.h5\"", "{ file = \"run.zarr\", rows = \"/data/*\" }")
    };
    let problem = planned(folder.path(), &groups("N")).expect_err("the second group");
    assert!(problem.contains("is `mN` in the file"), "{problem}");
    let problem = planned(folder.path(), &groups("mN")).expect_err("the first group");
    assert!(problem.contains("is `N` in the file"), "{problem}");
    let (_, found) = imported_from(
        folder.path(),
        &groups("N").replace("unit = \"N\"", "unit = \"N\", scale = 1"),
        &["Fz"],
    );
    assert_eq!(found[0], ["7.0", "7.0"]);
}

#[test]
fn a_unit_that_the_file_states_of_times_is_not_overruled_in_the_table_or_in_a_joined_one() {
    let folder = super::lab(&[("camera.csv", "t,Fz\n0,1\n0.1,2\n")]);
    let mut writer = Hdf5Writer::create(&folder.path().join("ft.h5")).expect("made");
    for (name, unit, numbers) in [("t", "ms", [0.0_f64, 100.0]), ("f", "N", [3.0, 4.0])] {
        writer
            .begin(name, WrittenElement::F64, &[2], &[("units", unit)])
            .expect("begun");
        for number in numbers {
            writer.write(&number.to_le_bytes()).expect("written");
        }
    }
    writer.finish(&[]).expect("written");
    let own = |unit: &str| {
        format!(
            "table = \"ft.h5\"\n[columns]\nFz = {{ from = \"f\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\ncolumn = \"t\"\nunit = \"{unit}\"\n"
        )
    };
    let joined = |unit: &str| {
        format!(
            "table = \"camera.csv\"\n[columns]\nFz = {{ from = \"ft.f\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\ncolumn = \"t\"\nunit = \"s\"\n[[join]]\nname = \"ft\"\ntable = \"ft.h5\"\ntime = {{ column = \"t\", unit = \"{unit}\" }}\ntolerance_ms = 1e6\nlag_ms = 0\n"
        )
    };
    for map in [own("s"), joined("s")] {
        let problem = planned(folder.path(), &map).expect_err("a thousand times");
        for word in ["column `t`", "is `ms` in the file", "`s` in the map"] {
            assert!(problem.contains(word), "{word}: {problem}");
        }
        assert!(!problem.contains("scale = 1"), "{problem}");
    }
    for map in [own("ms"), joined("ms")] {
        let (_, found) = imported_from(folder.path(), &map, &["Fz"]);
        assert_eq!(found[0], ["3.0", "4.0"]);
    }
}
