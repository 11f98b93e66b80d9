//! Tests of time columns that pyarrow writes, of every type and unit. The text of each time in seconds must equal the expected text.

use crate::recordings::{expected, recording};
use taceva_tables::{Cell, ColumnKind, ParquetTable};

fn table(name: &str) -> ParquetTable {
    ParquetTable::open(&recording("times").join(name)).expect("opens")
}

#[test]
fn times_of_every_type_are_in_seconds_by_what_the_file_says() {
    let expected = expected("times");
    let table = table("times.parquet");
    let columns = expected.as_object().expect("columns");
    assert_eq!(columns.len(), 20);
    for (name, texts) in columns {
        let found = table.column(name).expect(name);
        let found: Vec<_> = found.iter().map(Cell::text).collect();
        let texts = texts.as_array().expect("six");
        let texts: Vec<&str> = texts
            .iter()
            .map(|text| text.as_str().unwrap_or_default())
            .collect();
        assert_eq!(found, texts, "{name}");
    }
}

#[test]
fn columns_of_times_say_their_unit_and_integers_have_none() {
    let table = table("times.parquet");
    for unit in ["s", "ms", "us", "ns"] {
        // Parquet has no seconds. pyarrow writes milliseconds instead, except for durations, which it writes as integers.
        let counted = if unit == "s" { "ms" } else { unit };
        for (name, counted) in [
            ("stamp", counted),
            ("zoned", counted),
            ("time", counted),
            ("duration", unit),
        ] {
            let kind = table.kind(&format!("{name}_{unit}")).expect("there");
            assert_eq!(kind, ColumnKind::Time(counted), "{name}_{unit}");
        }
    }
    assert_eq!(table.kind("date32").expect("there"), ColumnKind::Time("d"));
    assert_eq!(
        table.kind("nested.at[0]").expect("there"),
        ColumnKind::Time("ms")
    );
    for name in ["nested.n", "count"] {
        assert_eq!(table.kind(name).expect("there"), ColumnKind::Integer);
    }
}

#[test]
fn time_stamps_of_96_bits_are_the_same() {
    let (new, old) = (table("times.parquet"), table("old.parquet"));
    for name in ["stamp_s", "stamp_ms", "stamp_us", "stamp_ns", "zoned_ns"] {
        let cells = old.column(name).expect(name);
        assert_eq!(cells, new.column(name).expect(name), "{name}");
        assert_eq!(old.kind(name).expect(name), ColumnKind::Time("ns"));
    }
}
