//! Shards of two tables with tasks. Each shard scores the rows of some clusters.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_dataset::Digest;
use taceva_evaluate::{EvaluateError, ScoreRequest, Shard, TaskRequest, TaskStates, read_table};

use super::Grid;
use crate::error::SweepError;
use crate::file::{LabelsEntry, TablesEntry};
use crate::key::{LabelShardParts, TaskKey};
use crate::task::{SHARD, Task};

/// Two planned tables with tasks.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlannedLabels {
    truth: PathBuf,
    prediction: PathBuf,
    labels: LabelsEntry,
    /// Digests of the truth table and of the prediction table.
    digests: [Digest; 2],
}

impl PlannedLabels {
    /// True if all `states` belong to the planned tables.
    pub(crate) fn is_of(&self, states: &TaskStates) -> bool {
        let [truth, prediction] = self.digests.map(|digest| digest.to_string());
        states.tables().all(|tables| {
            tables.get("truth") == Some(&truth) && tables.get("prediction") == Some(&prediction)
        })
    }

    /// Request that scores `shard`.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a text that is not a task, or for an invalid rule.
    pub(crate) fn request(
        &self,
        shard: Shard,
        jobs: NonZeroUsize,
    ) -> Result<TaskRequest, EvaluateError> {
        Ok(TaskRequest {
            tables: ScoreRequest {
                jobs,
                allow_invalid: self.labels.allow_invalid,
                ..ScoreRequest::of_tables(&self.truth, &self.prediction)
            },
            tasks: self.labels.specs()?,
            rules: self.labels.rules()?,
            cluster: self.labels.cluster.clone(),
            shard,
        })
    }
}

/// One task for each shard. Reads both tables once for their digests.
pub(super) fn grid(entry: &TablesEntry, labels: &LabelsEntry) -> Result<Grid, SweepError> {
    // Absolute, because jobs of a scheduler have another working folder.
    let absolute = |path: &Path| std::path::absolute(path).map_err(SweepError::io("find", path));
    let [truth, prediction] = [absolute(&entry.truth)?, absolute(&entry.prediction)?];
    let digest = |path: &Path| read_table(path, NonZeroUsize::MIN).map(|(_, digest)| digest);
    let digests = [digest(&truth)?, digest(&prediction)?];
    let words = labels.words();
    let tasks = (1..=entry.shards).map(|number| {
        let shard = Shard::new(number, entry.shards);
        let shard = shard.map_err(|error| EvaluateError::Request(error.to_string()))?;
        let key = TaskKey::of_label_shard(LabelShardParts {
            tables: digests,
            shard: &shard.to_string(),
            labels: &words,
        });
        Ok(Task {
            key,
            dataset: entry.name.clone(),
            path: truth.clone(),
            digest: digests[0].to_string(),
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
        tables: None,
        label_tables: Some(PlannedLabels {
            truth,
            prediction,
            labels: labels.clone(),
            digests,
        }),
    })
}
