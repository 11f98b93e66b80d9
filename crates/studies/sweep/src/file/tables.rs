//! Tables that a sweep scores in shards.

use std::path::{Path, PathBuf};

use taceva_core::{Unit, shown};
use taceva_models::Suggestion;

use super::labels_entry::LabelsEntry;
use super::place::FilePlace;
use crate::error::SweepError;
use crate::limits::MOST_TASKS;
use crate::syntax::{WrittenScore, WrittenSweep};

/// Two tables scored in shards, with one task per shard.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TablesEntry {
    /// File name of the truth table, as written in the sweep file.
    pub name: String,
    /// Path of the truth table.
    pub truth: PathBuf,
    /// Path of the prediction table.
    pub prediction: PathBuf,
    /// Number of shards.
    pub shards: u32,
    /// Units of channels other than the six standard channels.
    pub units: Vec<(String, Unit)>,
    /// True if non-finite cells are counted and skipped, false if they are rejected.
    pub allow_invalid: bool,
    /// Tasks to score instead of channels; `None` for channels.
    pub labels: Option<LabelsEntry>,
}

impl TablesEntry {
    /// Parses `written`. Paths in it are relative to `folder`.
    pub(super) fn of(
        written: &WrittenScore,
        folder: &Path,
        place: FilePlace<'_>,
    ) -> Result<TablesEntry, SweepError> {
        match u64::from(written.shards) {
            0 => {
                let problem = "`shards = 0`: expected a number from 1";
                return Err(place.wrong("shards", problem.to_owned()));
            }
            shards if shards > MOST_TASKS => {
                let problem = format!("`shards = {shards}`: expected at most {MOST_TASKS}");
                return Err(place.wrong("shards", problem));
            }
            _ => {}
        }
        let unit = |(name, symbol): (&String, &String)| {
            let unit = Unit::from_symbol(symbol);
            unit.map(|unit| (name.clone(), unit)).ok_or_else(|| {
                let known = Unit::ALL.iter().map(|unit| unit.symbol());
                let suggestion = Suggestion::of(symbol, known);
                place.wrong(
                    name,
                    format!("`{name}`: unknown unit `{}`, {suggestion}", shown(symbol)),
                )
            })
        };
        Ok(TablesEntry {
            name: written.truth.to_string_lossy().into_owned(),
            truth: folder.join(&written.truth),
            prediction: folder.join(&written.pred),
            shards: written.shards,
            units: written.units.iter().map(unit).collect::<Result<_, _>>()?,
            allow_invalid: written.allow_invalid,
            labels: LabelsEntry::of(written, place)?,
        })
    }
}

/// Rejects keys of a sweep over recordings in a sweep over tables.
pub(super) fn check_alone(written: &WrittenSweep, place: FilePlace<'_>) -> Result<(), SweepError> {
    let others = [
        ("datasets", !written.datasets.is_empty()),
        ("scenes", !written.scenes.is_empty()),
        ("task", !written.task.is_empty()),
        ("models", !written.models.is_empty()),
        ("seeds", written.seeds.is_some()),
        ("splits", !written.splits.is_empty()),
        ("vary", !written.vary.is_empty()),
        ("where", !written.skip.r#where.is_empty()),
        ("limits", written.limits.is_some()),
    ];
    if let Some((key, _)) = others.iter().find(|(_, is_there)| *is_there) {
        return Err(place.wrong(
            key,
            format!(
                "`{key}` cannot be combined with `[score]`: a sweep evaluates either recordings or tables; write two files"
            ),
        ));
    }
    let has_tasks = written.score.as_ref();
    let has_tasks = has_tasks.is_some_and(|score| !score.task.is_empty());
    let of_channels = [
        ("metrics", !written.metrics.is_empty()),
        ("sensor", written.sensor.is_some()),
    ];
    match of_channels.iter().find(|(_, is_there)| *is_there) {
        Some((key, _)) if has_tasks => Err(place.wrong(
            key,
            format!("`{key}` applies to channels only, but `[score]` has a `task`: omit `{key}`"),
        )),
        _ => Ok(()),
    }
}
