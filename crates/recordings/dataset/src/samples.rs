//! `samples.parquet`: file form of the table, with one column per table column.

mod read;
mod rows;
mod write;

use std::fs::File;

use taceva_core::Channels;

use crate::decoder_panic::guarded;
use crate::table::Table;
use read::read;
use rows::assemble;
use write::write;

/// Encodes `table` as a file.
pub(crate) fn to_parquet(table: &Table) -> Result<Vec<u8>, String> {
    guarded(|| write(table).map_err(|error| error.to_string()))?
}

/// Decodes the table in `file`, whose digest the caller has checked.
pub(crate) fn from_parquet(
    file: File,
    channels: &Channels,
    attributes: &[String],
    views: &[&str],
) -> Result<Table, String> {
    let columns = guarded(|| read(file).map_err(|error| error.to_string()))??;
    assemble(columns, channels, attributes, views)
}

#[cfg(test)]
mod tests {
    use std::io::{Seek, SeekFrom, Write};

    use taceva_core::{Channel, GratingKind, Limit, Nanometre, Phase};

    use super::*;
    use crate::table::Row;

    fn table(rows: u8) -> Table {
        let channels = Channels::new([Channel::FZ, Channel::PZ]).expect("distinct");
        let mut table = Table::new(channels, vec!["video".to_owned()]);
        for row in 0..rows {
            let is_even = row % 2 == 0;
            table.push(Row {
                sample: format!("sample {row}"),
                point_id: is_even.then(|| format!("p{}", row / 4)),
                repeat: Some(u32::MAX - u32::from(row)),
                phase: is_even.then_some(Phase::Load),
                limited_by: (row == 4).then_some(Limit::NormalForce),
                zero_u_mm: is_even.then_some(0.004),
                t_s: Some(1.7e9 + f64::from(row)),
                kind: is_even.then_some(GratingKind::Dot),
                spacing: Some(Nanometre(350_000 + i64::from(row))),
                intensity: is_even.then_some(107.3),
                truth: vec![is_even.then_some(-0.0), Some(f64::from(row) / 3.0)],
                attributes: vec![Some("ä,\"\n".to_owned()).filter(|_| is_even)],
                ..Row::default()
            });
        }
        table
    }

    fn read_back(bytes: &[u8], table: &Table) -> Result<Table, String> {
        let mut file = tempfile::tempfile().expect("a file");
        file.write_all(bytes).expect("written");
        file.seek(SeekFrom::Start(0)).expect("rewound");
        from_parquet(file, table.channels(), table.attribute_names(), &[])
    }

    #[test]
    fn a_table_reads_back_bit_for_bit() {
        for rows in [0, 1, 50] {
            let table = table(rows);
            let bytes = to_parquet(&table).expect("writes");
            let read = read_back(&bytes, &table).expect("reads");
            assert_eq!(read, table);
            assert_eq!(read.digest(), table.digest());
        }
    }

    #[test]
    fn the_same_table_gives_the_same_bytes() {
        assert_eq!(to_parquet(&table(9)), to_parquet(&table(9)));
    }

    #[test]
    fn damaged_files_reach_nobody_as_a_panic() {
        let table = table(50);
        let bytes = to_parquet(&table).expect("writes");
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << (at % 8);
            let _ = read_back(&damaged, &table);
            assert!(read_back(&bytes[..at], &table).is_err(), "cut at {at}");
        }
    }
}
