//! Tests of rosbag2 databases and ROS 1 bags: every message must equal the message that `tests/data/bags/make.py` wrote.

use std::fs;
use std::path::{Path, PathBuf};

use taceva_tables::{Cell, Picture, Recording, SampleForm, TableError, TopicTable};

/// Recordings with the definitions of their messages.
const WHOLE: [&str; 6] = [
    "iron.db3",
    "small_pages.db3",
    "messages.db3",
    "none.bag",
    "lz4.bag",
    "bz2.bag",
];

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/bags")
        .join(name)
}

fn table(file: &str, topic: &str) -> TopicTable {
    let recording = Recording::open(&data(file)).expect(file);
    recording.table(topic).expect(file)
}

fn numbers(column: &[Cell]) -> Vec<f64> {
    let number = |cell: &Cell| match cell {
        Cell::Number(number) => *number,
        other => panic!("{other:?}"),
    };
    column.iter().map(number).collect()
}

/// Reads all messages of the recording at `path`, up to the first error.
fn read_all(path: &Path) -> Result<usize, TableError> {
    let recording = Recording::open(path)?;
    let mut cells = 0;
    for topic in recording.topics() {
        let Ok(table) = recording.table(&topic.name) else {
            continue;
        };
        let names = table.names()?;
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        cells += table.columns(&names)?.iter().map(Vec::len).sum::<usize>();
        if names.contains(&"encoding") {
            let rows: Vec<u64> = (0..table.rows()).collect();
            table.visit_pictures::<TableError>("data", &rows, &mut |_, _| Ok(()))?;
        }
    }
    Ok(cells)
}

#[test]
fn wrenches_presses_and_pictures_are_those_that_were_written() {
    for file in WHOLE {
        let recording = Recording::open(&data(file)).expect(file);
        let topics: Vec<_> = recording
            .topics()
            .iter()
            .map(|topic| (topic.name.as_str(), topic.count))
            .collect();
        assert_eq!(
            topics,
            [("/ft", 8), ("/gel/image", 4), ("/press", 4)],
            "{file}"
        );
        let force = table(file, "/ft");
        let columns = force
            .columns(&[
                "wrench.force.x",
                "wrench.force.z",
                "wrench.torque.z",
                "header.stamp.ns",
                "log_time.ns",
                "header.frame_id",
            ])
            .expect(file);
        for (row, half) in (0..8).map(|row| (row, row % 2)) {
            let press = (row / 2) as f64;
            assert_eq!(columns[0][row], Cell::Number(0.25 * press), "{file}");
            assert_eq!(columns[1][row], Cell::Number(1.5 * press + half as f64));
            assert_eq!(columns[2][row], Cell::Number(0.01 * press));
            let stamp = 1_700_000_000_000_000_000 + 20_000_000 * row as i128;
            assert_eq!(columns[3][row], Cell::Integer(stamp), "{file}");
            assert_eq!(columns[4][row], Cell::Integer(stamp + 1_000_000), "{file}");
            assert_eq!(columns[5][row], Cell::Text("gel".to_owned()));
        }
        let press = table(file, "/press");
        let columns = press
            .columns(&["depth", "tool", "flags[0]", "flags"])
            .expect(file);
        assert_eq!(numbers(&columns[0]), [0.0, 0.1, 0.2, 0.1 * 3.0], "{file}");
        assert_eq!(columns[1][3], Cell::Text("ball 3".to_owned()));
        assert_eq!(columns[2][..2], [Cell::Bool(true), Cell::Bool(false)]);
        let mut rows = Vec::new();
        let pictures = table(file, "/gel/image");
        pictures
            .visit_pictures::<TableError>("data", &[0, 3], &mut |row, picture| {
                let Picture::Samples(samples) = picture else {
                    panic!("{file}")
                };
                assert_eq!((samples.width, samples.height), (40, 36));
                assert_eq!(samples.form, SampleForm::Bgr8);
                let level = u8::try_from(3 * row).expect("small");
                assert_eq!(samples.bytes[..3], [level; 3]);
                let pressed = (5 * 40 + usize::try_from(row).expect("small")) * 3;
                assert_eq!(samples.bytes[pressed..pressed + 3], [10, 120, 230]);
                rows.push(row);
                Ok(())
            })
            .expect(file);
        assert_eq!(rows, [0, 3]);
    }
}

#[test]
fn messages_that_every_ros_2_has_are_read_without_their_definitions_and_those_of_a_lab_are_named() {
    let recording = Recording::open(&data("humble.db3")).expect("opens");
    let force = recording.table("/ft").expect("known");
    let z = force.column("wrench.force.z").expect("there");
    assert_eq!(numbers(&z), [0.0, 1.0, 1.5, 2.5, 3.0, 4.0, 4.5, 5.5]);
    assert_eq!(recording.table("/gel/image").expect("known").rows(), 4);
    assert_eq!(recording.why_unread("/ft"), None);
    let problem = recording.table("/press").expect_err("of a lab").to_string();
    for word in ["lab_msgs/msg/Press", "ROS 2 Iron", "ros2 bag convert"] {
        assert!(problem.contains(word), "no `{word}` in {problem}");
    }
}

#[track_caller]
fn refused(path: &Path, words: &[&str]) {
    let problem = read_all(path).expect_err("refused").to_string();
    for word in words {
        assert!(problem.contains(word), "no `{word}` in {problem}");
    }
}

#[test]
fn logs_beside_a_database_are_refused_with_the_command_that_takes_them_in() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.db3");
    fs::copy(data("iron.db3"), &path).expect("copied");
    let log = folder.path().join("run.db3-wal");
    fs::write(&log, "").expect("written");
    assert!(read_all(&path).is_ok());
    fs::write(&log, "x").expect("written");
    refused(
        &path,
        &[
            "`run.db3-wal`",
            "write-ahead log",
            "PRAGMA journal_mode = DELETE",
        ],
    );
    fs::remove_file(&log).expect("removed");
    let journal = folder.path().join("run.db3-journal");
    fs::write(&journal, [0; 512]).expect("written");
    assert!(read_all(&path).is_ok());
    fs::write(&journal, [0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7]).expect("written");
    refused(&path, &["`run.db3-journal`", "rollback journal"]);
}

#[test]
fn bags_of_other_versions_and_forms_are_refused_with_what_mends_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("written");
        path
    };
    let packed = fs::read(data("bz2.bag")).expect("there");
    let place = packed
        .windows(15)
        .position(|part| part == b"compression=bz2");
    let mut other = packed.clone();
    let place = place.expect("there") + 12;
    other[place..place + 3].copy_from_slice(b"xz9");
    refused(
        &at("xz.bag", &other),
        &[
            "compressed by `xz9`",
            "none, lz4 or bz2",
            "rosbag decompress",
        ],
    );
    refused(
        &at("a.bag", b"#ROSBAG V1.2\n01234567"),
        &["another version than 2.0", "rosbag fix"],
    );
    refused(
        &at("a.mcap.zstd", &[0x28, 0xb5, 0x2f, 0xfd, 0, 0, 0, 0, 0]),
        &["the whole file is compressed", "zstd -d"],
    );
    refused(&at("a.db3", b"no recording at all"), &["not a recording"]);
    refused(&at("empty.mcap", b""), &["not a recording"]);

    // One word of the database differs: the version of the schema, a column of topics.
    let iron = fs::read(data("iron.db3")).expect("there");
    let with = |old: &[u8], new: &[u8]| {
        let mut bytes = iron.clone();
        let found = bytes.windows(old.len()).position(|part| part == old);
        let found = found.expect("there");
        bytes[found..found + old.len()].copy_from_slice(new);
        bytes
    };
    let newer = with(b"offered_qos_profiles", b"offered_qos_overview");
    refused(
        &at("newer.db3", &newer),
        &["offered_qos_overview", "ros2 bag convert"],
    );
    // The only row of the table `schema`, whose number is its version.
    let later = with(b"\x04\x03\0\x1brosbags", b"\x05\x03\0\x1brosbags");
    refused(
        &at("later.db3", &later),
        &[
            "rosbag2 schema version 5",
            "up to 4 are read",
            "ros2 bag convert",
        ],
    );
    let newer = with(b"CREATE TABLE metadata", b"CREATE TABLE metaDATA");
    assert!(read_all(&at("same.db3", &newer)).is_ok());

    let whole = fs::read(data("none.bag")).expect("there");
    for cut in [whole.len() / 3, whole.len() - 9] {
        refused(
            &at("cut.bag", &whole[..cut]),
            &[
                "cut short",
                "rosbag reindex",
                "complete messages are before the cut",
            ],
        );
    }
    // A killed recorder does not write the start of the index.
    let place = whole
        .windows(10)
        .position(|part| part == b"index_pos=")
        .expect("there");
    let mut open = whole;
    open[place + 10..place + 18].fill(0);
    refused(
        &at("open.bag", &open),
        &[
            "not close the bag",
            "rosbag reindex",
            "16 complete messages",
        ],
    );
}

#[test]
fn a_cut_bag_states_how_many_messages_are_whole_before_its_cut() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("cut.bag");
    let counted = |bytes: &[u8]| {
        fs::write(&path, bytes).expect("written");
        let problem = read_all(&path).expect_err("cut").to_string();
        let words = problem.split(" complete message").next();
        let number = words.and_then(|words| words.rsplit([' ', '(']).next()?.parse::<u64>().ok());
        number.unwrap_or_else(|| panic!("{problem}"))
    };
    for (file, is_by_chunk) in [("none.bag", false), ("lz4.bag", true), ("bz2.bag", true)] {
        let whole = fs::read(data(file)).expect("there");
        let mut before = 0;
        let mut steps = std::collections::BTreeSet::new();
        for cut in (whole.len() / 8..whole.len() - 1).step_by(61) {
            let messages = counted(&whole[..cut]);
            assert!(
                (before..=16).contains(&messages),
                "{file} cut at {cut}: {messages} after {before}"
            );
            before = messages;
            steps.insert(messages);
        }
        assert_eq!(before, 16, "{file}");
        // Messages of an uncompressed chunk are counted one by one.
        assert!(is_by_chunk || steps.len() > 8, "{file}: {steps:?}");
    }
}

#[test]
fn pages_that_lead_to_one_another_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("loop.db3");
    let whole = fs::read(data("small_pages.db3")).expect("there");
    // Every interior page of a table (kind 5) leads to itself last.
    let mut bytes = whole.clone();
    let mut changed = 0;
    for page in 1..bytes.len() / 512 {
        let at = page * 512;
        if bytes[at] == 5 {
            let number = u32::try_from(page + 1).expect("small").to_be_bytes();
            bytes[at + 8..at + 12].copy_from_slice(&number);
            changed += 1;
        }
    }
    assert!(changed > 0);
    fs::write(&path, &bytes).expect("written");
    refused(&path, &["leads to this page twice"]);
}

#[test]
fn rows_that_share_their_bytes_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shared.db3");
    let mut bytes = fs::read(data("small_pages.db3")).expect("there");
    // Every cell of a leaf page (kind 13) with a picture leads to that picture.
    let mut changed = 0;
    for page in 1..bytes.len() / 512 {
        let at = page * 512;
        if bytes[at] != 13 {
            continue;
        }
        let cells = usize::from(bytes[at + 4]);
        let places: Vec<[u8; 2]> = (0..cells)
            .map(|cell| at + 8 + 2 * cell)
            .map(|place| [bytes[place], bytes[place + 1]])
            .collect();
        let is_picture = |place: &&[u8; 2]| {
            let cell = at + usize::from(u16::from_be_bytes(**place));
            // A length from 3968 to 16383, in two bytes.
            bytes[cell] >= 0x9f && bytes[cell + 1] < 0x80
        };
        let Some(picture) = places.iter().find(is_picture).copied() else {
            continue;
        };
        for cell in 0..cells {
            let place = at + 8 + 2 * cell;
            bytes[place..place + 2].copy_from_slice(&picture);
            changed += 1;
        }
    }
    assert_eq!(changed, 12);
    fs::write(&path, &bytes).expect("written");
    refused(&path, &["the file has 28160", "rows share their bytes"]);
}

#[test]
fn every_cut_of_a_small_bag_is_an_error_in_words() {
    let folder = tempfile::tempdir().expect("a folder");
    for file in WHOLE {
        let whole = fs::read(data(file)).expect("there");
        let path = folder.path().join(file);
        for cut in (0..whole.len()).step_by(193) {
            fs::write(&path, &whole[..cut]).expect("written");
            let found = read_all(&path);
            assert!(found.is_err(), "{file} cut at {cut}: {found:?}");
        }
    }
}

#[test]
fn changed_bytes_of_a_small_bag_are_an_error_or_a_result_and_never_a_panic() {
    let folder = tempfile::tempdir().expect("a folder");
    for file in WHOLE {
        let whole = fs::read(data(file)).expect("there");
        let path = folder.path().join(file);
        let (mut errors, mut results) = (0, 0);
        // The first kilobytes describe the rest. Later bytes are sampled.
        let places = (0..1024.min(whole.len()))
            .step_by(3)
            .chain((1024..whole.len()).step_by(193));
        for place in places {
            let mut bytes = whole.clone();
            bytes[place] ^= 0x55;
            fs::write(&path, &bytes).expect("written");
            match read_all(&path) {
                Ok(_) => results += 1,
                Err(_) => errors += 1,
            }
        }
        assert!(
            errors > 0 && results > 0,
            "{file}: {errors} errors, {results} results"
        );
    }
}
