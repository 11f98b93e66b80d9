//! Tests with Parquet files that pyarrow and Hugging Face datasets wrote. Every value and picture must equal what those libraries read back.

use crate::recordings::{at, expected, number, picture_digest, recording};
use taceva_tables::{Cell, ParquetTable, TableError};

const THREE: [u64; 3] = [0, 7, 23];
const CHANNELS: [&str; 6] = ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"];

/// Compressions of the test files.
const CODECS: [&str; 5] = ["zstd", "gzip", "brotli", "lz4", "none"];

#[test]
fn every_codec_gives_the_same_columns() {
    for codec in CODECS {
        let folder = format!("parquet-{codec}");
        let table = ParquetTable::open(&recording(&folder).join("run.parquet")).expect(codec);
        let expected = expected(&folder);
        assert_eq!(table.rows(), 24);
        assert_eq!(
            table.names(),
            ["t", "ft", "fixed", "pose.x", "pose.y", "pose.z", "png"]
        );
        for (place, channel) in CHANNELS.iter().enumerate() {
            let column = table.column(&format!("ft[{place}]")).expect(codec);
            let single = table.column(&format!("fixed[{place}]")).expect(codec);
            for row in THREE {
                let cell = &column[at(row)];
                assert_eq!(
                    *cell,
                    Cell::Number(number(&expected["labels"][row.to_string()][channel])),
                    "{codec} {row} {channel}"
                );
                let Cell::Number(value) = cell else {
                    unreachable!()
                };
                #[expect(
                    clippy::cast_possible_truncation,
                    reason = "the file has it in single precision"
                )]
                let rounded = f64::from(*value as f32);
                assert_eq!(single[at(row)], Cell::Number(rounded));
            }
        }
        for (name, channel) in [("pose.x", "Px"), ("t", "t_s")] {
            let column = table.column(name).expect(codec);
            for row in THREE {
                let value = number(&expected["labels"][row.to_string()][channel]);
                assert_eq!(column[at(row)], Cell::Number(value), "{codec} {row} {name}");
            }
        }
        let mut seen = Vec::new();
        table
            .visit_bytes::<TableError>("png", &[0, 7, 7, 23], &mut |row, bytes| {
                seen.push((row, picture_digest(&bytes.expect("a picture"))));
                Ok(())
            })
            .expect(codec);
        assert_eq!(
            seen.iter().map(|(row, _)| *row).collect::<Vec<_>>(),
            [0, 7, 7, 23]
        );
        for (row, digest) in seen {
            assert_eq!(
                digest,
                expected["frames_sha256"][row.to_string()],
                "{codec} {row}"
            );
        }
    }
}

#[test]
fn rows_that_are_visited_are_those_of_the_whole_column() {
    for codec in CODECS {
        let path = recording(&format!("parquet-{codec}")).join("run.parquet");
        let table = ParquetTable::open(&path).expect(codec);
        let whole = table.column("png").expect(codec);
        for step in [1, 3, 11] {
            let rows: Vec<u64> = (0..24).step_by(step).collect();
            let mut next = rows.iter();
            table
                .visit_bytes::<TableError>("png", &rows, &mut |row, bytes| {
                    assert_eq!(Some(&row), next.next());
                    assert_eq!(Cell::Bytes(bytes.expect("a picture")), whole[at(row)]);
                    Ok(())
                })
                .expect(codec);
            assert_eq!(next.next(), None);
        }
    }
}

#[test]
fn pictures_of_hugging_face_come_in_their_own_bytes() {
    for kind in ["png", "jpeg"] {
        let folder = format!("hf-parquet-{kind}");
        let path = recording(&folder).join("data/train-00000-of-00001.parquet");
        let table = ParquetTable::open(&path).expect(kind);
        let expected = expected(&folder);
        assert_eq!(
            table.names(),
            ["image.bytes", "image.path", "wrench", "label", "split"]
        );
        let features = table.metadata("huggingface").expect("written by datasets");
        let features: serde_json::Value = serde_json::from_str(features).expect("JSON");
        let classes = &features["info"]["features"]["label"]["names"];
        assert_eq!(*classes, serde_json::json!(["cube", "ball"]));
        assert_eq!(table.metadata("absent"), None);
        let names = table.column("image.path").expect(kind);
        let labels = table.column("label").expect(kind);
        assert_eq!(table.column("split").expect(kind)[23].text(), "train");
        for row in THREE {
            assert_eq!(names[at(row)], Cell::Text(format!("{row}.{kind}")));
            let object = ["cube", "ball"]
                .iter()
                .position(|name| expected["labels"][row.to_string()]["label"] == *name);
            assert_eq!(
                labels[at(row)],
                Cell::Integer(object.expect("a label") as i128)
            );
            let wrench = table.column("wrench").expect(kind);
            for (place, channel) in CHANNELS.iter().enumerate() {
                let value = number(&expected["labels"][row.to_string()][channel]);
                assert_eq!(
                    wrench[at(row)].at(&format!("[{place}]")),
                    Some(&Cell::Number(value))
                );
            }
        }
        table
            .visit_bytes::<TableError>("image.bytes", &THREE, &mut |row, bytes| {
                let bytes = bytes.expect("a picture");
                match kind {
                    "png" => assert_eq!(
                        picture_digest(&bytes),
                        expected["frames_sha256"][row.to_string()]
                    ),
                    // Decoders of JPEG differ. The bytes are the whole bytes of the file.
                    _ => {
                        assert!(bytes.starts_with(&[0xff, 0xd8]) && bytes.ends_with(&[0xff, 0xd9]))
                    }
                }
                Ok(())
            })
            .expect(kind);
    }
}

#[test]
fn what_is_not_there_is_named_with_what_is() {
    let table = ParquetTable::open(&recording("parquet-none").join("run.parquet")).expect("opens");
    for (name, expected) in [
        (
            "pose.w",
            "no `pose.w`, expected one of t, ft, fixed, pose.x",
        ),
        ("force", "no `force`"),
        ("ft.x", "no `ft.x`"),
        ("t[0]", "no `t[0]`"),
        ("ft[0,0]", "no `ft[0,0]`"),
        ("ft[6]", "row 0 (from 0) has no such element"),
    ] {
        let message = table.column(name).expect_err(name).to_string();
        assert!(
            message.contains(expected) && message.contains("run.parquet"),
            "{message}"
        );
    }
    let visit = |name: &str, rows: &[u64]| {
        table
            .visit_bytes::<TableError>(name, rows, &mut |_, _| Ok(()))
            .expect_err(name)
            .to_string()
    };
    assert!(visit("t", &[0]).contains("holds no bytes"));
    assert!(visit("png", &[3, 2]).contains("row 2 is requested after row 3"));
    assert!(
        visit("png", &[24]).contains("row 24 was requested, but there are 24 rows, counted from 0")
    );
}

#[test]
fn an_error_of_the_caller_ends_the_visit() {
    #[derive(Debug)]
    struct Full(u64);
    impl From<TableError> for Full {
        fn from(error: TableError) -> Full {
            panic!("{error}")
        }
    }
    let table = ParquetTable::open(&recording("parquet-none").join("run.parquet")).expect("opens");
    let result = table.visit_bytes("png", &[1, 2, 3], &mut |row, _| match row {
        2 => Err(Full(row)),
        _ => Ok(()),
    });
    assert_eq!(result.expect_err("the second").0, 2);
}

#[test]
fn threads_share_a_table() {
    let table = ParquetTable::open(&recording("parquet-zstd").join("run.parquet")).expect("opens");
    let whole = table.column("png").expect("reads");
    std::thread::scope(|scope| {
        for start in 0..4 {
            let (table, whole) = (&table, &whole);
            scope.spawn(move || {
                let rows: Vec<u64> = (start..24).step_by(4).collect();
                table
                    .visit_bytes::<TableError>("png", &rows, &mut |row, bytes| {
                        assert_eq!(Cell::Bytes(bytes.expect("a picture")), whole[at(row)]);
                        Ok(())
                    })
                    .expect("reads");
            });
        }
    });
}
