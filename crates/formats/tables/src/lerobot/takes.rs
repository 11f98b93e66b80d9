//! Checks the rows of each episode against its description. Without this check, two recordings with the same episode number would get the same
//! pictures, those of the first recording.

use std::collections::BTreeMap;

use super::LeRobot;
use super::episodes;
use super::info::Layout;
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::source::Source;

/// Continuous recording of one episode in the data files.
#[derive(Clone, Copy)]
struct Take {
    rows: u64,
    last_s: f64,
}

/// Checks that every episode is one continuous recording, with the number of rows in its description. Datasets without episode numbers are not
/// checked.
pub(super) fn check(dataset: &LeRobot) -> Result<(), TableError> {
    let has = |name: &str| dataset.names.iter().any(|known| known == name);
    if !has("episode_index") {
        return Ok(());
    }
    let episodes = dataset.column("episode_index")?;
    let times = match has("timestamp") {
        true => dataset.column("timestamp")?,
        false => Vec::new(),
    };
    let mut takes: BTreeMap<u64, Take> = BTreeMap::new();
    // First row with a time not after the previous row of its episode.
    let mut again: Option<(u64, u64)> = None;
    for (row, episode) in episodes.iter().enumerate() {
        let Cell::Integer(episode) = episode else {
            continue;
        };
        let Ok(episode) = u64::try_from(*episode) else {
            continue;
        };
        let time_s = match times.get(row) {
            Some(Cell::Number(time_s)) => *time_s,
            _ => f64::NAN,
        };
        let take = takes.entry(episode).or_insert(Take {
            rows: 0,
            last_s: f64::NEG_INFINITY,
        });
        if time_s <= take.last_s && again.is_none() {
            again = Some((episode, row as u64));
        }
        take.rows += 1;
        take.last_s = time_s;
    }
    let lengths = episodes::lengths(&dataset.folder, dataset.info.layout == Layout::V21)?;
    for (episode, take) in &takes {
        if let Some((length, described)) = lengths.get(episode)
            && *length != take.rows
        {
            let problem = format!(
                "episode {episode} has {} rows, but its description states {length}, so its pictures cannot be assigned: renumber the takes or correct `length`",
                take.rows
            );
            return Err(Source::new(described)?.damaged(Place::of("length"), problem));
        }
    }
    match again {
        None => Ok(()),
        Some((episode, row)) => {
            let problem = format!(
                "row {row}: `timestamp` does not increase within episode {episode}, so it holds two takes or one frame twice: renumber \
                 the takes"
            );
            Err(dataset.source.damaged(Place::of("episode_index"), problem))
        }
    }
}
