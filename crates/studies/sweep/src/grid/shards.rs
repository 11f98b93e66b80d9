//! Shards of two tables as tasks.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_core::Unit;
use taceva_dataset::Digest;
use taceva_evaluate::{EvaluateError, ScoreRequest, ScoreTables, Shard};

use super::{Grid, sensor_digest};
use crate::error::SweepError;
use crate::file::{SweepFile, TablesEntry};
use crate::key::{ShardParts, TaskKey};
use crate::task::{SHARD, Task};

/// Two planned tables, with everything needed to score one shard.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlannedTables {
    truth: PathBuf,
    prediction: PathBuf,
    units: Vec<(String, Unit)>,
    allow_invalid: bool,
    /// Positions of the rows in both tables, and the digests of the tables.
    tables: ScoreTables,
}

impl PlannedTables {
    /// Returns the tables; scans both again if a file has changed.
    ///
    /// # Errors
    /// [`SweepError::Study`] if the content of a table has changed.
    pub(crate) fn again(&self) -> Result<ScoreTables, SweepError> {
        Ok(self.tables.clone().again()?)
    }

    /// Digests of the truth table and of the prediction table.
    pub(crate) fn digests(&self) -> [Digest; 2] {
        self.tables.digests()
    }

    /// Request that scores one shard.
    pub(crate) fn request(
        &self,
        metrics: &[String],
        sensor: Option<&Path>,
        jobs: NonZeroUsize,
    ) -> ScoreRequest {
        ScoreRequest {
            truth: self.truth.clone(),
            prediction: self.prediction.clone(),
            units: self.units.clone(),
            periods: Vec::new(),
            key: None,
            is_independent: false,
            sensor: sensor.map(Path::to_owned),
            metrics: metrics.to_vec(),
            allow_invalid: self.allow_invalid,
            jobs,
        }
    }
}

/// One task for each shard. Scans both tables once for all tasks.
pub(super) fn grid(file: &SweepFile, entry: &TablesEntry) -> Result<Grid, SweepError> {
    // Absolute, because jobs of a scheduler have another working folder.
    let absolute = |path: &Path| std::path::absolute(path).map_err(SweepError::io("find", path));
    let [truth, prediction] = [absolute(&entry.truth)?, absolute(&entry.prediction)?];
    let mut planned = ScoreRequest {
        truth: truth.clone(),
        prediction: prediction.clone(),
        units: entry.units.clone(),
        periods: Vec::new(),
        key: None,
        is_independent: false,
        sensor: file.sensor.clone(),
        metrics: file.metrics.clone(),
        allow_invalid: entry.allow_invalid,
        // One thread for each table.
        jobs: NonZeroUsize::MIN.saturating_add(1),
    };
    let tables = ScoreTables::scan(&planned)?;
    tables.check(&planned)?;
    let sensor = sensor_digest(file)?;
    planned.units.sort_by(|one, other| one.0.cmp(&other.0));
    let tasks = (1..=entry.shards).map(|number| {
        let shard = Shard::new(number, entry.shards);
        let shard = shard.map_err(|error| EvaluateError::Request(error.to_string()))?;
        let key = TaskKey::of_shard(ShardParts {
            tables: tables.digests(),
            shard: &shard.to_string(),
            units: &planned.units,
            allow_invalid: entry.allow_invalid,
            metrics: &file.metrics,
            sensor,
        });
        Ok(Task {
            key,
            dataset: entry.name.clone(),
            path: truth.clone(),
            digest: tables.digests()[0].to_string(),
            labels: None,
            model: "score".to_owned(),
            settings: BTreeMap::from([(SHARD.to_owned(), shard.to_string())]),
            split: None,
            seed: 0,
            plugin: None,
        })
    });
    Ok(Grid {
        tasks: tasks.collect::<Result<_, SweepError>>()?,
        skipped: 0,
        label_tables: None,
        tables: Some(PlannedTables {
            truth,
            prediction,
            units: planned.units,
            allow_invalid: entry.allow_invalid,
            tables,
        }),
    })
}
