//! Scores one shard of the tables of truth and prediction. The result contains sums, which are merged with the sums of other shards.

use taceva_evaluate::{EvaluateError, Shard, UNKNOWN_ORIGIN, Work, task_states};

use super::Common;
use crate::error::SweepError;
use crate::grid::{PlannedLabels, PlannedTables};
use crate::task::{SHARD, Task};

/// Scores the shard of `task` and writes its state.
///
/// # Errors
/// [`SweepError`] if the shard fails. Nothing is written in this case.
pub(super) fn carry_out(
    task: &Task,
    planned: &PlannedTables,
    common: Common<'_>,
    work: Work<'_>,
) -> Result<(), SweepError> {
    let shard = shard_of(task)?;
    let tables = planned.again()?;
    let request = planned.request(
        &common.list.metrics,
        common.list.sensor.as_deref(),
        work.jobs,
    );
    let scored = tables.score(&request, shard, work.progress)?;
    let path = common.folder.result(&task.key);
    let mut bytes = Vec::new();
    let written = scored.state.write(&mut bytes);
    written.map_err(SweepError::io("write", &path))?;
    common.folder.write(&path, &bytes)
}

/// Scores the tasks of the shard of `task` and writes their states.
///
/// # Errors
/// [`SweepError`] if the shard fails, or if a table has changed since planning. Nothing is written in this case.
pub(super) fn carry_out_labels(
    task: &Task,
    planned: &PlannedLabels,
    common: Common<'_>,
    work: Work<'_>,
) -> Result<(), SweepError> {
    let mut states = task_states(&planned.request(shard_of(task)?, work.jobs)?)?;
    if states.sources.is_empty() {
        states.sources.insert(UNKNOWN_ORIGIN.to_owned());
    }
    if !planned.is_of(&states) {
        return Err(SweepError::Changed {
            path: task.path.clone(),
            problem: "the table or its predictions have changed since the sweep was planned"
                .to_owned(),
        });
    }
    let path = common.folder.result(&task.key);
    let mut bytes = Vec::new();
    let written = states.write(&mut bytes);
    written.map_err(SweepError::io("write", &path))?;
    common.folder.write(&path, &bytes)
}

fn shard_of(task: &Task) -> Result<Shard, SweepError> {
    let named = task.settings.get(SHARD).map_or("", String::as_str);
    let shard = named.parse::<Shard>();
    Ok(shard.map_err(|error| EvaluateError::Request(format!("{error}")))?)
}
