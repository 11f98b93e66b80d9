//! Writer of the descriptions of tasks and episodes of a LeRobot 3.0 dataset, one Parquet file each.

use std::path::Path;

use serde_json::json;

use super::writer::{Episode, FILES_A_CHUNK};
use crate::cell::Cell;
use crate::error::TableError;
use crate::parquet::{ParquetWriter, WrittenColumn, WrittenKind};

/// Names of the columns of numbers in `meta/episodes`, in order. The column `tasks` comes after the first.
const NUMBERS: [&str; 8] = [
    "episode_index",
    "length",
    "data/chunk_index",
    "data/file_index",
    "dataset_from_index",
    "dataset_to_index",
    "meta/episodes/chunk_index",
    "meta/episodes/file_index",
];

/// Writes the texts of tasks to `path` as the index of a pandas data frame, where LeRobot searches them.
pub(super) fn describe_tasks(path: &Path, tasks: &[String]) -> Result<(), TableError> {
    const INDEX: &str = "__index_level_0__";
    let column = |name: &str, field: &str, kind: [&str; 2]| json!({ "name": (name != INDEX).then_some(name), "field_name": field, "pandas_type": kind[0], "numpy_type": kind[1], "metadata": null });
    let pandas = json!({
        "index_columns": [INDEX],
        "column_indexes": [{ "name": null, "field_name": null, "pandas_type": "unicode", "numpy_type": "object", "metadata": { "encoding": "UTF-8" } }],
        "columns": [
            column("task_index", "task_index", ["int64", "int64"]),
            column(INDEX, INDEX, ["unicode", "object"]),
        ],
        "creator": { "library": "taceva", "version": env!("CARGO_PKG_VERSION") },
        "pandas_version": "2.0.0",
    });
    let columns = [
        WrittenColumn::new("task_index", WrittenKind::Integer),
        WrittenColumn::new(INDEX, WrittenKind::Text),
    ];
    let mut writer = ParquetWriter::create(path, &columns, &[("pandas", &pandas.to_string())])?;
    for (index, task) in tasks.iter().enumerate() {
        writer.push(vec![Cell::Integer(index as i128), Cell::Text(task.clone())])?;
    }
    writer.finish()
}

/// Writes the row range and the task of each episode to `path`.
pub(super) fn describe_episodes(
    path: &Path,
    episodes: &[Episode],
    tasks: &[String],
) -> Result<(), TableError> {
    let mut columns: Vec<WrittenColumn> = NUMBERS
        .iter()
        .map(|name| WrittenColumn::new(*name, WrittenKind::Integer))
        .collect();
    columns.insert(1, WrittenColumn::new("tasks", WrittenKind::Texts));
    let mut writer = ParquetWriter::create(path, &columns, &[])?;
    for (index, episode) in episodes.iter().enumerate() {
        let length = episode.end - episode.first;
        let numbers = [
            index as u64,
            length,
            episode.file / FILES_A_CHUNK,
            episode.file % FILES_A_CHUNK,
            episode.first,
            episode.end,
            0,
            0,
        ];
        let mut row: Vec<Cell> = numbers.map(|number| Cell::Integer(number.into())).to_vec();
        let tasks = tasks.get(episode.task).cloned().map(Cell::Text);
        row.insert(1, Cell::List(tasks.into_iter().collect()));
        writer.push(row)?;
    }
    writer.finish()
}
