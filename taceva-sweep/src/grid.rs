//! Every combination of what varies, as tasks.

mod checks;
mod recordings;
mod shards;

use std::collections::{BTreeMap, BTreeSet};

use taceva_dataset::{Digest, SensorFile};
use taceva_metrics::catalogue;
use taceva_models::Models;
use taceva_study::StudyError;

use crate::error::SweepError;
use crate::file::{ModelEntry, SweepFile};
use crate::key::{KeyParts, TaskKey};
use crate::task::Task;
use recordings::Recording;

pub(crate) use checks::build_of;
pub(crate) use shards::PlannedTables;

/// The tasks of a sweep, in the order of its file: recordings, splits, seeds, settings, models; or shards of two tables.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Grid {
    /// The tasks.
    pub tasks: Vec<Task>,
    /// Combinations that `[skip]` leaves out.
    pub skipped: usize,
    /// The tables that tasks are shards of.
    pub(crate) tables: Option<PlannedTables>,
}

impl Grid {
    /// The tasks that `file` asks for. Opens each recording once, for its digest, and reads no frame; looks through tables once.
    ///
    /// # Errors
    /// [`SweepError`] for a grid that is empty or larger than [`MOST_TASKS`](crate::MOST_TASKS), a model, a setting or a metric that does not
    /// exist, and a recording or a table that cannot be read.
    pub fn of(file: &SweepFile, models: &Models) -> Result<Grid, SweepError> {
        let metrics = file.metrics.iter().map(String::as_str);
        let known = catalogue::select(metrics).map_err(StudyError::from);
        if let Some(tables) = &file.tables {
            known?;
            return shards::grid(file, tables);
        }
        let named = recordings::named(file)?;
        checks::size(file, named.len())?;
        known?;
        let sensor = sensor_digest(file)?;
        checks::words(file)?;
        let recordings = recordings::open(file, named)?;
        let common = Common {
            file,
            sensor,
            builds: checks::builds(file, models)?,
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

/// The digest of the file that says what is known of the sensor, if there is one.
pub(crate) fn sensor_digest(file: &SweepFile) -> Result<Option<Digest>, SweepError> {
    let Some(path) = &file.sensor else {
        return Ok(None);
    };
    SensorFile::read(path)?;
    let bytes = std::fs::read(path).map_err(SweepError::io("read", path))?;
    Ok(Some(Digest::of(&bytes)))
}

/// What tasks of recordings have in common.
struct Common<'a> {
    file: &'a SweepFile,
    sensor: Option<Digest>,
    /// The build of the plugin behind each model that one offers.
    builds: BTreeMap<String, String>,
}

impl Common<'_> {
    fn combined(&self, recordings: &[Recording]) -> Grid {
        let file = self.file;
        let varied = varied(file);
        let mut grid = Grid {
            tasks: Vec::new(),
            skipped: 0,
            tables: None,
        };
        for recording in recordings {
            for split in &file.splits {
                for &seed in &file.seeds {
                    for settings in &varied {
                        for model in &file.models {
                            let task =
                                self.task(recording, (model, settings), (split.as_deref(), seed));
                            match file.skip.iter().any(|condition| condition.holds(&task)) {
                                true => grid.skipped += 1,
                                false => grid.tasks.push(task),
                            }
                        }
                    }
                }
            }
        }
        // A model whose own setting stands in the place of one that varies comes once for each value; a result is made once.
        let mut known = BTreeSet::new();
        grid.tasks.retain(|task| known.insert(task.key.clone()));
        grid
    }

    fn task(
        &self,
        recording: &Recording,
        (model, varied): (&ModelEntry, &BTreeMap<String, String>),
        (split, seed): (Option<&str>, u64),
    ) -> Task {
        let mut settings = varied.clone();
        settings.extend(model.set.clone());
        let plugin = self.builds.get(&model.name);
        let key = TaskKey::of(KeyParts {
            dataset: recording.digest,
            model: &model.name,
            settings: &settings,
            split,
            seed,
            metrics: &self.file.metrics,
            sensor: self.sensor,
            plugin: plugin.map(String::as_str),
        });
        Task {
            key,
            dataset: recording.name.clone(),
            path: recording.path.clone(),
            digest: recording.digest.to_string(),
            model: model.name.clone(),
            settings,
            split: split.map(str::to_owned),
            seed,
            plugin: plugin.cloned(),
        }
    }
}

/// Every combination of the settings that vary.
fn varied(file: &SweepFile) -> Vec<BTreeMap<String, String>> {
    let mut all = vec![BTreeMap::new()];
    for (key, values) in &file.vary {
        let with = |settings: &BTreeMap<String, String>| {
            let settings = settings.clone();
            values.iter().map(move |value| {
                let mut settings = settings.clone();
                settings.insert(key.clone(), value.clone());
                settings
            })
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}
