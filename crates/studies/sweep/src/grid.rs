//! Tasks for every combination of the varied settings.

mod builds;
mod checks;
mod combinations;
mod label_shards;
mod recordings;
mod shards;

use taceva_dataset::{Digest, SensorFile};
use taceva_models::Models;

use crate::error::SweepError;
use crate::file::SweepFile;
use crate::scene_recording::SceneRecording;
use crate::task::Task;
use combinations::Common;

pub(crate) use builds::build_of;
pub(crate) use label_shards::PlannedLabels;
pub(crate) use shards::PlannedTables;

/// Tasks of a sweep, in the order of its file: recordings, splits, seeds, settings, models; or shards of two tables.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Grid {
    /// The tasks.
    pub tasks: Vec<Task>,
    /// Number of combinations that `[skip]` excludes.
    pub skipped: usize,
    /// Planned tables, whose shards are the tasks; `None` without tables.
    pub(crate) tables: Option<PlannedTables>,
    /// Planned tables with tasks to score, whose shards are the tasks of the sweep; `None` without such tables.
    pub(crate) label_tables: Option<PlannedLabels>,
}

impl Grid {
    /// Plans the tasks of `file`, including tasks on recordings that `scenes` will acquire. Opens each recording once for its digest, without reading frames;
    /// scans tables once. Tasks on a recording that is not acquired yet have provisional keys. These tasks can be counted and checked, and are planned again
    /// once the recording exists.
    ///
    /// # Errors
    /// [`SweepError`] for a grid that is empty or exceeds [`MOST_TASKS`](crate::MOST_TASKS). An unknown model, setting or metric, or an unreadable
    /// recording or table, is also an error.
    pub fn of(
        file: &SweepFile,
        scenes: &[SceneRecording],
        models: &Models,
    ) -> Result<Grid, SweepError> {
        let known = checks::metrics(file);
        if let Some(tables) = &file.tables {
            known?;
            return match &tables.labels {
                Some(labels) => label_shards::grid(tables, labels),
                None => shards::grid(file, tables),
            };
        }
        let named = recordings::named(file, scenes)?;
        checks::size(file, named.len())?;
        known?;
        let sensor = sensor_digest(file)?;
        checks::words(file)?;
        let recordings = recordings::open(file, &named)?;
        let common = Common {
            file,
            sensor,
            builds: builds::builds(file, models)?,
        };
        let grid = common.combined(&recordings);
        if grid.tasks.is_empty() {
            return Err(file.wrong(
                "where",
                format!(
                    "an empty grid: `[skip]` leaves out all {} combinations",
                    grid.skipped
                ),
            ));
        }
        checks::settings(file, &grid, models)?;
        Ok(grid)
    }
}

/// Digest of the file of sensor facts, if any.
pub(crate) fn sensor_digest(file: &SweepFile) -> Result<Option<Digest>, SweepError> {
    let Some(path) = &file.sensor else {
        return Ok(None);
    };
    SensorFile::read(path)?;
    let bytes = std::fs::read(path).map_err(SweepError::io("read", path))?;
    Ok(Some(Digest::of(&bytes)))
}
