//! Tests with malicious files, and with files whose extension contradicts their format. Reading them gives a typed error and takes little memory.

mod recordings;

use std::path::PathBuf;

use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use recordings::damage::peak_bytes;
use recordings::parquet_file::parquet_file;
use taceva_tables::{Cell, ParquetTable, Recording, TableError};

/// Writes `bytes` into a folder that exists as long as the returned value.
fn file(name: &str, bytes: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("written");
    (folder, path)
}

fn check_memory() {
    if let Some(peak) = peak_bytes() {
        assert!(peak < 512 << 20, "{peak} bytes");
    }
}

/// MCAP record.
fn record(code: u8, fields: &[u8]) -> Vec<u8> {
    let length = fields.len() as u64;
    [&[code][..], &length.to_le_bytes(), fields].concat()
}

fn text(text: &str) -> Vec<u8> {
    let length = u32::try_from(text.len()).expect("short");
    [&length.to_le_bytes()[..], text.as_bytes()].concat()
}

fn schema(encoding: &str, body: &str) -> Vec<u8> {
    record(
        3,
        &[
            &1_u16.to_le_bytes()[..],
            &text("a/msg/B"),
            &text(encoding),
            &text(body),
        ]
        .concat(),
    )
}

fn channel(id: u16, encoding: &str) -> Vec<u8> {
    let fields = [
        &id.to_le_bytes()[..],
        &1_u16.to_le_bytes(),
        &text("/x"),
        &text(encoding),
        &[0; 4],
    ];
    record(4, &fields.concat())
}

fn message(channel: u16, log_time: u64, data: &[u8]) -> Vec<u8> {
    let fields = [
        &channel.to_le_bytes()[..],
        &[0; 4],
        &log_time.to_le_bytes(),
        &log_time.to_le_bytes(),
        data,
    ];
    record(5, &fields.concat())
}

fn chunk(codec: &str, size: u64, packed: &[u8]) -> Vec<u8> {
    let fields = [
        &[0; 16][..],
        &size.to_le_bytes(),
        &[0; 4],
        &text(codec),
        &(packed.len() as u64).to_le_bytes(),
        packed,
    ];
    record(6, &fields.concat())
}

/// MCAP file with `records` and without a summary.
fn mcap(records: &[Vec<u8>]) -> Vec<u8> {
    let magic = &b"\x89MCAP0\r\n"[..];
    let header = record(1, &[0; 8]);
    let end = [record(15, &[0; 4]), record(2, &[0; 20])].concat();
    [magic, &header, &records.concat(), &end, magic].concat()
}

/// First error of reading all messages of the topic `/x` in an MCAP file with `records`.
fn problem(records: &[Vec<u8>]) -> String {
    let (_folder, path) = file("x.mcap", &mcap(records));
    let result = Recording::open(&path).and_then(|recording| {
        let table = recording.table("/x")?;
        let names = table.names()?;
        table.columns(&names.iter().map(String::as_str).collect::<Vec<_>>())
    });
    result.expect_err("hostile").to_string()
}

#[test]
fn chunks_that_announce_more_than_they_hold_are_refused_unpacked() {
    let huge = problem(&[chunk("zstd", 1 << 60, b"x")]);
    assert!(
        huge.contains("`chunk`: 1152921504606846976 decompressed bytes, at most 134217728"),
        "{huge}"
    );
    let mut zeros = lz4_flex::frame::FrameEncoder::new(Vec::new());
    std::io::copy(
        &mut std::io::Read::take(std::io::repeat(0), 300 << 20),
        &mut zeros,
    )
    .expect("packs");
    let bomb = zeros.finish().expect("packs");
    let message = problem(&[chunk("lz4", 1000, &bomb)]);
    assert!(
        message.contains("decompressed to 1001 bytes, expected 1000"),
        "{message}"
    );
    let message = problem(&[chunk("bz2", 1000, b"")]);
    assert!(
        message.contains("compressed by `bz2`, expected none, lz4 or zstd"),
        "{message}"
    );
    check_memory();
}

#[test]
fn a_schema_of_another_message_is_noticed() {
    let described = |body: &str, data: &[u8]| {
        problem(&[
            schema("ros2msg", body),
            channel(1, "cdr"),
            message(1, 5, data),
        ])
    };
    let head = [0, 1, 0, 0];
    let short = described("float64 x\nfloat64 y", &[&head[..], &[0; 8]].concat());
    assert!(
        short.contains("`/x`: `y` of a/B: the message is shorter than its schema"),
        "{short}"
    );
    let long = described("uint8[] data", &[&head[..], &[0xff; 4]].concat());
    assert!(
        long.contains("4294967295 elements are announced, but only 0 bytes follow"),
        "{long}"
    );
    let own = described("B inside", &head);
    assert!(
        own.contains("the schema of a/msg/B: a/B nests deeper than 32 messages"),
        "{own}"
    );
    let pl = described("uint8 x", &[0, 3, 0, 0, 1]);
    assert!(pl.contains("encapsulation 3 of CDR"), "{pl}");
    let many: String = (0..40)
        .map(|depth| format!("===\nMSG: a/L{depth}\nL{} a\nL{} b\n", depth + 1, depth + 1))
        .collect();
    let deep = described(&format!("L0 a\n{many}===\nMSG: a/L40\nint8 x"), &head);
    assert!(deep.contains("nests deeper than 32"), "{deep}");
    let few: String = (0..25)
        .map(|depth| format!("===\nMSG: a/L{depth}\nL{} a\nL{} b\n", depth + 1, depth + 1))
        .collect();
    let wide = described(&format!("L0 a\n{few}===\nMSG: a/L25\nint8 x"), &head);
    assert!(wide.contains("more than 65536 fields"), "{wide}");
    check_memory();
}

#[test]
fn encodings_that_are_not_read_are_refused_by_name() {
    for (of_schema, of_message) in [
        ("ros1msg", "cdr"),
        ("ros2idl", "cdr"),
        ("flatbuffer", "flatbuffer"),
    ] {
        let message = problem(&[
            schema(of_schema, "int8 x"),
            channel(1, of_message),
            message(1, 0, &[]),
        ]);
        let expected = format!(
            "messages in `{of_message}` by a schema in `{of_schema}`, expected `cdr` by `ros2msg`"
        );
        assert!(message.contains(&expected), "{message}");
    }
    let message = problem(&[
        schema("protobuf", "int8 x"),
        channel(1, "protobuf"),
        message(1, 0, &[]),
    ]);
    assert!(
        message.contains("protobuf messages by `a/msg/B`, of which"),
        "{message}"
    );
    let whole = mcap(&[]);
    let (_folder, path) = file("open.mcap", &whole[..whole.len() - 10]);
    let message = Recording::open(&path).expect_err("cut").to_string();
    let expected = "recover the complete messages with `mcap recover`";
    assert!(message.contains(expected), "{message}");
}

#[test]
fn messages_are_in_the_order_of_their_times_and_at_one_time_in_that_of_the_file() {
    let value = |channel: u16, time: u64, value: u8| message(channel, time, &[0, 1, 0, 0, value]);
    let packed = [value(1, 30, 0), value(2, 10, 1), value(1, 20, 2)].concat();
    let records = [
        schema("ros2msg", "uint8 x"),
        channel(1, "cdr"),
        channel(2, "cdr"),
        value(1, 20, 3),
        chunk("", packed.len() as u64, &packed),
        value(2, 20, 4),
    ];
    let (_folder, path) = file("x.mcap", &mcap(&records));
    let table = Recording::open(&path)
        .expect("opens")
        .table("/x")
        .expect("a topic");
    let column = table.column("x").expect("reads");
    assert_eq!(column, [1, 3, 2, 4, 0].map(Cell::Integer));
}

#[test]
fn a_text_that_a_dictionary_repeats_without_end_is_refused_in_time() {
    let (_folder, path) = parquet_file("message x { required binary text (UTF8); }", |column| {
        let ColumnWriter::ByteArrayColumnWriter(column) = column else {
            panic!()
        };
        let text = ByteArray::from(vec![b'x'; 10_000]);
        let batch = vec![text; 100_000];
        for _ in 0..5 {
            column.write_batch(&batch, None, None).expect("written");
        }
    });
    assert!(std::fs::metadata(&path).expect("there").len() < 1 << 20);
    let table = ParquetTable::open(&path).expect("opens");
    let message = table.column("text").expect_err("5 GB").to_string();
    assert!(
        message.contains("`text`: more than 100663296 bytes in memory"),
        "{message}"
    );
    let mut seen = 0;
    table
        .visit_bytes::<TableError>("text", &[0, 250_000, 499_999], &mut |_, bytes| {
            seen += bytes.expect("a text").len();
            Ok(())
        })
        .expect("one at a time");
    assert_eq!(seen, 30_000);
    check_memory();
}

#[test]
fn a_row_of_a_list_without_end_is_refused() {
    let schema = "message x { optional group a (LIST) { repeated group list { optional double element; } } }";
    let (_folder, path) = parquet_file(schema, |column| {
        let ColumnWriter::DoubleColumnWriter(column) = column else {
            panic!()
        };
        let count = 18_000_000;
        let mut repetitions = vec![1_i16; count];
        repetitions[0] = 0;
        column
            .write_batch(&[], Some(&vec![2_i16; count]), Some(&repetitions))
            .expect("written");
    });
    assert!(std::fs::metadata(&path).expect("there").len() < 1 << 20);
    let message = ParquetTable::open(&path)
        .and_then(|table| table.column("a"))
        .expect_err("too long")
        .to_string();
    assert!(
        message.contains("rows of more than 16777216 numbers are not accepted"),
        "{message}"
    );
    check_memory();
}

#[test]
fn footers_that_lie_about_themselves_are_refused() {
    let open = |end: &[u8]| {
        let (_folder, path) = file("x.parquet", &[&b"PAR1"[..], &[0; 30], end].concat());
        ParquetTable::open(&path).expect_err("hostile").to_string()
    };
    assert!(
        open(b"\xff\xff\xff\x00PAR1").contains("the footer has 16777215 bytes, but only 34 bytes")
    );
    assert!(
        open(b"\xff\xff\xff\x7fPAR1").contains("the footer has 2147483647 bytes, at most 33554432")
    );
    assert!(open(b"\x04\x00\x00\x00PARE").contains("the footer is encrypted"));
    assert!(open(b"\x04\x00\x00\x00ABCD").contains("does not end with `PAR1`"));
    let folder = tempfile::tempdir().expect("a folder");
    let message = ParquetTable::open(folder.path())
        .expect_err("a folder")
        .to_string();
    assert!(message.contains("not a regular file"), "{message}");
}
