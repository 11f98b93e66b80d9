//! Tests with damaged copies of every test file. Each copy gives a result or a typed error that names the file.
//!
//! The code of this crate does not panic, and uses little memory and time.

mod recordings;

use std::path::Path;

use recordings::damage::{Endings, attempt, damage, peak_bytes};
use recordings::recording;
use taceva_tables::{ArrowTable, Cell, LeRobot, ParquetTable, Recording, TableError};

/// Maximum peak memory of this process for reading damaged files of at most 100 KB, bytes.
const BYTES: u64 = 512 << 20;

fn every_column(path: &Path) -> Result<Vec<Vec<Cell>>, TableError> {
    let table = ParquetTable::open(path)?;
    table
        .names()
        .iter()
        .map(|name| table.column(name))
        .collect()
}

fn check_memory() {
    if let Some(peak) = peak_bytes() {
        assert!(peak < BYTES, "{peak} bytes");
    }
}

/// Reads two columns of bytes, one row at a time, as pictures are read. Returns the number of bytes.
fn every_picture(path: &Path) -> Result<usize, TableError> {
    let table = ParquetTable::open(path)?;
    let rows: Vec<u64> = (0..table.rows()).collect();
    let mut bytes = 0;
    for (name, rows) in [("image.bytes", &rows[..]), ("raw", &rows[rows.len() / 2..])] {
        table.visit_bytes::<TableError>(name, rows, &mut |_, cell| {
            bytes += cell.map_or(0, |cell| cell.len());
            Ok(())
        })?;
    }
    Ok(bytes)
}

#[test]
fn damaged_pages_of_pictures_are_refused_or_read() {
    let mut endings = Endings::default();
    for codec in ["none", "snappy", "gzip", "brotli", "lz4", "zstd"] {
        for version in [1, 2] {
            let root = recording("plain");
            let file = format!("{codec}-{version}.parquet");
            damage(&root, &root.join(&file), &mut endings, |copy| {
                every_picture(&copy.join(&file))
            });
        }
    }
    assert_eq!(
        (endings.read + endings.refused, endings.panicked),
        (12 * 46, 0),
        "{endings:?}"
    );
    assert!(endings.refused > 12 * 6, "{endings:?}");
    check_memory();
}

#[test]
fn damaged_parquet_files_are_refused_or_read() {
    let mut endings = Endings::default();
    for (folder, file) in [
        ("parquet-zstd", "run.parquet"),
        ("parquet-gzip", "run.parquet"),
        ("parquet-brotli", "run.parquet"),
        ("parquet-lz4", "run.parquet"),
        ("parquet-none", "run.parquet"),
        ("hf-parquet-png", "data/train-00000-of-00001.parquet"),
        ("hf-parquet-jpeg", "data/train-00000-of-00001.parquet"),
        ("nested", "snappy.parquet"),
        ("nested", "plain.parquet"),
        ("nested", "delta.parquet"),
        ("nested", "old.parquet"),
    ] {
        let root = recording(folder);
        damage(&root, &root.join(file), &mut endings, |copy| {
            every_column(&copy.join(file))
        });
    }
    assert_eq!(endings.read + endings.refused + endings.panicked, 11 * 46);
    assert!(endings.refused > 11 * 6, "{endings:?}");
    check_memory();
}

#[test]
fn damaged_files_of_arrow_are_refused_or_read() {
    let mut endings = Endings::default();
    let every_column = |path: &Path| -> Result<usize, TableError> {
        let table = ArrowTable::open(path)?;
        let rows: Vec<u64> = (0..table.rows()).step_by(7).collect();
        table.visit_bytes::<TableError>("bytes", &rows, &mut |_, _| Ok(()))?;
        let names = table.names();
        let columns = names.iter().map(|name| table.column(name));
        columns.map(|column| Ok(column?.len())).sum()
    };
    let root = recording("arrow");
    for file in ["stream.arrow", "zstd.arrow", "lz4.feather"] {
        damage(&root, &root.join(file), &mut endings, |copy| {
            every_column(&copy.join(file))
        });
    }
    assert_eq!(
        (endings.read + endings.refused, endings.panicked),
        (3 * 46, 0),
        "{endings:?}"
    );
    assert!(endings.refused > 3 * 6, "{endings:?}");
    check_memory();
}

/// Reads all columns and pictures of all topics. A failure in one topic does not stop the others.
fn every_topic(path: &Path) -> Result<usize, TableError> {
    let recording = Recording::open(path)?;
    let mut read = 0;
    let mut first = None;
    for topic in recording.topics() {
        let result = recording.table(&topic.name).and_then(|table| {
            let names = table.names()?;
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            read += table.columns(&names)?.len();
            let rows: Vec<u64> = (0..table.rows()).collect();
            if topic.schema.contains("Image") {
                table.visit_pictures::<TableError>("data", &rows, &mut |_, _| Ok(()))?;
            }
            Ok(())
        });
        first = first.or(result.err());
    }
    first.map_or(Ok(read), Err)
}

#[test]
fn damaged_mcap_files_are_refused_or_read() {
    let mut endings = Endings::default();
    for (folder, file) in [
        ("mcap-none", "run.mcap"),
        ("mcap-lz4", "run.mcap"),
        ("mcap-zstd", "run.mcap"),
        ("mcap", "chunks.mcap"),
        ("mcap", "loose.mcap"),
        ("mcap", "no_index.mcap"),
        ("mcap", "no_summary.mcap"),
    ] {
        let root = recording(folder);
        damage(&root, &root.join(file), &mut endings, |copy| {
            every_topic(&copy.join(file))
        });
    }
    assert_eq!(
        (endings.read + endings.refused, endings.panicked),
        (7 * 46, 0)
    );
    assert!(endings.refused > 7 * 40, "{endings:?}");
    check_memory();
}

fn every_row(folder: &Path) -> Result<usize, TableError> {
    let dataset = LeRobot::open(folder)?;
    let mut read = 0;
    for name in dataset.names() {
        read += dataset.column(name)?.len();
    }
    let videos = dataset
        .features()
        .iter()
        .filter(|feature| feature.dtype == "video");
    for feature in videos {
        read += dataset.video(&feature.name)?.files().len();
    }
    Ok(read)
}

#[test]
fn damaged_folders_of_lerobot_are_refused_or_read() {
    let mut endings = Endings::default();
    let mut files = 0;
    for (folder, damaged) in [
        (
            "lerobot-v3-h264",
            &[
                "meta/info.json",
                "meta/tasks.parquet",
                "data/chunk-000/file-000.parquet",
            ][..],
        ),
        (
            "lerobot-v3-files",
            &[
                "meta/info.json",
                "meta/episodes/chunk-000/file-001.parquet",
                "data/chunk-001/file-000.parquet",
            ],
        ),
        (
            "lerobot-v2.1",
            &[
                "meta/info.json",
                "meta/episodes.jsonl",
                "meta/tasks.jsonl",
                "data/chunk-000/episode_000001.parquet",
            ],
        ),
    ] {
        let root = recording(folder);
        for file in damaged {
            files += 1;
            damage(&root, &root.join(file), &mut endings, every_row);
        }
    }
    assert_eq!(
        endings.read + endings.refused + endings.panicked,
        files * 46
    );
    assert!(endings.refused > files * 6, "{endings:?}");
    check_memory();
}

#[test]
fn no_changed_byte_of_data_with_a_sum_goes_unnoticed() {
    let path = recording("mcap").join("loose.mcap");
    let bytes = std::fs::read(&path).expect("readable");
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("copy.mcap");
    let end = bytes
        .windows(9)
        .rposition(|head| head == [0x0f, 4, 0, 0, 0, 0, 0, 0, 0])
        .expect("the end of the data");
    for at in (0..end).step_by(7) {
        let mut changed = bytes.clone();
        changed[at] ^= 1 << (at % 8);
        std::fs::write(&copy, &changed).expect("written");
        let problem = Recording::open(&copy).expect_err("changed").to_string();
        assert!(
            problem.contains("the checksum of the data") || at < 8,
            "byte {at}: {problem}"
        );
    }
}

#[test]
fn no_changed_byte_of_pages_with_sums_goes_unnoticed() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.parquet");
    let bytes = std::fs::read(path).expect("readable");
    let whole = format!("{:?}", every_column(path.as_ref()).expect("reads"));
    let length = bytes.len();
    let footer =
        u32::from_le_bytes(bytes[length - 8..length - 4].try_into().expect("four")) as usize;
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("copy.parquet");
    let mut sums = 0;
    for at in 4..length - 8 - footer {
        for bit in [0x01, 0x80] {
            let mut changed = bytes.clone();
            changed[at] ^= bit;
            std::fs::write(&copy, &changed).expect("written");
            match attempt(|| every_column(&copy)) {
                Ok(Ok(columns)) => assert_eq!(format!("{columns:?}"), whole, "byte {at}"),
                Ok(Err(error)) => {
                    sums += usize::from(error.to_string().contains("the checksum of the page"))
                }
                // Headers have no checksum. A header with another encoding can make the decoder panic.
                Err(place) => assert!(!place.contains("taceva-tables"), "byte {at}: {place}"),
            }
        }
    }
    assert!(sums > 500, "{sums}");
}
