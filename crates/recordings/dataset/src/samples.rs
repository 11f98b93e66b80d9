//! `samples.parquet`: file form of the table, with one column per table column.

mod read;
mod rows;
mod write;

use std::fs::File;

use taceva_core::Channels;

use crate::decoder_panic::guarded;
use crate::table::Table;
use crate::task::Task;
use read::read;
use rows::assemble;
use write::write;

/// Encodes `table` as a Parquet file.
pub(crate) fn to_parquet(table: &Table) -> Result<Vec<u8>, String> {
    guarded(|| write(table).map_err(|error| error.to_string()))?
}

/// Decodes the table in `file`, whose digest the caller has checked.
pub(crate) fn from_parquet(
    file: File,
    channels: &Channels,
    attributes: &[String],
    views: &[&str],
    tasks: &[Task],
) -> Result<Table, String> {
    let columns = guarded(|| read(file).map_err(|error| error.to_string()))??;
    assemble(columns, channels, attributes, views, tasks)
}

#[cfg(test)]
mod tests {
    use std::io::{Seek, SeekFrom, Write};

    use taceva_core::{Channel, GratingKind, Limit, Nanometre, Phase};

    use super::*;
    use crate::digest::Digest;
    use crate::table::Row;
    use crate::task::{TaskKind, TaskLabel};

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
        let tasks = table.tasks().iter().map(|own| own.task().clone());
        let tasks: Vec<Task> = tasks.collect();
        from_parquet(file, table.channels(), table.attribute_names(), &[], &tasks)
    }

    /// Table with labels of two tasks, and one row without labels.
    fn table_with_tasks() -> Table {
        let mut slip = Task::new("slip", TaskKind::Event, "point_id");
        slip.names = ["no_slip", "slip"].map(str::to_owned).to_vec();
        let moved = Task::new("moved", TaskKind::Pose, "point_id");
        let channels = Channels::new([Channel::FZ]).expect("one");
        let mut table = Table::new(channels, Vec::new()).with_tasks([slip, moved]);
        let labels = [
            // The pose comes first, because tasks are sorted by name.
            vec![
                Some(TaskLabel::Pose([1.5, -2.0, 0.25, 0.0, 0.0, 0.6, 0.8])),
                Some(TaskLabel::Class(1)),
            ],
            vec![None, Some(TaskLabel::Class(0))],
            vec![None, None],
        ];
        for (number, tasks) in labels.into_iter().enumerate() {
            table.push(Row {
                sample: format!("stroke {number}"),
                truth: vec![Some(0.5)],
                tasks,
                ..Row::default()
            });
        }
        table
    }

    #[test]
    fn labels_of_tasks_read_back_and_absent_ones_stay_absent() {
        let table = table_with_tasks();
        let bytes = to_parquet(&table).expect("writes");
        assert_eq!(read_back(&bytes, &table), Ok(table.clone()));
        let names: Vec<&str> = table.columns().iter().map(|column| column.name).collect();
        assert_eq!(
            names,
            [
                "sample",
                "task.moved.x",
                "task.moved.y",
                "task.moved.z",
                "task.moved.qx",
                "task.moved.qy",
                "task.moved.qz",
                "task.moved.qw",
                "task.slip",
                "Fz"
            ]
        );
        assert_eq!(
            table.as_text("task.slip"),
            Some(vec![
                Some("slip".to_owned()),
                Some("no_slip".to_owned()),
                None
            ])
        );
    }

    #[test]
    fn a_reader_that_knows_no_tasks_reads_the_other_columns_and_the_same_digest() {
        let table = table_with_tasks();
        let mut file = tempfile::tempfile().expect("a file");
        file.write_all(&to_parquet(&table).expect("writes"))
            .expect("written");
        file.seek(SeekFrom::Start(0)).expect("rewound");
        let read = from_parquet(file, table.channels(), &[], &[], &[]).expect("reads");
        assert!(read.tasks().is_empty());
        assert_eq!(read.digest(), table.digest());
        let whole = Digest::of(b"dataset");
        assert_eq!(read.with_tasks_digest(whole), whole);
        assert_ne!(table.with_tasks_digest(whole), whole);
    }

    #[test]
    fn a_class_beyond_the_names_of_its_task_is_damage_with_its_row() {
        let table = table_with_tasks();
        let bytes = to_parquet(&table).expect("writes");
        let mut few = Task::new("slip", TaskKind::Event, "point_id");
        few.names = vec!["no_slip".to_owned()];
        let other = Table::new(table.channels().clone(), Vec::new()).with_tasks([few]);
        assert_eq!(
            read_back(&bytes, &other),
            Err(
                "column `task.slip`, row 0: class 1, but the task has 1 class, counted from 0"
                    .to_owned()
            )
        );
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
