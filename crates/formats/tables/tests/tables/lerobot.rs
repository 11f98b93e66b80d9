//! Tests of LeRobot folders. The package `lerobot` wrote some, and `make.py` others from the documented layout.

use std::path::Path;

use crate::recordings::{expected, number, recording};
use taceva_tables::{Cell, LeRobot, TableError};

const KEY: &str = "observation.images.tactile";

fn integers(column: &[Cell]) -> Vec<i128> {
    let integer = |cell: &Cell| match cell {
        Cell::Integer(value) => *value,
        other => panic!("{other:?}"),
    };
    column.iter().map(integer).collect()
}

#[test]
fn a_dataset_of_the_package_has_its_rows_tasks_and_frames() {
    let dataset = LeRobot::open(&recording("lerobot-v3-h264")).expect("opens");
    let expected = expected("lerobot-v3-h264");
    assert_eq!(dataset.rows(), 24);
    assert_eq!(
        dataset.names(),
        [
            "observation.state",
            "action",
            "timestamp",
            "frame_index",
            "episode_index",
            "index",
            "task_index",
            "task"
        ]
    );
    let episodes = integers(&dataset.column("episode_index").expect("a column"));
    let times = dataset.column("timestamp").expect("a column");
    let tasks = dataset.column("task").expect("a column");
    for row in [0, 7, 23] {
        let labels = &expected["labels"][row.to_string()];
        for (at, channel) in ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"].iter().enumerate() {
            let column = dataset
                .column(&format!("observation.state[{at}]"))
                .expect("a column");
            assert_eq!(column[row], Cell::Number(number(&labels[channel])));
            // A map reads this text. No digit may be missing.
            assert_eq!(column[row].text().parse(), Ok(number(&labels[channel])));
        }
        assert_eq!(
            i128::from(labels["episode_index"].as_i64().expect("a number")),
            episodes[row]
        );
        assert_eq!(times[row], Cell::Number(number(&labels["t_s"])));
        assert_eq!(tasks[row].text(), ["press cube", "press ball"][row / 6 % 2]);
    }
    let frames = dataset.video(KEY).expect("a video");
    let file = Path::new("videos/observation.images.tactile/chunk-000/file-000.mp4");
    for row in 0..24 {
        assert_eq!(frames.at(row), Some((file, row)));
    }
    assert_eq!((frames.at(24), frames.files().len()), (None, 1));
    let feature = dataset
        .features()
        .iter()
        .find(|feature| feature.name == KEY)
        .expect("listed");
    assert_eq!(
        (feature.dtype.as_str(), feature.shape.as_slice()),
        ("video", &[48, 64, 3][..])
    );
    assert!((feature.fps - 30.0).abs() < f64::EPSILON);
}

#[test]
fn version_2_1_has_a_file_an_episode() {
    let dataset = LeRobot::open(&recording("lerobot-v2.1")).expect("opens");
    assert_eq!(dataset.rows(), 9);
    assert_eq!(
        integers(&dataset.column("index").expect("a column")),
        (0..9).collect::<Vec<_>>()
    );
    assert_eq!(
        integers(&dataset.column("episode_index").expect("a column")),
        [0, 0, 0, 1, 1, 2, 2, 2, 2]
    );
    assert_eq!(
        dataset.column("observation.state[1]").expect("a column")[8],
        Cell::Number(2.75)
    );
    let tasks: Vec<String> = dataset
        .column("task")
        .expect("a column")
        .iter()
        .map(|task| task.text().into_owned())
        .collect();
    assert_eq!(
        tasks[2..5],
        ["press the cube", "press the ball", "press the ball"]
    );
    let frames = dataset.video("observation.images.gel").expect("a video");
    let name = |chunk: u32, episode: u32| {
        format!("videos/chunk-{chunk:03}/observation.images.gel/episode_{episode:06}.mp4")
    };
    for (row, file, frame) in [
        (0, name(0, 0), 0),
        (2, name(0, 0), 2),
        (3, name(0, 1), 0),
        (5, name(1, 2), 0),
        (8, name(1, 2), 3),
    ] {
        assert_eq!(frames.at(row), Some((file.as_ref(), frame)));
    }
}

/// Visits the pictures of `rows`. Returns each row with the brightness of its picture, as `make.py` draws it.
fn red(dataset: &LeRobot, rows: &[u64]) -> Vec<(u64, u8)> {
    let mut seen = Vec::new();
    dataset
        .visit_bytes::<TableError>("observation.images.tip", rows, &mut |row, bytes| {
            let picture = image::load_from_memory(&bytes.expect("a picture"))
                .expect("PNG")
                .into_rgb8();
            seen.push((row, picture.get_pixel(3, 2).0[0]));
            Ok(())
        })
        .expect("pictures");
    seen
}

#[test]
fn pictures_in_the_data_files_are_found_by_the_row_of_the_dataset() {
    let v21 = LeRobot::open(&recording("lerobot-v2.1")).expect("opens");
    assert_eq!(
        red(&v21, &[0, 2, 4, 4, 8]),
        [(0, 0), (2, 2), (4, 11), (4, 11), (8, 23)]
    );
    let v30 = LeRobot::open(&recording("lerobot-v3-files")).expect("opens");
    assert_eq!(
        red(&v30, &[1, 4, 5, 8, 9, 11]),
        [(1, 1), (4, 11), (5, 20), (8, 23), (9, 30), (11, 41)]
    );
}

#[test]
fn files_of_data_and_of_videos_are_cut_at_different_places() {
    let dataset = LeRobot::open(&recording("lerobot-v3-files")).expect("opens");
    assert_eq!(dataset.rows(), 12);
    assert_eq!(
        integers(&dataset.column("index").expect("a column")),
        (0..12).collect::<Vec<_>>()
    );
    assert_eq!(
        dataset.column("task").expect("a column")[9].text(),
        "press the ball"
    );
    let frames = dataset.video("observation.images.gel").expect("a video");
    let places: Vec<(usize, u64)> = (0..12)
        .map(|row| {
            let (file, frame) = frames.at(row).expect("a frame");
            (
                frames
                    .files()
                    .iter()
                    .position(|known| known == file)
                    .expect("listed"),
                frame,
            )
        })
        .collect();
    let expected = [
        (0, 0),
        (0, 1),
        (0, 2),
        (1, 0),
        (1, 1),
        (1, 2),
        (1, 3),
        (1, 4),
        (1, 5),
        (1, 6),
        (2, 0),
        (2, 1),
    ];
    assert_eq!(places, expected);
    assert_eq!(
        frames.files()[2],
        Path::new("videos/observation.images.gel/chunk-001/file-000.mp4")
    );
}

/// Opens a copy of the recording `name` that `change` has modified.
fn changed(name: &str, change: impl FnOnce(&Path)) -> Result<LeRobot, TableError> {
    let folder = tempfile::tempdir().expect("a folder");
    crate::recordings::damage::copy(&recording(name), folder.path());
    change(folder.path());
    LeRobot::open(folder.path())
}

fn replace(file: &Path, from: &str, to: &str) {
    let text = std::fs::read_to_string(file).expect("readable");
    assert!(text.contains(from));
    std::fs::write(file, text.replace(from, to)).expect("written");
}

#[test]
fn other_layouts_and_ways_out_of_the_folder_are_refused_in_words() {
    let info = |from: &'static str, to: &'static str| {
        let opened = changed("lerobot-v2.1", |folder| {
            replace(&folder.join("meta/info.json"), from, to)
        });
        opened.expect_err(to).to_string()
    };
    let message = info("v2.1", "v1.6");
    assert!(
        message.contains("`codebase_version`: version `v1.6`, expected v2.1 or v3.0"),
        "{message}"
    );
    assert!(
        info("\"data/chunk", "\"../data/chunk")
            .contains("not a pattern of paths inside the folder")
    );
    assert!(
        info("{episode_chunk:03d}/episode", "{chunk:03d}/episode")
            .contains("unknown field `chunk` in a path pattern")
    );
    assert!(info("\"fps\": 10", "\"fps\": 0").contains("frames per second"));
    let missing = changed("lerobot-v2.1", |folder| {
        std::fs::remove_file(folder.join("data/chunk-000/episode_000001.parquet"))
            .expect("removed");
    });
    assert!(
        missing
            .expect_err("missing")
            .to_string()
            .contains("episode_000001.parquet")
    );
    let dataset = LeRobot::open(&recording("lerobot-v2.1")).expect("opens");
    let message = dataset
        .video("observation.images.tip")
        .expect_err("an image")
        .to_string();
    assert!(
        message.contains("no `observation.images.tip`, expected one of observation.images.gel"),
        "{message}"
    );
    let message = dataset
        .column("observation.force")
        .expect_err("none")
        .to_string();
    assert!(message.contains("no `observation.force`"), "{message}");
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_out_of_the_folder_is_refused() {
    let outside = recording("lerobot-v2.1").join("data/chunk-000/episode_000001.parquet");
    let linked = changed("lerobot-v2.1", |folder| {
        let file = folder.join("data/chunk-000/episode_000001.parquet");
        std::fs::remove_file(&file).expect("removed");
        std::os::unix::fs::symlink(outside, file).expect("linked");
    });
    let message = linked.expect_err("a link").to_string();
    assert!(
        message.contains("a link leads outside the folder"),
        "{message}"
    );
}

#[test]
fn an_episode_of_other_rows_than_its_description_says_is_refused_with_both_counts() {
    for (from, to, words) in [
        (
            "[\"press the cube\"], \"length\": 3",
            "[\"press the cube\"], \"length\": 4",
            "episode 0 has 3 rows, but its description states 4",
        ),
        (
            "\"length\": 2",
            "\"length\": 1",
            "episode 1 has 2 rows, but its description states 1",
        ),
    ] {
        let opened = changed("lerobot-v2.1", |folder| {
            replace(&folder.join("meta/episodes.jsonl"), from, to);
        });
        let message = opened.expect_err("two counts").to_string();
        assert!(message.contains(words), "{message}");
        assert!(message.contains("episodes.jsonl"), "{message}");
    }
    // A description without lengths is accepted.
    let opened = changed("lerobot-v2.1", |folder| {
        let file = folder.join("meta/episodes.jsonl");
        let text = std::fs::read_to_string(&file).expect("readable");
        std::fs::write(&file, text.replace("\"length\"", "\"rows\"")).expect("written");
    });
    assert_eq!(opened.expect("opens").rows(), 9);
}

#[test]
fn a_depth_map_without_parameters_is_refused_as_pictures() {
    for (from, to) in [
        (
            "\"video.is_depth_map\": false",
            "\"video.is_depth_map\": true",
        ),
        ("\"video.is_depth_map\": false", "\"is_depth_map\": true"),
    ] {
        let dataset = changed("lerobot-v3-h264", |folder| {
            replace(&folder.join("meta/info.json"), from, to);
        });
        let dataset = dataset.expect("its other columns are read");
        let depths: Vec<bool> = dataset
            .features()
            .iter()
            .filter(|feature| feature.name == KEY)
            .map(|feature| feature.is_depth)
            .collect();
        assert_eq!(depths, [true]);
        let message = dataset.video(KEY).expect_err("depths").to_string();
        assert!(
            message.contains("`video.depth_min`") && message.contains(KEY),
            "{message}"
        );
    }
}
