//! Tests of columns of every type, nesting and encoding that pyarrow writes, compared with what pyarrow reads back.

use crate::recordings::{at, expected, recording};
use serde_json::Value;
use taceva_tables::{Cell, ColumnKind, ParquetTable, TableError};

/// Converts a cell to the JSON that `make.py` writes for it.
pub(crate) fn plain(cell: &Cell) -> Value {
    match cell {
        Cell::Null => Value::Null,
        Cell::Bool(value) => Value::from(*value),
        Cell::Integer(value) => match u64::try_from(*value) {
            Ok(value) => Value::from(value),
            Err(_) => Value::from(i64::try_from(*value).expect("of 64 bits")),
        },
        // `make.py` has one column of times in nanoseconds.
        Cell::Time(nanoseconds) => Value::from(i64::try_from(*nanoseconds).expect("of 64 bits")),
        Cell::Number(value) if value.is_nan() => Value::from("NaN"),
        Cell::Number(value) => Value::from(*value),
        Cell::Text(text) => Value::from(text.as_str()),
        Cell::Bytes(bytes) => Value::from(
            bytes
                .iter()
                .map(|byte| format!("{byte:02x}"))
                .collect::<String>(),
        ),
        Cell::List(cells) => cells.iter().map(plain).collect(),
        Cell::Struct(members) => members
            .iter()
            .map(|(name, cell)| (name.clone(), plain(cell)))
            .collect(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_type_nesting_and_encoding_is_read_as_pyarrow_reads_it() {
    let expected = expected("nested");
    for writing in ["snappy", "plain", "delta", "old"] {
        let path = recording("nested").join(format!("{writing}.parquet"));
        let table = ParquetTable::open(&path).expect(writing);
        assert_eq!(table.rows(), 700);
        for (row, cells) in expected.as_object().expect("rows") {
            assert_eq!(cells.as_object().expect("columns").len(), 17);
            let row: usize = row.parse().expect("a number");
            for (name, value) in cells.as_object().expect("columns") {
                let column = table.column(name).expect(name);
                assert_eq!(column.len(), 700);
                assert_eq!(plain(&column[row]), *value, "{writing}, {name}, row {row}");
            }
        }
    }
}

#[test]
fn a_place_in_a_nest_is_that_of_the_whole_column() {
    let table = ParquetTable::open(&recording("nested").join("snappy.parquet")).expect("opens");
    let whole = table.column("matrix").expect("reads");
    for (part, at) in [
        ("matrix[1,0]", "[1,0]"),
        ("matrix[0][1]", "[0][1]"),
        ("matrix[1]", "[1]"),
    ] {
        for (cell, part) in whole.iter().zip(table.column(part).expect("reads")) {
            assert_eq!(cell.at(at), Some(&part));
        }
    }
    let names = table.names();
    assert!(names.contains(&"odd.name[0]".to_owned()), "{names:?}");
    assert_eq!(
        table.column("odd.name[0]").expect("reads")[699],
        Cell::Integer(699)
    );
}

#[test]
fn rows_that_are_passed_over_leave_the_others_where_they_are() {
    for writing in ["snappy", "plain", "delta", "old"] {
        let path = recording("nested").join(format!("{writing}.parquet"));
        let table = ParquetTable::open(&path).expect(writing);
        for name in ["bytes", "text", "fixed"] {
            let whole = table.column(name).expect(name);
            let rows: Vec<u64> = (0..700)
                .filter(|row| row % 13 == 3 || row % 50 < 4)
                .collect();
            table
                .visit_bytes::<TableError>(name, &rows, &mut |row, bytes| {
                    let expected = match &whole[at(row)] {
                        Cell::Null => None,
                        Cell::Text(text) => Some(text.clone().into_bytes()),
                        Cell::Bytes(bytes) => Some(bytes.clone()),
                        other => panic!("{other:?}"),
                    };
                    assert_eq!(bytes, expected, "{writing}, {name}, row {row}");
                    Ok(())
                })
                .expect(name);
        }
    }
}

#[test]
fn cells_that_are_streamed_are_those_that_pages_decode_to() {
    for codec in ["none", "snappy", "gzip", "brotli", "lz4", "zstd"] {
        for version in [1, 2] {
            let path = recording("plain").join(format!("{codec}-{version}.parquet"));
            let table = ParquetTable::open(&path).expect(codec);
            for name in ["image.bytes", "raw"] {
                let whole = table.column(name).expect(name);
                let nulls = whole.iter().filter(|cell| **cell == Cell::Null).count();
                assert_eq!(nulls, if name == "raw" { 0 } else { 24 });
                for (first, step) in [(0, 1), (3, 7), (0, 49), (89, 1)] {
                    let rows: Vec<u64> = (first..90).step_by(step).collect();
                    let mut seen = 0;
                    table
                        .visit_bytes::<TableError>(name, &rows, &mut |row, bytes| {
                            let cell = bytes.map_or(Cell::Null, Cell::Bytes);
                            assert_eq!(
                                cell,
                                whole[at(row)],
                                "{codec}, {version}, {name}, row {row}"
                            );
                            seen += 1;
                            Ok(())
                        })
                        .expect(name);
                    assert_eq!(seen, rows.len());
                }
            }
            let problem = table.visit_bytes::<TableError>("image", &[0], &mut |_, _| Ok(()));
            let problem = problem.expect_err("a structure").to_string();
            assert!(problem.contains("holds no bytes"), "{problem}");
        }
    }
}

#[test]
fn columns_say_what_they_hold() {
    use ColumnKind::{Bool, Bytes, Integer, List, Number, Struct, Text, Time};
    let table = ParquetTable::open(&recording("nested").join("snappy.parquet")).expect("opens");
    for (name, kind) in [
        ("flag", Bool),
        ("unsigned", Integer),
        ("half", Number),
        ("money", Number),
        ("kind", Text),
        ("bytes", Bytes),
        ("fixed", Bytes),
        ("stamp", Time("ns")),
        ("matrix", List(Box::new(List(Box::new(Number))))),
        ("matrix[0]", List(Box::new(Number))),
        ("matrix[0,1]", Number),
        ("map[0]", Struct),
        ("map[0].value", Number),
        ("deep[0][1].b", Text),
    ] {
        assert_eq!(table.kind(name).expect(name), kind, "{name}");
    }
    assert!(table.kind("matrix[0,1,2]").is_err());
    let old = ParquetTable::open(&recording("nested").join("old.parquet")).expect("opens");
    assert_eq!(old.kind("stamp").expect("a column"), Time("ns"));
}
