//! Tests of truncated recordings. Opening one gives an error with the number of readable messages. `open_to_cut` reads these messages.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use taceva_tables::{Cell, Recording, TableError};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name)
}

/// Messages of a topic as texts. Each text has the cells of the columns `names`.
fn rows(recording: &Recording, topic: &str, names: &[&str]) -> Vec<String> {
    let table = recording.table(topic).expect("a topic");
    let columns = table.columns(names).expect("reads");
    let row = |row: usize| {
        let cells: Vec<&Cell> = columns.iter().map(|column| &column[row]).collect();
        format!("{cells:?}")
    };
    (0..usize::try_from(table.rows()).expect("few"))
        .map(row)
        .collect()
}

/// Names of the columns of a topic.
fn names(recording: &Recording, topic: &str) -> Vec<String> {
    let table = recording.table(topic).expect("a topic");
    table.names().expect("names")
}

/// Number of readable messages that the error states when the recording at `path` is opened.
#[track_caller]
fn refused(path: &Path) -> u64 {
    match Recording::open(path) {
        Err(TableError::Cut { messages, .. }) => messages,
        other => panic!("{other:?}"),
    }
}

/// Checks that `path` has `messages` readable messages, and that each is also in `whole`.
#[track_caller]
fn read_to_cut(path: &Path, whole: &Recording, messages: u64) {
    let cut = Recording::open_to_cut(path).expect("messages before the cut");
    let length = path.metadata().expect("there").len();
    assert!(cut.cut_at().is_some_and(|at| at <= length));
    let mut read = 0;
    for topic in cut.topics() {
        // Columns of JSON are those of the first message.
        let [own, others] = [&cut, whole].map(|recording| names(recording, &topic.name));
        let both = own.iter().filter(|name| others.contains(name));
        let both: Vec<&str> = both.map(String::as_str).collect();
        assert!(both.len() >= 4, "{}: {both:?}", topic.name);
        let known = rows(whole, &topic.name, &both);
        for row in rows(&cut, &topic.name, &both) {
            assert!(known.contains(&row), "{}: {row}", topic.name);
            read += 1;
        }
    }
    assert_eq!(read, messages, "{}", path.display());
}

#[test]
fn the_messages_before_a_cut_are_counted_when_refused_and_read_on_request() {
    let folder = tempfile::tempdir().expect("a folder");
    for (file, least_counts) in [
        ("bags/none.bag", 3),
        ("bags/lz4.bag", 1),
        ("bags/bz2.bag", 1),
        ("bags/iron.db3", 2),
        ("bags/small_pages.db3", 3),
        ("bags/messages.db3", 1),
        ("mcap/chunks.mcap", 1),
        ("mcap/loose.mcap", 4),
        ("mcap/no_index.mcap", 1),
        ("mcap/no_summary.mcap", 1),
    ] {
        let whole = Recording::open(&data(file)).expect(file);
        assert_eq!(whole.cut_at(), None);
        let bytes = fs::read(data(file)).expect("there");
        let path = folder.path().join("cut");
        let (mut before, mut counts) = (0, BTreeSet::new());
        let last = bytes.len() - 1;
        for cut in (bytes.len() / 4..last)
            .step_by(bytes.len() / 30)
            .chain([last])
        {
            fs::write(&path, &bytes[..cut]).expect("written");
            let messages = refused(&path);
            assert!(
                messages >= before,
                "{file} cut at {cut}: {messages} after {before}"
            );
            match messages {
                0 => {
                    let none = Recording::open_to_cut(&path);
                    assert!(matches!(none, Err(TableError::Cut { .. })), "{none:?}");
                }
                messages => {
                    let said = Recording::open(&path).expect_err("cut").to_string();
                    let one = "; 1 complete message is before the cut: ";
                    assert_eq!(said.contains(one), messages == 1, "{said}");
                    read_to_cut(&path, &whole, messages);
                    counts.insert(messages);
                }
            }
            before = messages;
        }
        assert!(counts.len() >= least_counts, "{file}: {counts:?}");
    }
}

#[test]
fn rows_that_end_behind_the_cut_hide_no_complete_message() {
    let mut bytes = fs::read(data("bags/small_pages.db3")).expect("there");
    // The length of the ninth message, a picture on pages 36 to 44: with it all rows are longer than 40 pages.
    let length = 17_965;
    assert_eq!(bytes[length..length + 3], [0xa2, 0x1e, 9]);
    bytes[length..length + 2].copy_from_slice(&[0xfd, 0x42]);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("cut.db3");
    fs::write(&path, &bytes[..40 * 512]).expect("written");
    assert_eq!(refused(&path), 8);
    let whole = Recording::open(&data("bags/small_pages.db3")).expect("opens");
    read_to_cut(&path, &whole, 8);
}

#[test]
fn messages_behind_the_head_of_a_chunk_whose_length_was_never_written_are_read() {
    let mut bytes = fs::read(data("bags/none.bag")).expect("there");
    let four = |bytes: &[u8], at: usize| {
        let four = bytes[at..at + 4].try_into().expect("four");
        usize::try_from(u32::from_le_bytes(four)).expect("small")
    };
    // The end of the head of a record, behind which the length of its data stands.
    let head_end = |bytes: &[u8], at: usize| at + 4 + four(bytes, at);
    let first = head_end(&bytes, 13);
    let chunk = first + 4 + four(&bytes, first);
    let length = head_end(&bytes, chunk);
    bytes[length..length + 4].fill(0);
    let index = bytes.windows(10).position(|part| part == b"index_pos=");
    let index = index.expect("there") + 10;
    bytes[index..index + 8].fill(0);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.bag");
    fs::write(&path, &bytes).expect("written");
    assert_eq!(refused(&path), 16);
    let whole = Recording::open(&data("bags/none.bag")).expect("opens");
    read_to_cut(&path, &whole, 16);
}

#[test]
fn a_whole_recording_is_read_alike_on_both_ways_and_a_damaged_one_on_neither() {
    let path = data("mcap/chunks.mcap");
    let [open, to_cut] = [Recording::open(&path), Recording::open_to_cut(&path)];
    let [open, to_cut] = [open.expect("opens"), to_cut.expect("opens")];
    assert_eq!(open.topics(), to_cut.topics());
    assert_eq!(to_cut.cut_at(), None);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("changed.bag");
    let mut bytes = fs::read(data("bags/none.bag")).expect("there");
    // The code of the chunk.
    let chunk = bytes.windows(4).position(|part| part == b"op=\x05");
    bytes[chunk.expect("there") + 3] = 0x2a;
    fs::write(&path, &bytes).expect("written");
    for opened in [Recording::open(&path), Recording::open_to_cut(&path)] {
        assert!(
            matches!(opened, Err(TableError::Damaged { .. })),
            "{opened:?}"
        );
    }
}
