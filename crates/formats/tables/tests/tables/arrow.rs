//! Tests of tables in Arrow files: every type and nesting must equal what pyarrow reads back. Also tests of rejected files.

use std::fs;
use std::path::PathBuf;

use crate::nested::plain;
use crate::recordings::{expected, recording};
use taceva_tables::{ArrowTable, Cell, ColumnKind, TableError};

fn file(name: &str) -> PathBuf {
    recording("arrow").join(name)
}

fn opened(name: &str) -> ArrowTable {
    ArrowTable::open(&file(name)).expect(name)
}

const FORMS: [&str; 3] = ["stream.arrow", "zstd.arrow", "lz4.feather"];

#[test]
fn every_type_and_nesting_of_a_stream_and_of_a_file_is_read_as_pyarrow_reads_it() {
    let expected = expected("nested");
    for form in FORMS {
        let table = opened(form);
        assert_eq!(table.rows(), 300, "{form}");
        let mut compared = 0;
        for (row, cells) in expected.as_object().expect("rows") {
            let row: usize = row.parse().expect("a number");
            if row >= 300 {
                continue;
            }
            for (name, value) in cells.as_object().expect("columns") {
                let column = table.column(name).expect(name);
                assert_eq!(column.len(), 300);
                assert_eq!(plain(&column[row]), *value, "{form}, {name}, row {row}");
                compared += 1;
            }
        }
        assert_eq!(compared, 7 * 17);
    }
}

/// Cell of the row `row`, as `make.py` writes it: null in every fifth row, otherwise `cell`.
fn some(row: u16, cell: Cell) -> Cell {
    match row % 5 {
        2 => Cell::Null,
        _ => cell,
    }
}

#[test]
fn types_that_parquet_has_not_are_their_numbers_texts_and_times() {
    for form in FORMS {
        let table = opened(form);
        let column = |name: &str| table.column(name).expect(name);
        let all: [Vec<Cell>; 9] = [
            column("wide.text"),
            column("wide.bytes"),
            column("wide.list"),
            column("nothing"),
            column("date"),
            column("time"),
            column("lasts"),
            column("seconds"),
            column("half.list"),
        ];
        for row in 0..300_u16 {
            let at = usize::from(row);
            let low = u8::try_from(row % 256).expect("a byte");
            let integers = (0..row % 4).map(|value| Cell::Integer(value.into()));
            let time = |nanoseconds: i128| some(row, Cell::Time(i128::from(row) * nanoseconds));
            let expected = [
                some(row, Cell::Text("é".repeat(at % 3))),
                some(row, Cell::Bytes(vec![low; at % 4])),
                some(row, Cell::List(integers.collect())),
                Cell::Null,
                time(86_400_000_000_000),
                time(1_000),
                time(1_000_000),
                time(1_000_000_000),
                some(
                    row,
                    Cell::List(vec![Cell::Number(f64::from(row) / 8.0), Cell::Null]),
                ),
            ];
            for (column, expected) in all.iter().zip(expected) {
                assert_eq!(column[at], expected, "{form}, row {row}");
            }
        }
        assert_eq!(table.kind("lasts").expect("there"), ColumnKind::Time("ms"));
        assert_eq!(
            table.kind("half.list[1]").expect("there"),
            ColumnKind::Number
        );
        assert!(matches!(
            table.column("half.list[2]"),
            Err(TableError::Mismatch { .. })
        ));
        assert!(matches!(
            table.column("halves"),
            Err(TableError::Missing { .. })
        ));
    }
}

#[test]
fn bytes_are_handed_over_row_by_row_across_batches_and_nulls() {
    for form in FORMS {
        let table = opened(form);
        let whole = table.column("bytes").expect("reads");
        let wanted: Vec<u64> = [0, 1, 3, 3, 129, 130, 131, 259, 260, 299].to_vec();
        let mut seen = Vec::new();
        let read = table.visit_bytes::<TableError>("bytes", &wanted, &mut |row, bytes| {
            seen.push(row);
            let at = usize::try_from(row).expect("small");
            assert_eq!(
                bytes.map_or(Cell::Null, Cell::Bytes),
                whole[at],
                "row {row}"
            );
            Ok(())
        });
        read.expect("reads");
        assert_eq!(seen, wanted, "{form}");
        let refused = |name: &str, rows: &[u64]| {
            let read = table.visit_bytes::<TableError>(name, rows, &mut |_, _| Ok(()));
            matches!(read, Err(TableError::Mismatch { .. }))
        };
        assert!(refused("text", &[0]) && refused("bytes", &[3, 2]) && refused("bytes", &[300]));
    }
}

#[test]
fn types_that_are_not_read_are_refused_by_their_column_with_the_way_to_write_another() {
    for (name, words) in [
        ("dictionary.arrow", "a dictionary"),
        ("view.arrow", "views of strings"),
        ("union.arrow", "a union"),
    ] {
        let error = ArrowTable::open(&file(name)).expect_err(name);
        assert!(matches!(error, TableError::Unsupported { .. }), "{error}");
        let error = error.to_string();
        for words in [words, "`odd`", "ds.to_parquet("] {
            assert!(error.contains(words), "{error}");
        }
    }
}

#[test]
fn files_that_end_early_are_damaged_wherever_they_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("cut.arrow");
    let whole = fs::read(file("stream.arrow")).expect("readable");
    // The end marker has eight bytes.
    for end in (0..whole.len() - 8).step_by(97).chain([whole.len() - 8]) {
        fs::write(&copy, &whole[..end]).expect("written");
        let error = ArrowTable::open(&copy).expect_err("cut short");
        assert!(
            matches!(error, TableError::Damaged { .. }),
            "{end}: {error}"
        );
    }
    fs::write(&copy, b"Fx,Fy,Fz\n0,0,1\n0,0,2\n").expect("written");
    assert!(matches!(
        ArrowTable::open(&copy),
        Err(TableError::Damaged { .. })
    ));
}
