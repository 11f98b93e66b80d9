//! Tests of arrays as tables and as frames, and of the messages about rejected arrays.

use super::{FACTS, NO_TIME, planned};
use taceva_dataset::Dataset;
use taceva_import::{ImportMap, ImportPlan};

/// NumPy file of version 1.
pub(super) fn npy(kind: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    let length = u16::try_from(header.len()).expect("short");
    [
        b"\x93NUMPY\x01\x00",
        &length.to_le_bytes()[..],
        header.as_bytes(),
        data,
    ]
    .concat()
}

pub(super) fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect()
}

/// Folder with a file of two forces and a file of the frames `frames`.
fn lab(frames: &[u8]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let forces = npy("<f4", "(2,)", &bytes_of(&[1.0, 2.0]));
    std::fs::write(folder.path().join("ft.npy"), forces).expect("written");
    std::fs::write(folder.path().join("frames.npy"), frames).expect("written");
    folder
}

fn map(frame: &str) -> String {
    format!(
        "table = \"ft.npy\"\n[frame]\n{frame}\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"value\", unit = \"N\" }}\n{NO_TIME}"
    )
}

/// Error of planning or running an import of `frames`, with the lines `frame` in the map.
fn problem(frames: &[u8], frame: &str) -> String {
    let folder = lab(frames);
    let plan = match planned(folder.path(), &map(frame)) {
        Err(problem) => return problem,
        Ok(plan) => plan,
    };
    let target = folder.path().join("dataset");
    let outcome = plan.run(
        &target,
        std::num::NonZeroUsize::MIN,
        &taceva_core::SilentProgress,
    );
    assert!(!target.exists(), "nothing is left");
    outcome.expect_err("refused").to_string()
}

#[test]
fn numbers_become_pixels_by_the_range_that_the_map_states() {
    let frames = npy("<f4", "(2, 1, 2)", &bytes_of(&[0.0, 1.0, 0.5, 0.25]));
    let folder = lab(&frames);
    let text = map("array = { file = \"frames.npy\" }\nrange = [1, 0]\nbits = 16");
    let plan = planned(folder.path(), &text).expect("planned");
    let target = folder.path().join("dataset");
    plan.run(
        &target,
        std::num::NonZeroUsize::MIN,
        &taceva_core::SilentProgress,
    )
    .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let frame = dataset.table().frames()[1].clone().expect("a frame");
    let picture = image::open(target.join(frame.path))
        .expect("a picture")
        .into_luma16();
    // Black and full scale are exchanged: halves are rounded away from zero.
    assert_eq!(picture.into_raw(), [32_768, 49_151]);
}

#[test]
fn a_number_outside_of_the_range_and_one_that_is_none_name_their_frame() {
    for (last, named) in [(1.5, "1.5"), (f32::NAN, "NaN"), (-0.1, "-0.1")] {
        let frames = npy("<f4", "(2, 1, 1)", &bytes_of(&[0.0, last]));
        let problem = problem(
            &frames,
            "array = { file = \"frames.npy\" }\nrange = [0, 1]\nbits = 8",
        );
        assert!(
            problem.contains("ft.npy, row 1, column `the row of its table`"),
            "{problem}"
        );
        assert!(problem.contains("frame 1: "), "{problem}");
        assert!(
            problem.contains(named) && problem.contains("outside of `range = [0, 1]`"),
            "{problem}"
        );
    }
}

#[test]
fn what_is_no_array_of_frames_is_refused_in_words() {
    let in_file = "array = { file = \"frames.npy\" }";
    for (frames, frame, expected) in [
        (
            npy("<f4", "(2, 1, 1)", &[0; 8]),
            in_file,
            "write `range = [BLACK, FULL]`",
        ),
        (
            npy("|u1", "(2,)", &[0; 2]),
            in_file,
            "shape (2), expected (n, height, width)",
        ),
        (
            npy("|u1", "(2, 2, 1, 4)", &[0; 16]),
            in_file,
            "expected (n, height, width)",
        ),
        (
            npy("|u1", "(2, 3, 2, 2)", &[0; 24]),
            in_file,
            "write `layout = \"nchw\"`",
        ),
        (
            npy("|u1", "(1, 1, 1)", &[0]),
            in_file,
            "no frame 1: there are 1, counted from 0",
        ),
        (npy("|u1", "(2, 1, 0)", &[]), in_file, "expected sides"),
        (npy("|u1", "(2, 2, 2)", &[0; 7]), in_file, "frames.npy"),
        (
            npy("|u1", "(2, 1, 1, 3)", &[0; 6]),
            in_file,
            "channel order `gray` is declared",
        ),
        (
            npy("|u1", "(2, 1, 1)", &[0; 2]),
            "array = \"frames\"",
            "no array `frames` of frames in",
        ),
        (
            npy("|u1", "(2, 1, 1)", &[0; 2]),
            "array = { file = \"absent.npy\" }",
            "no such file",
        ),
        (
            npy("|u1", "(2, 1, 1)", &[0; 2]),
            "bytes = \"value\"",
            "expected encoded pictures",
        ),
    ] {
        let problem = problem(&frames, frame);
        assert!(problem.contains(expected), "{frame}: {problem}");
    }
}

#[test]
fn keys_of_frames_that_do_not_go_together_name_their_line() {
    for (frame, expected) in [
        (
            "array = { file = \"frames.npy\" }\nrange = [0, 1]",
            "invalid `range` or `bits`",
        ),
        (
            "array = { file = \"frames.npy\" }\nrange = [1, 1]\nbits = 8",
            "invalid `range` or `bits`",
        ),
        (
            "array = { file = \"frames.npy\" }\nrange = [0, 1]\nbits = 12",
            "invalid `range` or `bits`",
        ),
        (
            "column = \"value\"\nlayout = \"nchw\"",
            "`layout` needs an `array`",
        ),
        (
            "bytes = \"value\"\nrange = [0, 1]\nbits = 8",
            "or a depth map as `video`",
        ),
        (
            "bytes = \"value\"\nindex = \"row\"",
            "expected one key for the frames",
        ),
        (
            "array = { file = \"../frames.npy\" }",
            "contains `..`, expected a path inside the folder",
        ),
    ] {
        let text = format!("map_version = 2\n{}\n{FACTS}", map(frame));
        let error = ImportMap::parse("map.toml".as_ref(), &text).expect_err(frame);
        let error = error.to_string();
        assert!(
            error.contains("map.toml, line 3") && error.contains(expected),
            "{frame}: {error}"
        );
    }
}

#[test]
fn a_table_of_arrays_has_the_rows_that_most_of_them_have() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.path().join(name), bytes).expect("written")
    };
    write(
        "ft.npy",
        &npy("<f4", "(2, 3)", &bytes_of(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])),
    );
    let text = format!(
        "table = \"ft.npy\"\n[columns]\nFz = {{ from = \"value[2]\", unit = \"N\" }}\nFx = {{ from = \"value[3]\", unit = \"N\" }}\n{NO_TIME}"
    );
    let problem = planned(folder.path(), &text).expect_err("three of four");
    assert!(
        problem.contains("row 0, column `value`: there is no value [3] among the 3"),
        "{problem}"
    );
    let text = format!(
        "map_version = 2\n{}\n{FACTS}",
        text.replace("value[3]", "force[0]")
    );
    let map = ImportMap::parse("map.toml".as_ref(), &text).expect("a map");
    let problem = ImportPlan::new(folder.path(), &map)
        .expect_err("no such column")
        .to_string();
    assert!(
        problem.contains("no column `force`") && problem.contains("the columns are value"),
        "{problem}"
    );
}

#[test]
fn a_column_called_row_does_not_say_which_picture_a_row_has() {
    let folder = lab(&npy("|u1", "(2, 1, 1)", &[10, 20]));
    std::fs::write(folder.path().join("l.csv"), "Fz,row\n1,1\n2,0\n").expect("written");
    let map = |index: &str| {
        format!(
            "table = \"l.csv\"\n[frame]\narray = {{ file = \"frames.npy\" }}\n{index}channel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
        )
    };
    for (name, index, expected) in [
        ("own", "", [10, 20]),
        ("named", "index = \"row\"\n", [20, 10]),
    ] {
        let target = folder.path().join(name);
        let plan = planned(folder.path(), &map(index)).expect("planned");
        plan.run(
            &target,
            std::num::NonZeroUsize::MIN,
            &taceva_core::SilentProgress,
        )
        .expect("imported");
        let dataset = Dataset::open(&target).expect("opens");
        let pixels = [0, 1].map(|row| {
            let frame = dataset.frame(row).expect("read").expect("a frame");
            frame.bytes()[0]
        });
        assert_eq!(pixels, expected, "{name}");
    }
}

/// Three recordings of two rows, each with a separate array, and one array with all six pictures. Recording 2 has the pictures 20 and 21.
fn recordings() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let mut all = Vec::new();
    for run in 0..3_u8 {
        let at = folder.path().join(format!("s{run}"));
        std::fs::create_dir(&at).expect("made");
        let first = 2 * run;
        let labels = format!("Fz,k\n{run},{first}\n{run},{}\n", first + 1);
        std::fs::write(at.join("labels.csv"), labels).expect("written");
        let pixels = [10 * run, 10 * run + 1];
        std::fs::write(at.join("frames.npy"), npy("|u1", "(2, 1, 1)", &pixels)).expect("written");
        all.extend(pixels);
    }
    let all = npy("|u1", "(6, 1, 1)", &all);
    std::fs::write(folder.path().join("all.npy"), all).expect("written");
    folder
}

fn map_of_recordings(array: &str) -> String {
    format!(
        "table = \"s*/labels.csv\"\n[path]\npattern = \"s{{s:digits}}/labels.csv\"\n[frame]\narray = {{ file = \"{array}\" }}\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
    )
}

#[test]
fn an_array_that_several_tables_share_without_an_index_is_refused_and_not_begun_anew() {
    let folder = recordings();
    let by_row = |map: String| map.replace("channel_order", "index = \"row\"\nchannel_order");
    for (array, map) in [
        ("all.npy", map_of_recordings("all.npy")),
        ("s*/frames.npy", map_of_recordings("s*/frames.npy")),
        // Explicit row number.
        ("all.npy", by_row(map_of_recordings("all.npy"))),
    ] {
        let problem = planned(folder.path(), &map).expect_err(array);
        for expected in [
            "s1/labels.csv, line 2",
            array,
            "`array`",
            "s0/labels.csv, and each",
            "each of the 3 tables would start again at the first picture",
            "`index = \"COLUMN\"`",
            "`{path.NAME}`",
        ] {
            assert!(problem.contains(expected), "{expected}: {problem}");
        }
    }
}

#[test]
fn pictures_that_are_called_by_the_row_belong_to_one_table_alone() {
    let folder = recordings();
    std::fs::create_dir(folder.path().join("images")).expect("made");
    for number in 0..6_u8 {
        image::GrayImage::from_pixel(2, 2, image::Luma([number]))
            .save(folder.path().join(format!("images/{number}.png")))
            .expect("saved");
    }
    let map = |pattern: &str| {
        map_of_recordings("all.npy").replace(
            "array = { file = \"all.npy\" }",
            &format!("pattern = \"{pattern}\"\nfolder = \"images\""),
        )
    };
    let problem = planned(folder.path(), &map("{row}.png")).expect_err("refused");
    for expected in [
        "s1/labels.csv, line 2",
        "`images/0.png`",
        "already the picture of a row of s0/labels.csv",
        "`row` in `pattern` starts anew in each of the 3 tables",
    ] {
        assert!(problem.contains(expected), "{expected}: {problem}");
    }
    let padded = planned(folder.path(), &map("{row:01}.png")).expect_err("refused");
    assert!(padded.contains("starts anew in each"), "{padded}");
    // A column counts across all tables.
    planned(folder.path(), &map("{k}.png")).expect("planned");
}

#[test]
fn each_of_several_tables_has_the_array_beside_it_or_counts_through_one_of_all() {
    let folder = recordings();
    let own = map_of_recordings("s{path.s}/frames.npy");
    let counted =
        map_of_recordings("all.npy").replace("channel_order", "index = \"k\"\nchannel_order");
    let through =
        map_of_recordings("s*/frames.npy").replace("channel_order", "index = \"k\"\nchannel_order");
    for (name, map) in [("own", own), ("counted", counted), ("through", through)] {
        let target = folder.path().join(name);
        let plan = planned(folder.path(), &map).expect(name);
        plan.run(
            &target,
            std::num::NonZeroUsize::MIN,
            &taceva_core::SilentProgress,
        )
        .expect("imported");
        let dataset = Dataset::open(&target).expect("opens");
        let pixels = [0, 1, 2, 3, 4, 5].map(|row| {
            let frame = dataset.frame(row).expect("read").expect("a frame");
            frame.bytes()[0]
        });
        assert_eq!(pixels, [0, 1, 10, 11, 20, 21], "{name}");
    }
}
