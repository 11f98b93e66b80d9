//! Descriptions of episodes and tasks of a LeRobot dataset: JSON lines in version 2.1, Parquet files in version 3.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::files::{inside, json_lines};
use super::pattern::Pattern;
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::parquet::ParquetTable;
use crate::source::Source;

/// Path pattern of the files that describe episodes in version 3 of LeRobot.
const EPISODES: &str = "meta/episodes/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet";

/// Part of a video file that contains one episode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clip {
    pub(super) chunk: u64,
    pub(super) file: u64,
    /// Start of the episode in the video file, s.
    pub(super) from: f64,
}

/// Indices of the episodes in a dataset of version 2.1, in the order of the lines in `meta/episodes.jsonl`.
pub(super) fn of_lines(folder: &Path) -> Result<Vec<u64>, TableError> {
    let (source, lines) = json_lines(folder, "meta/episodes.jsonl")?;
    lines
        .iter()
        .map(|(at, line)| {
            let index = line.get("episode_index").and_then(Value::as_u64);
            index.ok_or_else(|| {
                source.damaged(Place::byte(*at), "an episode has no `episode_index`")
            })
        })
        .collect()
}

/// Stated number of rows by episode index, with the path of the file that states it.
pub(super) fn lengths(
    folder: &Path,
    is_in_lines: bool,
) -> Result<BTreeMap<u64, (u64, PathBuf)>, TableError> {
    let mut lengths = BTreeMap::new();
    if is_in_lines {
        let name = "meta/episodes.jsonl";
        for (_, line) in json_lines(folder, name)?.1 {
            let number = |key: &str| line.get(key).and_then(Value::as_u64);
            if let (Some(episode), Some(length)) = (number("episode_index"), number("length")) {
                lengths.insert(episode, (length, folder.join(name)));
            }
        }
        return Ok(lengths);
    }
    for table in tables(folder)? {
        let names = table.names();
        let has = |name: &str| names.iter().any(|known| known == name);
        if !has("episode_index") || !has("length") {
            continue;
        }
        let columns = [table.column("episode_index")?, table.column("length")?];
        for (episode, length) in columns[0].iter().zip(&columns[1]) {
            let number = |cell: &Cell| match cell {
                Cell::Integer(value) => u64::try_from(*value).ok(),
                _ => None,
            };
            if let (Some(episode), Some(length)) = (number(episode), number(length)) {
                lengths.insert(episode, (length, table.path().to_owned()));
            }
        }
    }
    Ok(lengths)
}

/// Parts of the video files of `key` in version 3, by episode index.
pub(super) fn clips(folder: &Path, key: &str) -> Result<BTreeMap<u64, Clip>, TableError> {
    let mut clips = BTreeMap::new();
    for table in tables(folder)? {
        let column = |name: &str| table.column(&format!("videos/{key}/{name}"));
        let episodes = table.column("episode_index")?;
        let columns = (
            column("chunk_index")?,
            column("file_index")?,
            column("from_timestamp")?,
        );
        let rows = episodes
            .iter()
            .zip(&columns.0)
            .zip(columns.1.iter().zip(&columns.2));
        for ((episode, chunk), (file, from)) in rows {
            let number = |cell: &Cell| match cell {
                Cell::Integer(value) => u64::try_from(*value).ok(),
                _ => None,
            };
            let from = match from {
                Cell::Number(from) if *from >= 0.0 => Some(*from),
                _ => None,
            };
            let (Some(episode), Some(chunk), Some(file), Some(from)) =
                (number(episode), number(chunk), number(file), from)
            else {
                let source = Source::new(table.path())?;
                let problem = format!(
                    "episode {} has no video file or no start time",
                    episode.text()
                );
                return Err(source.damaged(Place::of(key), problem));
            };
            clips.insert(episode, Clip { chunk, file, from });
        }
    }
    Ok(clips)
}

fn tables(folder: &Path) -> Result<Vec<ParquetTable>, TableError> {
    let pattern = Pattern::parse(EPISODES).expect("a pattern");
    let files = pattern.files(folder).map_err(|source| TableError::Io {
        path: folder.join("meta/episodes"),
        source,
    })?;
    files
        .iter()
        .map(|file| ParquetTable::open(&inside(folder, file)?))
        .collect()
}

/// Texts of tasks, by index.
pub(super) fn tasks(
    folder: &Path,
    is_in_lines: bool,
) -> Result<BTreeMap<i128, String>, TableError> {
    if is_in_lines {
        let (source, lines) = json_lines(folder, "meta/tasks.jsonl")?;
        let task = |at: u64, line: &Value| {
            let index = line.get("task_index").and_then(Value::as_u64);
            let task = line.get("task").and_then(Value::as_str);
            let found = index
                .zip(task)
                .map(|(index, task)| (index.into(), task.to_owned()));
            found.ok_or_else(|| source.damaged(Place::byte(at), "expected `task_index` and `task`"))
        };
        return lines.iter().map(|(at, line)| task(*at, line)).collect();
    }
    let table = ParquetTable::open(&inside(folder, "meta/tasks.parquet".as_ref())?)?;
    let indices = table.column("task_index")?;
    // The text is the unnamed index of a pandas data frame.
    let names = table.names();
    let name = names
        .iter()
        .find(|name| *name == "task")
        .or_else(|| names.iter().find(|name| *name != "task_index"));
    let texts = table.column(name.map_or("task", String::as_str))?;
    Ok(indices
        .iter()
        .zip(&texts)
        .filter_map(|(index, text)| match index {
            Cell::Integer(index) => Some((*index, text.text().into_owned())),
            _ => None,
        })
        .collect())
}
