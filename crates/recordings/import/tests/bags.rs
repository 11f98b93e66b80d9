//! Tests of ROS recordings in databases and bags, and of Foxglove pictures, drafted and imported by preset.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ImportError, ImportMap, ImportPlan, MapDraft, Preset};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../formats/tables/tests/data")
        .join(name)
}

/// Folder with the recording `name`. A rosbag2 recording has the layout of `ros2 bag record`.
fn lab(name: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let file = Path::new(name).file_name().expect("a name");
    fs::copy(data(name), folder.path().join(file)).expect("copied");
    fs::write(
        folder.path().join("metadata.yaml"),
        "rosbag2_bagfile_information:\n  version: 9\n  storage_identifier: sqlite3\n",
    )
    .expect("written");
    folder
}

/// Imports `columns` by the preset of ROS. Returns their numbers and the summary.
fn by_preset(folder: &Path, columns: &[&str]) -> (Vec<Vec<f64>>, String) {
    let preset = Preset::from_name("rosbag").expect("known");
    let text = preset
        .text(folder)
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(!text.contains("\"?\""), "{text}");
    let map = preset
        .map(folder)
        .unwrap_or_else(|error| panic!("{error}\n{text}"));
    let plan = ImportPlan::new(folder, &map).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let summary = plan.summary().to_string();
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let numbers = columns.iter().map(|column| {
        let cells = dataset.table().as_text(column);
        let cells = cells.unwrap_or_else(|| panic!("no {column}: {text}"));
        let cells = cells.into_iter().flatten();
        cells.map(|cell| cell.parse().expect("a number")).collect()
    });
    (numbers.collect(), summary)
}

#[test]
fn databases_of_rosbag2_and_bags_of_ros_1_are_drafted_and_imported_by_preset() {
    for file in [
        "iron.db3",
        "small_pages.db3",
        "messages.db3",
        "humble.db3",
        "none.bag",
        "lz4.bag",
        "bz2.bag",
    ] {
        let folder = lab(&format!("bags/{file}"));
        let draft = MapDraft::of(folder.path()).expect(file).text().to_owned();
        for line in [
            "# This looks like the layout of `--preset rosbag`",
            "rows = \"/gel/image\"",
            "channel_order = \"bgr\"",
            "Fz = { from = \"ft.wrench.force.z\", unit = \"?\" }",
        ] {
            assert!(draft.contains(line), "{file}: no `{line}` in\n{draft}");
        }
        let (numbers, summary) = by_preset(folder.path(), &["Fx", "Fz", "t_s"]);
        assert_eq!(numbers[0], [0.0, 0.25, 0.5, 0.75], "{file}");
        assert_eq!(numbers[1], [0.0, 1.5, 3.0, 4.5], "{file}");
        assert_eq!(numbers[2].first(), Some(&1_700_000_000.0), "{file}");
        assert!(summary.contains("4 read, 4 kept"), "{file}: {summary}");
        // Joined by time, not by the counter of each publisher.
        assert!(!draft.contains("header.seq = "), "{draft}");
        assert!(!draft.contains("on = {"), "{draft}");
        let is_unread = summary.contains("not read topic /press (4 messages): ");
        assert_eq!(is_unread, file == "humble.db3", "{file}: {summary}");
        assert_eq!(
            draft.contains("# Not read: topic /press"),
            is_unread,
            "{draft}"
        );
    }
}

#[test]
fn pictures_of_foxglove_in_protobuf_are_joined_with_forces_in_json() {
    let folder = lab("mcap/foxglove.mcap");
    // Fz counts up by one, but a wrench holds no counter.
    let (numbers, summary) = by_preset(folder.path(), &["Fx", "Fz"]);
    let expected: Vec<f64> = (0..24).map(|press| 0.1 * f64::from(press)).collect();
    assert_eq!(numbers[0], expected, "{summary}");
    let expected: Vec<f64> = (0..24).map(f64::from).collect();
    assert_eq!(numbers[1], expected, "{summary}");
    assert!(summary.contains("frames   24, colours"), "{summary}");
}

#[test]
fn a_bag_whose_frames_change_and_one_that_is_cut_are_refused_with_the_remedy() {
    let folder = lab("bags/none.bag");
    let path = folder.path().join("none.bag");
    let mut bytes = fs::read(&path).expect("there");
    // Frame name in the last messages, between its length and the following bytes.
    let places: Vec<usize> = (0..bytes.len() - 7)
        .filter(|at| bytes[*at..*at + 7] == *b"\x03\0\0\0gel")
        .collect();
    assert_eq!(places.len(), 16);
    for place in &places[8..] {
        bytes[place + 4..place + 7].copy_from_slice(b"arm");
    }
    fs::write(&path, &bytes).expect("written");
    let map = Preset::from_name("rosbag")
        .expect("known")
        .map(folder.path());
    let problem = ImportPlan::new(folder.path(), &map.expect("a map"));
    let problem = problem.expect_err("two frames").to_string();
    for word in ["`arm`", "`gel`", "frame_id = \"gel\""] {
        assert!(problem.contains(word), "no `{word}` in {problem}");
    }

    fs::write(&path, &bytes[..bytes.len() / 2]).expect("written");
    let draft = MapDraft::of(folder.path()).expect("before the cut");
    let table = "{ file = \"none.bag\", cut = \"?\", rows = \"/ft\" }";
    let draft = draft.text();
    assert!(
        draft.contains(table) && draft.contains("# The recording was cut or not closed."),
        "{draft}"
    );
    assert!(!draft.contains("--preset"), "{draft}");

    let refused = |map: &str| {
        let planned = of_ft(folder.path(), map);
        planned.expect_err("refused").to_string()
    };
    let problem = refused("rows = \"/ft\"");
    for word in [
        "none.bag",
        "complete messages are before the cut",
        "rosbag reindex",
        "`cut = \"keep\"`",
    ] {
        assert!(problem.contains(word), "no `{word}` in {problem}");
    }
    assert_eq!(refused("cut = \"refuse\", rows = \"/ft\""), problem);
    let open = refused("cut = \"?\", rows = \"/ft\"");
    assert!(open.contains("`cut = \"?\"`, expected \"keep\""), "{open}");
}

/// Plan of an import of the forces in `none.bag`. `keys` are further keys of `table` in the map.
fn of_ft(folder: &Path, keys: &str) -> Result<ImportPlan, ImportError> {
    let map = format!(
        "map_version = 2\ntable = {{ file = \"none.bag\", {keys} }}\n[columns]\nFz = {{ from = \"wrench.force.z\", unit = \"N\" }}\n\
         [time]\nclock = \"unknown\"\n\
         [sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n"
    );
    ImportPlan::new(folder, &ImportMap::parse("map.toml".as_ref(), &map)?)
}

#[test]
fn messages_before_a_cut_are_imported_by_a_key_of_the_map_with_a_warning() {
    let folder = lab("bags/none.bag");
    let path = folder.path().join("none.bag");
    let bytes = fs::read(&path).expect("there");
    fs::write(&path, &bytes[..bytes.len() * 2 / 3]).expect("written");
    let plan = of_ft(folder.path(), "rows = \"/ft\", cut = \"keep\"").expect("a plan");
    let rows = plan.summary().rows_kept;
    assert!((1..8).contains(&rows), "{rows}");
    let warnings: Vec<String> = plan
        .summary()
        .warnings
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(
        warnings[0].starts_with("cut-recording: none.bag was cut or not closed: its "),
        "{warnings:?}"
    );
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    assert_eq!(dataset.header().warnings, warnings);
    let forces: Vec<f64> = dataset
        .table()
        .as_text("Fz")
        .expect("a column")
        .into_iter()
        .flatten()
        .map(|cell| cell.parse().expect("a number"))
        .collect();
    let whole = [0.0, 1.0, 1.5, 2.5, 3.0, 4.0, 4.5, 5.5];
    assert_eq!(forces, whole[..forces.len()]);
    assert_eq!(forces.len() as u64, rows);
    // For a complete recording the key makes no difference.
    fs::write(&path, &bytes).expect("written");
    let plan = of_ft(folder.path(), "rows = \"/ft\", cut = \"keep\"").expect("a plan");
    assert_eq!(plan.summary().rows_kept, 8);
    assert!(plan.summary().warnings.is_empty());
}

#[test]
fn the_key_of_a_cut_is_for_recordings_of_messages_alone() {
    let map = "map_version = 2\ntable = { file = \"a.csv\", cut = \"keep\" }\n[columns]\nFz = { from = \"Fz\", unit = \"N\" }\n\
               [time]\nclock = \"unknown\"\n\
               [sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n";
    let problem = ImportMap::parse("map.toml".as_ref(), map).expect_err("refused");
    let problem = problem.to_string();
    assert!(
        problem.contains("`cut` applies to recordings of messages only"),
        "{problem}"
    );
}
